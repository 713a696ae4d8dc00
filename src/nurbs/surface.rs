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
        self.jet::<1>(u, v)[0][0]
    }

    /// The point, `S_u` and `S_v` at (u, v).
    pub fn first_derivatives(&self, u: f64, v: f64) -> [DVec3; 3] {
        let jet = self.jet::<2>(u, v);
        [jet[0][0], jet[1][0], jet[0][1]]
    }

    /// The point and all derivatives up to the second at (u, v) (A4.4).
    pub fn derivatives(&self, u: f64, v: f64) -> SurfaceDerivatives {
        self.jet::<3>(u, v).into()
    }

    /// Derivatives `[k][l]`, the `k`-th in `u` and `l`-th in `v`, for `k + l < K`.
    fn jet<const K: usize>(&self, u: f64, v: f64) -> [[DVec3; K]; K] {
        // Known sizes let the compiler unroll: most surfaces are bicubic.
        match (self.knots_u.degree(), self.knots_v.degree(), &self.weights) {
            (3, 3, None) => self.polynomial_jet::<K, 4>(3, 3, u, v),
            (p @ ..6, q @ ..6, None) => self.polynomial_jet::<K, 6>(p, q, u, v),
            (p, q, None) => self.polynomial_jet::<K, { MAX_DEGREE + 1 }>(p, q, u, v),
            (.., Some(weights)) => self.rational_jet(weights, u, v),
        }
    }

    /// Derivatives are summed over differences from a pole of the span, so that those on short
    /// spans do not lose the digits of the position.
    #[inline(always)]
    fn polynomial_jet<const K: usize, const W: usize>(
        &self,
        p: usize,
        q: usize,
        u: f64,
        v: f64,
    ) -> [[DVec3; K]; K] {
        let (su, nu) = self.knots_u.functions::<K, W>(u);
        let (sv, nv) = self.knots_v.functions::<K, W>(v);
        let columns = self.knots_v.len();
        let origin = if K > 1 { self.poles[su * columns + sv] } else { DVec3::ZERO };
        let mut jet = [[DVec3::ZERO; K]; K];
        for i in 0..=p {
            let first = (su - p + i) * columns + sv - q;
            let row = &self.poles[first..=first + q];
            let mut line = [DVec3::ZERO; K];
            for j in 0..=q {
                let pole = row[j] - origin;
                for l in 0..K {
                    line[l] += pole * nv[l][j];
                }
            }
            for k in 0..K {
                for l in 0..K - k {
                    jet[k][l] += line[l] * nu[k][i];
                }
            }
        }
        jet[0][0] += origin;
        jet
    }

    fn rational_jet<const K: usize>(&self, weights: &[f64], u: f64, v: f64) -> [[DVec3; K]; K] {
        let (p, q) = (self.knots_u.degree(), self.knots_v.degree());
        let (su, nu) = self.knots_u.functions::<K, { MAX_DEGREE + 1 }>(u);
        let (sv, nv) = self.knots_v.functions::<K, { MAX_DEGREE + 1 }>(v);
        let columns = self.knots_v.len();
        let last = su * columns + sv;
        let (origin, base) = (self.poles[last], weights[last]);
        let (mut jet, mut total) = ([[DVec3::ZERO; K]; K], [[0.0; K]; K]);
        for i in 0..=p {
            let first = (su - p + i) * columns + sv - q;
            let (mut line, mut excess) = ([DVec3::ZERO; K], [0.0; K]);
            for j in 0..=q {
                let weight = weights[first + j];
                let pole = (self.poles[first + j] - origin) * weight;
                for l in 0..K {
                    line[l] += pole * nv[l][j];
                    excess[l] += (weight - base) * nv[l][j];
                }
            }
            for k in 0..K {
                for l in 0..K - k {
                    jet[k][l] += line[l] * nu[k][i];
                    total[k][l] += excess[l] * nu[k][i];
                }
            }
        }
        total[0][0] += base;
        divide(&mut jet, &total);
        jet[0][0] += origin;
        jet
    }
}

/// Divides homogeneous derivatives by those of the weight (eq. 4.20), up to the second order.
pub(crate) fn divide<const K: usize>(jet: &mut [[DVec3; K]; K], weight: &[[f64; K]; K]) {
    let binomial = |n: usize, k: usize| if n == 2 && k == 1 { 2.0 } else { 1.0 };
    for k in 0..K {
        for l in 0..K - k {
            let mut sum = jet[k][l];
            for i in 0..=k {
                for j in usize::from(i == 0)..=l {
                    sum -= jet[k - i][l - j] * (binomial(k, i) * binomial(l, j) * weight[i][j]);
                }
            }
            jet[k][l] = sum / weight[0][0];
        }
    }
}

impl From<[[DVec3; 3]; 3]> for SurfaceDerivatives {
    fn from(jet: [[DVec3; 3]; 3]) -> Self {
        Self { s: jet[0][0], u: jet[1][0], v: jet[0][1], uu: jet[2][0], uv: jet[1][1], vv: jet[0][2] }
    }
}
