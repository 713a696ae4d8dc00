//! Spline interpolation at the Greville abscissae, for curves and tensor-product surfaces, and of
//! closed curves through points.
//!
//! Interpolating a spline of a subspace gives it back (knot insertion, degree elevation and
//! restriction to a window are all this one operation, exact to rounding), and interpolating
//! anything else is a quasi-best approximation (de Boor, *A Practical Guide to Splines*, ch. XIII).

use crate::error::{Error, Result};
use crate::linalg::BandedLu;
use crate::linalg::banded::Rhs;
use crate::nurbs::basis::MAX_DEGREE;
use crate::nurbs::{KnotVector, NurbsCurve, Point};
use nalgebra::DMatrix;

/// The factored collocation matrix of a knot vector at its Greville abscissae.
#[derive(Debug, Clone)]
pub struct Collocation {
    points: Vec<f64>,
    lu: BandedLu,
}

impl Collocation {
    /// Builds and factors the matrix.
    ///
    /// # Errors
    /// [`crate::Error::Numerics`] for knots so uneven that the matrix is singular to rounding.
    pub fn new(knots: &KnotVector) -> Result<Self> {
        let points = knots.greville();
        let rows: Vec<(usize, Vec<f64>)> = points.iter().map(|&t| row(knots, t)).collect();
        Ok(Self { lu: BandedLu::new(&rows)?, points })
    }

    /// The parameters at which values are wanted.
    pub fn points(&self) -> &[f64] {
        &self.points
    }

    /// Turns values at [`points`](Self::points) into poles, in place.
    pub fn poles<T: Rhs>(&self, values: &mut [T]) {
        self.lu.solve_strided(values, 0, 1);
    }

    /// Turns values on the grid `u.points() × v.points()` (`v` fastest) into poles, in place.
    pub fn poles_tensor<T: Rhs>(u: &Self, v: &Self, values: &mut [T]) {
        let (rows, columns) = (u.points.len(), v.points.len());
        for i in 0..rows {
            v.lu.solve_strided(values, i * columns, 1);
        }
        for j in 0..columns {
            u.lu.solve_strided(values, j, columns);
        }
    }
}

/// The functions that do not vanish at `t`, and the index of the first.
fn row(knots: &KnotVector, t: f64) -> (usize, Vec<f64>) {
    let (p, span) = (knots.degree(), knots.span(t));
    let mut n = [0.0; MAX_DEGREE + 1];
    knots.basis(span, t, &mut n);
    (span - p, n[..=p].to_vec())
}

/// The closed spline, smooth at its seam as everywhere, that passes the points at the parameters.
/// There is one parameter more than points: where the first is passed again. Parameters of a list
/// that ends with its first point, as [`super::parametrise::parameters`] makes them, will do.
///
/// Odd degrees have their knots at the parameters; even ones halfway between, and their domain
/// begins half a step before the first parameter. The knots are unclamped and periodic.
///
/// # Errors
/// [`Error::Argument`] for counts that disagree, no more points than the degree, points that are not
/// finite, or parameters that do not ascend; [`Error::Numerics`] where even knots of a high degree
/// are too uneven to determine the spline.
pub fn interpolate_closed<P: Point + Rhs>(
    degree: usize,
    parameters: &[f64],
    points: &[P],
) -> Result<NurbsCurve<P>> {
    check_closed(degree, parameters, points)?;
    let (n, period) = (points.len(), parameters[points.len()] - parameters[0]);
    let breaks = if degree % 2 == 1 {
        parameters.to_vec()
    } else {
        let before = parameters[n - 1] - period;
        let mut halfway = vec![0.5 * (before + parameters[0])];
        halfway.extend(parameters[..n].windows(2).map(|w| 0.5 * (w[0] + w[1])));
        halfway.push(halfway[0] + period);
        halfway
    };
    let knots = KnotVector::periodic(degree, &breaks)?;
    let mut x = points.to_vec();
    // Counted from here, the largest function at each parameter is that of its own number.
    let shift = degree / 2;
    let rows: Vec<_> = parameters[..n].iter().map(|&t| row(&knots, t)).collect();
    solve_cyclic(&rows, shift, &mut x)?;
    x.rotate_right(shift);
    NurbsCurve::new(knots.clone(), knots.wrapped(&x), None)
}

fn check_closed<P: Point>(degree: usize, parameters: &[f64], points: &[P]) -> Result<()> {
    let fail = |name: &'static str, why: String| Err(Error::Argument { name, why });
    let n = points.len();
    if n <= degree {
        let least = degree + 1;
        return fail("points", format!("a closed curve of degree {degree} needs {least} points, not {n}"));
    }
    if parameters.len() != n + 1 {
        let why = format!("{} were expected for {n} points, not {}", n + 1, parameters.len());
        return fail("parameters", why);
    }
    if let Some(i) = points.iter().position(|p| !p.is_finite()) {
        return fail("points", format!("point {} is {:?}", i + 1, points[i]));
    }
    if let Some(i) = parameters.iter().position(|t| !t.is_finite()) {
        return fail("parameters", format!("parameter {} is {}", i + 1, parameters[i]));
    }
    match parameters.windows(2).position(|w| w[1] <= w[0]) {
        Some(i) => {
            fail("parameters", format!("they must ascend: {} follows {}", parameters[i + 1], parameters[i]))
        }
        None => Ok(()),
    }
}

/// Solves a cyclic banded system in place; rows are (first column + `shift`, values), their columns
/// counted around.
///
/// What reaches around is taken as a change of the few rows that do so (Woodbury 1950): the rest is
/// a section of a totally positive matrix, which needs no pivots.
fn solve_cyclic<P: Point + Rhs>(rows: &[(usize, Vec<f64>)], shift: usize, x: &mut [P]) -> Result<()> {
    let n = rows.len();
    let mut inner = Vec::new();
    let mut around: Vec<(usize, Vec<(usize, f64)>)> = Vec::new();
    for (i, (first, values)) in rows.iter().enumerate() {
        let column = |k: usize| (first + k) as isize - shift as isize;
        let is_inner = |k: &usize| (0..n as isize).contains(&column(*k));
        let kept: Vec<usize> = (0..values.len()).filter(is_inner).collect();
        inner.push((column(kept[0]) as usize, kept.iter().map(|&k| values[k]).collect()));
        let outer = (0..values.len()).filter(|k| !is_inner(k) && values[*k] != 0.0);
        let outer: Vec<_> = outer.map(|k| (column(k).rem_euclid(n as isize) as usize, values[k])).collect();
        if !outer.is_empty() {
            around.push((i, outer));
        }
    }
    let lu = BandedLu::new(&inner)?;
    lu.solve_strided(x, 0, 1);
    let unit = |&(i, _): &(usize, Vec<(usize, f64)>)| {
        let mut column = vec![0.0; n];
        column[i] = 1.0;
        lu.solve_strided(&mut column, 0, 1);
        column
    };
    let columns: Vec<Vec<f64>> = around.iter().map(unit).collect();
    let entry = |r: usize, c: usize| {
        let sum: f64 = around[r].1.iter().map(|&(k, value)| value * columns[c][k]).sum();
        sum + f64::from(r == c)
    };
    let inverse = DMatrix::from_fn(around.len(), around.len(), entry).try_inverse();
    let why = "the points of a closed curve do not determine it: their parameters are too uneven";
    let inverse = inverse.ok_or_else(|| Error::Numerics { why: why.into() })?;
    let reached = |(_, outer): &(usize, Vec<(usize, f64)>)| {
        outer.iter().fold(P::default(), |sum, &(k, value)| sum + x[k] * value)
    };
    let reached: Vec<P> = around.iter().map(reached).collect();
    for (r, column) in columns.iter().enumerate() {
        let change = (0..reached.len()).fold(P::default(), |sum, c| sum + reached[c] * inverse[(r, c)]);
        for (x, share) in x.iter_mut().zip(column) {
            *x -= change * *share;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::Side;
    use crate::ops::parametrise::{Spacing, parameters};
    use glam::DVec2;
    use std::f64::consts::TAU;

    /// Points of an egg, unevenly spaced, with their parameters.
    fn egg(count: usize) -> (Vec<f64>, Vec<DVec2>) {
        let t: Vec<f64> =
            (0..count).map(|i| (i as f64 + 0.3 * (i as f64).sin()) * TAU / count as f64).collect();
        let at = |t: &f64| DVec2::from_angle(*t) * (2.0 + 0.5 * t.cos());
        let points = t.iter().map(at).collect();
        (t.iter().copied().chain([t[0] + TAU]).collect(), points)
    }

    #[test]
    fn closed_curves_pass_their_points_and_are_smooth_at_the_seam() {
        for degree in 1..=9 {
            for count in [degree + 1, degree + 2, 25, 200] {
                let (t, points) = egg(count);
                let curve = interpolate_closed(degree, &t, &points).unwrap();
                for (t, p) in t.iter().zip(&points) {
                    let gap = curve.point(*t).distance(*p);
                    assert!(gap < 1e-11, "degree {degree}, {count} points: {gap} off at {t}");
                }
                let (a, b) = curve.knots().domain();
                let start = curve.derivatives_from(Side::Above, a, degree - 1);
                let end = curve.derivatives_from(Side::Below, b, degree - 1);
                for (k, (a, b)) in start.iter().zip(&end).enumerate() {
                    // Rounding, divided by the steps to the power of the order.
                    let (jump, limit) =
                        ((*a - *b).length(), 1e-13 * (count as f64 / TAU).max(1.0).powi(k as i32));
                    assert!(jump < limit, "degree {degree}, {count} points: derivative {k} jumps by {jump}");
                }
            }
        }
    }

    #[test]
    fn where_a_closed_curve_begins_does_not_matter() {
        for degree in [2, 3, 4, 5] {
            let (t, points) = egg(17);
            let curve = interpolate_closed(degree, &t, &points).unwrap();
            let (mut later, mut rotated) = (t[5..17].to_vec(), points.clone());
            later.extend(t[..=5].iter().map(|t| t + TAU));
            rotated.rotate_left(5);
            let other = interpolate_closed(degree, &later, &rotated).unwrap();
            for i in 0..100 {
                let t = TAU * i as f64 / 100.0;
                let (a, b) = (curve.knots().reduced(t), other.knots().reduced(t));
                let gap = curve.point(a).distance(other.point(b));
                assert!(gap < 1e-12, "degree {degree} at {t}: {gap}");
            }
        }
    }

    #[test]
    fn closed_interpolation_gains_a_power_for_each_degree() {
        let error = |degree: usize, count: usize| {
            let t: Vec<f64> = (0..=count).map(|i| TAU * i as f64 / count as f64).collect();
            let points: Vec<DVec2> = t[..count].iter().map(|t| DVec2::from_angle(*t)).collect();
            let curve = interpolate_closed(degree, &t, &points).unwrap();
            let off =
                |i: usize| (curve.point(curve.knots().reduced(TAU * i as f64 / 999.0)).length() - 1.0).abs();
            (0..999).map(off).fold(0.0, f64::max)
        };
        for degree in [2, 3, 4, 5] {
            let gain = error(degree, 12) / error(degree, 24);
            assert!(gain > 0.7 * 2f64.powi(degree as i32 + 1), "degree {degree} gained {gain}");
        }
    }

    #[test]
    fn unusable_points_of_closed_curves_are_refused() {
        let (t, points) = egg(5);
        let message = |degree: usize, t: &[f64], points: &[DVec2]| {
            interpolate_closed(degree, t, points).unwrap_err().to_string()
        };
        assert!(message(5, &t, &points).contains("needs 6 points"));
        assert!(message(3, &t[..5], &points).contains("6 were expected"));
        assert!(message(3, &[0.0, 1.0, 1.0, 2.0, 3.0, 4.0], &points).contains("ascend"));
        assert!(message(3, &t, &[vec![DVec2::NAN], points[1..].to_vec()].concat()).contains("point 1"));
        let closed = [points.clone(), vec![points[0]]].concat();
        let chords = parameters(&closed, Spacing::ChordLength).unwrap();
        assert!(interpolate_closed(3, &chords, &points).is_ok());
    }

    #[test]
    fn refinement_by_interpolation_keeps_the_curve() {
        let coarse = KnotVector::clamped(3, &[0.0, 0.4, 1.0]).unwrap();
        let poles: Vec<DVec2> = (0..5).map(|i| DVec2::new(i as f64, (i * i) as f64 * 0.3)).collect();
        let curve = NurbsCurve::new(coarse, poles, None).unwrap();
        // Degree 5, the old knot twice more (same continuity), one new knot.
        let mut flat = vec![0.0; 6];
        flat.extend([0.2, 0.4, 0.4, 0.4]);
        flat.extend([1.0; 6]);
        let fine = KnotVector::new(5, flat).unwrap();
        let c = Collocation::new(&fine).unwrap();
        let mut values: Vec<DVec2> = c.points().iter().map(|&t| curve.point(t)).collect();
        c.poles(&mut values);
        let same = NurbsCurve::new(fine, values, None).unwrap();
        for i in 0..=100 {
            let t = i as f64 / 100.0;
            assert!((same.point(t) - curve.point(t)).length() < 1e-14, "at {t}");
        }
    }

    #[test]
    fn error_falls_with_the_sixth_power_for_quintics() {
        let error = |spans: usize| {
            let breaks: Vec<f64> = (0..=spans).map(|i| i as f64 / spans as f64).collect();
            let knots = KnotVector::clamped(5, &breaks).unwrap();
            let c = Collocation::new(&knots).unwrap();
            let mut poles: Vec<f64> = c.points().iter().map(|t| (3.0 * t).sin()).collect();
            c.poles(&mut poles);
            let curve =
                NurbsCurve::new(knots, poles.iter().map(|&y| DVec2::new(0.0, y)).collect(), None).unwrap();
            (0..=999)
                .map(|i| i as f64 / 999.0)
                .map(|t| (curve.point(t).y - (3.0 * t).sin()).abs())
                .fold(0.0, f64::max)
        };
        let ratio = error(4) / error(8);
        assert!(ratio > 30.0, "halving the spans gained only {ratio}");
    }
}
