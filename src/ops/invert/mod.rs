//! Point inversion: the parameters of the nearest point of a curve or surface, always the global
//! one, with all ties on request.

mod batch;
pub mod bezier;
pub mod curve;
mod patch;
mod search;
pub mod surface;
mod taylor;
mod tree;

pub use curve::CurveInverter;
pub use surface::SurfaceInverter;

use crate::error::{Error, Result};
use crate::nurbs::Point;

/// Largest coordinate of curves, surfaces and points: squares of distances beyond it overflow.
const LARGEST: f64 = 1e150;

/// Parameters closer than this fraction of their range are one place.
const SAME: f64 = 1e-7;

/// A nearest point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest<T, P> {
    /// Its parameters.
    pub at: T,
    /// The point itself.
    pub point: P,
    /// Its distance, in the unit of the points.
    pub distance: f64,
}

/// Checks that squared distances between these points do not overflow.
///
/// # Errors
/// [`Error::Numerics`] for a coordinate beyond 1e150.
pub fn check_size<P: Point>(points: &[P]) -> Result<()> {
    let is_small = |p: P| p.max(p * -1.0).max_element() <= LARGEST;
    match points.iter().find(|&&p| !is_small(p)) {
        None => Ok(()),
        Some(p) => {
            let why = format!("{p:?} is too far out: nearest points need coordinates up to {LARGEST:e}");
            Err(Error::Numerics { why })
        }
    }
}
