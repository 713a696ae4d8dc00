//! Curves of the plane and of space: parametrisation as in Open CASCADE, evaluation, periods.

use super::jet::{self, CurveJet};
use super::space::{Frame, Space};
use super::spline::{BSplineCurve, BezierCurve};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A curve of the (u, v) plane of a surface.
pub type Curve2d = Curve<DVec2>;
/// A curve of space.
pub type Curve3d = Curve<DVec3>;

/// A curve; `O`, `X`, `Y` are the origin and axes of its frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve<P: Space> {
    /// `O + t D`.
    Line {
        /// The point at 0.
        origin: P,
        /// The unit direction.
        direction: P,
    },
    /// `O + r (cos t X + sin t Y)`.
    Circle {
        /// Centre and axes.
        frame: Frame<P>,
        /// The radius.
        radius: f64,
    },
    /// `O + a cos t X + b sin t Y`.
    Ellipse {
        /// Centre and axes.
        frame: Frame<P>,
        /// Radii along both axes.
        radii: [f64; 2],
    },
    /// `O + t² / (4 f) X + t Y`.
    Parabola {
        /// Apex and axes.
        frame: Frame<P>,
        /// The focal length.
        focal: f64,
    },
    /// `O + a cosh t X + b sinh t Y`.
    Hyperbola {
        /// Centre and axes.
        frame: Frame<P>,
        /// Radii along both axes.
        radii: [f64; 2],
    },
    /// A Bézier curve.
    Bezier(BezierCurve<P>),
    /// A B-spline curve.
    BSpline(BSplineCurve<P>),
    /// A part of a curve, with its parameter.
    Trimmed {
        /// First and last parameter.
        range: [f64; 2],
        /// The curve.
        basis: Box<Curve<P>>,
    },
    /// A curve moved sideways: by `offset` along `(T.y, -T.x)` of the unit tangent `T` in the
    /// plane, along the unit vector of `T × normal` in space.
    Offset {
        /// The distance, signed.
        offset: f64,
        /// The reference direction, in space.
        normal: P::Normal,
        /// The curve; never itself an offset.
        basis: Box<Curve<P>>,
    },
}

impl<P: Space> Curve<P> {
    /// The point at `t`.
    pub fn point(&self, t: f64) -> P {
        match self {
            Curve::Bezier(c) => c.nurbs().point(t),
            Curve::BSpline(c) => c.unwrapped().point(c.reduce(t)),
            Curve::Trimmed { basis, .. } => basis.point(t),
            _ => self.jet(t, 0)[0],
        }
    }

    /// The point and the first two derivatives at `t`. Not finite where an offset has no tangent.
    pub fn derivatives(&self, t: f64) -> [P; 3] {
        match self {
            Curve::Bezier(c) => c.nurbs().derivatives(t),
            Curve::BSpline(c) => c.unwrapped().derivatives(c.reduce(t)),
            Curve::Trimmed { basis, .. } => basis.derivatives(t),
            _ => {
                let jet = self.jet(t, 2);
                [jet[0], jet[1], jet[2]]
            }
        }
    }

    /// The point and the derivatives up to `order`.
    pub(super) fn jet(&self, t: f64, order: usize) -> CurveJet<P> {
        let mut jet = CurveJet::<P>::default();
        match self {
            Curve::Line { origin, direction } => {
                jet[0] = *origin + *direction * t;
                jet[1] = *direction;
            }
            Curve::Circle { frame, radius } => elliptic(frame, [*radius; 2], t, &mut jet),
            Curve::Ellipse { frame, radii } => elliptic(frame, *radii, t, &mut jet),
            Curve::Hyperbola { frame, radii } => hyperbolic(frame, *radii, t, &mut jet),
            Curve::Parabola { frame, focal } => {
                let quarter = 0.25 / focal;
                jet[0] = frame.origin + frame.x * (t * t * quarter) + frame.y * t;
                jet[1] = frame.x * (2.0 * t * quarter) + frame.y;
                jet[2] = frame.x * (2.0 * quarter);
            }
            Curve::Bezier(c) => jet = jet::nurbs_curve(c.nurbs(), t, order),
            Curve::BSpline(c) => jet = jet::nurbs_curve(c.unwrapped(), c.reduce(t), order),
            Curve::Trimmed { basis, .. } => jet = basis.jet(t, order),
            Curve::Offset { offset, normal, basis } => {
                jet = jet::offset_curve(&basis.jet(t, order + 1), *offset, *normal, order);
            }
        }
        jet
    }

    /// The period of a closed curve that repeats.
    pub fn period(&self) -> Option<f64> {
        match self {
            Curve::Circle { .. } | Curve::Ellipse { .. } => Some(TAU),
            Curve::BSpline(c) => c.knots().period(),
            Curve::Offset { basis, .. } => basis.period(),
            _ => None,
        }
    }

    /// First and last parameter, infinite where the curve does not end.
    pub fn domain(&self) -> [f64; 2] {
        match self {
            Curve::Line { .. } | Curve::Parabola { .. } | Curve::Hyperbola { .. } => {
                [f64::NEG_INFINITY, f64::INFINITY]
            }
            Curve::Circle { .. } | Curve::Ellipse { .. } => [0.0, TAU],
            Curve::Bezier(_) => [0.0, 1.0],
            Curve::BSpline(c) => c.unwrapped().knots().domain().into(),
            Curve::Trimmed { range, .. } => *range,
            Curve::Offset { basis, .. } => basis.domain(),
        }
    }

    /// Whether the curve is an offset, perhaps trimmed.
    pub fn is_offset(&self) -> bool {
        match self {
            Curve::Offset { .. } => true,
            Curve::Trimmed { basis, .. } => basis.is_offset(),
            _ => false,
        }
    }

    /// What the curve is, in a word.
    pub fn kind_name(&self) -> &'static str {
        match self {
            Curve::Line { .. } => "line",
            Curve::Circle { .. } => "circle",
            Curve::Ellipse { .. } => "ellipse",
            Curve::Parabola { .. } => "parabola",
            Curve::Hyperbola { .. } => "hyperbola",
            Curve::Bezier(_) => "Bézier curve",
            Curve::BSpline(_) => "B-spline curve",
            Curve::Trimmed { basis, .. } => basis.kind_name(),
            Curve::Offset { .. } => "offset curve",
        }
    }
}

fn elliptic<P: Space>(frame: &Frame<P>, radii: [f64; 2], t: f64, jet: &mut CurveJet<P>) {
    let (sin, cos) = t.sin_cos();
    let (a, b) = (frame.x * radii[0], frame.y * radii[1]);
    let around = [a * cos + b * sin, b * cos - a * sin];
    for (k, d) in jet.iter_mut().enumerate() {
        *d = around[k % 2] * if k % 4 < 2 { 1.0 } else { -1.0 };
    }
    jet[0] = jet[0] + frame.origin;
}

fn hyperbolic<P: Space>(frame: &Frame<P>, radii: [f64; 2], t: f64, jet: &mut CurveJet<P>) {
    let (a, b) = (frame.x * radii[0], frame.y * radii[1]);
    let along = [a * t.cosh() + b * t.sinh(), a * t.sinh() + b * t.cosh()];
    for (k, d) in jet.iter_mut().enumerate() {
        *d = along[k % 2];
    }
    jet[0] = jet[0] + frame.origin;
}

/// The derivatives of cos and sin at `t`, orders 0 to 3.
pub(super) fn circular(t: f64) -> [(f64, f64); 4] {
    let (sin, cos) = t.sin_cos();
    [(cos, sin), (-sin, cos), (-cos, -sin), (sin, -cos)]
}
