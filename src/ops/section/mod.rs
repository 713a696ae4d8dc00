//! Where surfaces meet planes and each other: all branches as curves, with their parameters.
//!
//! Points on all branches come from subdivision: for planes by the signs of Bernstein
//! coefficients, so that no branch that crosses is missed; for two surfaces by boxes and normals.
//! From these the branches are followed ([`trace`]). Branches end at borders of the surfaces, seams
//! of closed ones among them.

mod apex;
mod boxes;
mod pair;
mod seeds;
mod segment;
mod sheet;
mod touch;
mod trace;
mod zeros;

use crate::error::{Error, Result};
use crate::nurbs::{NurbsCurve, NurbsSurface};
use glam::{DVec2, DVec3};
use pair::{Kind, Pair};
use seeds::Seeds;
use sheet::Sheet;
use std::cell::Cell;
use trace::{End, Path};

/// One branch of an intersection.
#[derive(Debug, Clone)]
pub struct Branch {
    /// The curve, over its length in mm.
    pub curve: NurbsCurve<DVec3>,
    /// Its parameters on the first and the second surface, over the same parameter; on a plane in
    /// mm along the axes that [`Section::axes`] gives.
    pub parameters: [NurbsCurve<DVec2>; 2],
    /// Whether the end is the start.
    pub closed: bool,
    /// Whether the surfaces touch along it rather than cross.
    pub touching: bool,
    /// The largest distance seen of the curve, and of the points at its parameters, from each
    /// other and from the true branch, in mm; at three places between each two points that lie on
    /// the branch to rounding.
    pub deviation_mm: f64,
}

/// A point in which the tangent planes agree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchingPoint {
    /// The point.
    pub point: DVec3,
    /// Its parameters.
    pub parameters: [DVec2; 2],
    /// How far the surfaces are apart there, in mm; not more than the tolerance.
    pub gap_mm: f64,
    /// Whether two branches cross here; otherwise the surfaces meet in this point only.
    pub crossing: bool,
}

/// An intersection.
#[derive(Debug, Clone)]
pub struct Section {
    /// All branches.
    pub branches: Vec<Branch>,
    /// Points in which the surfaces touch.
    pub touching: Vec<TouchingPoint>,
    /// Rectangles, by two corners, of the first surface's parameters, over which it lies on the
    /// second within the tolerance.
    pub overlaps: Vec<[DVec2; 2]>,
    /// Parameters of the first surface around which the contact is too close to decide, or where a
    /// branch could not be followed to its end.
    pub uncertain: Vec<DVec2>,
    /// Origin and axes of the parameters on the plane, where there is one.
    pub axes: Option<[DVec3; 3]>,
}

/// The intersection of a surface with the plane through `origin` across `normal`, to a tolerance in
/// mm.
///
/// # Errors
/// [`Error::Argument`] for a plane without direction or a tolerance that is not positive or below
/// what rounding allows; [`Error::Numerics`] where they meet in too many places to follow.
pub fn with_plane(surface: &NurbsSurface, origin: DVec3, normal: DVec3, tolerance: f64) -> Result<Section> {
    let Some(normal) = normal.try_normalize().filter(|_| origin.is_finite()) else {
        let why = format!("a point and a direction were expected, not {origin} and {normal}");
        return Err(Error::Argument { name: "plane", why });
    };
    let (low, high) = bounds(surface);
    // The origin of the plane is the point nearest to the surface, to keep digits.
    let middle = 0.5 * (low + high);
    let origin = middle - normal * (middle - origin).dot(normal);
    let plane = Sheet::plane(origin, normal);
    let axes = match plane {
        Sheet::Plane { origin, x, y } => Some([origin, x, y]),
        Sheet::Surface(_) => None,
    };
    let pair = pair([Sheet::surface(surface)?, plane], low, high, tolerance)?;
    let seeds = zeros::seeds(&pair, surface, origin, normal)?;
    let section = section(&pair, seeds)?;
    Ok(Section { axes, ..section })
}

/// The intersection of two surfaces, to a tolerance in mm.
///
/// Branches that cross are found to patches of a millionth of the size; smaller loops may be missed.
///
/// # Errors
/// As [`with_plane`].
pub fn with_surface(a: &NurbsSurface, b: &NurbsSurface, tolerance: f64) -> Result<Section> {
    let (of_a, of_b) = (bounds(a), bounds(b));
    let (low, high) = (of_a.0.min(of_b.0), of_a.1.max(of_b.1));
    let mut pair = pair([Sheet::surface(a)?, Sheet::surface(b)?], low, high, tolerance)?;
    pair.size = (of_a.1 - of_a.0).length().min((of_b.1 - of_b.0).length());
    let seeds = boxes::seeds(&pair, a, b)?;
    section(&pair, seeds)
}

/// The box around the poles.
fn bounds(surface: &NurbsSurface) -> (DVec3, DVec3) {
    let poles = surface.poles().iter();
    poles.fold((DVec3::MAX, DVec3::MIN), |(a, b), p| (a.min(*p), b.max(*p)))
}

fn pair(sheets: [Sheet; 2], low: DVec3, high: DVec3, tolerance: f64) -> Result<Pair> {
    let reach = low.abs().max(high.abs()).max_element();
    let least = 256.0 * f64::EPSILON * reach;
    if !tolerance.is_finite() || tolerance < least {
        let why = format!(
            "a length in mm of at least {least:e} was expected, the rounding error of coordinates up to \
             {reach}, not {tolerance}"
        );
        return Err(Error::Argument { name: "tolerance", why });
    }
    Ok(Pair { sheets, size: (high - low).length(), reach, tolerance, work: Cell::new(0) })
}

fn section(pair: &Pair, mut seeds: Seeds) -> Result<Section> {
    let paths = seeds.branches(pair)?;
    let crossing = |i: usize| paths.iter().any(|p| p.ends.contains(&End::Target(i)));
    let touching = seeds.contacts.iter().enumerate().map(|(i, c)| TouchingPoint {
        point: c.x,
        parameters: c.at,
        gap_mm: c.gap,
        crossing: crossing(i),
    });
    Ok(Section {
        touching: touching.collect(),
        branches: paths.iter().map(branch).collect::<Result<_>>()?,
        overlaps: seeds.overlaps,
        uncertain: seeds.uncertain,
        axes: None,
    })
}

fn branch(path: &Path) -> Result<Branch> {
    let (curve, parameters) = segment::chained(&path.segments)?;
    Ok(Branch {
        curve,
        parameters,
        closed: path.ends[0] == End::Closed,
        touching: path.kind == Kind::Touching,
        deviation_mm: path.segments.iter().map(|s| s.deviation).fold(0.0, f64::max),
    })
}
