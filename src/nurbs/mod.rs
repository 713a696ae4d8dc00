//! B-spline and NURBS curves and surfaces: knots, evaluation, derivatives, exact reshaping.
//!
//! Algorithms after Piegl and Tiller, *The NURBS Book* (2nd ed., 1997), cited by number.

pub mod basis;
pub mod curve;
pub mod grid;
pub mod refine;
pub mod surface;

pub use basis::KnotVector;
pub use curve::{NurbsCurve, Point};
pub use grid::{BasisTable, IsoLine};
pub use refine::Direction;
pub use surface::{NurbsSurface, SurfaceDerivatives};
