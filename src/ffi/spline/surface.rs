//! Surfaces: from and to arrays, points and derivatives, normals and curvatures.

use super::{Row, filled, knots, numbers, optional, order};
use crate::error::{Error, Result};
use crate::ffi::guard::{guard, guard_silent};
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::{ArrayOut, total};
use crate::nurbs::{NurbsSurface, Side, SurfaceDerivatives, SurfaceEvaluator};
use crate::ops::invert::SurfaceInverter;
use crate::ops::ray::SurfaceCaster;
use glam::{DVec2, DVec3};
use std::sync::OnceLock;

/// A NURBS surface in space. Opaque and unchanging: any number of threads may use one handle at
/// once. Its lengths are in the unit of its poles, mm by convention.
pub struct Surface {
    pub(super) surface: NurbsSurface,
    inverter: OnceLock<SurfaceInverter>,
    caster: OnceLock<SurfaceCaster>,
}

impl From<NurbsSurface> for Surface {
    fn from(surface: NurbsSurface) -> Self {
        Self { surface, inverter: OnceLock::new(), caster: OnceLock::new() }
    }
}

impl Surface {
    /// Finds nearest points; made when first asked for.
    ///
    /// # Errors
    /// As [`SurfaceInverter::new`].
    pub(super) fn inverter(&self) -> Result<&SurfaceInverter> {
        if let Some(inverter) = self.inverter.get() {
            return Ok(inverter);
        }
        let made = SurfaceInverter::new(&self.surface)?;
        Ok(self.inverter.get_or_init(|| made))
    }

    /// Finds where rays meet it; made when first asked for.
    ///
    /// # Errors
    /// As [`SurfaceCaster::new`].
    pub(super) fn caster(&self) -> Result<&SurfaceCaster> {
        if let Some(caster) = self.caster.get() {
            return Ok(caster);
        }
        let made = SurfaceCaster::new(&self.surface)?;
        Ok(self.caster.get_or_init(|| made))
    }
}

/// Makes a surface from arrays, which are copied.
///
/// degree_u, degree_v: 1 to 25.
/// knots_u, knots_v: [knot_count_u] and [knot_count_v] all knots along u and v, as in
/// bladesmith_curve_new(); they ask for n = knot_count_u - degree_u - 1 rows of
/// m = knot_count_v - degree_v - 1 poles.
/// poles: [n][m][3], v fastest.
/// weights: [n][m] positive weights, or NULL for a polynomial surface.
/// pole_count: n * m.
/// Units: one length unit for all coordinates, mm by convention.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for arrays that make no surface.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_new(
    degree_u: u32,
    degree_v: u32,
    knots_u: *const f64,
    knot_count_u: usize,
    knots_v: *const f64,
    knot_count_v: usize,
    poles: *const f64,
    weights: *const f64,
    pole_count: usize,
    out: *mut *mut Surface,
) -> i32 {
    guard(|| {
        // SAFETY: the header states the lengths of the arrays and asks for room for a handle.
        let (knots_u, knots_v, poles, weights, out) = unsafe {
            (
                knots(degree_u, knots_u, knot_count_u, "knots_u")?,
                knots(degree_v, knots_v, knot_count_v, "knots_v")?,
                DVec3::rows(poles, pole_count, "poles")?.to_vec(),
                optional(weights, pole_count, "weights")?.map(<[f64]>::to_vec),
                Out::new(out, "out")?,
            )
        };
        out.hand_over(NurbsSurface::new(knots_u, knots_v, poles, weights)?.into());
        Ok(())
    })
}

/// Sizes of a surface. Any of the outputs may be NULL.
///
/// degree_u, degree_v: 1 to 25.
/// pole_count_u, pole_count_v: poles along u and v; there are as many knots and degree + 1 more.
/// rational: 1 for a surface with weights, 0 for a polynomial one.
/// Owner: the caller gives the places.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_size(
    surface: *const Surface,
    degree_u: *mut u32,
    degree_v: *mut u32,
    pole_count_u: *mut usize,
    pole_count_v: *mut usize,
    rational: *mut u32,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for each number that is asked for.
        let (surface, degree_u, degree_v, pole_count_u, pole_count_v, rational) = unsafe {
            (
                &handle::borrow(surface, "surface")?.surface,
                ArrayOut::new(degree_u, 1, "degree_u")?,
                ArrayOut::new(degree_v, 1, "degree_v")?,
                ArrayOut::new(pole_count_u, 1, "pole_count_u")?,
                ArrayOut::new(pole_count_v, 1, "pole_count_v")?,
                ArrayOut::new(rational, 1, "rational")?,
            )
        };
        degree_u.fill([surface.knots_u().degree() as u32]);
        degree_v.fill([surface.knots_v().degree() as u32]);
        pole_count_u.fill([surface.knots_u().len()]);
        pole_count_v.fill([surface.knots_v().len()]);
        rational.fill([u32::from(surface.weights().is_some())]);
        Ok(())
    })
}

/// Knots, poles and weights of a surface. Any of the arrays may be NULL.
///
/// pole_count: all poles, n * m of bladesmith_surface_size(); anything else is refused.
/// knots_u, knots_v: [n + degree_u + 1] and [m + degree_v + 1].
/// poles: [n][m][3].
/// weights: [n][m], all 1 for a polynomial surface.
/// Units: those of the surface.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_data(
    surface: *const Surface,
    pole_count: usize,
    knots_u: *mut f64,
    knots_v: *mut f64,
    poles: *mut f64,
    weights: *mut f64,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle.
        let surface = unsafe { &handle::borrow(surface, "surface")?.surface };
        let count = surface.poles().len();
        if pole_count != count {
            let why = format!("is {pole_count}, but the surface has {count} poles");
            return Err(Error::Argument { name: "pole_count", why }.into());
        }
        let (flat_u, flat_v) = (surface.knots_u().flat(), surface.knots_v().flat());
        // SAFETY: the header states the lengths of the arrays.
        let (knots_u, knots_v, poles, weights) = unsafe {
            (
                ArrayOut::new(knots_u, flat_u.len(), "knots_u")?,
                ArrayOut::new(knots_v, flat_v.len(), "knots_v")?,
                DVec3::rows_out(poles, count, "poles")?,
                ArrayOut::new(weights, count, "weights")?,
            )
        };
        knots_u.fill(flat_u.iter().copied());
        knots_v.fill(flat_v.iter().copied());
        poles.fill(surface.poles().iter().copied());
        weights.fill(surface.weights().map_or(vec![1.0; count], <[f64]>::to_vec));
        Ok(())
    })
}

/// Points and derivatives of a surface.
///
/// uv: [count][2] parameters, finite. Outside the domain the end spans are continued.
/// order: highest total order of derivatives, 0 to 25.
/// below_u, below_v: not 0: where a knot along this direction makes derivatives jump, those from
/// smaller parameters; 0: those from larger ones.
/// out: [count][(order + 1) * (order + 2) / 2][3]: S; S_u, S_v; S_uu, S_uv, S_vv; and so on.
/// Units: mm, and mm per parameter to the power of the order.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_evaluate(
    surface: *const Surface,
    uv: *const f64,
    count: usize,
    order: u32,
    below_u: u32,
    below_v: u32,
    out: *mut f64,
) -> i32 {
    guard(|| {
        let order = self::order(order)?;
        let each = (order + 1) * (order + 2) / 2;
        let rows = total(count, each, "count")?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (surface, uv, out) = unsafe {
            (
                &handle::borrow(surface, "surface")?.surface,
                DVec2::rows(uv, count, "uv")?,
                filled(out.cast::<DVec3>(), rows, "out")?,
            )
        };
        let sides = [below_u, below_v].map(|below| if below != 0 { Side::Below } else { Side::Above });
        if order > 2 || sides != [Side::Above; 2] {
            let jet = |at: &DVec2| in_rows(&surface.derivatives_from(sides, at.x, at.y, order));
            out.fill(uv.iter().flat_map(jet));
        } else if order == 0 {
            out.fill(SurfaceEvaluator::new(surface).points(uv));
        } else {
            let jets = SurfaceEvaluator::new(surface).derivatives(uv);
            out.fill(jets.iter().flat_map(|d| in_order(d).into_iter().take(each)));
        }
        Ok(())
    })
}

fn in_order(d: &SurfaceDerivatives) -> [DVec3; 6] {
    [d.s, d.u, d.v, d.uu, d.uv, d.vv]
}

/// Derivatives `[k][l]` by their total order, those in u first.
fn in_rows(jet: &[Vec<DVec3>]) -> Vec<DVec3> {
    let of_order = |order: usize| (0..=order).map(move |l| jet[order - l][l]);
    (0..jet.len()).flat_map(of_order).collect()
}

/// Points and derivatives of a surface on a grid, faster than one by one.
///
/// u, v: [count_u] and [count_v] parameters, finite. Outside the domain the end spans are continued.
/// order: highest total order of derivatives, 0 to 2.
/// out: [count_u][count_v][(order + 1) * (order + 2) / 2][3]: as bladesmith_surface_evaluate(), v
/// fastest.
/// Units: mm, and mm per parameter to the power of the order.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_evaluate_grid(
    surface: *const Surface,
    u: *const f64,
    count_u: usize,
    v: *const f64,
    count_v: usize,
    order: u32,
    out: *mut f64,
) -> i32 {
    guard(|| {
        if order > 2 {
            let why = format!("is {order}; on grids give at most 2");
            return Err(Error::Argument { name: "order", why }.into());
        }
        let each = (order as usize + 1) * (order as usize + 2) / 2;
        let rows = total(total(count_u, count_v, "count_u")?, each, "count_u")?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (surface, u, v, out) = unsafe {
            (
                &handle::borrow(surface, "surface")?.surface,
                numbers(u, count_u, "u")?,
                numbers(v, count_v, "v")?,
                filled(out.cast::<DVec3>(), rows, "out")?,
            )
        };
        if order == 0 {
            out.fill(surface.points_on_grid(u, v));
        } else {
            let jets = surface.derivatives_on_grid(u, v);
            out.fill(jets.iter().flat_map(|d| in_order(d).into_iter().take(each)));
        }
        Ok(())
    })
}

/// Normals and principal curvatures of a surface. Any of the outputs may be NULL; where the surface
/// has no normal all are NaN.
///
/// uv: [count][2] parameters, finite.
/// normals: [count][3] unit normals along S_u x S_v.
/// curvatures: [count][2] the smaller and the larger principal curvature, positive where the surface
/// bends towards the normal.
/// directions: [count][2][3] unit tangents along which they hold; at an umbilic any two.
/// Units: curvatures 1/mm.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_curvatures(
    surface: *const Surface,
    uv: *const f64,
    count: usize,
    normals: *mut f64,
    curvatures: *mut f64,
    directions: *mut f64,
) -> i32 {
    guard(|| {
        let pairs = total(count, 2, "count")?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (surface, uv, normals, curvatures, directions) = unsafe {
            (
                &handle::borrow(surface, "surface")?.surface,
                DVec2::rows(uv, count, "uv")?,
                DVec3::rows_out(normals, count, "normals")?,
                ArrayOut::new(curvatures, pairs, "curvatures")?,
                DVec3::rows_out(directions, pairs, "directions")?,
            )
        };
        let jets = SurfaceEvaluator::new(surface).derivatives(uv);
        let found: Vec<_> = jets.iter().map(|jet| jet.principal_curvatures().ok()).collect();
        let found = || found.iter().map(Option::as_ref);
        normals.fill(found().map(|at| at.map_or(DVec3::NAN, |at| at.normal)));
        curvatures.fill(found().flat_map(|at| at.map_or([f64::NAN; 2], |at| at.curvatures)));
        directions.fill(found().flat_map(|at| at.map_or([DVec3::NAN; 2], |at| at.directions)));
        Ok(())
    })
}

/// Frees a surface; NULL is fine. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_free(surface: *mut Surface) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(surface) });
}
