//! Bounds of the curvature of planar Bézier pieces.
//!
//! With the homogeneous point (X, w) a curve has the velocity V / w² where V = w X' − w' X, and the
//! curvature (V × V') w² / |V|³. Its square is a quotient of two polynomials: in Bernstein form of one
//! degree, with positive coefficients below, it lies between the least and the largest quotient of
//! coefficients. That is exact for circles, and misses by the square of a short piece's length.

use crate::ops::invert::bezier::{CurvePiece, halve};
use glam::DVec2;
use std::ops::{Add, Mul, Sub};

/// What the curvature of a piece is made of, as Bernstein coefficients.
#[derive(Debug, Clone)]
pub struct Bend {
    /// V.
    velocity: Vec<DVec2>,
    /// V × V'.
    turning: Vec<f64>,
    /// w; one number where it is constant.
    weights: Vec<f64>,
}

impl Bend {
    /// That of a piece.
    pub fn new(piece: &CurvePiece<DVec2>) -> Self {
        let (w, p) = (&piece.weights, piece.poles.len() as f64 - 1.0);
        // Seen from its start, a piece far from the origin keeps its digits.
        let start = piece.poles[0] / w[0];
        let top = w.iter().copied().fold(0.0, f64::max);
        let poles: Vec<DVec2> = piece.poles.iter().zip(w).map(|(&x, &w)| (x - start * w) / top).collect();
        let (velocity, weights) = if w.iter().all(|&x| x == w[0]) {
            (steps(&poles, p), vec![1.0])
        } else {
            let weights: Vec<f64> = w.iter().map(|w| w / top).collect();
            let grown = product(&steps(&poles, p), &weights, |d, w| d * w);
            let shrunk = product(&poles, &steps(&weights, p), |x, d| x * d);
            (grown.into_iter().zip(shrunk).map(|(a, b)| a - b).collect(), weights)
        };
        let change = steps(&velocity, velocity.len() as f64 - 1.0);
        let turning =
            if change.is_empty() { vec![0.0] } else { product(&velocity, &change, DVec2::perp_dot) };
        Self { velocity, turning, weights }
    }

    /// That of both halves.
    pub fn halves(mut self) -> [Self; 2] {
        let (velocity, turning) = (halve(&mut self.velocity), halve(&mut self.turning));
        let weights = halve(&mut self.weights);
        [self, Self { velocity, turning, weights }]
    }

    /// Least and largest curvature, positive to the left; infinite where the bounds do not tell the
    /// velocity from zero.
    pub fn curvatures(&self) -> [f64; 2] {
        let unit = self.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
        let velocity: Vec<DVec2> = self.velocity.iter().map(|&v| v / unit).collect();
        let velocity = scaled(&velocity);
        let squared = convolved(&velocity, &velocity, DVec2::dot);
        let times = |a: &[f64], b: &[f64]| convolved(a, b, |x, y| x * y);
        let below = times(&times(&squared, &squared), &squared);
        let turning: Vec<f64> = self.turning.iter().map(|t| t / (unit * unit)).collect();
        let (turning, weights) = (scaled(&turning), scaled(&self.weights));
        let weights = times(&weights, &weights);
        let above = times(&times(&turning, &turning), &times(&weights, &weights));
        let above = times(&above, &binomials(below.len() - above.len()));
        if !below.iter().all(|&b| b > 0.0) {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        let quotients = above.iter().zip(&below).map(|(a, b)| a / b);
        let [least, largest] = quotients.fold([f64::INFINITY, 0.0], |[l, h], q| [l.min(q), h.max(q)]);
        let [least, largest] = [least.max(0.0), largest].map(|square| square.sqrt() / unit);
        if turning.iter().all(|&t| t >= 0.0) {
            [least, largest]
        } else if turning.iter().all(|&t| t <= 0.0) {
            [-largest, -least]
        } else {
            [-largest, largest]
        }
    }
}

fn steps<T: Copy + Sub<Output = T> + Mul<f64, Output = T>>(of: &[T], factor: f64) -> Vec<T> {
    of.windows(2).map(|s| (s[1] - s[0]) * factor).collect()
}

/// `n` over `k` for all `k`.
fn binomials(n: usize) -> Vec<f64> {
    (0..=n).scan(1.0, |b, k| Some(std::mem::replace(b, *b * (n - k) as f64 / (k + 1) as f64))).collect()
}

/// Bernstein coefficients times their binomials: products are convolutions of these.
fn scaled<T: Copy + Mul<f64, Output = T>>(of: &[T]) -> Vec<T> {
    of.iter().zip(binomials(of.len() - 1)).map(|(&x, b)| x * b).collect()
}

fn convolved<A: Copy, B: Copy, C>(a: &[A], b: &[B], each: impl Fn(A, B) -> C) -> Vec<C>
where
    C: Copy + Default + Add<Output = C>,
{
    let mut out = vec![C::default(); a.len() + b.len() - 1];
    for (i, &x) in a.iter().enumerate() {
        for (j, &y) in b.iter().enumerate() {
            out[i + j] = out[i + j] + each(x, y);
        }
    }
    out
}

/// The product of two polynomials in Bernstein form.
fn product<A, B, C>(a: &[A], b: &[B], each: impl Fn(A, B) -> C) -> Vec<C>
where
    A: Copy + Mul<f64, Output = A>,
    B: Copy + Mul<f64, Output = B>,
    C: Copy + Default + Add<Output = C> + Mul<f64, Output = C>,
{
    let sums = convolved(&scaled(a), &scaled(b), each);
    let binomials = binomials(sums.len() - 1);
    sums.iter().zip(binomials).map(|(&s, b)| s * (1.0 / b)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::{KnotVector, NurbsCurve};
    use crate::ops::invert::CurveInverter;
    use crate::ops::invert::bezier::curve_pieces;
    use crate::ops::offset::Offset;
    use std::f64::consts::FRAC_PI_2;

    /// Curves of all degrees, some rational, with poles in a ring so that few stand still.
    fn curves() -> impl Iterator<Item = NurbsCurve<DVec2>> {
        (1..=9).flat_map(|degree| (0..20).map(move |i| (degree, i))).map(|(degree, i)| {
            let knots = KnotVector::clamped(degree, &[0.0, 0.01, 0.6, 1.0]).unwrap();
            let noise = |k: usize| ((k * 7919 + i * 104_729) as f64 * 0.618).fract();
            let pole = |k: usize| {
                DVec2::from_angle(k as f64) * (1.0 + noise(k)) + DVec2::splat(1e3 * (i % 2) as f64)
            };
            let poles: Vec<DVec2> = (0..knots.len()).map(pole).collect();
            let weights = (i % 4 > 1).then(|| (0..knots.len()).map(|k| 0.1 + 3.0 * noise(k + 50)).collect());
            NurbsCurve::new(knots, poles, weights).unwrap()
        })
    }

    #[test]
    fn no_curvature_lies_beyond_the_bounds_and_they_close_in() {
        let (mut seen, mut widest) = (0, 0.0f64);
        for curve in curves() {
            for piece in curve_pieces(&curve).unwrap() {
                let mut parts = vec![(Bend::new(&piece), piece.range)];
                for _ in 0..7 {
                    let halves = |(bend, [a, b]): (Bend, [f64; 2])| {
                        let ([first, second], middle) = (bend.halves(), 0.5 * (a + b));
                        [(first, [a, middle]), (second, [middle, b])]
                    };
                    parts = parts.into_iter().flat_map(halves).collect();
                }
                for (bend, [a, b]) in parts {
                    let [least, largest] = bend.curvatures();
                    let at = |k: usize| curve.curvature(a + (b - a) * k as f64 / 10.0).unwrap();
                    // At the ends are those of the neighbours.
                    let found: Vec<f64> = (1..10).map(at).collect();
                    let size = found.iter().fold(0.0f64, |s, k| s.max(k.abs()));
                    let noise = 1e-8 * size + 1e-12;
                    let within = |&k: &f64| least - noise <= k && k <= largest + noise;
                    assert!(found.iter().all(within), "{found:?} not in [{least}, {largest}]");
                    if least.is_finite() {
                        seen += 1;
                        let spread = found.iter().fold(f64::MIN, |s, &k| s.max(k))
                            - found.iter().fold(f64::MAX, |s, &k| s.min(k));
                        widest = widest.max((largest - least - 4.0 * spread) / (size + 1.0));
                    }
                }
            }
        }
        assert!(seen > 60_000, "bounds of {seen} parts");
        assert!(widest < 0.5, "bounds wider by {widest} than what they hold");
    }

    #[test]
    fn a_circle_has_one_curvature() {
        for (centre, radius) in [(DVec2::ZERO, 1.0), (DVec2::splat(1e4), 1e-2), (DVec2::X, 1e5)] {
            let [x, y] = [DVec2::X, DVec2::Y].map(|d| d * radius);
            let arc = NurbsCurve::arc(centre, x, y, 0.0, FRAC_PI_2).unwrap();
            for piece in curve_pieces(&arc).unwrap() {
                for bend in Bend::new(&piece).halves() {
                    let found = bend.curvatures().map(|k| (k * radius - 1.0).abs());
                    assert!(found.iter().all(|&e| e < 1e-9), "{found:?} off 1 / {radius}");
                }
            }
        }
    }

    #[test]
    fn a_short_sharp_bend_loses_its_loop() {
        let poles = [(0.0, 0.0), (0.98, 0.0), (0.999, 0.004), (1.01, 0.006)].map(DVec2::from);
        let curve =
            NurbsCurve::new(KnotVector::clamped(3, &[0.0, 1.0]).unwrap(), poles.to_vec(), None).unwrap();
        let (inverter, distance) = (CurveInverter::new(&curve).unwrap(), 0.06);
        let raw = Offset::new(distance, 1e-7).raw(&curve).unwrap();
        let least = |o: &NurbsCurve<DVec2>| {
            let (a, b) = o.knots().domain();
            let at = |k: usize| inverter.nearest(o.point(a + (b - a) * k as f64 / 10_000.0)).distance;
            (0..=10_000).map(at).fold(f64::INFINITY, f64::min)
        };
        assert!(least(&raw[0].curve) < distance - 1e-5, "the loop is worth trimming");
        let kept = Offset::new(distance, 1e-7).trimmed(&curve).unwrap();
        let found = kept.iter().map(|o| least(&o.curve)).fold(f64::INFINITY, f64::min);
        assert!(!kept.is_empty() && found >= distance - 1e-7, "{found} of {distance}");
    }
}
