//! Surfaces from curves: ruled, of revolution, Coons (*The NURBS Book*, sections 8.4, 8.5 and 10.6).

use super::basis::KnotVector;
use super::conic::unit_arc_net;
use super::curve::NurbsCurve;
use super::join::compatible;
use super::refine::Direction;
use super::surface::NurbsSurface;
use crate::error::{Error, Result};
use crate::tolerance::CONFUSION_MM;
use glam::DVec3;

impl NurbsSurface {
    /// The ruled surface whose lines lead along `v` in [0, 1] from points of the first curve to
    /// those of the second at equal parameters along `u`.
    ///
    /// # Errors
    /// As [`compatible`].
    pub fn ruled(first: &NurbsCurve<DVec3>, second: &NurbsCurve<DVec3>) -> Result<Self> {
        let pair = compatible(&[first.clone(), second.clone()])?;
        let each = |i: usize| [0, 1].map(|k: usize| pair[k].poles()[i]);
        let poles = (0..pair[0].poles().len()).flat_map(each).collect();
        let weights = pair[0].weights().zip(pair[1].weights());
        let weights = weights.map(|(a, b)| a.iter().zip(b).flat_map(|(a, b)| [*a, *b]).collect());
        Self::new(pair[0].knots().clone(), KnotVector::clamped(1, &[0.0, 1.0])?, poles, weights)
    }

    /// The surface that the curve (along `u`) sweeps when it turns about an axis by an angle in rad,
    /// counterclockwise seen against the axis (along `v` in [0, 1]).
    ///
    /// # Errors
    /// [`Error::Argument`] for an axis without direction, and as [`NurbsCurve::arc`].
    pub fn revolved(curve: &NurbsCurve<DVec3>, origin: DVec3, axis: DVec3, angle: f64) -> Result<Self> {
        let axis = axis.try_normalize().ok_or_else(|| Error::Argument {
            name: "axis",
            why: format!("a direction was expected, not {axis}"),
        })?;
        let (knots, circle, factors) = unit_arc_net(0.0, angle)?;
        let turned = |&p: &DVec3| {
            let foot = origin + axis * (p - origin).dot(axis);
            let (x, y) = (p - foot, axis.cross(p - foot));
            circle.iter().map(move |[c, s]| foot + x * *c + y * *s)
        };
        let poles = curve.poles().iter().flat_map(turned).collect();
        let rational = curve.rational();
        let weights = rational.weights().unwrap_or_default().iter();
        let weights = weights.flat_map(|w| factors.iter().map(move |f| w * f)).collect();
        Self::new(curve.knots().clone(), knots, poles, Some(weights))
    }

    /// The bilinearly blended Coons patch between two curves along `u` (at the start and the end of
    /// `v`) and two along `v` (at the start and the end of `u`). Domains are those of the first of
    /// each pair.
    ///
    /// # Errors
    /// [`Error::Spline`] when the curves do not meet in four corners or are rational, whose blend
    /// is no NURBS of a sensible degree.
    pub fn coons(along_u: [&NurbsCurve<DVec3>; 2], along_v: [&NurbsCurve<DVec3>; 2]) -> Result<Self> {
        if along_u.iter().chain(&along_v).any(|c| c.weights().is_some()) {
            let why = "a Coons patch takes polynomial curves only: approximate the rational ones first";
            return Err(Error::Spline { why: why.into() });
        }
        let corners = corners(along_u, along_v)?;
        let across = |pair: [&NurbsCurve<DVec3>; 2], other: &NurbsCurve<DVec3>| {
            let (a, b) = other.knots().domain();
            let ruled = Self::ruled(pair[0], pair[1])?;
            Self::new(ruled.knots_u().clone(), ruled.knots_v().over(a, b)?, ruled.poles().to_vec(), None)
        };
        let first = across(along_u, along_v[0])?;
        let second = across(along_v, along_u[0])?.swapped();
        let (u, v) = (along_u[0].knots().domain(), along_v[0].knots().domain());
        let line = |(a, b): (f64, f64)| KnotVector::clamped(1, &[a, b]);
        let plane = Self::new(line(u)?, line(v)?, corners, None)?;
        let [a, b, c] = same_knots([first, second, plane])?;
        let poles = (0..a.poles().len()).map(|i| a.poles()[i] + b.poles()[i] - c.poles()[i]).collect();
        Self::new(a.knots_u().clone(), a.knots_v().clone(), poles, None)
    }

    /// The same surface with its directions exchanged.
    pub fn swapped(&self) -> Self {
        let (n, m) = (self.knots_u().len(), self.knots_v().len());
        let order = |k: usize| (k % n) * m + k / n;
        let poles = (0..n * m).map(|k| self.poles()[order(k)]).collect();
        let weights = self.weights().map(|w| (0..n * m).map(|k| w[order(k)]).collect());
        Self::new(self.knots_v().clone(), self.knots_u().clone(), poles, weights)
            .expect("the same values in another order")
    }
}

/// Where the curves meet: (0, 0), (0, 1), (1, 0), (1, 1).
fn corners(along_u: [&NurbsCurve<DVec3>; 2], along_v: [&NurbsCurve<DVec3>; 2]) -> Result<Vec<DVec3>> {
    let end = |curve: &NurbsCurve<DVec3>, last: usize| {
        let (a, b) = curve.knots().domain();
        curve.point([a, b][last])
    };
    let corner = |(i, j): (usize, usize)| {
        let (a, b) = (end(along_u[j], i), end(along_v[i], j));
        let apart = a.distance(b);
        if apart <= CONFUSION_MM {
            return Ok(0.5 * (a + b));
        }
        let why = format!("the curves are {apart:e} mm apart at corner ({i}, {j}): {a} and {b}");
        Err(Error::Spline { why })
    };
    [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().map(corner).collect()
}

/// Surfaces over one domain with the same degrees and knots.
fn same_knots(mut surfaces: [NurbsSurface; 3]) -> Result<[NurbsSurface; 3]> {
    for direction in [Direction::U, Direction::V] {
        let degree = surfaces.iter().map(|s| s.knots(direction).degree()).max().unwrap_or(1);
        for s in &mut surfaces {
            *s = s.elevated(direction, degree - s.knots(direction).degree())?;
        }
        // Twice around, so that the first has seen them all before the others take from it.
        for (i, j) in [(0, 1), (0, 2), (1, 0), (2, 0)] {
            let missing = surfaces[i].knots(direction).missing(surfaces[j].knots(direction));
            surfaces[i] = surfaces[i].refined(direction, &missing)?;
        }
    }
    Ok(surfaces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn curve(degree: usize, breaks: &[f64], at: impl Fn(f64) -> DVec3) -> NurbsCurve<DVec3> {
        let knots = KnotVector::clamped(degree, breaks).unwrap();
        let poles = knots.greville().iter().map(|&t| at(t)).collect();
        NurbsCurve::new(knots, poles, None).unwrap()
    }

    #[test]
    fn ruled_lines_lead_from_curve_to_curve() {
        let a = curve(2, &[0.0, 0.4, 1.0], |t| DVec3::new(t, t * t, 0.0));
        let b = NurbsCurve::arc(DVec3::Z, DVec3::X, DVec3::Y, 0.0, 2.0).unwrap();
        let s = NurbsSurface::ruled(&a, &b).unwrap();
        for i in 0..=20 {
            let t = i as f64 / 20.0;
            assert!(s.point(t, 0.0).distance(a.point(t)) < 1e-14);
            assert!(s.point(t, 1.0).distance(b.point(t)) < 1e-14);
            let (p, q, r) = (s.point(t, 0.0), s.point(t, 0.3), s.point(t, 1.0));
            assert!((q - p).cross(r - p).length() < 1e-14, "not straight at {t}");
        }
    }

    #[test]
    fn a_turned_arc_is_a_sphere() {
        let meridian = NurbsCurve::arc(DVec3::ZERO, DVec3::Z * -2.0, DVec3::X * 2.0, 0.0, PI).unwrap();
        let s = NurbsSurface::revolved(&meridian, DVec3::Z * 7.0, DVec3::Z, TAU).unwrap();
        for i in 0..=400 {
            let (u, v) = ((i % 21) as f64 / 20.0, i as f64 / 400.0);
            let p = s.point(u, v);
            assert!((p.length() - 2.0).abs() < 2e-15, "{} at ({u}, {v})", p.length());
            let k = s.principal_curvatures(0.02 + 0.95 * u, v).unwrap();
            for c in k.curvatures {
                assert!((c.abs() - 0.5).abs() < 1e-9, "{c} at ({u}, {v})");
            }
        }
        let quarter = NurbsSurface::revolved(&meridian, DVec3::ZERO, DVec3::Z, 0.5 * PI).unwrap();
        assert!(quarter.point(0.5, 1.0).distance(DVec3::Y * 2.0) < 1e-15);
        assert!(NurbsSurface::revolved(&meridian, DVec3::ZERO, DVec3::ZERO, 1.0).is_err());
    }

    #[test]
    fn a_coons_patch_has_its_four_borders() {
        let bump = |t: f64| t * (1.0 - t);
        let c0 = curve(3, &[0.0, 0.3, 1.0], |t| DVec3::new(t, 0.0, bump(t)));
        let c1 = curve(2, &[0.0, 2.0], |t| DVec3::new(0.5 * t, 1.0, -bump(0.5 * t)));
        let d0 = curve(2, &[1.0, 1.6, 2.0], |t| DVec3::new(0.0, t - 1.0, 2.0 * bump(t - 1.0)));
        let d1 = curve(4, &[1.0, 2.0], |t| DVec3::new(1.0, t - 1.0, bump(t - 1.0).powi(2)));
        let s = NurbsSurface::coons([&c0, &c1], [&d0, &d1]).unwrap();
        for i in 0..=50 {
            let t = i as f64 / 50.0;
            let pairs = [
                (s.point(t, 1.0), c0.point(t)),
                (s.point(t, 2.0), c1.point(2.0 * t)),
                (s.point(0.0, 1.0 + t), d0.point(1.0 + t)),
                (s.point(1.0, 1.0 + t), d1.point(1.0 + t)),
            ];
            for (k, (a, b)) in pairs.into_iter().enumerate() {
                assert!(a.distance(b) < 1e-14, "border {k} at {t}: {a} {b}");
            }
        }
        let lifted = d1.mapped(|p| p + DVec3::Z).unwrap();
        let message = NurbsSurface::coons([&c0, &c1], [&d0, &lifted]).unwrap_err().to_string();
        assert!(message.contains("corner (1, 0)"), "{message}");
    }
}
