//! Derivatives of any order, rational ones included, and one-sided limits at knots
//! (A4.2 and A4.4 of *The NURBS Book*).
//!
//! Sums run over differences from the coordinates and the weight of the span that are nearest to
//! zero: high derivatives on short spans do not lose the digits of the position, and no error is
//! added beyond that of the poles and weights themselves.

use super::basis::KnotVector;
use super::curve::{NurbsCurve, Point};
use super::surface::NurbsSurface;
use glam::DVec3;

/// From where a parameter is approached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// From smaller parameters.
    Below,
    /// From larger parameters.
    Above,
}

impl KnotVector {
    /// The span whose polynomial holds on this side of `u`; at the ends of the domain the only one
    /// there is.
    pub fn span_from(&self, u: f64, side: Side) -> usize {
        let (flat, p) = (self.flat(), self.degree());
        match side {
            Side::Above => self.span(u),
            Side::Below => {
                let before = flat[..=self.len()].partition_point(|&k| k < u);
                if before <= p || before > self.len() { self.span(u) } else { before - 1 }
            }
        }
    }

    /// Basis functions and derivatives up to `order`, `[k][j]`, on a span.
    fn table(&self, span: usize, u: f64, order: usize) -> Vec<Vec<f64>> {
        let width = self.degree() + 1;
        let mut n = vec![0.0; (order + 1) * width];
        self.basis_derivatives(span, u, order, &mut n);
        n.chunks(width).map(<[f64]>::to_vec).collect()
    }
}

/// What differences are taken from, point and weight.
#[inline]
pub(super) fn origin<P: Point>(
    poles: impl Iterator<Item = P>,
    weights: impl Iterator<Item = f64>,
) -> (P, f64) {
    let nearest = poles.fold([f64::INFINITY; 3], |least, pole| {
        let x = pole.coordinates();
        std::array::from_fn(|k| if x[k].abs() < least[k].abs() { x[k] } else { least[k] })
    });
    (P::from_coordinates(nearest), weights.fold(f64::INFINITY, f64::min))
}

/// `n` over `k`.
pub(super) fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
}

impl<P: Point> NurbsCurve<P> {
    /// The point and all derivatives up to `order` at `t`; where a knot makes them jump, those from
    /// above, and at the end of the domain from below.
    pub fn derivatives_to(&self, t: f64, order: usize) -> Vec<P> {
        self.derivatives_on(self.knots().span(t), t, order)
    }

    /// The same, as limits from one side.
    pub fn derivatives_from(&self, side: Side, t: f64, order: usize) -> Vec<P> {
        self.derivatives_on(self.knots().span_from(t, side), t, order)
    }

    fn derivatives_on(&self, span: usize, t: f64, order: usize) -> Vec<P> {
        let first = span - self.knots().degree();
        let n = self.knots().table(span, t, order);
        let weight = |i: usize| self.weights().map_or(1.0, |w| w[i]);
        let (origin, base) = origin(self.poles()[first..=span].iter().copied(), (first..=span).map(weight));
        let (mut a, mut w) = (vec![P::default(); order + 1], vec![0.0; order + 1]);
        for k in 0..=order {
            for (i, &b) in (first..).zip(&n[k]) {
                a[k] = a[k] + (self.poles()[i] - origin) * (b * weight(i));
                w[k] += b * (weight(i) - base);
            }
        }
        w[0] += base;
        if self.weights().is_some() {
            for k in 0..=order {
                for i in 1..=k {
                    a[k] = a[k] - a[k - i] * (binomial(k, i) * w[i]);
                }
                a[k] = a[k] / w[0];
            }
        }
        a[0] = a[0] + origin;
        a
    }
}

impl NurbsSurface {
    /// Derivatives `[k][l]`, the `k`-th in `u` and `l`-th in `v`, for `k + l <= order`.
    pub fn derivatives_to(&self, u: f64, v: f64, order: usize) -> Vec<Vec<DVec3>> {
        self.derivatives_from([Side::Above; 2], u, v, order)
    }

    /// The same, as limits from one side in each direction.
    pub fn derivatives_from(&self, sides: [Side; 2], u: f64, v: f64, order: usize) -> Vec<Vec<DVec3>> {
        let (ku, kv) = (self.knots_u(), self.knots_v());
        let (su, sv) = (ku.span_from(u, sides[0]), kv.span_from(v, sides[1]));
        let (nu, nv) = (ku.table(su, u, order), kv.table(sv, v, order));
        let weight = |i: usize| self.weights().map_or(1.0, |w| w[i]);
        let row = |i: usize| (su - ku.degree() + i) * kv.len() + sv - kv.degree();
        let indices = || (0..ku.degree() + 1).flat_map(|i| row(i)..row(i) + kv.degree() + 1);
        let (origin, base) = origin(indices().map(|i| self.poles()[i]), indices().map(weight));
        let mut jet: Vec<_> = (0..=order).map(|k| vec![DVec3::ZERO; order + 1 - k]).collect();
        let mut w: Vec<_> = (0..=order).map(|k| vec![0.0; order + 1 - k]).collect();
        for i in 0..=ku.degree() {
            let row = row(i);
            for j in 0..=kv.degree() {
                let pole = (self.poles()[row + j] - origin) * weight(row + j);
                let excess = weight(row + j) - base;
                for k in 0..=order {
                    for l in 0..=order - k {
                        let b = nu[k][i] * nv[l][j];
                        jet[k][l] += pole * b;
                        w[k][l] += excess * b;
                    }
                }
            }
        }
        w[0][0] += base;
        if self.weights().is_some() {
            divide(&mut jet, &w);
        }
        jet[0][0] += origin;
        jet
    }
}

/// Divides homogeneous derivatives by those of the weight (eq. 4.20).
fn divide(jet: &mut [Vec<DVec3>], w: &[Vec<f64>]) {
    for k in 0..jet.len() {
        for l in 0..jet[k].len() {
            let mut sum = jet[k][l];
            for i in 0..=k {
                for j in usize::from(i == 0)..=l {
                    sum -= jet[k - i][l - j] * (binomial(k, i) * binomial(l, j) * w[i][j]);
                }
            }
            jet[k][l] = sum / w[0][0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    /// A quarter of the unit circle (The NURBS Book, example 7.1) between two straight pieces.
    fn bent() -> NurbsCurve<DVec2> {
        let flat = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 3.0];
        let at = [(1.0, -2.0), (1.0, -1.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (-2.0, 1.0), (-4.0, 1.0)];
        let poles = at.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
        let half = 0.5f64.sqrt();
        let weights = Some(vec![1.0, 1.0, 1.0, half, 1.0, 1.0, 1.0]);
        NurbsCurve::new(KnotVector::new(2, flat).unwrap(), poles, weights).unwrap()
    }

    #[test]
    fn limits_at_a_knot_are_those_of_the_neighbours() {
        let c = bent();
        let (below, above) =
            (c.derivatives_from(Side::Below, 1.0, 2), c.derivatives_from(Side::Above, 1.0, 2));
        assert_eq!(below[0], above[0]);
        assert_eq!(below[1], DVec2::new(0.0, 2.0));
        assert!((above[1] - DVec2::new(0.0, 2.0 * 0.5f64.sqrt())).length() < 1e-15, "{}", above[1]);
        for side in [Side::Below, Side::Above] {
            assert_eq!(c.derivatives_from(side, 0.0, 2), c.derivatives_to(0.0, 2));
            assert_eq!(c.derivatives_from(side, 3.0, 2), c.derivatives_to(3.0, 2));
            assert_eq!(c.derivatives_from(side, 0.7, 2), c.derivatives_to(0.7, 2));
            assert_eq!(c.derivatives_from(side, -0.5, 2), c.derivatives_to(-0.5, 2));
            assert_eq!(c.derivatives_from(side, 3.5, 2), c.derivatives_to(3.5, 2));
        }
    }

    #[test]
    fn each_derivative_is_the_slope_of_the_one_before() {
        let c = bent();
        for t in [0.3, 1.4, 2.2] {
            let d = c.derivatives_to(t, 6);
            for k in 0..6 {
                let error = |h: f64| {
                    let (a, b) = (c.derivatives_to(t - h, k)[k], c.derivatives_to(t + h, k)[k]);
                    ((b - a) / (2.0 * h) - d[k + 1]).length()
                };
                let (coarse, fine) = (error(1e-2), error(1e-3));
                let size = 1e-9 * d[k + 1].length().max(1.0);
                assert!(fine < 0.0125 * coarse + size, "order {k} at {t}: {coarse} then {fine}");
            }
        }
    }

    #[test]
    fn derivatives_of_a_surface_are_those_of_its_lines() {
        let (ku, kv) = (bent().knots().clone(), KnotVector::clamped(3, &[0.0, 0.4, 1.0]).unwrap());
        let pole = |k: usize| DVec3::new((k / 5) as f64, (k % 5) as f64, (k as f64).sin());
        let weights = (0..35).map(|k| 1.0 + 0.4 * (k as f64).cos()).collect();
        let s = NurbsSurface::new(ku, kv, (0..35).map(pole).collect(), Some(weights)).unwrap();
        for (u, v) in [(0.2, 0.1), (1.0, 0.4), (2.5, 1.0)] {
            let jet = s.derivatives_to(u, v, 4);
            let fast = s.derivatives(u, v);
            let pairs =
                [(jet[0][0], fast.s), (jet[1][1], fast.uv), (jet[2][0], fast.uu), (jet[0][2], fast.vv)];
            for (a, b) in pairs {
                assert!((a - b).length() < 1e-12 * b.length().max(1.0), "{a} {b}");
            }
            let h = 1e-4 * if u == 1.0 { 0.0 } else { 1.0 };
            if h > 0.0 {
                let slope =
                    (s.derivatives_to(u + h, v, 3)[1][2] - s.derivatives_to(u - h, v, 3)[1][2]) / (2.0 * h);
                assert!((slope - jet[2][2]).length() < 1e-4 * slope.length(), "{slope} {}", jet[2][2]);
            }
        }
    }
}
