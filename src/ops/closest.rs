//! The foot of a point on a surface, from a start nearby (The NURBS Book, section 6.1).

use crate::nurbs::NurbsSurface;
use glam::{DVec2, DVec3};

/// A foot point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// Parameters (u, v).
    pub uv: DVec2,
    /// The point on the surface.
    pub point: DVec3,
    /// Distance to the surface point.
    pub distance: f64,
}

/// Steps end when they move the foot by less than this, in mm.
const STEP_MM: f64 = 1e-11;

/// A full Newton step shorter than this, in mm, leaves less than [`STEP_MM`]: the error is squared.
const NEWTON_MM: f64 = 1e-7;

/// Steps at most.
const STEPS: usize = 30;

/// The local nearest point of `surface` to `p`, by damped Newton steps from `start`, kept within
/// the knot domain. Finds a local minimum only: the caller starts from every place of interest.
pub fn foot(surface: &NurbsSurface, p: DVec3, start: DVec2) -> Foot {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    foot_within(surface, p, start, [DVec2::new(u0, v0), DVec2::new(u1, v1)])
}

/// As [`foot`], kept within the rectangle of parameters from `low` to `high`.
pub fn foot_within(surface: &NurbsSurface, p: DVec3, start: DVec2, [low, high]: [DVec2; 2]) -> Foot {
    let mut uv = start.clamp(low, high);
    let mut d = surface.derivatives(uv.x, uv.y);
    for _ in 0..STEPS {
        let r = d.s - p;
        let gradient = DVec2::new(d.u.dot(r), d.v.dot(r));
        // A coordinate at its bound with the descent pointing out is frozen.
        let frozen = |x: f64, a: f64, b: f64, g: f64| (x <= a && g > 0.0) || (x >= b && g < 0.0);
        let stuck = [frozen(uv.x, low.x, high.x, gradient.x), frozen(uv.y, low.y, high.y, gradient.y)];
        let (step, newton) = newton_step(&d, r, gradient, stuck);
        let mut next = (uv + step).clamp(low, high);
        let mut e = surface.derivatives(next.x, next.y);
        let mut halvings = 0;
        while (e.s - p).length_squared() > r.length_squared() * (1.0 + 1e-14) + 1e-24 && halvings < 20 {
            next = 0.5 * (uv + next);
            e = surface.derivatives(next.x, next.y);
            halvings += 1;
        }
        let moved = (d.u * (next.x - uv.x)).length() + (d.v * (next.y - uv.y)).length();
        uv = next;
        d = e;
        if moved < STEP_MM || (moved < NEWTON_MM && newton && halvings == 0) {
            break;
        }
    }
    Foot { uv, point: d.s, distance: (d.s - p).length() }
}

/// The Newton step, or the Gauss-Newton step where the Hessian is not positive definite, and
/// whether it is the former.
fn newton_step(
    d: &crate::nurbs::SurfaceDerivatives,
    r: DVec3,
    gradient: DVec2,
    stuck: [bool; 2],
) -> (DVec2, bool) {
    let (guu, guv, gvv) = (d.u.dot(d.u), d.u.dot(d.v), d.v.dot(d.v));
    let floor = 1e-300;
    if stuck[0] || stuck[1] {
        let along = |g: f64, gg: f64, second: f64| {
            let h = if gg + second > 0.1 * gg { gg + second } else { gg };
            -g / h.max(floor)
        };
        let step = DVec2::new(
            if stuck[0] { 0.0 } else { along(gradient.x, guu, r.dot(d.uu)) },
            if stuck[1] { 0.0 } else { along(gradient.y, gvv, r.dot(d.vv)) },
        );
        return (step, false);
    }
    let solve = |a: f64, b: f64, c: f64| {
        let det = a * c - b * b;
        (det > 1e-12 * guu * gvv && a > 0.0).then(|| {
            DVec2::new(-(c * gradient.x - b * gradient.y) / det, -(a * gradient.y - b * gradient.x) / det)
        })
    };
    if let Some(step) = solve(guu + r.dot(d.uu), guv + r.dot(d.uv), gvv + r.dot(d.vv)) {
        return (step, true);
    }
    let steepest = || DVec2::new(-gradient.x / guu.max(floor), -gradient.y / gvv.max(floor)) * 0.5;
    (solve(guu, guv, gvv).unwrap_or_else(steepest), false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ops::approximate::{Breaks, surface};

    fn bowl() -> NurbsSurface {
        let f = |u: f64, v: f64| DVec3::new(u, v, 0.1 * u * u - 0.05 * v * v * v);
        surface(f, Breaks::simple(3, &[-2.0, 0.0, 2.0]), Breaks::simple(3, &[-2.0, 2.0]), 1e-12, 50)
            .unwrap()
            .0
    }

    #[test]
    fn foot_of_a_lifted_point_is_the_point() {
        let s = bowl();
        for i in 0..20 {
            for j in 0..20 {
                let (u, v) = (-1.9 + 0.2 * i as f64, -1.9 + 0.2 * j as f64);
                let d = s.derivatives(u, v);
                let p = d.s + d.normal().normalize() * 0.3;
                let f = foot(&s, p, DVec2::new(u + 0.15, v - 0.15));
                assert!((f.uv - DVec2::new(u, v)).length() < 1e-9, "{} instead of ({u}, {v})", f.uv);
                assert!((f.distance - 0.3).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn foot_outside_the_domain_lies_on_the_border() {
        let s = bowl();
        let f = foot(&s, DVec3::new(5.0, 0.4, 0.2), DVec2::new(0.0, 0.0));
        assert_eq!(f.uv.x, 2.0);
        let best = (0..=4000)
            .map(|i| -2.0 + i as f64 * 1e-3)
            .map(|v| (s.point(2.0, v) - DVec3::new(5.0, 0.4, 0.2)).length());
        let best = best.fold(f64::MAX, f64::min);
        assert!(f.distance <= best + 1e-9, "{} but {best} is possible", f.distance);
    }
}
