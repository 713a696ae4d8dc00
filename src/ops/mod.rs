//! Operations on splines: interpolation, least squares, approximation, skinning, nearest points,
//! offsets, fillets.

pub mod approximate;
pub mod closest;
pub mod conditions;
pub mod fillet;
pub mod interpolate;
pub mod invert;
pub mod least_squares;
pub mod offset;
pub mod parametrise;
pub mod skin;
