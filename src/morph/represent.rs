//! Every surface as one polynomial spline in its own parameters.
//!
//! A morphed face has to be a spline over the parameters that its pcurves use. Polynomial B-spline
//! surfaces with smooth inner knots of degree up to 5 are taken as they are (raised to degree 3
//! where lower, exactly). Everything else (quadrics, revolutions, rational and high-degree
//! fillets) is approximated by quintics.

use super::space::{MAX_SPACE_DEGREE, Space};
use crate::brep::{BSplineCurve, BSplineSurface, Curve3d, Surface};
use crate::error::Result;
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::ops::approximate::{self, Breaks, Finest};
use crate::ops::interpolate::Collocation;
use glam::{DVec2, DVec3};

/// What an approximated quadric or revolution may miss, in mm.
const EXACT_MM: f64 = 4e-7;
/// What an approximated spline may miss, in mm. Fillets of high degree are rough between the
/// places looked at, so more is asked of them than of the smooth rational strips a user draws,
/// where few poles matter more.
const FILLET_MM: f64 = 4e-6;
const STRIP_MM: f64 = 1.6e-5;
/// Spans at most along one direction of an approximated surface.
const SPAN_LIMIT: usize = 200;
/// Lowest degree of a displacement: below it second derivatives cannot vary smoothly.
const LOWEST_DEGREE: usize = 3;
/// A knot this close to the end of a window, as a fraction of it, is its end.
const KNOT_SLACK: f64 = 1e-9;
/// Angular spans to start from.
const START_ANGLE: f64 = std::f64::consts::FRAC_PI_3;

/// A surface as a polynomial spline.
#[derive(Debug, Clone)]
pub struct Represented {
    /// The spline, over the window.
    pub surface: NurbsSurface,
    /// Whether its poles are the input's own.
    pub own_poles: bool,
    /// Number of poles of an input spline of degree up to 5.
    pub user_poles: Option<usize>,
    /// What it misses of the input, mm.
    pub error_mm: f64,
}

/// Represents `surface` over the window from `low` to `high` (mm and radians, as the surface has
/// its parameters); a B-spline that is taken as it is keeps its whole domain.
///
/// # Errors
/// [`crate::Error::Spline`] or [`crate::Error::Numerics`] for a degenerate window or surface.
pub fn represent(surface: &Surface, low: DVec2, high: DVec2) -> Result<Represented> {
    if let Some(nurbs) = smooth_polynomial(surface, low, high)? {
        let raised = raise(&nurbs)?;
        let user_poles = Some(nurbs.poles().len());
        return Ok(Represented { surface: raised, own_poles: true, user_poles, error_mm: 0.0 });
    }
    let (u, v) = (surface_breaks(surface, 0, low, high), surface_breaks(surface, 1, low, high));
    let user_poles = user_poles(surface);
    let tolerance = match (is_spline(surface), user_poles) {
        (true, Some(_)) => STRIP_MM,
        (true, None) => FILLET_MM,
        _ => EXACT_MM,
    };
    let (surface, error_mm) =
        approximate::surface(|u, v| Ok(surface.point(u, v)), u, v, tolerance, Finest::spans(SPAN_LIMIT))?;
    Ok(Represented { surface, own_poles: false, user_poles, error_mm })
}

/// The surface's own spline where it can serve as it is.
fn smooth_polynomial(surface: &Surface, low: DVec2, high: DVec2) -> Result<Option<NurbsSurface>> {
    let nurbs = match surface {
        Surface::BSpline(s) => s.to_nurbs()?,
        Surface::Bezier(s) => s.nurbs().clone(),
        Surface::Trimmed { basis, .. } => return smooth_polynomial(basis, low, high),
        _ => return Ok(None),
    };
    let fits = |k: &KnotVector, a: f64, b: f64| {
        let (start, end) = k.domain();
        let slack = 1e-6 * (end - start);
        is_smooth(k) && a >= start - slack && b <= end + slack
    };
    let fits = nurbs.weights().is_none()
        && fits(nurbs.knots_u(), low.x, high.x)
        && fits(nurbs.knots_v(), low.y, high.y);
    Ok(fits.then_some(nurbs))
}

/// The same surface with both degrees at least [`LOWEST_DEGREE`].
fn raise(nurbs: &NurbsSurface) -> Result<NurbsSurface> {
    reknot(nurbs, &Space { ku: raised(nurbs.knots_u()).knots()?, kv: raised(nurbs.knots_v()).knots()? })
}

/// The same surface over knots whose space contains it.
///
/// # Errors
/// As [`Collocation::new`].
pub fn reknot(nurbs: &NurbsSurface, space: &Space) -> Result<NurbsSurface> {
    let Space { ku, kv } = space.clone();
    if ku == *nurbs.knots_u() && kv == *nurbs.knots_v() {
        return Ok(nurbs.clone());
    }
    let (cu, cv) = (Collocation::new(&ku)?, Collocation::new(&kv)?);
    let mut poles = nurbs.points_on_grid(cu.points(), cv.points());
    Collocation::poles_tensor(&cu, &cv, &mut poles);
    NurbsSurface::new(ku, kv, poles, None)
}

/// Number of poles of a spline that a user may edit.
fn user_poles(surface: &Surface) -> Option<usize> {
    match surface {
        Surface::BSpline(s) if s.knots().iter().all(|k| k.degree() <= MAX_SPACE_DEGREE) => {
            Some(s.pole_counts().iter().product())
        }
        Surface::Trimmed { basis, .. } => user_poles(basis),
        _ => None,
    }
}

fn is_spline(surface: &Surface) -> bool {
    match surface {
        Surface::BSpline(_) | Surface::Bezier(_) => true,
        Surface::Trimmed { basis, .. } | Surface::Offset { basis, .. } => is_spline(basis),
        _ => false,
    }
}

/// Whether a spline over these knots can serve as it is.
fn is_smooth(knots: &KnotVector) -> bool {
    let all = knots.breaks_and_multiplicities();
    knots.degree() <= MAX_SPACE_DEGREE && all[1..all.len() - 1].iter().all(|&(_, m)| m < knots.degree())
}

/// Breaks of the same spline with a degree of at least [`LOWEST_DEGREE`].
fn raised(knots: &KnotVector) -> Breaks {
    let up = LOWEST_DEGREE.saturating_sub(knots.degree());
    let at = knots.breaks_and_multiplicities().into_iter().map(|(t, m)| (t, m + up)).collect();
    Breaks { degree: knots.degree() + up, at }
}

/// How the surface runs along one direction.
enum Run {
    Straight,
    Angular,
    /// As a polynomial spline that can be kept.
    Kept(Breaks),
    /// Smooth between these parameters (one period, if periodic).
    Pieces(Vec<f64>),
}

fn kept(curve: &BSplineCurve<DVec3>) -> Option<Breaks> {
    let nurbs = curve.to_nurbs().ok()?;
    (nurbs.weights().is_none() && !curve.knots().is_periodic() && is_smooth(nurbs.knots()))
        .then(|| raised(nurbs.knots()))
}

/// The knots along one direction of a surface that is polynomial there, if they can be kept.
fn kept_along(surface: &BSplineSurface, direction: usize) -> Option<Breaks> {
    let nurbs = surface.to_nurbs().ok()?;
    let (ku, kv) = (nurbs.knots_u(), nurbs.knots_v());
    let knots = if direction == 0 { ku } else { kv };
    let columns = kv.len();
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(b.abs());
    let polynomial = nurbs.weights().is_none_or(|w| {
        (0..w.len()).all(|k| same(w[k], if direction == 0 { w[k % columns] } else { w[k - k % columns] }))
    });
    (polynomial && !surface.knots()[direction].is_periodic() && is_smooth(knots)).then(|| raised(knots))
}

fn curve_run(curve: &Curve3d) -> Run {
    match curve {
        Curve3d::Line { .. } => Run::Straight,
        Curve3d::Bezier(_) => Run::Pieces(vec![0.0, 1.0]),
        Curve3d::BSpline(c) if kept(c).is_some() => kept(c).map_or(Run::Angular, Run::Kept),
        Curve3d::BSpline(c) => Run::Pieces(c.knots().knots().iter().map(|k| k.0).collect()),
        Curve3d::Trimmed { basis, .. } | Curve3d::Offset { basis, .. } => curve_run(basis),
        _ => Run::Angular,
    }
}

fn run(surface: &Surface, direction: usize) -> Run {
    match (surface, direction) {
        (Surface::Plane(_), _)
        | (Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Extrusion { .. }, 1) => Run::Straight,
        (Surface::Extrusion { curve, .. }, _) | (Surface::Revolution { curve, .. }, 1) => curve_run(curve),
        (Surface::BSpline(s), d) if kept_along(s, d).is_some() => {
            kept_along(s, d).map_or(Run::Angular, Run::Kept)
        }
        (Surface::BSpline(s), d) => Run::Pieces(s.knots()[d].knots().iter().map(|k| k.0).collect()),
        (Surface::Bezier(_), _) => Run::Pieces(vec![0.0, 1.0]),
        (Surface::Trimmed { basis, .. } | Surface::Offset { basis, .. }, d) => run(basis, d),
        _ => Run::Angular,
    }
}

/// Breaks over (a, b) to start an approximation from; `smoothness` gives first and second
/// derivatives at a parameter, at some places across.
fn start_breaks(
    run: Run,
    period: Option<f64>,
    [a, b]: [f64; 2],
    smoothness: &dyn Fn(f64) -> Vec<[DVec3; 2]>,
) -> Breaks {
    match run {
        Run::Straight => Breaks::simple(LOWEST_DEGREE, &[a, b]),
        Run::Kept(Breaks { degree, at }) => {
            // A window may end a rounding beyond the last knot.
            let slack = KNOT_SLACK * (b - a);
            let inner = at.into_iter().filter(|&(t, _)| t > a + slack && t < b - slack);
            Breaks { degree, at: [(a, 1)].into_iter().chain(inner).chain([(b, 1)]).collect() }
        }
        Run::Angular => {
            let spans = ((b - a) / START_ANGLE).ceil().clamp(1.0, SPAN_LIMIT as f64) as usize;
            let at: Vec<f64> = (0..=spans).map(|i| a + (b - a) * i as f64 / spans as f64).collect();
            Breaks::simple(MAX_SPACE_DEGREE, &at)
        }
        Run::Pieces(knots) => {
            let mut at = vec![(a, 1)];
            let step = 1e-6 * (b - a);
            for t in unroll(&knots, period, a, b) {
                at.push((t, multiplicity(&smoothness(t - step), &smoothness(t + step), step)));
            }
            at.push((b, 1));
            Breaks { degree: MAX_SPACE_DEGREE, at }
        }
    }
}

/// Breaks for the direction (0 for u, 1 for v) of a surface within a window.
fn surface_breaks(surface: &Surface, direction: usize, low: DVec2, high: DVec2) -> Breaks {
    let smoothness = |t: f64| {
        let across = |k: usize| {
            let mut uv = low + (high - low) * (0.1 + 0.2 * k as f64);
            uv[direction] = t;
            let d = surface.derivatives(uv.x, uv.y);
            if direction == 0 { [d.u, d.uu] } else { [d.v, d.vv] }
        };
        (0..5).map(across).collect()
    };
    let range = [low[direction], high[direction]];
    start_breaks(run(surface, direction), surface.period()[direction], range, &smoothness)
}

/// Breaks for a curve between two parameters.
pub fn curve_breaks(curve: &Curve3d, a: f64, b: f64) -> Breaks {
    let smoothness = |t: f64| {
        let [_, first, second] = curve.derivatives(t);
        vec![[first, second]]
    };
    start_breaks(curve_run(curve), curve.period(), [a, b], &smoothness)
}

/// Knots strictly inside (a, b), repeated with the period.
fn unroll(knots: &[f64], period: Option<f64>, a: f64, b: f64) -> Vec<f64> {
    let slack = KNOT_SLACK * (b - a);
    let inside = |t: &f64| *t > a + slack && *t < b - slack;
    let Some(period) = period else { return knots.iter().copied().filter(inside).collect() };
    let (first, last) = (((a - knots[0]) / period).floor() as i64, ((b - knots[0]) / period).ceil() as i64);
    let turns = (first..=last).flat_map(|k| knots[1..].iter().map(move |t| t + k as f64 * period));
    turns.filter(inside).collect()
}

/// The multiplicity that a quintic needs at a break, from derivatives `step` before and after it.
fn multiplicity(before: &[[DVec3; 2]], after: &[[DVec3; 2]], step: f64) -> usize {
    let (mut first, mut second) = (0.0f64, 0.0f64);
    for ([d1, dd1], [d2, dd2]) in before.iter().zip(after) {
        let drift = 2.0 * step * (dd1.length() + dd2.length());
        first = first.max(((*d1 - *d2).length() - drift) / d1.length().max(1e-12));
        second = second.max((*dd1 - *dd2).length() / (dd1.length() + dd2.length()).max(1e-12));
    }
    match () {
        _ if first > 1e-6 => MAX_SPACE_DEGREE,
        _ if second > 1e-2 => MAX_SPACE_DEGREE - 1,
        _ => 1,
    }
}
