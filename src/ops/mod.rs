//! Operations on splines: interpolation, least squares, approximation, skinning, nearest points,
//! intersections, rays, sections, offsets, fillets, projected curves.

pub mod approximate;
pub mod closest;
pub mod conditions;
pub mod fillet;
pub mod interpolate;
pub mod intersect;
pub mod invert;
pub mod least_squares;
pub mod offset;
pub mod parametrise;
pub mod project;
pub mod ray;
pub mod section;
pub mod skin;
pub mod surface_offset;
