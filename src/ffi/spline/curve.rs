//! Curves: from and to arrays, points and derivatives, frames, lengths.

use super::{Row, filled, knots, number, numbers, optional, order};
use crate::error::{Error, Result};
use crate::ffi::guard::{guard, guard_silent};
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::{ArrayOut, total};
use crate::linalg::banded::Rhs;
use crate::nurbs::{ArcLength, CurveEvaluator, NurbsCurve, Side};
use crate::ops::invert::CurveInverter;
use glam::{DVec2, DVec3};
use std::ops::Deref;
use std::sync::OnceLock;

/// A NURBS curve in the plane or in space. Opaque and unchanging: any number of threads may use
/// one handle at once. Its lengths are in the unit of its poles, mm by convention.
#[derive(Clone)]
pub struct Curve {
    pub(super) inside: Inside,
}

/// A curve by its dimension.
#[derive(Clone)]
pub(super) enum Inside {
    Plane(Prepared<DVec2>),
    Space(Prepared<DVec3>),
}

impl Curve {
    /// Number of coordinates.
    pub(super) fn dimension(&self) -> u32 {
        match &self.inside {
            Inside::Plane(_) => 2,
            Inside::Space(_) => 3,
        }
    }
}

/// A curve with what looking for its nearest points needs, made when first asked for.
#[derive(Clone)]
pub(super) struct Prepared<P: Dimension> {
    curve: NurbsCurve<P>,
    inverter: OnceLock<CurveInverter<P>>,
}

impl<P: Dimension> Prepared<P> {
    /// Finds nearest points.
    ///
    /// # Errors
    /// As [`CurveInverter::new`].
    pub(super) fn inverter(&self) -> Result<&CurveInverter<P>> {
        if let Some(inverter) = self.inverter.get() {
            return Ok(inverter);
        }
        let made = CurveInverter::new(&self.curve)?;
        Ok(self.inverter.get_or_init(|| made))
    }
}

impl<P: Dimension> Deref for Prepared<P> {
    type Target = NurbsCurve<P>;

    fn deref(&self) -> &NurbsCurve<P> {
        &self.curve
    }
}

/// Tangent, normal and binormal (in space), curvature and torsion.
pub(super) type Frame<P> = ([P; 3], f64, f64);

/// Points of the dimensions that handles know.
pub(super) trait Dimension: Row + Rhs {
    /// The curve of this dimension inside a handle.
    fn of(curve: &Curve) -> Option<&Prepared<Self>>;
    /// A curve of this dimension as what is inside a handle.
    fn inside(curve: Prepared<Self>) -> Inside;
    /// Frame of a curve at `t`.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the curve stands still.
    fn frame(curve: &NurbsCurve<Self>, t: f64) -> Result<Frame<Self>>;
}

impl Dimension for DVec2 {
    fn of(curve: &Curve) -> Option<&Prepared<Self>> {
        if let Inside::Plane(curve) = &curve.inside { Some(curve) } else { None }
    }

    fn inside(curve: Prepared<Self>) -> Inside {
        Inside::Plane(curve)
    }

    fn frame(curve: &NurbsCurve<Self>, t: f64) -> Result<Frame<Self>> {
        let [tangent, normal] = curve.frame(t)?;
        Ok(([tangent, normal, DVec2::ZERO], curve.curvature(t)?, 0.0))
    }
}

impl Dimension for DVec3 {
    fn of(curve: &Curve) -> Option<&Prepared<Self>> {
        if let Inside::Space(curve) = &curve.inside { Some(curve) } else { None }
    }

    fn inside(curve: Prepared<Self>) -> Inside {
        Inside::Space(curve)
    }

    fn frame(curve: &NurbsCurve<Self>, t: f64) -> Result<Frame<Self>> {
        let frame = curve.frenet(t)?;
        Ok(([frame.tangent, frame.normal, frame.binormal], frame.curvature, frame.torsion))
    }
}

impl<P: Dimension> From<NurbsCurve<P>> for Curve {
    fn from(curve: NurbsCurve<P>) -> Self {
        Self { inside: P::inside(Prepared { curve, inverter: OnceLock::new() }) }
    }
}

/// An expression for the curve inside a handle, whatever its dimension.
macro_rules! each {
    ($curve:expr, $inside:ident => $body:expr) => {
        match &$curve.inside {
            crate::ffi::spline::curve::Inside::Plane($inside) => $body,
            crate::ffi::spline::curve::Inside::Space($inside) => $body,
        }
    };
}

/// An expression for the point type of a dimension that the caller names.
macro_rules! by_dimension {
    ($dimension:expr, $point:ident => $body:expr) => {
        match $dimension {
            2 => {
                type $point = glam::DVec2;
                $body
            }
            3 => {
                type $point = glam::DVec3;
                $body
            }
            other => {
                let why = format!("is {other}; curves have 2 or 3 coordinates");
                Err(crate::error::Error::Argument { name: "dimension", why }.into())
            }
        }
    };
}

pub(super) use {by_dimension, each};

/// Makes a curve from arrays, which are copied.
///
/// dimension: coordinates of a point, 2 or 3.
/// degree: 1 to 25.
/// knots: [knot_count] all knots, repeated by multiplicity, not decreasing. The domain runs from
/// knots[degree] to knots[pole_count]; the ends need not be repeated (closed curves repeat poles).
/// poles: [pole_count][dimension], where pole_count is knot_count - degree - 1.
/// weights: [pole_count] positive weights, or NULL for a polynomial curve.
/// Units: one length unit for all coordinates, mm by convention.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for arrays that make no curve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_new(
    dimension: u32,
    degree: u32,
    knots: *const f64,
    knot_count: usize,
    poles: *const f64,
    weights: *const f64,
    pole_count: usize,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        // SAFETY: the header states the lengths of the arrays.
        let (knots, weights, out) = unsafe {
            (
                self::knots(degree, knots, knot_count, "knots")?,
                optional(weights, pole_count, "weights")?.map(<[f64]>::to_vec),
                Out::new(out, "out")?,
            )
        };
        by_dimension!(dimension, P => {
            // SAFETY: as above.
            let poles = unsafe { P::rows(poles, pole_count, "poles")? }.to_vec();
            out.hand_over(NurbsCurve::new(knots, poles, weights)?.into());
            Ok(())
        })
    })
}

/// Sizes of a curve. Any of the outputs may be NULL.
///
/// dimension: 2 or 3.
/// degree: 1 to 25.
/// pole_count: number of poles; there are pole_count + degree + 1 knots.
/// rational: 1 for a curve with weights, 0 for a polynomial one.
/// Owner: the caller gives the places.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_size(
    curve: *const Curve,
    dimension: *mut u32,
    degree: *mut u32,
    pole_count: *mut usize,
    rational: *mut u32,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for each number that is asked for.
        let (curve, dimension, degree, pole_count, rational) = unsafe {
            (
                handle::borrow(curve, "curve")?,
                ArrayOut::new(dimension, 1, "dimension")?,
                ArrayOut::new(degree, 1, "degree")?,
                ArrayOut::new(pole_count, 1, "pole_count")?,
                ArrayOut::new(rational, 1, "rational")?,
            )
        };
        dimension.fill([curve.dimension()]);
        each!(curve, c => {
            degree.fill([c.knots().degree() as u32]);
            pole_count.fill([c.poles().len()]);
            rational.fill([u32::from(c.weights().is_some())]);
        });
        Ok(())
    })
}

/// Knots, poles and weights of a curve. Any of the arrays may be NULL.
///
/// pole_count: as bladesmith_curve_size() tells it; anything else is refused.
/// knots: [pole_count + degree + 1].
/// poles: [pole_count][dimension].
/// weights: [pole_count], all 1 for a polynomial curve.
/// Units: those of the curve.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_data(
    curve: *const Curve,
    pole_count: usize,
    knots: *mut f64,
    poles: *mut f64,
    weights: *mut f64,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle.
        let curve = unsafe { handle::borrow(curve, "curve")? };
        each!(curve, c => {
            // SAFETY: the header states the lengths of the arrays.
            unsafe { data(c, pole_count, [knots, poles, weights]) }
        })?;
        Ok(())
    })
}

unsafe fn data<P: Dimension>(
    curve: &NurbsCurve<P>,
    count: usize,
    [knots, poles, weights]: [*mut f64; 3],
) -> Result<()> {
    if count != curve.poles().len() {
        let why = format!("is {count}, but the curve has {} poles", curve.poles().len());
        return Err(Error::Argument { name: "pole_count", why });
    }
    let flat = curve.knots().flat();
    // SAFETY: promised by the caller.
    let (knots, poles, weights) = unsafe {
        (
            ArrayOut::new(knots, flat.len(), "knots")?,
            P::rows_out(poles, count, "poles")?,
            ArrayOut::new(weights, count, "weights")?,
        )
    };
    knots.fill(flat.iter().copied());
    poles.fill(curve.poles().iter().copied());
    weights.fill(curve.weights().map_or(vec![1.0; count], <[f64]>::to_vec));
    Ok(())
}

/// Points and derivatives of a curve.
///
/// t: [count] parameters, finite. Outside the domain the end spans are continued.
/// order: highest derivative, 0 to 25.
/// below: not 0: where a knot makes derivatives jump, those from smaller parameters; 0: those from
/// larger ones (at the end of the domain there is one kind only).
/// out: [count][order + 1][dimension] the point, then the first derivative, and so on.
/// Units: mm, and mm per parameter to the power of the order.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_evaluate(
    curve: *const Curve,
    t: *const f64,
    count: usize,
    order: u32,
    below: u32,
    out: *mut f64,
) -> i32 {
    guard(|| {
        let order = self::order(order)?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (curve, t) = unsafe { (handle::borrow(curve, "curve")?, numbers(t, count, "t")?) };
        let rows = total(count, order + 1, "count")?;
        each!(curve, c => {
            // SAFETY: as above.
            let out = unsafe { filled(out.cast(), rows, "out")? };
            if below != 0 {
                out.fill(t.iter().flat_map(|&t| c.derivatives_from(Side::Below, t, order)));
            } else if order == 0 {
                out.fill(CurveEvaluator::new(c).points(t));
            } else if order <= 2 {
                let rows = CurveEvaluator::new(c).derivatives(t);
                out.fill(rows.into_iter().flat_map(|row| row.into_iter().take(order + 1)));
            } else {
                out.fill(t.iter().flat_map(|&t| c.derivatives_to(t, order)));
            }
        });
        Ok(())
    })
}

/// Frames and curvatures of a curve. Any of the outputs may be NULL; where the curve stands still
/// all are NaN.
///
/// t: [count] parameters, finite.
/// axes: [count][dimension][dimension] unit tangent, unit normal and, in space, unit binormal. In
/// the plane the normal is to the left of the tangent; in space it points to the centre of
/// curvature, and where the curve is straight it is any one.
/// curvatures: [count], in the plane positive where the curve turns left, in space never negative.
/// torsions: [count], 0 in the plane.
/// Units: curvature and torsion 1/mm.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_frames(
    curve: *const Curve,
    t: *const f64,
    count: usize,
    axes: *mut f64,
    curvatures: *mut f64,
    torsions: *mut f64,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (curve, t, curvatures, torsions) = unsafe {
            (
                handle::borrow(curve, "curve")?,
                numbers(t, count, "t")?,
                ArrayOut::new(curvatures, count, "curvatures")?,
                ArrayOut::new(torsions, count, "torsions")?,
            )
        };
        each!(curve, c => {
            // SAFETY: as above.
            let frames = unsafe { frames(c, t, axes)? };
            curvatures.fill(frames.iter().map(|frame| frame.0));
            torsions.fill(frames.iter().map(|frame| frame.1));
        });
        Ok(())
    })
}

/// Writes the axes; returns curvatures and torsions.
unsafe fn frames<P: Dimension>(curve: &NurbsCurve<P>, t: &[f64], axes: *mut f64) -> Result<Vec<(f64, f64)>> {
    let rows = total(t.len(), P::DIMENSION, "count")?;
    // SAFETY: promised by the caller.
    let axes = unsafe { P::rows_out(axes, rows, "axes")? };
    let nowhere = P::from_coordinates([f64::NAN; 3]);
    let none = || ([nowhere; 3], f64::NAN, f64::NAN);
    let frames: Vec<_> = t.iter().map(|&t| P::frame(curve, t).unwrap_or_else(|_| none())).collect();
    axes.fill(frames.iter().flat_map(|frame| frame.0.into_iter().take(P::DIMENSION)));
    Ok(frames.into_iter().map(|frame| (frame.1, frame.2)).collect())
}

/// Arc lengths from the start of the domain to parameters.
///
/// tolerance: bound of the estimated error of the whole length, positive.
/// t: [count] parameters, finite; those outside the domain are taken to its ends.
/// out: [count] lengths.
/// Units: mm.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for a tolerance that cannot be reached.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_lengths(
    curve: *const Curve,
    tolerance: f64,
    t: *const f64,
    count: usize,
    out: *mut f64,
) -> i32 {
    // SAFETY: the header states the same of these arguments.
    unsafe { measured(curve, tolerance, (t, "t"), count, out, Measure::Length) }
}

/// Parameters at arc lengths from the start of the domain.
///
/// tolerance: bound of the estimated error of the whole length, positive.
/// lengths: [count] finite; those beyond the ends give the ends.
/// out: [count] parameters.
/// Units: mm.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for a tolerance that cannot be reached.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_at_lengths(
    curve: *const Curve,
    tolerance: f64,
    lengths: *const f64,
    count: usize,
    out: *mut f64,
) -> i32 {
    // SAFETY: the header states the same of these arguments.
    unsafe { measured(curve, tolerance, (lengths, "lengths"), count, out, Measure::Parameter) }
}

/// What is asked of a measured curve.
#[derive(Clone, Copy)]
enum Measure {
    Length,
    Parameter,
}

unsafe fn measured(
    curve: *const Curve,
    tolerance: f64,
    (values, name): (*const f64, &'static str),
    count: usize,
    out: *mut f64,
    measure: Measure,
) -> i32 {
    guard(|| {
        let tolerance = number(tolerance, "tolerance")?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (curve, values, out) = unsafe {
            (handle::borrow(curve, "curve")?, numbers(values, count, name)?, filled(out, count, "out")?)
        };
        each!(curve, c => {
            let (a, b) = c.knots().domain();
            let length = ArcLength::new(c, tolerance)?;
            match measure {
                Measure::Length => out.fill(values.iter().map(|t| length.to(t.clamp(a, b)))),
                Measure::Parameter => out.fill(values.iter().map(|&s| length.parameter(s))),
            }
        });
        Ok(())
    })
}

/// Frees a curve; NULL is fine. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_free(curve: *mut Curve) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(curve) });
}
