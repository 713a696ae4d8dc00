//! Many points of one curve or surface, anywhere on it.
//!
//! Knots are prepared once ([`super::span_table`]); points are worked off in blocks: basis
//! functions of the block along each direction, then sums over poles of four numbers
//! (x, y, z, weight), which fill a wide register. The results have the same bits on every
//! processor.

use super::basis::KnotVector;
use super::span_table::{Functions, SpanTable, WIDE};
use super::surface::{NurbsSurface, SurfaceDerivatives};
use super::wide::{self, Four, Work};
use glam::{DVec2, DVec3};

/// Points of one block: its basis functions fit the fastest cache.
const BLOCK: usize = 4 * FOURS;
const FOURS: usize = 8;

/// A surface prepared for evaluation at many places.
#[derive(Debug, Clone)]
pub struct SurfaceEvaluator<'a> {
    surface: &'a NurbsSurface,
    prepared: Option<Prepared>,
}

/// Only for degrees that the span tables carry.
#[derive(Debug, Clone)]
struct Prepared {
    u: SpanTable,
    v: SpanTable,
    rows: usize,
    width: usize,
    columns: usize,
    /// Coordinates and weights.
    poles: Vec<[f64; 4]>,
}

impl<'a> SurfaceEvaluator<'a> {
    /// Prepares the surface; its cost is that of about as many points as there are poles.
    pub fn new(surface: &'a NurbsSurface) -> Self {
        let prepared = SpanTable::new(surface.knots_u()).zip(SpanTable::new(surface.knots_v()));
        let order = |knots: &KnotVector| knots.degree() + 1;
        let pole = |i: usize| {
            let [x, y, z] = surface.poles()[i].to_array();
            [x, y, z, surface.weights().map_or(0.0, |w| w[i])]
        };
        let prepared = prepared.map(|(u, v)| Prepared {
            u,
            v,
            rows: order(surface.knots_u()),
            width: order(surface.knots_v()),
            columns: surface.knots_v().len(),
            poles: (0..surface.poles().len()).map(pole).collect(),
        });
        Self { surface, prepared }
    }

    /// The points at the parameters.
    pub fn points(&self, uv: &[DVec2]) -> Vec<DVec3> {
        let mut out = vec![DVec3::ZERO; uv.len()];
        self.points_into(uv, &mut out);
        out
    }

    /// Writes the points at the parameters, as many as both slices have.
    pub fn points_into(&self, uv: &[DVec2], out: &mut [DVec3]) {
        self.each(uv, out, |uv| self.surface.point(uv.x, uv.y));
    }

    /// The points and derivatives up to the second at the parameters.
    pub fn derivatives(&self, uv: &[DVec2]) -> Vec<SurfaceDerivatives> {
        let mut out = vec![SurfaceDerivatives::default(); uv.len()];
        self.derivatives_into(uv, &mut out);
        out
    }

    /// Writes the points and derivatives at the parameters, as many as both slices have.
    pub fn derivatives_into(&self, uv: &[DVec2], out: &mut [SurfaceDerivatives]) {
        self.each(uv, out, |uv| self.surface.derivatives(uv.x, uv.y));
    }

    fn each<const K: usize, T: OfJet<K>>(&self, uv: &[DVec2], out: &mut [T], one: impl Fn(DVec2) -> T) {
        match &self.prepared {
            Some(prepared) => {
                let rational = self.surface.weights().is_some();
                wide::run((Order, Batch { prepared, rational, uv, out }));
            }
            None => uv.iter().zip(out).for_each(|(&uv, out)| *out = one(uv)),
        }
    }
}

/// What is kept of the derivatives `[k][l]`, `k + l < K`.
trait OfJet<const K: usize> {
    fn of_jet<F: Four>(jet: &[[F; K]; K]) -> Self;
}

impl OfJet<1> for DVec3 {
    #[inline(always)]
    fn of_jet<F: Four>(jet: &[[F; 1]; 1]) -> Self {
        coordinates(jet[0][0])
    }
}

impl OfJet<3> for SurfaceDerivatives {
    #[inline(always)]
    fn of_jet<F: Four>(jet: &[[F; 3]; 3]) -> Self {
        Self {
            s: coordinates(jet[0][0]),
            u: coordinates(jet[1][0]),
            v: coordinates(jet[0][1]),
            uu: coordinates(jet[2][0]),
            uv: coordinates(jet[1][1]),
            vv: coordinates(jet[0][2]),
        }
    }
}

#[inline(always)]
fn coordinates<F: Four>(four: F) -> DVec3 {
    let [x, y, z, _] = four.to_array();
    DVec3::new(x, y, z)
}

#[inline(always)]
fn weight<F: Four>(four: F) -> f64 {
    four.to_array()[3]
}

struct Batch<'a, T> {
    prepared: &'a Prepared,
    rational: bool,
    uv: &'a [DVec2],
    out: &'a mut [T],
}

impl<const K: usize, T: OfJet<K>> Work for (Order<K>, Batch<'_, T>) {
    #[inline(always)]
    fn run<F: Four>(self) {
        let batch = self.1;
        match (batch.rational, batch.prepared.width) {
            (false, 2) => batch.blocks::<F, K, 2, false>(),
            (false, 3) => batch.blocks::<F, K, 3, false>(),
            (false, 4) => batch.blocks::<F, K, 4, false>(),
            (false, 5) => batch.blocks::<F, K, 5, false>(),
            (false, _) => batch.blocks::<F, K, WIDE, false>(),
            (true, 2) => batch.blocks::<F, K, 2, true>(),
            (true, 3) => batch.blocks::<F, K, 3, true>(),
            (true, 4) => batch.blocks::<F, K, 4, true>(),
            (true, 5) => batch.blocks::<F, K, 5, true>(),
            (true, _) => batch.blocks::<F, K, WIDE, true>(),
        }
    }
}

impl<T> Batch<'_, T> {
    #[inline(always)]
    fn blocks<F: Four, const K: usize, const W: usize, const RATIONAL: bool>(self)
    where
        T: OfJet<K>,
    {
        let (mut nu, mut nv) = ([Functions::<K>::NONE; FOURS], [Functions::<K>::NONE; FOURS]);
        for (uv, out) in self.uv.chunks(BLOCK).zip(self.out.chunks_mut(BLOCK)) {
            // The last four repeat the last point.
            let mut padded = [uv[uv.len() - 1]; BLOCK];
            padded[..uv.len()].copy_from_slice(uv);
            let fours = padded.as_chunks::<4>().0.iter().take(uv.len().div_ceil(4));
            let us = fours.clone().map(|[a, b, c, d]| [a.x, b.x, c.x, d.x]);
            self.prepared.u.functions::<F, K>(us, &mut nu);
            self.prepared.v.functions::<F, K>(fours.map(|[a, b, c, d]| [a.y, b.y, c.y, d.y]), &mut nv);
            for (k, out) in out.iter_mut().enumerate().take(uv.len()) {
                let jet = self.prepared.jet::<F, K, W, RATIONAL>(&nu[k / 4], &nv[k / 4], k % 4);
                *out = T::of_jet(&jet);
            }
        }
    }
}

/// How many orders of derivatives, the point among them.
struct Order<const K: usize>;

impl Prepared {
    /// Derivatives `[k][l]`, `k + l < K`, of one of four; as in [`NurbsSurface::derivatives`] over
    /// differences from a pole of the span.
    #[inline(always)]
    fn jet<F: Four, const K: usize, const W: usize, const RATIONAL: bool>(
        &self,
        nu: &Functions<K>,
        nv: &Functions<K>,
        of: usize,
    ) -> [[F; K]; K] {
        let first = nu.first[of] * self.columns + nv.first[of];
        let last = first + (self.rows - 1) * self.columns + W - 1;
        let (local, zero) = (K > 1 || RATIONAL, F::splat(0.0));
        let origin = F::load(&self.poles[last]);
        let mut jet = [[zero; K]; K];
        for i in 0..self.rows {
            let row = &self.poles[first + i * self.columns..][..W];
            let mut line = [zero; K];
            for j in 0..W {
                let mut pole = F::load(&row[j]);
                if local {
                    pole = pole - origin;
                }
                if RATIONAL {
                    let w = row[j][3];
                    pole = pole * F::load(&[w, w, w, 1.0]);
                }
                for l in 0..K {
                    line[l] = line[l] + pole * F::splat(nv.n[l][j][of]);
                }
            }
            for k in 0..K {
                for l in 0..K - k {
                    jet[k][l] = jet[k][l] + line[l] * F::splat(nu.n[k][i][of]);
                }
            }
        }
        if RATIONAL {
            divide(&mut jet, self.poles[last][3]);
        }
        if local {
            jet[0][0] = jet[0][0] + origin;
        }
        jet
    }
}

/// Divides by the weight (eq. 4.20), up to the second order; weights are over `base`.
#[inline(always)]
fn divide<F: Four, const K: usize>(jet: &mut [[F; K]; K], base: f64) {
    let inverse = F::splat(1.0 / (weight(jet[0][0]) + base));
    let s = jet[0][0] * inverse;
    jet[0][0] = s;
    if K < 2 {
        return;
    }
    let (wu, wv) = (weight(jet[1][0]), weight(jet[0][1]));
    let u = (jet[1][0] - s * F::splat(wu)) * inverse;
    let v = (jet[0][1] - s * F::splat(wv)) * inverse;
    (jet[1][0], jet[0][1]) = (u, v);
    if K < 3 {
        return;
    }
    jet[2][0] = (over(jet[2][0], u, wu, u, wu) - s * F::splat(weight(jet[2][0]))) * inverse;
    jet[1][1] = (over(jet[1][1], u, wu, v, wv) - s * F::splat(weight(jet[1][1]))) * inverse;
    jet[0][2] = (over(jet[0][2], v, wv, v, wv) - s * F::splat(weight(jet[0][2]))) * inverse;
}

/// A second derivative less what the first ones of points and weights make of it.
#[inline(always)]
fn over<F: Four>(d: F, a: F, wa: f64, b: F, wb: f64) -> F {
    d - a * F::splat(wb) - b * F::splat(wa)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(p: usize, q: usize, rational: bool) -> NurbsSurface {
        let ku = KnotVector::clamped(p, &[0.0, 0.3, 0.35, 1.0]).unwrap();
        let kv = KnotVector::clamped(q, &[-1.0, 0.2, 0.9, 2.0]).unwrap();
        let n = ku.len() * kv.len();
        let poles = (0..n).map(|k| DVec3::new(k as f64, (k as f64).sin(), 100.0 + (k % 5) as f64)).collect();
        let weights = rational.then(|| (0..n).map(|k| 1.0 + 0.3 * ((k * k) as f64).cos()).collect());
        NurbsSurface::new(ku, kv, poles, weights).unwrap()
    }

    #[test]
    fn a_batch_equals_single_evaluations() {
        let at = |k: usize| DVec2::new((k * 37 % 101) as f64 / 100.0, (k * 53 % 103) as f64 * 0.03 - 1.0);
        let uv: Vec<DVec2> = (0..101).map(at).collect();
        for (p, q) in [(1, 1), (2, 3), (3, 3), (4, 2), (5, 3), (3, 5), (1, 4), (7, 2)] {
            for rational in [false, true] {
                let s = surface(p, q, rational);
                let evaluator = SurfaceEvaluator::new(&s);
                let (points, jets) = (evaluator.points(&uv), evaluator.derivatives(&uv));
                for (k, &at) in uv.iter().enumerate() {
                    let (a, b) = (jets[k], s.derivatives(at.x, at.y));
                    let pairs =
                        [(a.s, b.s), (a.u, b.u), (a.v, b.v), (a.uu, b.uu), (a.uv, b.uv), (a.vv, b.vv)];
                    for (d, (x, y)) in pairs.into_iter().enumerate() {
                        let error = (x - y).length() / y.length().max(100.0);
                        assert!(error < 1e-13, "{p} × {q}, {rational}, {at}, derivative {d}: {x} {y}");
                    }
                    assert!((points[k] - b.s).length() < 1e-13 * 200.0, "{p} × {q}, {rational}, {at}");
                }
            }
        }
    }

    #[test]
    fn no_points_are_no_work() {
        assert!(SurfaceEvaluator::new(&surface(3, 3, false)).points(&[]).is_empty());
    }
}
