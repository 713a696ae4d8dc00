//! Displacement fields in closed form.

use glam::{DMat3, DVec3};

/// `x ↦ gradient · x + shift`.
pub struct Affine {
    pub gradient: DMat3,
    pub shift: DVec3,
}

impl Affine {
    pub fn at(&self, x: DVec3) -> DVec3 {
        self.gradient * x + self.shift
    }

    /// Volume after over volume before.
    pub fn volume_ratio(&self) -> f64 {
        (DMat3::IDENTITY + self.gradient).determinant()
    }

    /// Uniform shrinking.
    pub fn scaling() -> Self {
        Self { gradient: DMat3::from_diagonal(DVec3::splat(-0.008)), shift: DVec3::ZERO }
    }

    /// A turn of a quarter radian with some shear and another stretch in each direction.
    pub fn turned_and_sheared() -> Self {
        let stretch = DMat3::from_diagonal(DVec3::new(1.01, 0.98, 1.03));
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(0.05, 1.0, 0.0), DVec3::new(0.0, -0.03, 1.0));
        let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.25);
        Self { gradient: turn * shear * stretch - DMat3::IDENTITY, shift: DVec3::new(0.3, -0.1, 0.2) }
    }

    pub fn translation() -> Self {
        Self { gradient: DMat3::ZERO, shift: DVec3::new(0.5, -0.25, 0.125) }
    }
}

/// Bending of a beam along z in the xz plane, exactly onto an arc of this curvature (1/mm).
pub fn bend(x: DVec3, curvature: f64) -> DVec3 {
    let (angle, radius) = (curvature * x.z, 1.0 / curvature - x.x);
    DVec3::new(1.0 / curvature - radius * angle.cos(), x.y, radius * angle.sin()) - x
}

/// A twist about z by this angle a length (1/mm).
pub fn twist(x: DVec3, rate: f64) -> DVec3 {
    let (s, c) = (rate * x.z).sin_cos();
    DVec3::new(c * x.x - s * x.y, s * x.x + c * x.y, x.z) - x
}

/// Expansion by a temperature that grows with the square of x and of z.
pub fn heat(x: DVec3, rate: f64) -> DVec3 {
    x * (rate * (x.x * x.x + 0.5 * x.z * x.z + x.x * x.y))
}
