//! Surfaces from curves: ruled, of revolution, Coons (*The NURBS Book*, sections 8.4, 8.5 and 10.6).

use super::basis::KnotVector;
use super::conic::UnitArc;
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
        let unit = UnitArc::new(0.0, angle)?;
        let turned = |&p: &DVec3| {
            let foot = origin + axis * (p - origin).dot(axis);
            let (x, y) = (p - foot, axis.cross(p - foot));
            unit.poles.iter().map(move |[c, s]| foot + x * *c + y * *s)
        };
        let poles = curve.poles().iter().flat_map(turned).collect();
        let rational = curve.rational();
        let weights = rational.weights().unwrap_or_default().iter();
        let weights = weights.flat_map(|w| unit.weights.iter().map(move |f| w * f)).collect();
        Self::new(curve.knots().clone(), unit.knots, poles, Some(weights))
    }

    /// The bilinearly blended Coons patch between two curves along `u` (at the start and the end of
    /// `v`) and two along `v` (at the start and the end of `u`). Domains are those of the first of
    /// each pair. Where one is rational, all are blended with their weights, those of the corners
    /// made one: the borders keep their shapes and parameters.
    ///
    /// # Errors
    /// [`Error::Spline`] when the curves do not meet in four corners, and for rational ones whose
    /// weights fall so far below those of their ends that the blend has none above zero.
    pub fn coons(along_u: [&NurbsCurve<DVec3>; 2], along_v: [&NurbsCurve<DVec3>; 2]) -> Result<Self> {
        let corners = corners(along_u, along_v)?;
        let is_rational = along_u.iter().chain(&along_v).any(|c| c.weights().is_some());
        let of = |curve: &NurbsCurve<DVec3>| {
            if is_rational { curve.with_ends_of_weight_one() } else { Ok(curve.clone()) }
        };
        let across = |pair: [&NurbsCurve<DVec3>; 2], other: &NurbsCurve<DVec3>| {
            let (a, b) = other.knots().domain();
            let ruled = Self::ruled(&of(pair[0])?, &of(pair[1])?)?;
            let weights = ruled.weights().map(<[f64]>::to_vec);
            Self::new(ruled.knots_u().clone(), ruled.knots_v().over(a, b)?, ruled.poles().to_vec(), weights)
        };
        let first = across(along_u, along_v[0])?;
        let second = across(along_v, along_u[0])?.swapped();
        let (u, v) = (along_u[0].knots().domain(), along_v[0].knots().domain());
        let line = |(a, b): (f64, f64)| KnotVector::clamped(1, &[a, b]);
        let plane = Self::new(line(u)?, line(v)?, corners, is_rational.then(|| vec![1.0; 4]))?;
        let [a, b, c] = same_knots([first, second, plane])?;
        boolean_sum(&a, &b, &c)
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

/// `a + b - c` in homogeneous coordinates, for surfaces over the same knots.
fn boolean_sum(a: &NurbsSurface, b: &NurbsSurface, c: &NurbsSurface) -> Result<NurbsSurface> {
    let weight = |s: &NurbsSurface, i: usize| s.weights().map_or(1.0, |w| w[i]);
    let pole = |i: usize| {
        let total = weight(a, i) + weight(b, i) - weight(c, i);
        let [p, q, r] = [a, b, c].map(|s| s.poles()[i] * weight(s, i));
        ((p + q - r) / total, total)
    };
    let (poles, weights): (Vec<_>, Vec<_>) = (0..a.poles().len()).map(pole).unzip();
    if let Some(w) = weights.iter().find(|w| **w <= 1e-6) {
        let why = format!(
            "the weights of the borders fall so far below those of the corners that {w} is left within: \
             split the borders, or approximate them by polynomial curves"
        );
        return Err(Error::Spline { why });
    }
    let weights = a.weights().is_some().then_some(weights);
    NurbsSurface::new(a.knots_u().clone(), a.knots_v().clone(), poles, weights)
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

    /// Whether the borders at the start and end of v, then of u, are these curves.
    fn check_borders(s: &NurbsSurface, curves: &[NurbsCurve<DVec3>; 4]) {
        let ((u0, u1), (v0, v1)) = (s.knots_u().domain(), s.knots_v().domain());
        for i in 0..=50 {
            let t = i as f64 / 50.0;
            let (u, v) = (u0 + (u1 - u0) * t, v0 + (v1 - v0) * t);
            let places = [(u, v0), (u, v1), (u0, v), (u1, v)];
            for (k, (u, v)) in places.into_iter().enumerate() {
                let (a, b) = curves[k].knots().domain();
                let (is, expected) = (s.point(u, v), curves[k].point(a + (b - a) * t));
                assert!(is.distance(expected) < 1e-14, "border {k} at {t}: {is} {expected}");
            }
        }
    }

    #[test]
    fn a_coons_patch_between_arcs_has_round_borders() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let arc = |from: usize, to: usize, up: f64| {
            let (a, b) = (corners[from], corners[to]);
            NurbsCurve::conic(a, 0.5 * (a + b) + DVec3::Z * up, b, 0.8).unwrap()
        };
        let all = [arc(0, 1, 0.3), arc(2, 3, -0.2), arc(0, 2, 0.5), arc(1, 3, 0.4)];
        check_borders(&NurbsSurface::coons([&all[0], &all[1]], [&all[2], &all[3]]).unwrap(), &all);
        let sharp = |from: usize, to: usize| {
            let (a, b) = (corners[from], corners[to]);
            NurbsCurve::conic(a, 0.5 * (a + b) + DVec3::Z, b, 0.4).unwrap()
        };
        let all = [sharp(0, 1), sharp(2, 3), sharp(0, 2), sharp(1, 3)];
        let message = NurbsSurface::coons([&all[0], &all[1]], [&all[2], &all[3]]).unwrap_err().to_string();
        assert!(message.contains("split the borders"), "{message}");
    }

    #[test]
    fn a_coons_patch_has_its_four_borders() {
        let bump = |t: f64| t * (1.0 - t);
        let c0 = curve(3, &[0.0, 0.3, 1.0], |t| DVec3::new(t, 0.0, bump(t)));
        let c1 = curve(2, &[0.0, 2.0], |t| DVec3::new(0.5 * t, 1.0, -bump(0.5 * t)));
        let d0 = curve(2, &[1.0, 1.6, 2.0], |t| DVec3::new(0.0, t - 1.0, 2.0 * bump(t - 1.0)));
        let d1 = curve(4, &[1.0, 2.0], |t| DVec3::new(1.0, t - 1.0, bump(t - 1.0).powi(2)));
        let all = [c0.clone(), c1.clone(), d0.clone(), d1.clone()];
        check_borders(&NurbsSurface::coons([&c0, &c1], [&d0, &d1]).unwrap(), &all);
        // The same with uneven weights, which the shapes of the borders then follow.
        let heavy = |c: &NurbsCurve<DVec3>| {
            let weights = (0..c.poles().len()).map(|k| 1.0 + 0.4 * (2.0 * k as f64).cos()).collect();
            NurbsCurve::new(c.knots().clone(), c.poles().to_vec(), Some(weights)).unwrap()
        };
        let all = [heavy(&c0), c1.clone(), heavy(&d0), heavy(&d1)];
        check_borders(&NurbsSurface::coons([&all[0], &all[1]], [&all[2], &all[3]]).unwrap(), &all);
        let lifted = d1.mapped(|p| p + DVec3::Z).unwrap();
        let message = NurbsSurface::coons([&c0, &c1], [&d0, &lifted]).unwrap_err().to_string();
        assert!(message.contains("corner (1, 0)"), "{message}");
    }
}
