//! Geometry moved by a rigid motion or mirrored, keeping its parametrisation.

use super::curve::Curve3d;
use super::location::Isometry;
use super::space::Frame;
use super::spline::{BSplineCurve, BSplineSurface, BezierCurve, BezierSurface};
use super::surface::Surface;
use crate::error::Result;
use glam::DVec3;

fn frame_of_surface(frame: &Frame<DVec3>, by: &Isometry) -> Frame<DVec3> {
    Frame {
        origin: by.point(frame.origin),
        x: by.vector(frame.x),
        y: by.vector(frame.y),
        normal: by.vector(frame.normal),
    }
}

/// As that of a surface, but always right-handed, as the text has it.
fn frame_of_conic(frame: &Frame<DVec3>, by: &Isometry) -> Frame<DVec3> {
    let moved = frame_of_surface(frame, by);
    Frame { normal: moved.normal * by.handedness, ..moved }
}

impl Curve3d {
    /// The curve moved.
    pub(super) fn moved(&self, by: &Isometry) -> Result<Self> {
        Ok(match self {
            Curve3d::Line { origin, direction } => {
                Curve3d::Line { origin: by.point(*origin), direction: by.vector(*direction) }
            }
            Curve3d::Circle { frame, radius } => {
                Curve3d::Circle { frame: frame_of_conic(frame, by), radius: *radius }
            }
            Curve3d::Ellipse { frame, radii } => {
                Curve3d::Ellipse { frame: frame_of_conic(frame, by), radii: *radii }
            }
            Curve3d::Parabola { frame, focal } => {
                Curve3d::Parabola { frame: frame_of_conic(frame, by), focal: *focal }
            }
            Curve3d::Hyperbola { frame, radii } => {
                Curve3d::Hyperbola { frame: frame_of_conic(frame, by), radii: *radii }
            }
            Curve3d::Bezier(c) => {
                let poles = c.nurbs().poles().iter().map(|&p| by.point(p)).collect();
                Curve3d::Bezier(BezierCurve::new(poles, c.nurbs().weights().map(<[f64]>::to_vec))?)
            }
            Curve3d::BSpline(c) => {
                let poles = c.poles().iter().map(|&p| by.point(p)).collect();
                let weights = c.weights().map(<[f64]>::to_vec);
                Curve3d::BSpline(BSplineCurve::new(c.knots().clone(), poles, weights)?)
            }
            Curve3d::Trimmed { range, basis } => {
                Curve3d::Trimmed { range: *range, basis: Box::new(basis.moved(by)?) }
            }
            Curve3d::Offset { offset, normal, basis } => Curve3d::Offset {
                offset: offset * by.handedness,
                normal: by.vector(*normal),
                basis: Box::new(basis.moved(by)?),
            },
        })
    }
}

impl Surface {
    /// The surface moved.
    pub(super) fn moved(&self, by: &Isometry) -> Result<Self> {
        Ok(match self {
            Surface::Plane(frame) => Surface::Plane(frame_of_surface(frame, by)),
            Surface::Cylinder { frame, radius } => {
                Surface::Cylinder { frame: frame_of_surface(frame, by), radius: *radius }
            }
            Surface::Cone { frame, radius, angle } => {
                Surface::Cone { frame: frame_of_surface(frame, by), radius: *radius, angle: *angle }
            }
            Surface::Sphere { frame, radius } => {
                Surface::Sphere { frame: frame_of_surface(frame, by), radius: *radius }
            }
            Surface::Torus { frame, radii } => {
                Surface::Torus { frame: frame_of_surface(frame, by), radii: *radii }
            }
            Surface::Extrusion { direction, curve } => {
                Surface::Extrusion { direction: by.vector(*direction), curve: Box::new(curve.moved(by)?) }
            }
            Surface::Revolution { origin, axis, curve } => Surface::Revolution {
                origin: by.point(*origin),
                // A mirror image turns the other way.
                axis: by.vector(*axis) * by.handedness,
                curve: Box::new(curve.moved(by)?),
            },
            Surface::Bezier(s) => Surface::Bezier(moved_bezier(s, by)?),
            Surface::BSpline(s) => Surface::BSpline(moved_bspline(s, by)?),
            Surface::Trimmed { u, v, basis } => {
                Surface::Trimmed { u: *u, v: *v, basis: Box::new(basis.moved(by)?) }
            }
            Surface::Offset { offset, basis } => {
                Surface::Offset { offset: offset * by.handedness, basis: Box::new(basis.moved(by)?) }
            }
        })
    }
}

fn moved_bezier(surface: &BezierSurface, by: &Isometry) -> Result<BezierSurface> {
    let nurbs = surface.nurbs();
    let degrees = [nurbs.knots_u().degree(), nurbs.knots_v().degree()];
    let poles = nurbs.poles().iter().map(|&p| by.point(p)).collect();
    BezierSurface::new(degrees, surface.rational(), poles, nurbs.weights().map(<[f64]>::to_vec))
}

fn moved_bspline(surface: &BSplineSurface, by: &Isometry) -> Result<BSplineSurface> {
    let poles: Vec<DVec3> = surface.poles().map(|p| by.point(p)).collect();
    let weights: Option<Vec<f64>> = surface.weights().map(Iterator::collect);
    BSplineSurface::new(surface.knots().clone(), surface.rational(), &poles, weights.as_deref())
}
