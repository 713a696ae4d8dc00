//! Trimmed offsets of a closed blade section of 50 poles, 100 mm long, one thread: time, the curves
//! and poles found, and how far their points are from the distance asked.

use bladesmith::nurbs::{KnotVector, NurbsCurve};
use bladesmith::ops::invert::CurveInverter;
use bladesmith::ops::offset::Offset;
use glam::DVec2;
use std::hint::black_box;
use std::time::Instant;

const ROUNDS: usize = 30;
const TOLERANCE_MM: f64 = 1e-6;

fn main() {
    let section = section();
    let p = section.poles();
    let area: f64 = p.windows(2).map(|w| w[0].perp_dot(w[1])).sum();
    println!("{:>9} {:>9} {:>7} {:>6} {:>12}", "inward mm", "ms", "curves", "poles", "worst mm");
    for inward in [-3.0, -1.0, 1.0, 1.5, 2.5, 3.0] {
        let offset = Offset::new(inward * area.signum(), TOLERANCE_MM);
        let mut best = f64::MAX;
        for _ in 0..ROUNDS {
            let start = Instant::now();
            black_box(offset.trimmed(&section).expect("an offset"));
            best = best.min(start.elapsed().as_secs_f64());
        }
        let found = offset.trimmed(&section).expect("an offset");
        let inverter = CurveInverter::new(&section).expect("a curve");
        let mut worst = 0.0f64;
        for part in &found {
            let (a, b) = part.curve.knots().domain();
            for i in 0..=2000 {
                let p = part.curve.point(a + (b - a) * i as f64 / 2000.0);
                worst = worst.max((inverter.nearest(p).distance - inward.abs()).abs());
            }
        }
        let poles: usize = found.iter().map(|f| f.curve.poles().len()).sum();
        println!("{inward:>9} {:>9.3} {:>7} {poles:>6} {worst:>12.1e}", 1e3 * best, found.len());
    }
}

/// A cambered four-digit profile, 10 % thick, run from the trailing edge along its pressure side to
/// the nose and back; the last pole is the first.
fn section() -> NurbsCurve<DVec2> {
    const POLES: usize = 50;
    let breaks: Vec<f64> = (0..=POLES - 3).map(|i| i as f64 / (POLES - 3) as f64).collect();
    let knots = KnotVector::clamped(3, &breaks).expect("knots");
    let pole = |s: f64| {
        let c = (std::f64::consts::PI * s).cos();
        let x = c * c;
        let even = x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1015 * x)));
        let thickness = 0.5 * (0.2969 * c + c.signum() * even);
        100.0 * DVec2::new(x, 0.48 * x * (1.0 - x) - thickness)
    };
    let mut poles: Vec<DVec2> = knots.greville().into_iter().map(pole).collect();
    poles[POLES - 1] = poles[0];
    NurbsCurve::new(knots, poles, None).expect("a curve")
}
