//! Many points of one surface, anywhere on it.
//!
//! Knots are prepared once ([`super::span_table`]); points are worked off in blocks: basis
//! functions of the block along each direction, then sums over poles of four numbers
//! (x, y, z, weight), which fill a wide register. The results have the same bits on every
//! processor.

use super::divided::{self, Net};
use super::span_table::{Functions, SpanTable, WIDE};
use super::surface::{NurbsSurface, SurfaceDerivatives};
use super::wide::{self, Four, Work};
use glam::{DVec2, DVec3};
use std::sync::OnceLock;

/// Points of one block: its basis functions fit the fastest cache.
pub(super) const BLOCK: usize = 4 * FOURS;
pub(super) const FOURS: usize = 8;
/// Parameter pairs in a line of the cache.
const LINE: usize = 4;

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
    net: Net,
    /// The poles of derivatives, once they are asked for.
    derived: OnceLock<Vec<[[f64; 4]; 5]>>,
}

impl<'a> SurfaceEvaluator<'a> {
    /// Prepares the surface; its cost is that of about as many points as there are poles.
    pub fn new(surface: &'a NurbsSurface) -> Self {
        let prepared = SpanTable::new(surface.knots_u()).zip(SpanTable::new(surface.knots_v()));
        let pole = |i: usize| {
            let [x, y, z] = surface.poles()[i].to_array();
            [x, y, z, surface.weights().map_or(0.0, |w| w[i])]
        };
        let prepared = prepared.map(|(u, v)| Prepared {
            u,
            v,
            rows: surface.knots_u().degree() + 1,
            width: surface.knots_v().degree() + 1,
            columns: surface.knots_v().len(),
            net: Net::new((0..surface.poles().len()).map(pole).collect()),
            derived: OnceLock::new(),
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
        self.each(uv, out, |uv| {
            let d = self.surface.derivatives_to(uv.x, uv.y, 2);
            SurfaceDerivatives { s: d[0][0], u: d[1][0], v: d[0][1], uu: d[2][0], uv: d[1][1], vv: d[0][2] }
        });
    }

    fn each<const K: usize, T: OfJet<K>>(&self, uv: &[DVec2], out: &mut [T], one: impl Fn(DVec2) -> T) {
        match &self.prepared {
            Some(prepared) => {
                let rational = self.surface.weights().is_some();
                let knots = || [self.surface.knots_u(), self.surface.knots_v()];
                let derived: &[_] = if K == 1 {
                    &[]
                } else {
                    prepared.derived.get_or_init(|| divided::of_surface(&prepared.net, knots()))
                };
                wide::run((Order, Batch { of: Poles { prepared, derived }, rational, uv, out }));
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
pub(super) fn weight<F: Four>(four: F) -> f64 {
    four.to_array()[3]
}

/// What is summed.
#[derive(Clone, Copy)]
struct Poles<'a> {
    prepared: &'a Prepared,
    derived: &'a [[[f64; 4]; 5]],
}

struct Batch<'a, T> {
    of: Poles<'a>,
    rational: bool,
    uv: &'a [DVec2],
    out: &'a mut [T],
}

impl<const K: usize, T: OfJet<K>> Work for (Order<K>, Batch<'_, T>) {
    #[inline(always)]
    fn run<F: Four>(self) {
        let batch = self.1;
        match (batch.rational, batch.of.prepared.width) {
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
        let of @ Poles { prepared, .. } = self.of;
        let (mut nu, mut nv) = ([Functions::<K>::NONE; FOURS], [Functions::<K>::NONE; FOURS]);
        let blocks = self.uv.chunks(BLOCK).zip(self.out.chunks_mut(BLOCK));
        for (uv, out, next) in blocks.enumerate().map(|(b, (uv, out))| (uv, out, (b + 1) * BLOCK)) {
            self.uv.iter().skip(next).take(BLOCK).step_by(LINE).for_each(F::prefetch);
            // The last four repeat the last point.
            let mut padded = [uv[uv.len() - 1]; BLOCK];
            padded[..uv.len()].copy_from_slice(uv);
            let fours = padded.as_chunks::<4>().0.iter().take(uv.len().div_ceil(4));
            let us = fours.clone().map(|[a, b, c, d]| [a.x, b.x, c.x, d.x]);
            prepared.u.functions::<F, K>(us, &mut nu);
            prepared.v.functions::<F, K>(fours.map(|[a, b, c, d]| [a.y, b.y, c.y, d.y]), &mut nv);
            for (k, out) in out.iter_mut().enumerate().take(uv.len()) {
                let jet = of.jet::<F, K, W, RATIONAL>(&nu[k / 4], &nv[k / 4], k % 4);
                *out = T::of_jet(&jet);
            }
        }
    }
}

impl Poles<'_> {
    /// Derivatives `[k][l]`, `k + l < K`, of one of four.
    #[inline(always)]
    fn jet<F: Four, const K: usize, const W: usize, const RATIONAL: bool>(
        &self,
        nu: &Functions<K>,
        nv: &Functions<K>,
        of: usize,
    ) -> [[F; K]; K] {
        let Prepared { rows, columns, net, .. } = self.prepared;
        let first = nu.first[of] * columns + nv.first[of];
        let m = |k: usize, i: usize| F::splat(nu.n[k][i][of]);
        let n = |l: usize, j: usize| F::splat(nv.n[l][j][of]);
        let mut jet = [[F::splat(0.0); K]; K];
        for i in 0..*rows {
            let row = &net.poles[first + i * columns..][..W];
            let mut s = F::splat(0.0);
            for j in 0..W {
                s = s + F::load(&row[j]) * n(0, j);
            }
            jet[0][0] = jet[0][0] + s * m(0, i);
        }
        // The `k`-th in u and `l`-th in v has so many fewer poles, which are the `which`-th.
        macro_rules! add {
            ($($k:literal $l:literal $which:literal)*) => {$(
                if $k + $l < K {
                    for i in 0..*rows - $k {
                        let row = &self.derived[first + i * columns..][..W];
                        let mut sum = F::splat(0.0);
                        for j in 0..W - $l {
                            sum = sum + F::load(&row[j][$which]) * n($l, j);
                        }
                        jet[$k][$l] = jet[$k][$l] + sum * m($k, i);
                    }
                }
            )*};
        }
        add!(0 1 0  0 2 1  1 0 2  1 1 3  2 0 4);
        if RATIONAL {
            divide(&mut jet);
        }
        jet[0][0] = jet[0][0] + F::load(&net.centre);
        jet
    }
}

/// How many orders of derivatives, the point among them.
struct Order<const K: usize>;

/// Divides by the weight (eq. 4.20), up to the second order.
#[inline(always)]
fn divide<F: Four, const K: usize>(jet: &mut [[F; K]; K]) {
    let inverse = F::splat(1.0 / weight(jet[0][0]));
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
    use crate::nurbs::KnotVector;

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
