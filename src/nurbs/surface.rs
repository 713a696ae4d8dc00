//! NURBS surfaces in space.

use super::basis::{KnotVector, MAX_DEGREE};
use super::curve::check_poles;
use crate::error::Result;
use glam::DVec3;

/// A NURBS surface; poles and weights are stored with `v` fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsSurface {
    knots_u: KnotVector,
    knots_v: KnotVector,
    poles: Vec<DVec3>,
    weights: Option<Vec<f64>>,
}

/// A point of a surface with all derivatives up to the second.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SurfaceDerivatives {
    /// The point.
    pub s: DVec3,
    /// First derivative in `u`.
    pub u: DVec3,
    /// First derivative in `v`.
    pub v: DVec3,
    /// Second derivative in `u`.
    pub uu: DVec3,
    /// Mixed second derivative.
    pub uv: DVec3,
    /// Second derivative in `v`.
    pub vv: DVec3,
}

impl SurfaceDerivatives {
    /// The normal `S_u × S_v`, not normalised.
    pub fn normal(&self) -> DVec3 {
        self.u.cross(self.v)
    }
}

impl NurbsSurface {
    /// A surface from knots, poles (`v` fastest) and, if rational, weights.
    ///
    /// # Errors
    /// [`crate::Error::Spline`] when the counts disagree or a value is not usable.
    pub fn new(
        knots_u: KnotVector,
        knots_v: KnotVector,
        poles: Vec<DVec3>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self> {
        check_poles(knots_u.len() * knots_v.len(), &poles, weights.as_deref())?;
        Ok(Self { knots_u, knots_v, poles, weights })
    }

    /// Knots along `u`.
    pub fn knots_u(&self) -> &KnotVector {
        &self.knots_u
    }

    /// Knots along `v`.
    pub fn knots_v(&self) -> &KnotVector {
        &self.knots_v
    }

    /// The poles, `v` fastest.
    pub fn poles(&self) -> &[DVec3] {
        &self.poles
    }

    /// The poles, for writing.
    pub fn poles_mut(&mut self) -> &mut [DVec3] {
        &mut self.poles
    }

    /// The weights, if rational.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The point at (u, v).
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        let (p, q) = (self.knots_u.degree(), self.knots_v.degree());
        let (su, sv) = (self.knots_u.span(u), self.knots_v.span(v));
        let (mut nu, mut nv) = ([0.0; MAX_DEGREE + 1], [0.0; MAX_DEGREE + 1]);
        self.knots_u.basis(su, u, &mut nu);
        self.knots_v.basis(sv, v, &mut nv);
        let columns = self.knots_v.len();
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        for i in 0..=p {
            let row = (su - p + i) * columns + sv - q;
            for j in 0..=q {
                let b = nu[i] * nv[j] * self.weights.as_ref().map_or(1.0, |w| w[row + j]);
                sum += self.poles[row + j] * b;
                total += b;
            }
        }
        if self.weights.is_some() { sum / total } else { sum }
    }

    /// The point, `S_u` and `S_v` at (u, v).
    pub fn first_derivatives(&self, u: f64, v: f64) -> [DVec3; 3] {
        let (p, q) = (self.knots_u.degree(), self.knots_v.degree());
        let (su, sv) = (self.knots_u.span(u), self.knots_v.span(v));
        let (mut nu, mut nv) = ([0.0; 2 * (MAX_DEGREE + 1)], [0.0; 2 * (MAX_DEGREE + 1)]);
        self.knots_u.basis_derivatives(su, u, 1, &mut nu);
        self.knots_v.basis_derivatives(sv, v, 1, &mut nv);
        let columns = self.knots_v.len();
        let (mut a, mut w) = ([DVec3::ZERO; 3], [0.0; 3]);
        for i in 0..=p {
            let row = (su - p + i) * columns + sv - q;
            let (mut line, mut line_w) = ([DVec3::ZERO; 2], [0.0; 2]);
            for j in 0..=q {
                let weight = self.weights.as_ref().map_or(1.0, |w| w[row + j]);
                let pole = self.poles[row + j] * weight;
                for l in 0..2 {
                    line[l] += pole * nv[l * (q + 1) + j];
                    line_w[l] += weight * nv[l * (q + 1) + j];
                }
            }
            for (k, l, f) in [(0, 0, nu[i]), (1, 0, nu[p + 1 + i]), (2, 1, nu[i])] {
                a[k] += line[l] * f;
                w[k] += line_w[l] * f;
            }
        }
        if self.weights.is_none() {
            return a;
        }
        let s = a[0] / w[0];
        [s, (a[1] - s * w[1]) / w[0], (a[2] - s * w[2]) / w[0]]
    }

    /// The point and all derivatives up to the second at (u, v) (A4.4).
    pub fn derivatives(&self, u: f64, v: f64) -> SurfaceDerivatives {
        let (p, q) = (self.knots_u.degree(), self.knots_v.degree());
        let (su, sv) = (self.knots_u.span(u), self.knots_v.span(v));
        let (mut nu, mut nv) = ([0.0; 3 * (MAX_DEGREE + 1)], [0.0; 3 * (MAX_DEGREE + 1)]);
        self.knots_u.basis_derivatives(su, u, 2, &mut nu);
        self.knots_v.basis_derivatives(sv, v, 2, &mut nv);
        let columns = self.knots_v.len();
        // Homogeneous sums a[k][l] = d^{k+l}(wS)/du^k dv^l, w likewise.
        let (mut a, mut w) = ([[DVec3::ZERO; 3]; 3], [[0.0; 3]; 3]);
        for i in 0..=p {
            let row = (su - p + i) * columns + sv - q;
            let (mut line, mut line_w) = ([DVec3::ZERO; 3], [0.0; 3]);
            for j in 0..=q {
                let weight = self.weights.as_ref().map_or(1.0, |w| w[row + j]);
                let pole = self.poles[row + j] * weight;
                for l in 0..3 {
                    line[l] += pole * nv[l * (q + 1) + j];
                    line_w[l] += weight * nv[l * (q + 1) + j];
                }
            }
            for k in 0..3 {
                for l in 0..3 - k {
                    a[k][l] += line[l] * nu[k * (p + 1) + i];
                    w[k][l] += line_w[l] * nu[k * (p + 1) + i];
                }
            }
        }
        if self.weights.is_none() {
            return SurfaceDerivatives {
                s: a[0][0],
                u: a[1][0],
                v: a[0][1],
                uu: a[2][0],
                uv: a[1][1],
                vv: a[0][2],
            };
        }
        let w0 = w[0][0];
        let s = a[0][0] / w0;
        let du = (a[1][0] - s * w[1][0]) / w0;
        let dv = (a[0][1] - s * w[0][1]) / w0;
        let uu = (a[2][0] - du * (2.0 * w[1][0]) - s * w[2][0]) / w0;
        let uv = (a[1][1] - dv * w[1][0] - du * w[0][1] - s * w[1][1]) / w0;
        let vv = (a[0][2] - dv * (2.0 * w[0][1]) - s * w[0][2]) / w0;
        SurfaceDerivatives { s, u: du, v: dv, uu, uv, vv }
    }
}
