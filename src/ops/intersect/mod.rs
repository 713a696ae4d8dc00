//! Intersections of curves with each other and with themselves, in the plane and in space.
//!
//! Every curve becomes a tree of Bézier pieces; pairs of pieces are halved until their boxes are
//! apart, or no tangent of one is parallel to one of the other: then they meet once at most, and
//! Newton steps find where (Lüken 2022, algorithms 7 and 8, whose chords lose roots where the
//! crossing of the chords lies in another pair). Where tangents are parallel, the stretch within
//! the tolerance is followed: it is a touch, or an overlap.

pub(super) mod approach;
mod contact;
mod pairs;
mod report;
pub(super) mod tree;

use crate::error::{Error, Result};
use crate::nurbs::{NurbsCurve, Point};
use pairs::Search;
use tree::Tree;

/// How curves meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// They cross, or end on each other, at an angle.
    Transversal,
    /// They touch: their tangents are parallel where they are nearest to each other.
    Tangential,
}

/// A point that two curves, or two stretches of one, have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing<P> {
    /// Its parameters on both curves.
    pub at: [f64; 2],
    /// The point: the middle between both.
    pub point: P,
    /// Their distance there, not above the tolerance.
    pub distance: f64,
    /// How they meet.
    pub kind: Kind,
}

/// A stretch along which two curves are one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// Parameters of the first curve, ascending.
    pub first: [f64; 2],
    /// Those of the second at the same points; descending where it runs the other way.
    pub second: [f64; 2],
}

/// All that two curves have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Intersections<P> {
    /// Single points, by their parameter on the first curve.
    pub crossings: Vec<Crossing<P>>,
    /// Stretches; their ends are not among the single points.
    pub overlaps: Vec<Overlap>,
}

/// The intersections of two curves: all places where they are not further apart than `tolerance`
/// (in the unit of the points), each once.
///
/// Two crossings are one touch where the curves stay within the tolerance between them. A place on
/// the seam of a closed curve has the parameter of its start.
///
/// # Errors
/// [`Error::Argument`] for a tolerance that is no positive number; [`Error::Numerics`] for curves
/// that are near to each other in too many places (a tolerance in the order of their size).
pub fn curves<P: Point>(
    first: &NurbsCurve<P>,
    second: &NurbsCurve<P>,
    tolerance: f64,
) -> Result<Intersections<P>> {
    check(tolerance)?;
    let trees = vec![Tree::new(first, tolerance), Tree::new(second, tolerance)];
    Search::new(trees, tolerance).run()
}

/// The places that a curve passes twice, to within `tolerance`: `at` and overlaps are pairs of
/// different parameters, the smaller first. The seam of a closed curve and cusps are none.
///
/// # Errors
/// As [`curves`].
pub fn self_intersections<P: Point>(curve: &NurbsCurve<P>, tolerance: f64) -> Result<Intersections<P>> {
    check(tolerance)?;
    Search::new(vec![Tree::new(curve, tolerance)], tolerance).run()
}

pub(super) fn check(tolerance: f64) -> Result<()> {
    if tolerance.is_finite() && tolerance > 0.0 {
        return Ok(());
    }
    let why = format!("{tolerance} where a positive length was expected");
    Err(Error::Argument { name: "tolerance", why })
}
