//! Curves made compatible, and joined.

use super::basis::KnotVector;
use super::curve::{NurbsCurve, Point};
use crate::error::{Error, Result};
use crate::tolerance::PARAMETER_RELATIVE;

/// Inner knots that differ from one of `to` by rounding only become that one.
fn snapped(knots: &KnotVector, to: &KnotVector) -> Result<KnotVector> {
    let (a, b) = to.domain();
    let breaks = to.breaks();
    let near = |k: f64| {
        let after = breaks.partition_point(|&t| t < k);
        let around = &breaks[after.saturating_sub(1)..breaks.len().min(after + 1)];
        around.iter().copied().find(|t| (t - k).abs() <= PARAMETER_RELATIVE * (b - a)).unwrap_or(k)
    };
    KnotVector::new(knots.degree(), knots.flat().iter().map(|&k| near(k)).collect())
}

/// The same curves, clamped, with one degree, one domain (that of the first) and the same knots.
///
/// # Errors
/// [`Error::Spline`] for curves that jump.
pub fn compatible<P: Point>(curves: &[NurbsCurve<P>]) -> Result<Vec<NurbsCurve<P>>> {
    let Some(first) = curves.first() else { return Ok(Vec::new()) };
    let degree = curves.iter().map(|c| c.knots().degree()).max().unwrap_or(1);
    let (a, b) = first.knots().domain();
    let mut out: Vec<NurbsCurve<P>> = Vec::new();
    for curve in curves {
        let mut curve = curve.clamped()?.elevated(degree - curve.knots().degree())?.over(a, b)?;
        for other in &out {
            let knots = snapped(curve.knots(), other.knots())?;
            curve = NurbsCurve::new(knots, curve.poles().to_vec(), curve.weights().map(<[f64]>::to_vec))?;
        }
        out.push(curve);
    }
    let last = out.len() - 1;
    for i in 0..last {
        out[last] = out[last].refined(&out[last].knots().missing(out[i].knots()))?;
    }
    for i in 0..last {
        out[i] = out[i].refined(&out[i].knots().missing(out[last].knots()))?;
    }
    let rational = out.iter().any(|c| c.weights().is_some());
    Ok(if rational { out.iter().map(NurbsCurve::rational).collect() } else { out })
}

impl<P: Point> NurbsCurve<P> {
    /// The same curve with weights, all one where it had none.
    pub fn rational(&self) -> Self {
        let weights = self.weights().map_or(vec![1.0; self.poles().len()], <[f64]>::to_vec);
        self.with_weights(weights)
    }

    fn with_weights(&self, weights: Vec<f64>) -> Self {
        Self::new(self.knots().clone(), self.poles().to_vec(), Some(weights)).expect("positive weights")
    }

    /// This curve and, behind it, `next`, as one: continuous, each with its own parametrisation,
    /// that of `next` shifted. The point where they meet is the mean of both ends.
    ///
    /// # Errors
    /// [`Error::Spline`] when the ends are further apart than `gap` (mm).
    pub fn joined(&self, next: &Self, gap: f64) -> Result<Self> {
        let (a, b) = (self.clamped()?, next.clamped()?);
        let degree = a.knots().degree().max(b.knots().degree());
        let (a, b) = (a.elevated(degree - a.knots().degree())?, b.elevated(degree - b.knots().degree())?);
        let (end, start) = (a.poles()[a.poles().len() - 1], b.poles()[0]);
        let apart = (end - start).length();
        if apart > gap {
            let why = format!("the curves are {apart:e} mm apart where they should meet, beyond {gap:e}");
            return Err(Error::Spline { why });
        }
        let ((_, at), (from, to)) = (a.knots().domain(), b.knots().domain());
        let b = b.over(at, at + (to - from))?;
        let mut flat = a.knots().flat()[..a.knots().flat().len() - 1].to_vec();
        flat.extend(&b.knots().flat()[degree + 1..]);
        let mut poles = a.poles().to_vec();
        poles[a.poles().len() - 1] = (end + start) * 0.5;
        poles.extend(&b.poles()[1..]);
        let rational = a.weights().is_some() || b.weights().is_some();
        let weights = rational.then(|| {
            let (a, b) = (a.rational(), b.rational());
            let mut all = a.weights().unwrap_or_default().to_vec();
            let scale = all.last().copied().unwrap_or(1.0) / b.weights().map_or(1.0, |w| w[0]);
            all.extend(b.weights().unwrap_or_default()[1..].iter().map(|w| w * scale));
            all
        });
        Self::new(KnotVector::new(degree, flat)?, poles, weights)
    }

    /// As [`joined`](Self::joined), but with the speed of `next` brought to that of this curve, and
    /// the joint made as smooth as it can be while the curve moves by no more than `gap` (mm).
    ///
    /// # Errors
    /// [`Error::Spline`] when the ends are further apart than `gap`, [`Error::Numerics`] when a
    /// curve stands still where they meet.
    pub fn joined_smoothly(&self, next: &Self, gap: f64) -> Result<Self> {
        let ((_, end), (start, last)) = (self.knots().domain(), next.knots().domain());
        let (before, after) = (self.derivatives(end)[1].length(), next.derivatives(start)[1].length());
        if before == 0.0 || after == 0.0 {
            return Err(Error::Numerics { why: "a curve stands still where two should be joined".into() });
        }
        let same_speed = next.over(0.0, (last - start) * after / before)?;
        let joined = self.joined(&same_speed, gap)?;
        let degree = joined.knots().degree();
        Ok(joined.remove_knot(end, degree, gap)?.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn curve(degree: usize, breaks: &[f64], rational: bool) -> NurbsCurve<DVec2> {
        let knots = KnotVector::clamped(degree, breaks).unwrap();
        let n = knots.len();
        let poles = (0..n).map(|i| DVec2::new(i as f64, (i as f64 * 1.3).sin())).collect();
        let weights = rational.then(|| (0..n).map(|i| 1.0 + 0.4 * (i as f64).cos()).collect());
        NurbsCurve::new(knots, poles, weights).unwrap()
    }

    #[test]
    fn compatible_curves_have_the_same_knots_and_shapes() {
        let given = [
            curve(2, &[0.0, 0.1, 0.7, 1.0], false),
            curve(3, &[1.0, 1.0 + 0.1 / 3.0, 2.0], true),
            curve(1, &[-5.0, 0.0, 1.0], false),
        ];
        let same = compatible(&given).unwrap();
        for (before, after) in given.iter().zip(&same) {
            assert_eq!(after.knots(), same[0].knots());
            assert!(after.weights().is_some());
            let (a, b) = before.knots().domain();
            for i in 0..=200 {
                let t = i as f64 / 200.0;
                let gap = (before.point(a + (b - a) * t) - after.point(t)).length();
                assert!(gap < 1e-13, "{gap} at {t}");
            }
        }
        // 0.1 of the first, a third of that of the second, 5/6 of the third: none is doubled.
        assert_eq!(same[0].knots().breaks().len(), 6);
        assert!(compatible::<DVec2>(&[]).unwrap().is_empty());
    }

    #[test]
    fn a_split_curve_joins_to_itself() {
        for rational in [false, true] {
            let c = curve(3, &[0.0, 0.3, 0.6, 1.0], rational);
            let [a, b] = c.split(0.45).unwrap();
            let sharp = a.joined(&b, 1e-9).unwrap();
            assert_eq!(sharp.knots().multiplicity(0.45), 3);
            let smooth = a.joined_smoothly(&b.over(7.0, 9.5).unwrap(), 1e-9).unwrap();
            assert_eq!(smooth.knots().len(), c.knots().len(), "{:?}", smooth.knots());
            for i in 0..=100 {
                let t = i as f64 / 100.0;
                assert!((sharp.point(t) - c.point(t)).length() < 1e-13);
                assert!((smooth.point(t) - c.point(t)).length() < 1e-9, "{t}");
            }
        }
    }

    #[test]
    fn a_gap_is_named() {
        let (a, b) = (curve(2, &[0.0, 1.0], false), curve(2, &[0.0, 1.0], true));
        let message = a.joined(&b, 1e-3).unwrap_err().to_string();
        assert!(message.contains("mm apart"), "{message}");
    }
}
