//! Operations on splines: interpolation, least squares, approximation, skinning, nearest points,
//! intersections, rays.

pub mod approximate;
pub mod closest;
pub mod conditions;
pub mod interpolate;
pub mod intersect;
pub mod invert;
pub mod least_squares;
pub mod parametrise;
pub mod ray;
pub mod skin;
