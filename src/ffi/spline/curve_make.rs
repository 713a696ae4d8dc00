//! Arcs, conics, closed curves.

use super::curve::{Curve, by_dimension};
use super::{Row, number, numbers, optional};
use crate::ffi::guard::guard;
use crate::ffi::handle::Out;
use crate::nurbs::{KnotVector, NurbsCurve};

/// The arc centre + x cos a + y sin a for angles a from one to another, exactly: of a circle where
/// x and y are perpendicular and as long as the radius, else of the ellipse with these conjugate
/// semi-diameters. Its domain is [0, 1].
///
/// centre, x, y: [dimension] each, dimension 2 or 3.
/// from, to: angles in rad; to less than from runs clockwise; at most a full turn.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for an empty sweep or more than a turn.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_arc(
    dimension: u32,
    centre: *const f64,
    x: *const f64,
    y: *const f64,
    from: f64,
    to: f64,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        let (from, to) = (number(from, "from")?, number(to, "to")?);
        by_dimension!(dimension, P => {
            // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
            let (centre, x, y, out) = unsafe {
                (P::row(centre, "centre")?, P::row(x, "x")?, P::row(y, "y")?, Out::new(out, "out")?)
            };
            out.hand_over(NurbsCurve::arc(centre, x, y, from, to)?.into());
            Ok(())
        })
    })
}

/// The conic segment from start to end that is tangent there to the lines through a corner. Its
/// domain is [0, 1].
///
/// start, corner, end: [dimension] each, dimension 2 or 3.
/// through: [dimension] a point inside their triangle that the segment passes, or NULL.
/// weight: without such a point, the weight of the corner: below 1 an ellipse, 1 a parabola, above
/// a hyperbola.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for a point outside the triangle;
/// BLADESMITH_STATUS_SPLINE for a weight that is not positive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_conic(
    dimension: u32,
    start: *const f64,
    corner: *const f64,
    end: *const f64,
    through: *const f64,
    weight: f64,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        by_dimension!(dimension, P => {
            // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
            let (start, corner, end, out) = unsafe {
                let [start, corner, end] = [(start, "start"), (corner, "corner"), (end, "end")]
                    .map(|(point, name)| P::row(point, name));
                (start?, corner?, end?, Out::new(out, "out")?)
            };
            let conic = if through.is_null() {
                NurbsCurve::conic(start, corner, end, weight)?
            } else {
                // SAFETY: as above.
                NurbsCurve::conic_through(start, corner, end, unsafe { P::row(through, "through")? })?
            };
            out.hand_over(conic.into());
            Ok(())
        })
    })
}

/// The closed curve that goes on smoothly over its seam: its knots are unclamped and repeat by the
/// period.
///
/// dimension: 2 or 3.
/// degree: 1 to 25.
/// breaks: [break_count] ascending, the domain from the first to the last.
/// poles: [break_count - 1][dimension], each once.
/// weights: [break_count - 1] positive weights, or NULL for a polynomial curve.
/// Units: one length unit for all coordinates, mm by convention.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for arrays that make no curve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_periodic(
    dimension: u32,
    degree: u32,
    breaks: *const f64,
    break_count: usize,
    poles: *const f64,
    weights: *const f64,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        let count = break_count.saturating_sub(1);
        // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
        let (breaks, weights, out) = unsafe {
            (
                numbers(breaks, break_count, "breaks")?,
                optional(weights, count, "weights")?,
                Out::new(out, "out")?,
            )
        };
        let knots = KnotVector::periodic(degree as usize, breaks)?;
        by_dimension!(dimension, P => {
            // SAFETY: as above.
            let poles = knots.wrapped(unsafe { P::rows(poles, count, "poles")? });
            let weights = weights.map(|weights| knots.wrapped(weights));
            out.hand_over(NurbsCurve::new(knots, poles, weights)?.into());
            Ok(())
        })
    })
}
