//! Random curves, and crossings by brute force.

use bladesmith::nurbs::{KnotVector, NurbsCurve, Point};
use glam::DVec2;

/// Numbers in 0..1, the same in every run.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn within(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.next()
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }
}

/// A plane curve of random shape: uneven knots, some of them multiple up to a kink, clamped or not.
pub fn curve(random: &mut Random, degree: usize, rational: bool) -> NurbsCurve<DVec2> {
    let spans = 1 + random.below(6);
    let mut flat = vec![0.0; degree + 1];
    let mut at = 0.0;
    for _ in 1..spans {
        at += random.within(0.1, 1.0);
        let times = if random.next() < 0.2 { 1 + random.below(degree) } else { 1 };
        flat.extend(std::iter::repeat_n(at, times));
    }
    at += random.within(0.1, 1.0);
    flat.extend(std::iter::repeat_n(at, degree + 1));
    if random.next() < 0.2 {
        for k in 0..degree {
            flat[k] -= 0.3 * (degree - k) as f64;
        }
    }
    let knots = KnotVector::new(degree, flat).unwrap();
    let poles = (0..knots.len()).map(|_| DVec2::new(random.within(-5.0, 5.0), random.within(-5.0, 5.0)));
    let poles = poles.collect();
    let weights = rational.then(|| (0..knots.len()).map(|_| random.within(0.2, 4.0)).collect());
    NurbsCurve::new(knots, poles, weights).unwrap()
}

/// Points at parameters that divide every span evenly.
pub fn polyline<P: Point>(curve: &NurbsCurve<P>, each: usize) -> Vec<(f64, P)> {
    let breaks = curve.knots().breaks();
    let mut out = Vec::new();
    for w in breaks.windows(2) {
        out.extend((0..each).map(|k| w[0] + (w[1] - w[0]) * k as f64 / each as f64));
    }
    out.push(breaks[breaks.len() - 1]);
    out.into_iter().map(|t| (t, curve.point(t))).collect()
}

/// Newton's method for a crossing from a start, kept within the domains; none where it fails.
pub fn newton(a: &NurbsCurve<DVec2>, b: &NurbsCurve<DVec2>, mut at: [f64; 2]) -> Option<[f64; 2]> {
    let within = |curve: &NurbsCurve<DVec2>, t: f64| {
        let (from, to) = curve.knots().domain();
        t.clamp(from, to)
    };
    for _ in 0..30 {
        let ([p, d, _], [q, e, _]) = (a.derivatives(at[0]), b.derivatives(at[1]));
        let (gap, det) = (q - p, d.perp_dot(e));
        let by = [gap.perp_dot(e) / det, gap.perp_dot(d) / det];
        if !(by[0].is_finite() && by[1].is_finite()) {
            return None;
        }
        at = [within(a, at[0] + by[0]), within(b, at[1] + by[1])];
        if by[0].abs() < 1e-14 && by[1].abs() < 1e-14 {
            break;
        }
    }
    (a.point(at[0]).distance(b.point(at[1])) < 1e-11).then_some(at)
}

/// Parameters of crossings, from all pairs of chords whose boxes meet.
pub fn brute_force(a: &NurbsCurve<DVec2>, b: &NurbsCurve<DVec2>, each: usize) -> Vec<[f64; 2]> {
    let (p, q) = (polyline(a, each), polyline(b, each));
    let boxed = |w: &[(f64, DVec2)]| {
        let margin = DVec2::splat(0.1 * w[0].1.distance(w[1].1));
        (w[0].1.min(w[1].1) - margin, w[0].1.max(w[1].1) + margin)
    };
    let boxes: Vec<_> = q.windows(2).map(boxed).collect();
    let mut roots: Vec<[f64; 2]> = Vec::new();
    for w in p.windows(2) {
        let (low, high) = boxed(w);
        for (v, (l, h)) in q.windows(2).zip(&boxes) {
            if !(low.cmple(*h).all() && high.cmpge(*l).all()) {
                continue;
            }
            let start = [0.5 * (w[0].0 + w[1].0), 0.5 * (v[0].0 + v[1].0)];
            let Some(root) = newton(a, b, start) else { continue };
            let known = |r: &[f64; 2]| (r[0] - root[0]).abs() < 1e-7 && (r[1] - root[1]).abs() < 1e-7;
            if !roots.iter().any(known) {
                roots.push(root);
            }
        }
    }
    roots
}
