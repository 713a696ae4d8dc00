//! Point inversion: the parameters of the nearest point of a curve or surface, always the global
//! one, with all ties on request.

pub mod bezier;
pub mod curve;
mod patch;
mod search;
pub mod surface;
mod taylor;
mod tree;

pub use curve::CurveInverter;
pub use surface::SurfaceInverter;

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
