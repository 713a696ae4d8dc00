//! Surfaces: parametrisation as in Open CASCADE, evaluation, periods.

use super::curve::{Curve3d, circular};
use super::jet::{self, SURFACE_ORDER, SurfaceJet};
use super::space::Frame;
use super::spline::{BSplineSurface, BezierSurface};
use crate::nurbs::SurfaceDerivatives;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A surface; `O`, `X`, `Y`, `Z` are the origin and axes of its frame, `E(u) = cos u X + sin u Y`.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// `O + u X + v Y`.
    Plane(Frame<DVec3>),
    /// `O + r E(u) + v Z`.
    Cylinder {
        /// Position.
        frame: Frame<DVec3>,
        /// The radius.
        radius: f64,
    },
    /// `O + (r + v sin a) E(u) + v cos a Z`.
    Cone {
        /// Position.
        frame: Frame<DVec3>,
        /// The radius at `v = 0`.
        radius: f64,
        /// The half angle `a`.
        angle: f64,
    },
    /// `O + r cos v E(u) + r sin v Z`.
    Sphere {
        /// Position.
        frame: Frame<DVec3>,
        /// The radius.
        radius: f64,
    },
    /// `O + (R + r cos v) E(u) + r sin v Z`.
    Torus {
        /// Position.
        frame: Frame<DVec3>,
        /// Major and minor radius.
        radii: [f64; 2],
    },
    /// `C(u) + v D`.
    Extrusion {
        /// The unit direction.
        direction: DVec3,
        /// The curve.
        curve: Box<Curve3d>,
    },
    /// `C(v)` turned by `u` about an axis.
    Revolution {
        /// A point of the axis.
        origin: DVec3,
        /// The unit direction of the axis.
        axis: DVec3,
        /// The curve.
        curve: Box<Curve3d>,
    },
    /// A Bézier surface.
    Bezier(BezierSurface),
    /// A B-spline surface.
    BSpline(BSplineSurface),
    /// A part of a surface, with its parameters.
    Trimmed {
        /// First and last `u`.
        u: [f64; 2],
        /// First and last `v`.
        v: [f64; 2],
        /// The surface.
        basis: Box<Surface>,
    },
    /// A surface moved along its unit normal `S_u × S_v`.
    Offset {
        /// The distance, signed.
        offset: f64,
        /// The surface; never itself an offset.
        basis: Box<Surface>,
    },
}

/// Distance from the axis and height of a surface of revolution at `v`, with derivatives.
type Profile = [[f64; 2]; SURFACE_ORDER + 1];

impl Surface {
    /// The point at (u, v).
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        match self {
            Surface::Bezier(s) => s.nurbs().point(u, v),
            Surface::BSpline(s) => {
                let (u, v) = s.reduce(u, v);
                s.unwrapped().point(u, v)
            }
            Surface::Trimmed { basis, .. } => basis.point(u, v),
            _ => self.jet(u, v, 0)[0][0],
        }
    }

    /// The point and all derivatives up to the second at (u, v). Not finite where an offset's
    /// basis has no normal.
    pub fn derivatives(&self, u: f64, v: f64) -> SurfaceDerivatives {
        match self {
            Surface::Bezier(s) => s.nurbs().derivatives(u, v),
            Surface::BSpline(s) => {
                let (u, v) = s.reduce(u, v);
                s.unwrapped().derivatives(u, v)
            }
            Surface::Trimmed { basis, .. } => basis.derivatives(u, v),
            _ => {
                let s = self.jet(u, v, 2);
                SurfaceDerivatives {
                    s: s[0][0],
                    u: s[1][0],
                    v: s[0][1],
                    uu: s[2][0],
                    uv: s[1][1],
                    vv: s[0][2],
                }
            }
        }
    }

    /// The point and the derivatives up to a total `order`; for an offset at most the second.
    fn jet(&self, u: f64, v: f64, order: usize) -> SurfaceJet {
        match self {
            Surface::Plane(frame) => {
                let mut s = SurfaceJet::default();
                s[0][0] = frame.origin + frame.x * u + frame.y * v;
                s[1][0] = frame.x;
                s[0][1] = frame.y;
                s
            }
            Surface::Cylinder { frame, radius } => {
                round(frame, u, [[*radius, v], [0.0, 1.0], [0.0; 2], [0.0; 2]])
            }
            Surface::Cone { frame, radius, angle } => {
                let (sin, cos) = angle.sin_cos();
                round(frame, u, [[radius + v * sin, v * cos], [sin, cos], [0.0; 2], [0.0; 2]])
            }
            Surface::Sphere { frame, radius } => round(frame, u, arc(0.0, *radius, v)),
            Surface::Torus { frame, radii } => round(frame, u, arc(radii[0], radii[1], v)),
            Surface::Extrusion { direction, curve } => {
                let c = curve.jet(u, order);
                let mut s = SurfaceJet::default();
                for k in 0..=order {
                    s[k][0] = c[k];
                }
                s[0][0] += v * *direction;
                s[0][1] = *direction;
                s
            }
            Surface::Revolution { origin, axis, curve } => turned(*origin, *axis, curve, [u, v], order),
            Surface::Bezier(s) => jet::nurbs_surface(s.nurbs(), u, v, order),
            Surface::BSpline(s) => {
                let (u, v) = s.reduce(u, v);
                jet::nurbs_surface(s.unwrapped(), u, v, order)
            }
            Surface::Trimmed { basis, .. } => basis.jet(u, v, order),
            Surface::Offset { offset, basis } => {
                jet::offset_surface(&basis.jet(u, v, SURFACE_ORDER), *offset)
            }
        }
    }

    /// The periods along `u` and `v`.
    pub fn period(&self) -> [Option<f64>; 2] {
        match self {
            Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Sphere { .. } => [Some(TAU), None],
            Surface::Torus { .. } => [Some(TAU); 2],
            Surface::Extrusion { curve, .. } => [curve.period(), None],
            Surface::Revolution { curve, .. } => [Some(TAU), curve.period()],
            Surface::BSpline(s) => [s.knots()[0].period(), s.knots()[1].period()],
            Surface::Offset { basis, .. } => basis.period(),
            Surface::Plane(_) | Surface::Bezier(_) | Surface::Trimmed { .. } => [None; 2],
        }
    }

    /// First and last parameter along `u` and `v`, infinite where the surface does not end.
    pub fn domain(&self) -> [[f64; 2]; 2] {
        const ENDLESS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        match self {
            Surface::Plane(_) => [ENDLESS; 2],
            Surface::Cylinder { .. } | Surface::Cone { .. } => [[0.0, TAU], ENDLESS],
            Surface::Sphere { .. } => [[0.0, TAU], [-FRAC_PI_2, FRAC_PI_2]],
            Surface::Torus { .. } => [[0.0, TAU]; 2],
            Surface::Extrusion { curve, .. } => [curve.domain(), ENDLESS],
            Surface::Revolution { curve, .. } => [[0.0, TAU], curve.domain()],
            Surface::Bezier(_) => [[0.0, 1.0]; 2],
            Surface::BSpline(s) => {
                let nurbs = s.unwrapped();
                [nurbs.knots_u().domain().into(), nurbs.knots_v().domain().into()]
            }
            Surface::Trimmed { u, v, .. } => [*u, *v],
            Surface::Offset { basis, .. } => basis.domain(),
        }
    }

    /// Whether the surface is an offset, perhaps trimmed.
    pub fn is_offset(&self) -> bool {
        match self {
            Surface::Offset { .. } => true,
            Surface::Trimmed { basis, .. } => basis.is_offset(),
            _ => false,
        }
    }

    /// What the surface is, in a word.
    pub fn kind_name(&self) -> &'static str {
        match self {
            Surface::Plane(_) => "plane",
            Surface::Cylinder { .. } => "cylinder",
            Surface::Cone { .. } => "cone",
            Surface::Sphere { .. } => "sphere",
            Surface::Torus { .. } => "torus",
            Surface::Extrusion { .. } => "extrusion",
            Surface::Revolution { .. } => "revolution",
            Surface::Bezier(_) => "Bézier surface",
            Surface::BSpline(_) => "B-spline surface",
            Surface::Trimmed { basis, .. } => basis.kind_name(),
            Surface::Offset { .. } => "offset surface",
        }
    }
}

/// The profile of a sphere or torus.
fn arc(major: f64, minor: f64, v: f64) -> Profile {
    let mut profile = circular(v).map(|(cos, sin)| [minor * cos, minor * sin]);
    profile[0][0] += major;
    profile
}

/// A profile turned about the third axis of a frame.
fn round(frame: &Frame<DVec3>, u: f64, profile: Profile) -> SurfaceJet {
    let mut s = SurfaceJet::default();
    for (k, (cos, sin)) in circular(u).into_iter().enumerate() {
        let around = frame.x * cos + frame.y * sin;
        for (l, [radius, _]) in profile.into_iter().enumerate() {
            s[k][l] = around * radius;
        }
    }
    for (l, [_, height]) in profile.into_iter().enumerate() {
        s[0][l] += frame.normal * height;
    }
    s[0][0] += frame.origin;
    s
}

/// A curve turned about an axis.
fn turned(origin: DVec3, axis: DVec3, curve: &Curve3d, [u, v]: [f64; 2], order: usize) -> SurfaceJet {
    let mut c = curve.jet(v, order);
    c[0] -= origin;
    let mut s = SurfaceJet::default();
    for (k, (cos, sin)) in circular(u).into_iter().enumerate().take(order + 1) {
        for l in 0..=order - k {
            let along = axis * axis.dot(c[l]);
            s[k][l] = (c[l] - along) * cos + axis.cross(c[l]) * sin;
            if k == 0 {
                s[k][l] += along;
            }
        }
    }
    s[0][0] += origin;
    s
}
