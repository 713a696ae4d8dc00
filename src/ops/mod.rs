//! Operations on splines: interpolation, approximation, nearest points.

pub mod approximate;
pub mod closest;
pub mod interpolate;
pub mod invert;
