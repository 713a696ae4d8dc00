//! B-spline and NURBS curves and surfaces: knots, evaluation, derivatives, exact reshaping.
//!
//! Algorithms after Piegl and Tiller, *The NURBS Book* (2nd ed., 1997), cited by number.

#[cfg(test)]
mod accuracy;
pub mod basis;
pub mod conic;
pub mod construct;
pub mod curve;
pub mod curve_evaluator;
pub mod degree;
pub mod derivatives;
pub mod differential;
mod divided;
mod double;
pub mod evaluator;
pub mod grid;
pub mod join;
mod knots;
pub mod length;
pub mod refine;
pub mod removal;
mod span_table;
pub mod split;
pub mod surface;
pub(crate) mod wide;

pub use basis::KnotVector;
pub use curve::{NurbsCurve, Point};
pub use curve_evaluator::CurveEvaluator;
pub use derivatives::Side;
pub use differential::{Frenet, PrincipalCurvatures};
pub use evaluator::SurfaceEvaluator;
pub use grid::{BasisTable, IsoLine};
pub use join::compatible;
pub use length::ArcLength;
pub use refine::Direction;
pub use surface::{NurbsSurface, SurfaceDerivatives};
