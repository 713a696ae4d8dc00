//! The foot of a point on a surface, from a start nearby (The NURBS Book, section 6.1).

use crate::nurbs::{NurbsSurface, SurfaceDerivatives};
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

/// Steps end when they are shorter than this fraction of the coordinates.
const STEP: f64 = 1e-14;

/// A full Newton step below this fraction of the parameters leaves nothing to do: the error is
/// squared.
const NEWTON: f64 = 1e-8;

/// Steps at most.
const STEPS: usize = 30;

/// Halvings of one step at most.
const HALVINGS: usize = 20;

/// The local nearest point of `surface` to `p`, by damped Newton steps from `start`, kept within
/// the knot domain. Finds a local minimum only: the caller starts from every place of interest.
pub fn foot(surface: &NurbsSurface, p: DVec3, start: DVec2) -> Foot {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let corners = [DVec2::new(u0, v0), DVec2::new(u1, v1)];
    let Local { at, point, .. } = descend(surface, p, start, corners);
    Foot { uv: at, point, distance: (point - p).length() }
}

/// Something with a point and derivatives at each pair of parameters.
pub(crate) trait Jet {
    fn jet(&self, at: DVec2) -> SurfaceDerivatives;
}

impl Jet for NurbsSurface {
    #[inline(always)]
    fn jet(&self, at: DVec2) -> SurfaceDerivatives {
        self.derivatives(at.x, at.y)
    }
}

/// Where the steps have led.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Local {
    pub at: DVec2,
    pub point: DVec3,
    /// How fast the distance squared, halved, grows inwards from bounds that hold the foot.
    pub push: DVec2,
    /// Whether the steps came to rest.
    pub settled: bool,
}

/// As [`foot`], for anything with derivatives over a rectangle of parameters.
#[inline(always)]
pub(crate) fn descend(shape: &impl Jet, p: DVec3, start: DVec2, [low, high]: [DVec2; 2]) -> Local {
    let mut at = start.clamp(low, high);
    let mut d = shape.jet(at);
    let mut push = DVec2::ZERO;
    for _ in 0..STEPS {
        let r = d.s - p;
        let gradient = DVec2::new(d.u.dot(r), d.v.dot(r));
        // A coordinate at its bound with the descent pointing out is frozen.
        let frozen = |x: f64, a: f64, b: f64, g: f64| (x <= a && g > 0.0) || (x >= b && g < 0.0);
        let stuck = [frozen(at.x, low.x, high.x, gradient.x), frozen(at.y, low.y, high.y, gradient.y)];
        push = DVec2::from(stuck.map(|s| f64::from(u8::from(s)))) * gradient.abs();
        if stuck == [true; 2] {
            return Local { at, point: d.s, push, settled: true };
        }
        let (mut step, mut newton) = newton_step(&d, r, gradient, stuck);
        // A step against its bound although the descent points away from it: along the other.
        let blocked = |x: f64, a: f64, b: f64, s: f64| (x <= a && s < 0.0) || (x >= b && s > 0.0);
        let against = [blocked(at.x, low.x, high.x, step.x), blocked(at.y, low.y, high.y, step.y)];
        if against != [false; 2] {
            (step, newton) = (newton_step(&d, r, gradient, against).0, false);
        }
        let mut next = within(at, step, low, high);
        let moved = next - at;
        if newton && (step.abs() / (high - low)).max_element() < NEWTON {
            let point = d.s
                + d.u * moved.x
                + d.v * moved.y
                + 0.5 * (d.uu * moved.x * moved.x + d.vv * moved.y * moved.y)
                + d.uv * moved.x * moved.y;
            return Local { at: next, point, push, settled: true };
        }
        let noise = STEP * (p.abs().max_element() + d.s.abs().max_element());
        // What rounding of the coordinates may add to the distance squared.
        let slack = 1e-14 * r.length_squared() + 0.1 * noise * r.length() + 0.01 * noise * noise;
        let mut e = shape.jet(next);
        let mut halvings = 0;
        while (e.s - p).length_squared() > r.length_squared() + slack && halvings < HALVINGS {
            next = 0.5 * (at + next);
            e = shape.jet(next);
            halvings += 1;
        }
        let moved = (d.u * (next.x - at.x)).length() + (d.v * (next.y - at.y)).length();
        (at, d) = (next, e);
        if moved <= noise {
            return Local { at, point: d.s, push, settled: true };
        }
    }
    Local { at, point: d.s, push, settled: false }
}

/// The end of a step, or where it meets the bounds: cut off coordinate by coordinate it might lead
/// uphill.
#[inline(always)]
fn within(at: DVec2, step: DVec2, low: DVec2, high: DVec2) -> DVec2 {
    let part = |x: f64, a: f64, b: f64, s: f64| {
        if x + s > b {
            (b - x) / s
        } else if x + s < a {
            (a - x) / s
        } else {
            1.0
        }
    };
    let (x, y) = (part(at.x, low.x, high.x, step.x), part(at.y, low.y, high.y, step.y));
    let end = (at + step * x.min(y)).clamp(low, high);
    // Rounding must not keep it off the bound.
    let snap = |e: f64, part: f64, least: f64, a: f64, b: f64, s: f64| {
        if part < 1.0 && part == least { if s > 0.0 { b } else { a } } else { e }
    };
    let least = x.min(y);
    DVec2::new(snap(end.x, x, least, low.x, high.x, step.x), snap(end.y, y, least, low.y, high.y, step.y))
}

/// The Newton step, or the Gauss-Newton step where the Hessian is not positive definite, and
/// whether it is the former.
#[inline(always)]
fn newton_step(d: &SurfaceDerivatives, r: DVec3, gradient: DVec2, stuck: [bool; 2]) -> (DVec2, bool) {
    let (guu, guv, gvv) = (d.u.dot(d.u), d.u.dot(d.v), d.v.dot(d.v));
    let floor = f64::MIN_POSITIVE;
    if stuck[0] || stuck[1] {
        let along = |g: f64, gg: f64, second: f64| {
            let h = gg + second;
            if h > 0.1 * gg { (-g / h.max(floor), true) } else { (-g / gg.max(floor), false) }
        };
        let ((x, in_u), (y, in_v)) =
            (along(gradient.x, guu, r.dot(d.uu)), along(gradient.y, gvv, r.dot(d.vv)));
        return if stuck[0] { (DVec2::new(0.0, y), in_v) } else { (DVec2::new(x, 0.0), in_u) };
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
    (solve(guu, guv, gvv).unwrap_or_else(|| steepest(d, gradient, stuck)), false)
}

/// Half the Gauss-Newton step of each coordinate by itself.
fn steepest(d: &SurfaceDerivatives, gradient: DVec2, stuck: [bool; 2]) -> DVec2 {
    let along = |g: f64, of: DVec3, stuck: bool| {
        if stuck { 0.0 } else { -0.5 * g / of.length_squared().max(f64::MIN_POSITIVE) }
    };
    DVec2::new(along(gradient.x, d.u, stuck[0]), along(gradient.y, d.v, stuck[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ops::approximate::{Breaks, Finest, surface};

    fn bowl() -> NurbsSurface {
        let f = |u: f64, v: f64| Ok(DVec3::new(u, v, 0.1 * u * u - 0.05 * v * v * v));
        surface(
            f,
            Breaks::simple(3, &[-2.0, 0.0, 2.0]),
            Breaks::simple(3, &[-2.0, 2.0]),
            1e-12,
            Finest::spans(50),
        )
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
