//! Degree elevation by polar forms (Ramshaw, *Blossoms are polar forms*, 1989) and reduction through
//! Bézier segments (A5.11 of *The NURBS Book*).

use super::basis::{KnotVector, MAX_DEGREE};
use super::curve::{NurbsCurve, Point};
use super::derivatives::binomial;
use super::refine::{Direction, Net, insert_all, polar_form, window};
use super::removal::remove;
use super::surface::NurbsSurface;
use crate::error::{Error, Result};

type Shares = Vec<Vec<(usize, f64)>>;

/// Cuts the net into Bézier segments that share their end rows; returns the breaks and how often
/// each stood.
pub(super) fn segments<P: Point>(knots: &KnotVector, net: &mut Net<P>) -> Result<Vec<(f64, usize)>> {
    let p = knots.degree();
    let knots = window(knots, net, knots.domain())?;
    let breaks = knots.breaks_and_multiplicities();
    refuse_jumps(p, &breaks)?;
    let inner = &breaks[1..breaks.len() - 1];
    let new: Vec<f64> = inner.iter().flat_map(|&(t, m)| std::iter::repeat_n(t, p - m)).collect();
    insert_all(&knots, net, &new)?;
    Ok(breaks)
}

fn refuse_jumps(p: usize, breaks: &[(f64, usize)]) -> Result<()> {
    let inner = &breaks[1..breaks.len() - 1];
    let Some((t, m)) = inner.iter().find(|(_, m)| *m > p) else { return Ok(()) };
    let why = format!("knot {t} stands {m} times at degree {p}: the spline jumps there; split it first");
    Err(Error::Spline { why })
}

/// Knots of Bézier segments over the breaks.
fn joined(degree: usize, breaks: &[(f64, usize)]) -> Result<KnotVector> {
    let ends = [0, breaks.len() - 1];
    let of = |i: usize| if ends.contains(&i) { degree + 1 } else { degree };
    let flat = breaks.iter().enumerate().flat_map(|(i, &(t, _))| std::iter::repeat_n(t, of(i)));
    KnotVector::new(degree, flat.collect())
}

/// The same change of every segment of degree `p`, for segments that share their end rows.
fn for_each_segment(one: &Shares, p: usize, count: usize) -> Shares {
    let mut all = vec![one[0].clone()];
    for segment in 0..count {
        let shifted = |row: &Vec<(usize, f64)>| row.iter().map(|&(i, s)| (i + segment * p, s)).collect();
        all.extend(one[1..].iter().map(shifted));
    }
    all
}

/// A Bézier segment of degree `p` raised by `by` (eq. 5.36).
fn raised(p: usize, by: usize) -> Shares {
    let share = |i: usize, j: usize| binomial(p, j) * binomial(by, i - j) / binomial(p + by, i);
    (0..=p + by).map(|i| (i.saturating_sub(by)..=p.min(i)).map(|j| (j, share(i, j))).collect()).collect()
}

/// A Bézier segment of degree `p` lowered by one, its ends kept (eq. 5.41 and 5.42).
fn lowered(p: usize) -> Shares {
    let alpha = |i: usize| i as f64 / p as f64;
    let rest = |i: usize, factor: f64, row: &[(usize, f64)], over: f64| {
        let others = row.iter().map(|&(k, s)| (k, -factor * s / over));
        std::iter::once((i, 1.0 / over)).chain(others).collect::<Vec<_>>()
    };
    let half = (p - 1) / 2;
    let mut left = vec![vec![(0, 1.0)]];
    for i in 1..=half {
        left.push(rest(i, alpha(i), &left[i - 1], 1.0 - alpha(i)));
    }
    let mut right = vec![vec![(p, 1.0)]];
    let lowest = if p % 2 == 1 { half } else { half + 1 };
    for i in (lowest..p - 1).rev() {
        right.push(rest(i + 1, 1.0 - alpha(i + 1), &right[right.len() - 1], alpha(i + 1)));
    }
    if p % 2 == 1 && p > 1 {
        // Both sides reach the middle one.
        let (a, b) = (left.pop().unwrap_or_default(), right.pop().unwrap_or_default());
        left.push(a.into_iter().chain(b).map(|(k, s)| (k, 0.5 * s)).collect());
    }
    left.into_iter().chain(right.into_iter().rev()).collect()
}

/// The spline times a linear function, which makes its degree higher by one. A pole is the mean of
/// the polar form with each of its arguments left out in turn, times the function of that one.
/// Nothing is inserted and removed again, which would cost digits at uneven knots.
fn times_linear<P: Point>(
    knots: &KnotVector,
    net: &mut Net<P>,
    linear: impl Fn(f64) -> f64,
) -> Result<KnotVector> {
    let p = knots.degree();
    let raised =
        knots.breaks_and_multiplicities().into_iter().flat_map(|(t, m)| std::iter::repeat_n(t, m + 1));
    let raised = KnotVector::new(p + 1, raised.collect())?;
    let row = |j: usize| {
        let arguments = &raised.flat()[j + 1..=j + p + 1];
        let span = knots.span(arguments.iter().sum::<f64>() / (p + 1) as f64);
        let mut shares = vec![0.0; p + 1];
        for left_out in 0..=p {
            let mut rest: Vec<f64> = arguments.to_vec();
            let factor = linear(rest.remove(left_out)) / (p + 1) as f64;
            for (i, share) in polar_form(knots, span, &mut rest) {
                shares[i + p - span] += share * factor;
            }
        }
        shares.into_iter().enumerate().map(|(k, s)| (span + k - p, s)).filter(|(_, s)| *s != 0.0).collect()
    };
    let rows: Shares = (0..raised.len()).map(row).collect();
    net.combine(&rows);
    Ok(raised)
}

fn elevate<P: Point>(knots: &KnotVector, net: &mut Net<P>, by: usize) -> Result<KnotVector> {
    let p = knots.degree();
    if by == 0 {
        return Ok(knots.clone());
    }
    if p + by > MAX_DEGREE {
        let why = format!("degree {p} raised by {by} is above {MAX_DEGREE}");
        return Err(Error::Spline { why });
    }
    let mut knots = window(knots, net, knots.domain())?;
    let breaks = knots.breaks_and_multiplicities();
    refuse_jumps(p, &breaks)?;
    for _ in 0..by {
        knots = times_linear(&knots, net, |_| 1.0)?;
    }
    Ok(knots)
}

/// Coordinates and weights times a linear function, which is given at the ends of the domain.
fn weigh<P: Point>(knots: &KnotVector, net: &mut Net<P>, [start, end]: [f64; 2]) -> Result<KnotVector> {
    let (a, b) = knots.domain();
    let knots = window(knots, net, (a, b))?;
    refuse_jumps(knots.degree(), &knots.breaks_and_multiplicities())?;
    times_linear(&knots, net, |t| (start * (b - t) + end * (t - a)) / (b - a))
}

fn reduce<P: Point>(knots: &KnotVector, net: &mut Net<P>, tolerance: f64) -> Result<(KnotVector, f64)> {
    let p = knots.degree();
    if p < 2 {
        return Err(Error::Spline { why: format!("degree {p} cannot be reduced") });
    }
    let breaks = segments(knots, net)?;
    let before = net.clone();
    net.combine(&for_each_segment(&lowered(p), p, breaks.len() - 1));
    let mut back = net.clone();
    back.combine(&for_each_segment(&raised(p - 1, 1), p - 1, breaks.len() - 1));
    let mut change = back.distance(&before);
    if change > tolerance {
        let why =
            format!("degree {p} reduced by one moves the shape by up to {change:e}, beyond {tolerance:e}");
        return Err(Error::Numerics { why });
    }
    let mut knots = joined(p - 1, &breaks)?;
    for &(t, m) in &breaks[1..breaks.len() - 1] {
        let (fewer, more) = remove(&knots, net, t, p - m.max(1), tolerance - change)?;
        (knots, change) = (fewer, change + more);
    }
    Ok((knots, change))
}

impl<P: Point> NurbsCurve<P> {
    /// The same curve, clamped, with its degree raised by so much; continuity at knots is kept.
    ///
    /// # Errors
    /// [`Error::Spline`] beyond [`MAX_DEGREE`] and for curves that jump.
    pub fn elevated(&self, by: usize) -> Result<Self> {
        self.reshape(|knots, net| elevate(knots, net, by))
    }

    /// The same rational curve, clamped, with weights of one at both ends, at the same parameters: a
    /// linear function is multiplied in where the weights of the ends differ.
    pub(super) fn with_ends_of_weight_one(&self) -> Result<Self> {
        let curve = self.rational().clamped()?;
        let weights = curve.weights().unwrap_or_default();
        let [start, end] = [weights[0], weights[weights.len() - 1]];
        if (start - end).abs() <= f64::EPSILON * start {
            let even = weights.iter().map(|w| w / start).collect();
            return Self::new(curve.knots().clone(), curve.poles().to_vec(), Some(even));
        }
        curve.reshape(|knots, net| weigh(knots, net, [1.0 / start, 1.0 / end]))
    }

    /// A curve of a degree lower by one, with a bound of its distance (at equal parameters), no
    /// more than `tolerance`, in mm. Inner knots stay where their removal would go beyond.
    ///
    /// # Errors
    /// [`Error::Numerics`], with the bound, when the tolerance cannot be met; [`Error::Spline`] for
    /// degree 1 and curves that jump.
    pub fn reduced(&self, tolerance: f64) -> Result<(Self, f64)> {
        self.reshape_within(|knots, net| reduce(knots, net, tolerance))
    }
}

impl NurbsSurface {
    /// The same surface with its degree along `direction` raised, as [`NurbsCurve::elevated`].
    ///
    /// # Errors
    /// As there.
    pub fn elevated(&self, direction: Direction, by: usize) -> Result<Self> {
        self.reshape(direction, |knots, net| elevate(knots, net, by))
    }

    /// A surface of a degree lower by one along `direction`, as [`NurbsCurve::reduced`].
    ///
    /// # Errors
    /// As there.
    pub fn reduced(&self, direction: Direction, tolerance: f64) -> Result<(Self, f64)> {
        self.reshape_within(direction, |knots, net| reduce(knots, net, tolerance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn wave(degree: usize, rational: bool) -> NurbsCurve<DVec3> {
        let mut multiplicities = [1; 5];
        (multiplicities[0], multiplicities[4]) = (degree + 1, degree + 1);
        multiplicities[2] = 2.min(degree);
        let knots =
            KnotVector::with_multiplicities(degree, &[0.0, 0.2, 0.5, 0.6, 1.0], &multiplicities).unwrap();
        let n = knots.len();
        let poles = (0..n).map(|i| DVec3::new(i as f64, (i as f64).sin() * 2.0, (i % 3) as f64)).collect();
        let weights = rational.then(|| (0..n).map(|i| 1.0 + 0.5 * (i as f64).cos()).collect());
        NurbsCurve::new(knots, poles, weights).unwrap()
    }

    fn gap(a: &NurbsCurve<DVec3>, b: &NurbsCurve<DVec3>) -> f64 {
        let at = |i: usize| i as f64 / 997.0;
        (0..=997).map(|i| a.point(at(i)).distance(b.point(at(i)))).fold(0.0, f64::max)
    }

    #[test]
    fn elevation_keeps_the_curve_and_its_continuity() {
        for degree in 1..=9 {
            for by in 1..=2 {
                for rational in [false, true] {
                    let curve = wave(degree, rational);
                    let high = curve.elevated(by).unwrap();
                    let expected: Vec<usize> =
                        curve.knots().breaks_and_multiplicities().iter().map(|(_, m)| m + by).collect();
                    let is: Vec<usize> =
                        high.knots().breaks_and_multiplicities().iter().map(|(_, m)| *m).collect();
                    assert_eq!(is, expected);
                    let bound = 1e-14 * 10.0;
                    assert!(gap(&curve, &high) < bound, "degree {degree} + {by}: {}", gap(&curve, &high));
                }
            }
        }
    }

    #[test]
    fn uneven_knots_cost_no_digits() {
        for degree in 1..=9 {
            let knots = KnotVector::clamped(degree, &[0.0, 1e-3, 0.4, 0.4005, 0.9, 1.0]).unwrap();
            let poles =
                (0..knots.len()).map(|i| DVec3::new(i as f64, (i as f64).sin() * 2.0, (i % 3) as f64));
            let curve = NurbsCurve::new(knots.clone(), poles.collect(), None).unwrap();
            let found = gap(&curve, &curve.elevated(2).unwrap());
            assert!(found < 1e-14 * 10.0, "degree {degree}: {found:e}");
        }
    }

    #[test]
    fn reduction_undoes_elevation() {
        for degree in 1..=5 {
            for rational in [false, true] {
                let curve = wave(degree, rational);
                let (low, bound) = curve.elevated(1).unwrap().reduced(1e-10).unwrap();
                assert_eq!(low.knots(), curve.knots(), "degree {degree}");
                assert!(gap(&curve, &low) < 1e-11 && bound < 1e-10, "degree {degree}: {}", gap(&curve, &low));
            }
        }
    }

    #[test]
    fn the_error_of_a_reduction_is_bounded() {
        for degree in 2..=5 {
            let curve = wave(degree, degree % 2 == 0);
            let (low, bound) = curve.reduced(100.0).unwrap();
            let moved = gap(&curve, &low);
            assert!(moved <= bound && moved > 1e-6, "degree {degree}: moved {moved}, bound {bound}");
            let refused = curve.reduced(1e-9).unwrap_err();
            assert!(matches!(refused, Error::Numerics { .. }), "{refused}");
        }
    }

    #[test]
    fn a_surface_is_elevated_along_either_direction() {
        let knots = [3, 2].map(|p| KnotVector::clamped(p, &[0.0, 0.4, 1.0]).unwrap());
        let n = knots[0].len() * knots[1].len();
        let poles = (0..n).map(|i| DVec3::new((i / 4) as f64, (i % 4) as f64, (i as f64).sin())).collect();
        let [ku, kv] = knots;
        let s = NurbsSurface::new(ku, kv, poles, None).unwrap();
        let high = s.elevated(Direction::U, 1).unwrap().elevated(Direction::V, 2).unwrap();
        assert_eq!((high.knots_u().degree(), high.knots_v().degree()), (4, 4));
        for i in 0..100 {
            let (u, v) = (i as f64 / 99.0, (i * 37 % 100) as f64 / 99.0);
            assert!(high.point(u, v).distance(s.point(u, v)) < 2e-13, "({u}, {v})");
        }
    }
}
