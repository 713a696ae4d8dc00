//! Named tolerances, with units.

/// Parameters closer than this fraction of their range are one.
pub const PARAMETER_RELATIVE: f64 = 1e-12;

/// Points closer than this are one, in mm (Open CASCADE's confusion).
pub const CONFUSION_MM: f64 = 1e-7;

/// Tangent joint: largest angle between the face normals along an edge, in degrees.
pub const TANGENT_DEG: f64 = 1.0;
