//! Points and derivatives of surfaces at random parameters, one thread, against a plain de Boor
//! scheme in the same run.

use bladesmith::nurbs::{KnotVector, NurbsSurface, SurfaceDerivatives, SurfaceEvaluator};
use glam::{DVec2, DVec3};
use std::hint::black_box;
use std::time::Instant;

const POINTS: usize = 100_000;
const ROUNDS: usize = 25;

fn main() {
    let uv: Vec<DVec2> = (1..=POINTS)
        .map(|k| DVec2::new((k as f64 * 0.754_877_666).fract(), (k as f64 * 0.569_840_291).fract()))
        .collect();
    println!("{:<34} {:>10} {:>10} {:>10} {:>8}", "ns a point", "batch", "single", "de Boor", "ratio");
    for (p, q, rational) in [(3, 3, false), (5, 3, true), (5, 5, false), (2, 2, true)] {
        let s = surface(p, q, rational);
        let kind = if rational { "rational" } else { "polynomial" };
        let naive = best(|| uv.iter().map(|uv| de_boor(&s, *uv).x).sum());
        let mut points = vec![DVec3::ZERO; POINTS];
        let batch = best(|| {
            SurfaceEvaluator::new(&s).points_into(&uv, &mut points);
            points[POINTS / 2].x
        });
        let single = best(|| uv.iter().map(|uv| s.point(uv.x, uv.y).x).sum());
        row(&format!("points, {p} × {q} {kind}"), [batch, single, naive]);
        let mut jets = vec![SurfaceDerivatives::default(); POINTS];
        let batch = best(|| {
            SurfaceEvaluator::new(&s).derivatives_into(&uv, &mut jets);
            jets[POINTS / 2].s.x
        });
        let single = best(|| uv.iter().map(|uv| s.derivatives(uv.x, uv.y).uv.x).sum());
        row(&format!("two derivatives, {p} × {q} {kind}"), [batch, single, naive]);
    }
}

fn row(name: &str, [batch, single, naive]: [f64; 3]) {
    println!("{name:<34} {batch:>10.1} {single:>10.1} {naive:>10.1} {:>8.1}", naive / batch);
}

/// A wavy sheet of 60 × 40 poles over uneven knots.
fn surface(p: usize, q: usize, rational: bool) -> NurbsSurface {
    let knots = |degree: usize, poles: usize| {
        let spans = poles - degree;
        let at = |i: usize| (i as f64 + 0.3 * (i as f64).sin() * f64::from(i < spans)) / spans as f64;
        KnotVector::clamped(degree, &(0..=spans).map(at).collect::<Vec<_>>()).expect("knots")
    };
    let pole = |k: usize| {
        let (x, y) = ((k / 40) as f64, (k % 40) as f64);
        DVec3::new(x, y, (0.3 * x).sin() * (0.4 * y).cos())
    };
    let weights = rational.then(|| (0..2400).map(|k| 1.0 + 0.5 * (k as f64).sin()).collect());
    NurbsSurface::new(knots(p, 60), knots(q, 40), (0..2400).map(pole).collect(), weights).expect("a surface")
}

/// One point by de Boor's scheme in each direction, homogeneous.
fn de_boor(s: &NurbsSurface, uv: DVec2) -> DVec3 {
    let (ku, kv) = (s.knots_u(), s.knots_v());
    let weight = |i: usize| s.weights().map_or(1.0, |w| w[i]);
    let (su, sv) = (ku.span(uv.x), kv.span(uv.y));
    let line = |i: usize| {
        let pole = |j: usize| {
            let k = i * kv.len() + j;
            (s.poles()[k] * weight(k)).extend(weight(k))
        };
        corners(kv, sv, uv.y, (sv - kv.degree()..=sv).map(pole).collect())
    };
    let sum = corners(ku, su, uv.x, (su - ku.degree()..=su).map(line).collect());
    sum.truncate() / sum.w
}

fn corners(knots: &KnotVector, span: usize, t: f64, mut d: Vec<glam::DVec4>) -> glam::DVec4 {
    let (p, k) = (knots.degree(), knots.flat());
    for r in 1..=p {
        for j in (r..=p).rev() {
            let i = span - p + j;
            let a = (t - k[i]) / (k[i + p + 1 - r] - k[i]);
            d[j] = d[j - 1] * (1.0 - a) + d[j] * a;
        }
    }
    d[p]
}

/// The shortest of some rounds, in nanoseconds a point.
fn best(mut work: impl FnMut() -> f64) -> f64 {
    let round = |_| {
        let start = Instant::now();
        black_box(work());
        start.elapsed().as_secs_f64()
    };
    (0..ROUNDS).map(round).fold(f64::MAX, f64::min) * 1e9 / POINTS as f64
}
