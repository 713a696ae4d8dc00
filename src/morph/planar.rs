//! The pcurve of an edge on a plane: Open CASCADE stores none, and a plane that becomes a spline
//! needs one.

use crate::brep::{Curve2d, Curve3d, Frame};
use crate::error::Result;
use crate::ops::approximate::{self, Breaks};
use glam::{DVec2, DVec3};

/// Distance that a pcurve may be off, in mm.
const TOLERANCE_MM: f64 = 1e-9;

/// The curve in the parameters of the plane, over `range`, with the same parameter.
///
/// Straight and spline curves map exactly; any other is approximated.
///
/// # Errors
/// As [`approximate::curve`].
pub fn pcurve(plane: &Frame<DVec3>, curve: &Curve3d, range: [f64; 2]) -> Result<Curve2d> {
    let map = |p: DVec3| {
        let r = p - plane.origin;
        DVec2::new(r.dot(plane.x), r.dot(plane.y))
    };
    let turn = |d: DVec3| DVec2::new(d.dot(plane.x), d.dot(plane.y));
    match curve {
        Curve3d::Trimmed { basis, .. } => return pcurve(plane, basis, range),
        Curve3d::Line { origin, direction } => {
            let direction_2d = turn(*direction);
            if (direction_2d.length() - 1.0).abs() < 1e-12 {
                return Ok(Curve2d::Line { origin: map(*origin), direction: direction_2d.normalize() });
            }
        }
        Curve3d::Circle { frame, radius } => {
            let (x, y) = (turn(frame.x), turn(frame.y));
            if (x.length() - 1.0).abs() < 1e-12 && (y.length() - 1.0).abs() < 1e-12 {
                let frame = Frame { origin: map(frame.origin), x, y, normal: () };
                return Ok(Curve2d::Circle { frame, radius: *radius });
            }
        }
        Curve3d::BSpline(c) => {
            let nurbs = c.to_nurbs()?;
            let poles = nurbs.poles().iter().map(|p| map(*p)).collect();
            let weights = nurbs.weights().map(<[f64]>::to_vec);
            let flat = crate::nurbs::NurbsCurve::new(nurbs.knots().clone(), poles, weights)?;
            let (a, b) = flat.knots().domain();
            if range[0] >= a && range[1] <= b {
                return Ok(Curve2d::BSpline((&flat).into()));
            }
        }
        _ => {}
    }
    let spans = 8;
    let at: Vec<f64> =
        (0..=spans).map(|i| range[0] + (range[1] - range[0]) * i as f64 / spans as f64).collect();
    let f = |t: f64| map(curve.point(t));
    let (fitted, _) = approximate::curve(f, Breaks::simple(5, &at), TOLERANCE_MM, 400)?;
    Ok(Curve2d::BSpline((&fitted).into()))
}
