//! Crossings of two plane curves of 50 poles each, one thread: a wave of ten periods and a slow one
//! through it. All twenty must be found.

use bladesmith::nurbs::{KnotVector, NurbsCurve};
use bladesmith::ops::intersect::{curves, self_intersections};
use glam::DVec2;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

const POLES: usize = 50;
const ROUNDS: usize = 2000;

fn main() {
    let fast = wave(0.4, |x| DVec2::new(100.0 * x, 8.0 * (TAU * 10.0 * x).sin()));
    let slow = wave(-0.3, |x| DVec2::new(100.0 * x, 2.0 * (TAU * 1.3 * x + 0.4).sin()));
    let coil = wave(0.2, |x| DVec2::from_angle(TAU * 5.0 * x) * 8.0 + DVec2::new(60.0 * x, 0.0));
    println!("{:<44} {:>6} {:>8}", "", "found", "µs");
    row("two cubic curves", || curves(&fast, &slow, 1e-7).expect("few places").crossings.len());
    let heavy = |c: &NurbsCurve<DVec2>| {
        let weights = (0..POLES).map(|k| 1.0 + 0.3 * (k as f64).sin()).collect();
        NurbsCurve::new(c.knots().clone(), c.poles().to_vec(), Some(weights)).expect("a curve")
    };
    let [fast, slow] = [heavy(&fast), heavy(&slow)];
    row("the same with weights", || curves(&fast, &slow, 1e-7).expect("few places").crossings.len());
    row("a coil with itself", || self_intersections(&coil, 1e-7).expect("few places").crossings.len());
}

/// A cubic over uneven knots with its poles on a line.
fn wave(unevenness: f64, at: impl Fn(f64) -> DVec2) -> NurbsCurve<DVec2> {
    let spans = POLES - 3;
    let inner = |k: usize| f64::from(k > 0 && k < spans) * unevenness * (3.0 * k as f64).sin();
    let breaks: Vec<f64> = (0..=spans).map(|k| (k as f64 + inner(k)) / spans as f64).collect();
    let knots = KnotVector::clamped(3, &breaks).expect("knots");
    let poles = knots.greville().into_iter().map(at).collect();
    NurbsCurve::new(knots, poles, None).expect("a curve")
}

/// The shortest of many rounds.
fn row(name: &str, work: impl Fn() -> usize) {
    let round = |_| {
        let start = Instant::now();
        let found = black_box(work());
        (start.elapsed().as_secs_f64() * 1e6, found)
    };
    let best = (0..ROUNDS).map(round).min_by(|a, b| a.0.total_cmp(&b.0)).expect("some rounds");
    println!("{name:<44} {:>6} {:>8.1}", best.1, best.0);
}
