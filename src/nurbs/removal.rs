//! Knot removal to a tolerance (Tiller 1992; *The NURBS Book*, section 5.4).

use super::basis::KnotVector;
use super::curve::{NurbsCurve, Point};
use super::refine::{Direction, Net, raise};
use super::surface::NurbsSurface;
use crate::error::{Error, Result};

/// Rows of the net without one of the knots `t`, from both sides towards the middle. Where both
/// meet in one row, it is their mean.
fn shares(knots: &KnotVector, t: f64) -> Vec<Vec<(usize, f64)>> {
    let (p, flat) = (knots.degree(), knots.flat());
    let s = knots.multiplicity(t);
    let r = flat.partition_point(|&k| k <= t) - 1;
    let (first, last) = (r - p, r - s);
    let alpha = |i: usize| (t - flat[i]) / (flat[i + p + 1] - flat[i]);
    let minus = |i: usize, factor: f64, row: &[(usize, f64)], over: f64| {
        let rest = row.iter().map(|&(k, share)| (k, -factor * share / over));
        std::iter::once((i, 1.0 / over)).chain(rest).collect::<Vec<_>>()
    };
    let keep = |i: usize| vec![(i, 1.0)];
    let (mut i, mut j) = (first, last);
    let (mut left, mut right) = (vec![keep(first - 1)], vec![keep(last + 1)]);
    while j > i {
        left.push(minus(i, 1.0 - alpha(i), &left[left.len() - 1], alpha(i)));
        right.push(minus(j, alpha(j), &right[right.len() - 1], 1.0 - alpha(j)));
        (i, j) = (i + 1, j - 1);
    }
    if j < i {
        let (a, b) = (left.pop().unwrap_or_default(), right.pop().unwrap_or_default());
        left.push(a.into_iter().chain(b).map(|(k, share)| (k, 0.5 * share)).collect());
    }
    let before = (0..first - 1).map(keep);
    let after = (last + 2..knots.len()).map(keep);
    before.chain(left).chain(right.into_iter().rev()).chain(after).collect()
}

/// Removes `t` once, whatever becomes of the shape; returns a bound of its change.
pub(super) fn remove_once<P: Point>(
    knots: &KnotVector,
    net: &mut Net<P>,
    t: f64,
) -> Result<(KnotVector, f64)> {
    let multiplicity = knots.multiplicity(t);
    let old = net.clone();
    net.combine(&shares(knots, t));
    let mut flat = knots.flat().to_vec();
    flat.remove(flat.partition_point(|&k| k <= t) - 1);
    let fewer = KnotVector::new(knots.degree(), flat)?;
    let mut back = net.clone();
    raise(fewer.clone(), &mut back, t, multiplicity)?;
    Ok((fewer, back.distance(&old)))
}

/// Removes `t` up to so many times, as long as the changes sum up to no more than `tolerance`;
/// returns their sum.
pub(super) fn remove<P: Point>(
    knots: &KnotVector,
    net: &mut Net<P>,
    t: f64,
    times: usize,
    tolerance: f64,
) -> Result<(KnotVector, f64)> {
    let (mut knots, mut change) = (knots.clone(), 0.0);
    for _ in 0..times {
        let mut next = net.clone();
        let (fewer, more) = remove_once(&knots, &mut next, t)?;
        if change + more > tolerance {
            break;
        }
        (knots, *net, change) = (fewer, next, change + more);
    }
    Ok((knots, change))
}

/// Refuses knots that are not there, at the ends, or at a jump.
fn check(knots: &KnotVector, t: f64, times: usize) -> Result<()> {
    let ((a, b), present) = (knots.domain(), knots.multiplicity(t));
    if a < t && t < b && times <= present && present <= knots.degree() {
        return Ok(());
    }
    let why = format!(
        "knot {t} cannot be removed {times} times: it must lie inside ({a}, {b}); it stands there {present} \
         times, at degree {}",
        knots.degree()
    );
    Err(Error::Spline { why })
}

impl<P: Point> NurbsCurve<P> {
    /// The curve with the knot `t` removed up to so many times while it moves by no more than
    /// `tolerance` (mm) in all; returns a bound of that movement. How often it was removed shows in
    /// the knots.
    ///
    /// # Errors
    /// [`Error::Spline`] when `t` is not an inner knot that stands there so often, or the curve
    /// jumps at it.
    pub fn remove_knot(&self, t: f64, times: usize, tolerance: f64) -> Result<(Self, f64)> {
        check(self.knots(), t, times)?;
        self.reshape_within(|knots, net| remove(knots, net, t, times, tolerance))
    }
}

impl NurbsSurface {
    /// As [`NurbsCurve::remove_knot`], along `direction`.
    ///
    /// # Errors
    /// As there.
    pub fn remove_knot(
        &self,
        direction: Direction,
        t: f64,
        times: usize,
        tolerance: f64,
    ) -> Result<(Self, f64)> {
        check(self.knots(direction), t, times)?;
        self.reshape_within(direction, |knots, net| remove(knots, net, t, times, tolerance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

    fn wave(degree: usize, rational: bool) -> NurbsCurve<DVec3> {
        let knots = KnotVector::clamped(degree, &[0.0, 0.2, 0.5, 0.7, 1.0]).unwrap();
        let n = knots.len();
        let poles = (0..n).map(|i| DVec3::new(i as f64, (i as f64).sin() * 2.0, (i % 3) as f64)).collect();
        let weights = rational.then(|| (0..n).map(|i| 1.0 + 0.5 * (i as f64).cos()).collect());
        NurbsCurve::new(knots, poles, weights).unwrap()
    }

    #[test]
    fn what_was_inserted_can_be_removed() {
        for degree in 2..=6 {
            for rational in [false, true] {
                let curve = wave(degree, rational);
                let more = curve.insert_knot(0.4, degree).unwrap();
                let (fewer, change) = more.remove_knot(0.4, degree, 1e-11).unwrap();
                assert_eq!(fewer.knots(), curve.knots(), "degree {degree}, moved {change}");
                for (a, b) in fewer.poles().iter().zip(curve.poles()) {
                    assert!((*a - *b).length() < 1e-12, "degree {degree}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn the_bound_holds_and_the_tolerance_decides() {
        for rational in [false, true] {
            let curve = wave(3, rational);
            let (fewer, bound) = curve.remove_knot(0.5, 1, 100.0).unwrap();
            let gap = |t: f64| fewer.point(t).distance(curve.point(t));
            let most = (0..=1000).map(|i| gap(i as f64 / 1000.0)).fold(0.0, f64::max);
            assert!(most > 1e-3 && most <= bound, "moved {most}, bound {bound}");
            let (same, none) = curve.remove_knot(0.5, 1, 0.5 * bound).unwrap();
            assert_eq!((same.knots(), none), (curve.knots(), 0.0));
        }
    }

    #[test]
    fn a_knot_that_is_not_there_is_refused() {
        let line = NurbsCurve::new(KnotVector::clamped(1, &[0.0, 1.0]).unwrap(), vec![DVec2::ZERO; 2], None);
        let message = line.unwrap().remove_knot(0.5, 1, 1.0).unwrap_err().to_string();
        assert!(message.contains("0.5"), "{message}");
    }
}
