//! Operations on splines: interpolation, least squares, approximation, skinning, nearest points,
//! sections, offset surfaces, projected curves.

pub mod approximate;
pub mod closest;
pub mod conditions;
pub mod interpolate;
pub mod invert;
pub mod least_squares;
pub mod parametrise;
pub mod project;
pub mod section;
pub mod skin;
pub mod surface_offset;
