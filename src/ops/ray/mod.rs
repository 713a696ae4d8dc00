//! Where straight lines meet curves and surfaces.
//!
//! In place of steps by the distance to the nearest point (Lüken 2022, algorithm 6, which takes any
//! point within the tolerance for a hit and creeps where the ray grazes), boxes exclude what is
//! away from the ray, and Newton steps find the one hit where there is one at most. Lengths along
//! the ray are true lengths: its direction is normalised.

mod curve;
mod frame;
mod surface;

pub use surface::SurfaceCaster;

use super::intersect::Kind;
use crate::error::{Error, Result};
use crate::nurbs::Point;

/// A half-line, or a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray<P> {
    origin: P,
    direction: P,
    from: f64,
}

/// Where a ray meets a curve (`T` its parameter) or surface (`T` its two).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit<T, P> {
    /// Length from the origin of the ray, negative before that of a line; where it grazes, of the
    /// place at which both are parallel.
    pub s: f64,
    /// The part of the ray that is within the tolerance; of no length unless it grazes a surface or
    /// runs along a curve or surface.
    pub along: [f64; 2],
    /// Parameters of the curve or surface.
    pub at: T,
    /// The point of the curve or surface.
    pub point: P,
    /// Its distance from the ray.
    pub distance: f64,
    /// Tangential where the ray grazes, or runs along the curve or surface.
    pub kind: Kind,
}

impl<P: Point> Ray<P> {
    /// All points `origin + s direction`, `s ≥ 0`; the direction of any length but 0.
    ///
    /// # Errors
    /// [`Error::Argument`] for a direction of no length and for numbers that are not finite.
    pub fn new(origin: P, direction: P) -> Result<Self> {
        let fail = |name, why: String| Err(Error::Argument { name, why });
        if !origin.is_finite() {
            return fail("origin", format!("{origin:?} is not finite"));
        }
        let largest = direction.max(direction * -1.0).max_element();
        if !(direction.is_finite() && largest > 0.0) {
            return fail("direction", format!("{direction:?} where a direction was expected"));
        }
        let direction = direction / largest;
        Ok(Self { origin, direction: direction / direction.length(), from: 0.0 })
    }

    /// The same, to both sides.
    ///
    /// # Errors
    /// As [`Ray::new`].
    pub fn line(origin: P, direction: P) -> Result<Self> {
        Ok(Self { from: f64::NEG_INFINITY, ..Self::new(origin, direction)? })
    }

    /// The point at a length from the origin.
    pub fn point(&self, s: f64) -> P {
        self.origin + self.direction * s
    }

    /// The lengths between which it is in a box, if it is.
    fn clip(&self, low: P, high: P) -> Option<[f64; 2]> {
        let mut range = [self.from, f64::INFINITY];
        let (low, high) = ((low - self.origin).coordinates(), (high - self.origin).coordinates());
        let direction = self.direction.coordinates();
        for k in 0..P::DIMENSION {
            if direction[k] == 0.0 {
                if low[k] > 0.0 || high[k] < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (low[k] / direction[k], high[k] / direction[k]);
            range = [range[0].max(a.min(b)), range[1].min(a.max(b))];
        }
        (range[0] <= range[1]).then_some(range)
    }
}

/// A point with the same number in every coordinate.
fn splat<P: Point>(x: f64) -> P {
    P::from_coordinates([x; 3])
}
