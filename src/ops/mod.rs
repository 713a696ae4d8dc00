//! Operations on splines: interpolation, approximation, closest points.

pub mod approximate;
pub mod closest;
pub mod interpolate;
