//! Curves through points and near points.

use super::curve::{Curve, Dimension, by_dimension};
use super::{Row, filled, knots, numbers, optional, tolerance};
use crate::error::{Error, Result};
use crate::ffi::guard::guard;
use crate::ffi::handle::Out;
use crate::ffi::slice::{ArrayOut, slice};
use crate::nurbs::KnotVector;
use crate::ops::conditions::{Condition, interpolate, interpolate_over};
use crate::ops::interpolate::interpolate_closed;
use crate::ops::least_squares::{Sample, fit, smooth, smooth_within};
use crate::ops::parametrise::{self, averaged_knots, parameters};

/// How bladesmith_parameters() spaces parameters.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spacing {
    /// Equally.
    Uniform = 0,
    /// By the distance of neighbours.
    Chord = 1,
    /// By the distance of neighbours to a power, usually 0.5.
    Centripetal = 2,
    /// By the distance in the metric of the points' own scatter (Foley and Nielson 1989).
    AffineChord = 3,
    /// As that, widened where the points turn by a factor, usually 1.5.
    AffineAngle = 4,
}

fn spacing(number: u32, factor: f64) -> Result<parametrise::Spacing> {
    let refuse = |name, why| Err(Error::Argument { name, why });
    let of_factor = (2..=4).contains(&number) && number != Spacing::AffineChord as u32;
    if of_factor && !(factor.is_finite() && factor >= 0.0) {
        return refuse("factor", format!("is {factor}; give a finite number of at least 0"));
    }
    Ok(match number {
        0 => parametrise::Spacing::Uniform,
        1 => parametrise::Spacing::ChordLength,
        2 => parametrise::Spacing::Centripetal(factor),
        3 => parametrise::Spacing::AffineChord,
        4 => parametrise::Spacing::AffineAngle(factor),
        _ => return refuse("spacing", format!("is {number}; give one of bladesmith_spacing, 0 to 4")),
    })
}

/// Parameters for points that a curve shall pass, ascending from 0 to 1.
///
/// dimension: 2 or 3.
/// points: [count][dimension], at least two; neighbours may coincide with uniform spacing only.
/// spacing: one of bladesmith_spacing.
/// factor: the power of BLADESMITH_SPACING_CENTRIPETAL or the factor of
/// BLADESMITH_SPACING_AFFINE_ANGLE, not negative; others ignore it.
/// out: [count].
/// Units: any length.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_parameters(
    dimension: u32,
    points: *const f64,
    count: usize,
    spacing: u32,
    factor: f64,
    out: *mut f64,
) -> i32 {
    guard(|| {
        let spacing = self::spacing(spacing, factor)?;
        by_dimension!(dimension, P => {
            // SAFETY: the header states the lengths of the arrays.
            let (points, out) = unsafe { (P::rows(points, count, "points")?, filled(out, count, "out")?) };
            out.fill(parameters(points, spacing)?);
            Ok(())
        })
    })
}

/// Clamped knots for a curve through points: inner ones are means of neighbouring parameters, as
/// bladesmith_curve_interpolate() takes them by itself.
///
/// degree: 1 to 25.
/// parameters: [count] ascending, more than degree.
/// out: [count + degree + 1].
/// Units: those of the parameter.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for too few or descending parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_averaged_knots(
    degree: u32,
    parameters: *const f64,
    count: usize,
    out: *mut f64,
) -> i32 {
    guard(|| {
        // SAFETY: the header states the length of the array.
        let parameters = unsafe { numbers(parameters, count, "parameters")? };
        let knots = averaged_knots(degree as usize, parameters)?;
        // SAFETY: as above.
        unsafe { filled(out, knots.flat().len(), "out")? }.fill(knots.flat().iter().copied());
        Ok(())
    })
}

/// The curve of a degree that passes points, or has derivatives, at parameters.
///
/// dimension: 2 or 3.
/// parameters: [count], in any order.
/// orders: [count] what is given at each: 0 the point, 1 the first derivative, and so on up to the
/// degree; NULL for points alone.
/// values: [count][dimension].
/// knots: [knot_count], as many as count + degree + 1; or NULL with a knot_count of 0 for clamped
/// knots that are means of neighbouring parameters.
/// Units: mm, and mm per parameter to the power of the order.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT for conditions that contradict or are too many or few;
/// BLADESMITH_STATUS_SPLINE where they do not fit the knots (Schoenberg and Whitney);
/// BLADESMITH_STATUS_NUMERICS where they do not determine a curve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_interpolate(
    dimension: u32,
    degree: u32,
    parameters: *const f64,
    orders: *const u32,
    values: *const f64,
    count: usize,
    knots: *const f64,
    knot_count: usize,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
        let (parameters, orders, out) = unsafe {
            (
                numbers(parameters, count, "parameters")?,
                if orders.is_null() { None } else { Some(slice(orders, count, "orders")?) },
                Out::new(out, "out")?,
            )
        };
        by_dimension!(dimension, P => {
            // SAFETY: as above.
            let values = unsafe { P::rows(values, count, "values")? };
            let order = |i: usize| orders.map_or(0, |orders| orders[i] as usize);
            let condition = |i: usize| Condition { parameter: parameters[i], order: order(i), value: values[i] };
            let conditions: Vec<_> = (0..count).map(condition).collect();
            let curve = if knots.is_null() && knot_count == 0 {
                interpolate(degree as usize, &conditions)?
            } else {
                // SAFETY: as above.
                interpolate_over(unsafe { self::knots(degree, knots, knot_count, "knots")? }, &conditions)?
            };
            out.hand_over(curve.into());
            Ok(())
        })
    })
}

/// The closed curve, smooth at its seam as everywhere, that passes points at parameters; its knots are
/// periodic. Odd degrees have them at the parameters, even ones halfway between.
///
/// dimension: 2 or 3.
/// degree: 1 to 25, less than count.
/// parameters: [count + 1] ascending, the last where the first point is passed again.
/// points: [count][dimension], the first not repeated.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for parameters so uneven that they do
/// not determine a curve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_interpolate_closed(
    dimension: u32,
    degree: u32,
    parameters: *const f64,
    points: *const f64,
    count: usize,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
        let (parameters, out) =
            unsafe { (numbers(parameters, count.saturating_add(1), "parameters")?, Out::new(out, "out")?) };
        by_dimension!(dimension, P => {
            // SAFETY: as above.
            let points = unsafe { P::rows(points, count, "points")? };
            out.hand_over(interpolate_closed(degree as usize, parameters, points)?.into());
            Ok(())
        })
    })
}

/// The arrays that every fit takes.
struct Given {
    degree: u32,
    knots: *const f64,
    knot_count: usize,
    parameters: *const f64,
    points: *const f64,
    weights: *const f64,
    count: usize,
}

impl Given {
    /// Knots and samples.
    ///
    /// # Errors
    /// Those of the arrays.
    ///
    /// # Safety
    /// The arrays must be as long as their counts say.
    unsafe fn read<P: Dimension>(&self) -> Result<(KnotVector, Vec<Sample<P>>)> {
        // SAFETY: promised by the caller.
        let (knots, parameters, points, weights) = unsafe {
            (
                knots(self.degree, self.knots, self.knot_count, "knots")?,
                numbers(self.parameters, self.count, "parameters")?,
                P::rows(self.points, self.count, "points")?,
                optional(self.weights, self.count, "weights")?,
            )
        };
        let weight = |i: usize| weights.map_or(1.0, |weights| weights[i]);
        let sample = |i: usize| Sample { parameter: parameters[i], point: points[i], weight: weight(i) };
        Ok((knots, (0..self.count).map(sample).collect()))
    }
}

/// The curve over given knots with the least sum of weighted squared distances to points at their
/// parameters, with given derivatives at its ends.
///
/// dimension: 2 or 3.
/// degree, knots: [knot_count] as in bladesmith_curve_new().
/// parameters: [count] in the domain of the knots.
/// points: [count][dimension].
/// weights: [count] not negative, or NULL for 1 each.
/// start, end: [start_count][dimension] and [end_count][dimension]: the point at the end of the
/// domain, then the first derivative there, and so on; a count of 0 leaves the end free. They need
/// clamped knots.
/// Units: mm, and mm per parameter to the power of the order.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where points are too few for the
/// knots, or badly placed (Schoenberg and Whitney).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_fit(
    dimension: u32,
    degree: u32,
    knots: *const f64,
    knot_count: usize,
    parameters: *const f64,
    points: *const f64,
    weights: *const f64,
    count: usize,
    start: *const f64,
    start_count: usize,
    end: *const f64,
    end_count: usize,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        let given = Given { degree, knots, knot_count, parameters, points, weights, count };
        by_dimension!(dimension, P => {
            // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
            let ((knots, samples), start, end, out) = unsafe {
                (
                    given.read::<P>()?,
                    P::rows(start, start_count, "start")?,
                    P::rows(end, end_count, "end")?,
                    Out::new(out, "out")?,
                )
            };
            out.hand_over(fit(knots, &samples, start, end)?.into());
            Ok(())
        })
    })
}

/// The curve over given knots with the least sum of weighted squared distances to points, plus
/// smoothing times the integral of its squared second derivative: for small values it comes near
/// the points, for large ones near a straight line.
///
/// dimension, degree, knots, parameters, points, weights: as in bladesmith_curve_fit(): [knot_count],
/// [count], [count][dimension], [count].
/// smoothing: above 0.
/// Units: mm; smoothing the third power of the parameter's unit.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for less than two parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_smooth(
    dimension: u32,
    degree: u32,
    knots: *const f64,
    knot_count: usize,
    parameters: *const f64,
    points: *const f64,
    weights: *const f64,
    count: usize,
    smoothing: f64,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        let given = Given { degree, knots, knot_count, parameters, points, weights, count };
        by_dimension!(dimension, P => {
            // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
            let ((knots, samples), out) = unsafe { (given.read::<P>()?, Out::new(out, "out")?) };
            out.hand_over(smooth(knots, &samples, smoothing)?.into());
            Ok(())
        })
    })
}

/// The smoothest curve over given knots whose weighted squared distances to points sum up to no
/// more than a residual.
///
/// dimension, degree, knots, parameters, points, weights: as in bladesmith_curve_fit(): [knot_count],
/// [count], [count][dimension], [count].
/// residual: not negative.
/// smoothing: [1] is set to what bladesmith_curve_smooth() needs for the same curve; may be NULL.
/// Units: residual mm^2.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS where the knots leave more than the
/// residual, or for less than two parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_smooth_within(
    dimension: u32,
    degree: u32,
    knots: *const f64,
    knot_count: usize,
    parameters: *const f64,
    points: *const f64,
    weights: *const f64,
    count: usize,
    residual: f64,
    smoothing: *mut f64,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        let given = Given { degree, knots, knot_count, parameters, points, weights, count };
        let residual = tolerance(residual, "residual")?;
        by_dimension!(dimension, P => {
            // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
            let ((knots, samples), place, out) = unsafe {
                (given.read::<P>()?, ArrayOut::new(smoothing, 1, "smoothing")?, Out::new(out, "out")?)
            };
            let (curve, smoothing) = smooth_within(&knots, &samples, residual)?;
            place.fill([smoothing]);
            out.hand_over(curve.into());
            Ok(())
        })
    })
}
