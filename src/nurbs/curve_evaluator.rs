//! Many points of one curve, as [`super::evaluator`] does those of a surface.

use super::curve::{NurbsCurve, Point};
use super::divided::{self, Net};
use super::evaluator::{BLOCK, FOURS, weight};
use super::span_table::{Functions, SpanTable, WIDE};
use super::wide::{self, Four, Work};

/// A curve prepared for evaluation at many parameters.
#[derive(Debug, Clone)]
pub struct CurveEvaluator<'a, P: Point> {
    curve: &'a NurbsCurve<P>,
    /// None for degrees that the span table does not carry.
    spans: Option<SpanTable>,
    net: Net,
    /// The poles of derivatives.
    derived: Vec<[[f64; 4]; 2]>,
}

impl<'a, P: Point> CurveEvaluator<'a, P> {
    /// Prepares the curve; its cost is that of about as many points as there are poles.
    pub fn new(curve: &'a NurbsCurve<P>) -> Self {
        let pole = |(i, p): (usize, &P)| {
            let [x, y, z] = p.coordinates();
            [x, y, z, curve.weights().map_or(0.0, |w| w[i])]
        };
        let net = Net::new(curve.poles().iter().enumerate().map(pole).collect());
        let derived = divided::of_curve(&net, curve.knots());
        Self { curve, spans: SpanTable::new(curve.knots()), net, derived }
    }

    /// The points at the parameters.
    pub fn points(&self, parameters: &[f64]) -> Vec<P> {
        let mut out = vec![P::default(); parameters.len()];
        self.points_into(parameters, &mut out);
        out
    }

    /// Writes the points at the parameters, as many as both slices have.
    pub fn points_into(&self, parameters: &[f64], out: &mut [P]) {
        self.each(parameters, out.as_chunks_mut::<1>().0, |t| [self.curve.point(t)]);
    }

    /// The points and the first two derivatives at the parameters.
    pub fn derivatives(&self, parameters: &[f64]) -> Vec<[P; 3]> {
        let mut out = vec![[P::default(); 3]; parameters.len()];
        self.derivatives_into(parameters, &mut out);
        out
    }

    /// Writes the points and derivatives at the parameters, as many as both slices have.
    pub fn derivatives_into(&self, parameters: &[f64], out: &mut [[P; 3]]) {
        self.each(parameters, out, |t| {
            let d = self.curve.derivatives_to(t, 2);
            [d[0], d[1], d[2]]
        });
    }

    fn each<const K: usize>(&self, parameters: &[f64], out: &mut [[P; K]], one: impl Fn(f64) -> [P; K]) {
        match &self.spans {
            Some(spans) => {
                wide::run(Batch { evaluator: self, spans, parameters, out });
            }
            None => parameters.iter().zip(out).for_each(|(&t, out)| *out = one(t)),
        }
    }
}

struct Batch<'a, P: Point, const K: usize> {
    evaluator: &'a CurveEvaluator<'a, P>,
    spans: &'a SpanTable,
    parameters: &'a [f64],
    out: &'a mut [[P; K]],
}

impl<P: Point, const K: usize> Work for Batch<'_, P, K> {
    #[inline(always)]
    fn run<F: Four>(self) {
        match self.evaluator.curve.weights() {
            Some(_) => self.blocks::<F, true>(),
            None => self.blocks::<F, false>(),
        }
    }
}

impl<P: Point, const K: usize> Batch<'_, P, K> {
    #[inline(always)]
    fn blocks<F: Four, const RATIONAL: bool>(self) {
        let CurveEvaluator { curve, net, derived, .. } = self.evaluator;
        let order = curve.knots().degree() + 1;
        let mut n = [Functions::<K>::NONE; FOURS];
        for (ts, out) in self.parameters.chunks(BLOCK).zip(self.out.chunks_mut(BLOCK)) {
            // The last four repeat the last parameter.
            let mut padded = [ts[ts.len() - 1]; BLOCK];
            padded[..ts.len()].copy_from_slice(ts);
            let fours = padded.as_chunks::<4>().0.iter().take(ts.len().div_ceil(4));
            self.spans.functions::<F, K>(fours.copied(), &mut n);
            for (k, out) in out.iter_mut().enumerate().take(ts.len()) {
                let functions = &n[k / 4];
                let first = functions.first[k % 4];
                let at = first..first + order;
                let rows = (&net.poles[at.clone()], &derived[at]);
                let mut jet = derivatives::<F, K, RATIONAL>(rows, &functions.n, k % 4);
                jet[0] = jet[0] + F::load(&net.centre);
                for d in 0..K {
                    let [x, y, z, _] = jet[d].to_array();
                    out[d] = P::from_coordinates([x, y, z]);
                }
            }
        }
    }
}

/// The point, from the centre, and the derivatives of one of four.
#[inline(always)]
fn derivatives<F: Four, const K: usize, const RATIONAL: bool>(
    (poles, derived): (&[[f64; 4]], &[[[f64; 4]; 2]]),
    n: &[[[f64; 4]; WIDE]; K],
    of: usize,
) -> [F; K] {
    let mut jet = [F::splat(0.0); K];
    for (j, (pole, derived)) in poles.iter().zip(derived).enumerate() {
        jet[0] = jet[0] + F::load(pole) * F::splat(n[0][j][of]);
        // The last ones have no difference to the next.
        for d in (1..K).filter(|d| j + d < poles.len()) {
            jet[d] = jet[d] + F::load(&derived[d - 1]) * F::splat(n[d][j][of]);
        }
    }
    if RATIONAL {
        // Eq. 4.8, up to the second order.
        let inverse = F::splat(1.0 / weight(jet[0]));
        jet[0] = jet[0] * inverse;
        if K > 2 {
            let (w1, w2) = (F::splat(weight(jet[1])), F::splat(weight(jet[2])));
            jet[1] = (jet[1] - jet[0] * w1) * inverse;
            jet[2] = (jet[2] - jet[1] * (w1 + w1) - jet[0] * w2) * inverse;
        }
    }
    jet
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;
    use glam::{DVec2, DVec3};

    fn check<P: Point>(point: impl Fn(usize) -> P) {
        let ts: Vec<f64> = (0..=103).map(|i| (i * 37 % 104) as f64 / 103.0).collect();
        for degree in 1..=7 {
            for rational in [false, true] {
                let knots = KnotVector::clamped(degree, &[0.0, 0.2, 0.3, 0.7, 1.0]).unwrap();
                let n = knots.len();
                let weights = rational.then(|| (0..n).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect());
                let curve = NurbsCurve::new(knots, (0..n).map(&point).collect(), weights).unwrap();
                let evaluator = CurveEvaluator::new(&curve);
                let (points, jets) = (evaluator.points(&ts), evaluator.derivatives(&ts));
                for (k, &t) in ts.iter().enumerate() {
                    let expected = curve.derivatives(t);
                    let pairs =
                        std::iter::once((points[k], expected[0])).chain(jets[k].into_iter().zip(expected));
                    for (d, (a, b)) in pairs.enumerate() {
                        let error = (a - b).length() / b.length().max(10.0);
                        assert!(error < 1e-13, "degree {degree}, {rational}, {t}, entry {d}: {a:?} {b:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_batch_equals_single_evaluations() {
        check(|i| DVec2::new(i as f64, (i as f64).cos()));
        check(|i| DVec3::new(i as f64, (i as f64).cos(), 30.0 - (i % 3) as f64));
    }
}
