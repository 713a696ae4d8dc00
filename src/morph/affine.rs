//! The best affine motion of a set of points, removed before anything is fitted: rotation,
//! uniform expansion and shear are then exact to rounding, unmeshed regions included.

use glam::{DMat3, DVec3};
use nalgebra::{Matrix3, Vector3};

/// A displacement `x ↦ linear · (x − centre) + shift`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineField {
    /// Gradient of the displacement.
    pub linear: DMat3,
    /// Where `shift` is the displacement.
    pub centre: DVec3,
    /// Displacement of the centre, mm.
    pub shift: DVec3,
}

/// Directions in which the points spread less than this fraction of their largest spread carry
/// no gradient.
const FLAT: f64 = 1e-4;

impl AffineField {
    /// Least squares over points and their displacements; without points, no motion.
    ///
    /// Points in a plane or on a line determine the motion only along it: the gradient across is
    /// left at zero.
    pub fn fit(points: &[DVec3], displacements: &[DVec3]) -> Self {
        let n = points.len().max(1) as f64;
        let centre = points.iter().sum::<DVec3>() / n;
        let shift = displacements.iter().sum::<DVec3>() / n;
        let mut products = Matrix3::<f64>::zeros();
        for (x, d) in points.iter().zip(displacements) {
            products += vector(*d - shift) * vector(*x - centre).transpose();
        }
        let eigen = moments(points, centre).symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let inverse =
            eigen.eigenvalues.map(|e| if e > FLAT * FLAT * largest && e > 0.0 { 1.0 / e } else { 0.0 });
        let inverse = eigen.eigenvectors * Matrix3::from_diagonal(&inverse) * eigen.eigenvectors.transpose();
        let a: Matrix3<f64> = products * inverse;
        let column = |j: usize| DVec3::new(a[(0, j)], a[(1, j)], a[(2, j)]);
        Self { linear: DMat3::from_cols(column(0), column(1), column(2)), centre, shift }
    }

    /// No displacement.
    pub const NONE: Self = Self { linear: DMat3::ZERO, centre: DVec3::ZERO, shift: DVec3::ZERO };

    /// The displacement at `x`.
    pub fn at(&self, x: DVec3) -> DVec3 {
        self.linear * (x - self.centre) + self.shift
    }
}

/// Whether points determine an affine motion everywhere: they do not lie in a plane.
pub fn spans_space(points: &[DVec3]) -> bool {
    let centre = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    let spreads = moments(points, centre).symmetric_eigenvalues();
    spreads.min() > FLAT * FLAT * spreads.max()
}

fn vector(v: DVec3) -> Vector3<f64> {
    Vector3::from(v.to_array())
}

/// Second moments of points about `centre`.
fn moments(points: &[DVec3], centre: DVec3) -> Matrix3<f64> {
    points.iter().map(|x| vector(*x - centre)).map(|r| r * r.transpose()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud() -> Vec<DVec3> {
        let f = |k: usize, s: f64| (k as f64 * s).sin() * 20.0;
        (0..200).map(|k| DVec3::new(f(k, 1.3), 150.0 + f(k, 2.1), f(k, 0.7))).collect()
    }

    #[test]
    fn affine_fields_are_found_to_rounding() {
        let linear = DMat3::from_cols(
            DVec3::new(-0.008, 0.1, 0.0),
            DVec3::new(0.3, -0.2, 0.01),
            DVec3::new(0.0, 1.0, 0.5),
        );
        let field =
            AffineField { linear, centre: DVec3::new(1.0, 2.0, 3.0), shift: DVec3::new(0.4, 0.0, -7.0) };
        let x = cloud();
        let d: Vec<DVec3> = x.iter().map(|x| field.at(*x)).collect();
        let fitted = AffineField::fit(&x, &d);
        let far = DVec3::new(300.0, -200.0, 50.0);
        assert!((fitted.at(far) - field.at(far)).length() < 1e-10);
    }

    #[test]
    fn flat_clouds_get_no_gradient_across() {
        let x: Vec<DVec3> = cloud().iter().map(|p| DVec3::new(p.x, p.y, 0.0)).collect();
        let d: Vec<DVec3> = x.iter().map(|p| DVec3::new(0.01 * p.x, 0.0, 0.0)).collect();
        let fitted = AffineField::fit(&x, &d);
        assert!((fitted.linear * DVec3::Z).length() < 1e-12);
        assert!(!spans_space(&x) && !spans_space(&[]) && spans_space(&cloud()));
        assert!((fitted.at(x[5]) - d[5]).length() < 1e-12);
        assert_eq!(AffineField::fit(&[], &[]).at(DVec3::ONE), DVec3::ZERO);
    }
}
