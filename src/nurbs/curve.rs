//! NURBS curves in two and three dimensions.

use super::basis::{KnotVector, MAX_DEGREE};
use crate::error::{Error, Result};
use glam::{DVec2, DVec3};
use std::ops::{Add, Div, Mul, Sub};

/// A point of the plane or of space.
pub trait Point:
    Copy
    + Default
    + PartialEq
    + std::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + Send
    + Sync
{
    /// Number of coordinates.
    const DIMENSION: usize;
    /// A point from its coordinates; those beyond the dimension are ignored.
    fn from_coordinates(coordinates: [f64; 3]) -> Self;
    /// The coordinates, padded with zeros.
    fn coordinates(self) -> [f64; 3];
    /// Scalar product.
    fn dot(self, other: Self) -> f64;
    /// Whether every coordinate is finite.
    fn is_finite(self) -> bool;
    /// The smaller of each coordinate.
    fn min(self, other: Self) -> Self;
    /// The larger of each coordinate.
    fn max(self, other: Self) -> Self;
    /// The largest coordinate.
    fn max_element(self) -> f64;
    /// Euclidean length.
    fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
}

impl Point for DVec2 {
    const DIMENSION: usize = 2;
    fn coordinates(self) -> [f64; 3] {
        [self.x, self.y, 0.0]
    }
    fn from_coordinates([x, y, _]: [f64; 3]) -> Self {
        DVec2::new(x, y)
    }
    fn dot(self, other: Self) -> f64 {
        DVec2::dot(self, other)
    }
    fn is_finite(self) -> bool {
        DVec2::is_finite(self)
    }
    fn min(self, other: Self) -> Self {
        DVec2::min(self, other)
    }
    fn max(self, other: Self) -> Self {
        DVec2::max(self, other)
    }
    fn max_element(self) -> f64 {
        DVec2::max_element(self)
    }
}

impl Point for DVec3 {
    const DIMENSION: usize = 3;
    fn coordinates(self) -> [f64; 3] {
        self.to_array()
    }
    fn from_coordinates(coordinates: [f64; 3]) -> Self {
        DVec3::from_array(coordinates)
    }
    fn dot(self, other: Self) -> f64 {
        DVec3::dot(self, other)
    }
    fn is_finite(self) -> bool {
        DVec3::is_finite(self)
    }
    fn min(self, other: Self) -> Self {
        DVec3::min(self, other)
    }
    fn max(self, other: Self) -> Self {
        DVec3::max(self, other)
    }
    fn max_element(self) -> f64 {
        DVec3::max_element(self)
    }
}

/// A NURBS curve; without weights a B-spline curve.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsCurve<P: Point> {
    knots: KnotVector,
    poles: Vec<P>,
    weights: Option<Vec<f64>>,
}

/// Checks poles and weights against the number of basis functions.
pub(super) fn check_poles<P: Point>(expected: usize, poles: &[P], weights: Option<&[f64]>) -> Result<()> {
    let fail = |why: String| Err(Error::Spline { why });
    if poles.len() != expected {
        return fail(format!("{} poles where the knots ask for {expected}", poles.len()));
    }
    if let Some(i) = poles.iter().position(|p| !p.is_finite()) {
        return fail(format!("pole {} is not finite", i + 1));
    }
    if let Some(w) = weights {
        if w.len() != expected {
            return fail(format!("{} weights for {expected} poles", w.len()));
        }
        if let Some(i) = w.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
            return fail(format!("weight {} is {}: weights must be positive", i + 1, w[i]));
        }
    }
    Ok(())
}

impl<P: Point> NurbsCurve<P> {
    /// A curve from knots, poles and, if rational, weights.
    ///
    /// # Errors
    /// [`Error::Spline`] when the counts disagree or a value is not usable.
    pub fn new(knots: KnotVector, poles: Vec<P>, weights: Option<Vec<f64>>) -> Result<Self> {
        check_poles(knots.len(), &poles, weights.as_deref())?;
        Ok(Self { knots, poles, weights })
    }

    /// The knots.
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The poles.
    pub fn poles(&self) -> &[P] {
        &self.poles
    }

    /// The weights, if rational.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The point at `t`; outside the domain the end spans are continued.
    pub fn point(&self, t: f64) -> P {
        let p = self.knots.degree();
        let span = self.knots.span(t);
        let mut n = [0.0; MAX_DEGREE + 1];
        self.knots.basis(span, t, &mut n);
        let first = span - p;
        let mut sum = P::default();
        match &self.weights {
            None => {
                for j in 0..=p {
                    sum = sum + self.poles[first + j] * n[j];
                }
                sum
            }
            Some(w) => {
                let mut total = 0.0;
                for j in 0..=p {
                    let b = n[j] * w[first + j];
                    sum = sum + self.poles[first + j] * b;
                    total += b;
                }
                sum / total
            }
        }
    }

    /// The point and the first two derivatives at `t` (A4.2).
    pub fn derivatives(&self, t: f64) -> [P; 3] {
        let p = self.knots.degree();
        let span = self.knots.span(t);
        let mut n = [0.0; 3 * (MAX_DEGREE + 1)];
        self.knots.basis_derivatives(span, t, 2, &mut n);
        let first = span - p;
        // Differences from a pole of the span keep the digits of the derivatives on short spans.
        let origin = self.poles[span];
        let base = self.weights.as_ref().map_or(1.0, |w| w[span]);
        let mut a = [P::default(); 3];
        let mut w = [0.0; 3];
        for d in 0..3 {
            for j in 0..=p {
                let weight = self.weights.as_ref().map_or(1.0, |w| w[first + j]);
                let b = n[d * (p + 1) + j];
                a[d] = a[d] + (self.poles[first + j] - origin) * (b * weight);
                w[d] += b * (weight - base);
            }
        }
        if self.weights.is_none() {
            return [a[0] + origin, a[1], a[2]];
        }
        let total = w[0] + base;
        let c0 = a[0] / total;
        let c1 = (a[1] - c0 * w[1]) / total;
        let c2 = (a[2] - c1 * (2.0 * w[1]) - c0 * w[2]) / total;
        [c0 + origin, c1, c2]
    }
}
