//! Parser of the tables of curves and surfaces.

use super::curve::{Curve, Curve3d};
use super::scan::Scanner;
use super::space::{Frame, Space, unit};
use super::spline::{BSplineCurve, BSplineSurface, BezierCurve, BezierSurface, SplineKnots};
use super::surface::Surface;
use crate::error::Result;
use crate::nurbs::basis::MAX_DEGREE;
use glam::DVec3;

/// Trimmed and offset geometry nested deeper than this is refused.
const MAX_NESTING: usize = 16;

fn point<P: Space>(scanner: &mut Scanner) -> Result<P> {
    let mut c = [0.0; 3];
    for x in &mut c[..P::DIMENSION] {
        *x = scanner.real("a coordinate")?;
    }
    Ok(P::from_coordinates(c))
}

fn direction<P: Space>(scanner: &mut Scanner) -> Result<P> {
    let at = scanner.mark();
    match unit(point::<P>(scanner)?) {
        Some(direction) => Ok(direction),
        None => scanner.fail_at(at, "expected a direction, found a null vector"),
    }
}

fn frame_of_conic<P: Space>(scanner: &mut Scanner) -> Result<Frame<P>> {
    let at = scanner.mark();
    let origin = point(scanner)?;
    let mut directions = [P::default(); 3];
    for d in &mut directions[..P::FRAME_DIRECTIONS] {
        *d = point(scanner)?;
    }
    match P::conic_frame(origin, directions) {
        Some(frame) => Ok(frame),
        None => scanner.fail_at(at, "expected the axes of a frame, found null or parallel vectors"),
    }
}

fn frame_of_surface(scanner: &mut Scanner) -> Result<Frame<DVec3>> {
    let at = scanner.mark();
    let (origin, z, x, y) = (point(scanner)?, point(scanner)?, point(scanner)?, point(scanner)?);
    match Frame::new(origin, z, x, y) {
        Some(frame) => Ok(frame),
        None => scanner.fail_at(at, "expected the axes of a frame, found null or parallel vectors"),
    }
}

fn radii(scanner: &mut Scanner) -> Result<[f64; 2]> {
    Ok([scanner.length("a radius")?, scanner.length("a radius")?])
}

fn check_nesting(scanner: &mut Scanner, nesting: usize) -> Result<()> {
    if nesting > MAX_NESTING {
        return scanner.fail(format!("trimmed or offset geometry nested deeper than {MAX_NESTING}"));
    }
    Ok(())
}

/// Poles with their weights, if rational.
fn poles<P: Space>(scanner: &mut Scanner, n: usize, rational: bool) -> Result<(Vec<P>, Option<Vec<f64>>)> {
    let mut poles = Vec::with_capacity(n);
    let mut weights = rational.then(|| Vec::with_capacity(n));
    for _ in 0..n {
        poles.push(point(scanner)?);
        if let Some(w) = &mut weights {
            w.push(scanner.real("a weight")?);
        }
    }
    Ok((poles, weights))
}

fn knots(scanner: &mut Scanner, degree: usize, periodic: bool, n: usize) -> Result<SplineKnots> {
    let at = scanner.mark();
    let mut knots = Vec::with_capacity(n);
    for _ in 0..n {
        let multiplicity = 1..=MAX_DEGREE as i64 + 1;
        knots.push((scanner.real("a knot")?, scanner.integer_in("a multiplicity", multiplicity)?));
    }
    scanner.locate(at, SplineKnots::new(degree, periodic, knots))
}

fn degree(scanner: &mut Scanner) -> Result<usize> {
    scanner.integer_in("a degree", 1..=MAX_DEGREE as i64)
}

/// One curve with its basis curves.
pub(super) fn curve<P: Space>(scanner: &mut Scanner, nesting: usize) -> Result<Curve<P>> {
    check_nesting(scanner, nesting)?;
    let kind = scanner.integer_in("a kind of curve", 1..=9)?;
    Ok(match kind {
        1 => Curve::Line { origin: point(scanner)?, direction: direction(scanner)? },
        2 => Curve::Circle { frame: frame_of_conic(scanner)?, radius: scanner.length("a radius")? },
        3 => Curve::Ellipse { frame: frame_of_conic(scanner)?, radii: radii(scanner)? },
        4 => parabola(scanner)?,
        5 => Curve::Hyperbola { frame: frame_of_conic(scanner)?, radii: radii(scanner)? },
        6 => {
            let (at, rational) = (scanner.mark(), scanner.flag("rational")?);
            let n = degree(scanner)? + 1;
            let (poles, weights) = poles(scanner, n, rational)?;
            Curve::Bezier(scanner.locate(at, BezierCurve::new(poles, weights))?)
        }
        7 => Curve::BSpline(bspline_curve(scanner)?),
        8 => Curve::Trimmed {
            range: scanner.reals("a parameter")?,
            basis: Box::new(curve(scanner, nesting + 1)?),
        },
        _ => offset_curve(scanner, nesting)?,
    })
}

fn parabola<P: Space>(scanner: &mut Scanner) -> Result<Curve<P>> {
    let frame = frame_of_conic(scanner)?;
    let at = scanner.mark();
    let focal = scanner.length("a focal length")?;
    if focal == 0.0 {
        return scanner.fail_at(at, "the focal length of a parabola is 0");
    }
    Ok(Curve::Parabola { frame, focal })
}

fn bspline_curve<P: Space>(scanner: &mut Scanner) -> Result<BSplineCurve<P>> {
    let at = scanner.mark();
    let (rational, periodic) = (scanner.flag("rational")?, scanner.flag("periodic")?);
    let degree = degree(scanner)?;
    let pole_count = scanner.count("poles", P::DIMENSION)?;
    let knot_count = scanner.count("knots", 2)?;
    let (poles, weights) = poles(scanner, pole_count, rational)?;
    let knots = knots(scanner, degree, periodic, knot_count)?;
    scanner.locate(at, BSplineCurve::new(knots, poles, weights))
}

fn offset_curve<P: Space>(scanner: &mut Scanner, nesting: usize) -> Result<Curve<P>> {
    let offset = scanner.real("an offset")?;
    let at = scanner.mark();
    let mut c = [0.0; 3];
    for x in &mut c[..P::NORMAL_COORDINATES] {
        *x = scanner.real("a direction")?;
    }
    let Some(normal) = P::normal(c) else {
        return scanner.fail_at(at, "expected a direction, found a null vector");
    };
    let at = scanner.mark();
    let basis: Curve<P> = curve(scanner, nesting + 1)?;
    if basis.is_offset() {
        return scanner.fail_at(at, "an offset of an offset curve: Open CASCADE writes one offset instead");
    }
    Ok(Curve::Offset { offset, normal, basis: Box::new(basis) })
}

/// One surface with its basis geometry.
pub(super) fn surface(scanner: &mut Scanner, nesting: usize) -> Result<Surface> {
    check_nesting(scanner, nesting)?;
    let kind = scanner.integer_in("a kind of surface", 1..=11)?;
    Ok(match kind {
        1 => Surface::Plane(frame_of_surface(scanner)?),
        2 => Surface::Cylinder { frame: frame_of_surface(scanner)?, radius: scanner.length("a radius")? },
        3 => Surface::Cone {
            frame: frame_of_surface(scanner)?,
            radius: scanner.length("a radius")?,
            angle: scanner.real("an angle")?,
        },
        4 => Surface::Sphere { frame: frame_of_surface(scanner)?, radius: scanner.length("a radius")? },
        5 => Surface::Torus { frame: frame_of_surface(scanner)?, radii: radii(scanner)? },
        6 => Surface::Extrusion { direction: direction(scanner)?, curve: basis_curve(scanner)? },
        7 => Surface::Revolution {
            origin: point(scanner)?,
            axis: direction(scanner)?,
            curve: basis_curve(scanner)?,
        },
        8 => Surface::Bezier(bezier_surface(scanner)?),
        9 => Surface::BSpline(bspline_surface(scanner)?),
        10 => Surface::Trimmed {
            u: scanner.reals("a parameter")?,
            v: scanner.reals("a parameter")?,
            basis: Box::new(surface(scanner, nesting + 1)?),
        },
        _ => offset_surface(scanner, nesting)?,
    })
}

fn basis_curve(scanner: &mut Scanner) -> Result<Box<Curve3d>> {
    Ok(Box::new(curve(scanner, 0)?))
}

fn flags(scanner: &mut Scanner, what: &str) -> Result<[bool; 2]> {
    Ok([scanner.flag(what)?, scanner.flag(what)?])
}

fn bezier_surface(scanner: &mut Scanner) -> Result<BezierSurface> {
    let at = scanner.mark();
    let rational = flags(scanner, "rational")?;
    let degrees = [degree(scanner)?, degree(scanner)?];
    let n = (degrees[0] + 1) * (degrees[1] + 1);
    let (poles, weights) = poles(scanner, n, rational != [false; 2])?;
    scanner.locate(at, BezierSurface::new(degrees, rational, poles, weights))
}

fn bspline_surface(scanner: &mut Scanner) -> Result<BSplineSurface> {
    let at = scanner.mark();
    let rational = flags(scanner, "rational")?;
    let periodic = flags(scanner, "periodic")?;
    let degrees = [degree(scanner)?, degree(scanner)?];
    let rows = scanner.count("rows of poles", 3)?;
    let columns = scanner.count("columns of poles", 3 * rows.max(1))?;
    let knot_counts = [scanner.count("knots", 2)?, scanner.count("knots", 2)?];
    let (poles, weights) = poles(scanner, rows * columns, rational != [false; 2])?;
    let knots = [
        knots(scanner, degrees[0], periodic[0], knot_counts[0])?,
        knots(scanner, degrees[1], periodic[1], knot_counts[1])?,
    ];
    let expected = [knots[0].pole_count(), knots[1].pole_count()];
    if expected != [rows, columns] {
        let [n, m] = expected;
        return scanner.fail_at(at, format!("{rows} × {columns} poles where the knots ask for {n} × {m}"));
    }
    scanner.locate(at, BSplineSurface::new(knots, rational, &poles, weights.as_deref()))
}

fn offset_surface(scanner: &mut Scanner, nesting: usize) -> Result<Surface> {
    let offset = scanner.real("an offset")?;
    let at = scanner.mark();
    let basis = surface(scanner, nesting + 1)?;
    if basis.is_offset() {
        return scanner.fail_at(at, "an offset of an offset surface: Open CASCADE writes one offset instead");
    }
    Ok(Surface::Offset { offset, basis: Box::new(basis) })
}
