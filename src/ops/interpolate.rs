//! Spline interpolation at the Greville abscissae, for curves and tensor-product surfaces.
//!
//! Interpolating a spline of a subspace gives it back (knot insertion, degree elevation and
//! restriction to a window are all this one operation, exact to rounding), and interpolating
//! anything else is a quasi-best approximation (de Boor, *A Practical Guide to Splines*, ch. XIII).

use crate::error::Result;
use crate::linalg::BandedLu;
use crate::linalg::banded::Rhs;
use crate::nurbs::KnotVector;
use crate::nurbs::basis::MAX_DEGREE;

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
        let p = knots.degree();
        let points = knots.greville();
        let rows: Vec<(usize, Vec<f64>)> = points
            .iter()
            .map(|&t| {
                let span = knots.span(t);
                let mut n = [0.0; MAX_DEGREE + 1];
                knots.basis(span, t, &mut n);
                (span - p, n[..=p].to_vec())
            })
            .collect();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::NurbsCurve;
    use glam::DVec2;

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
