//! Exact arcs of circles and ellipses, and conic segments (*The NURBS Book*, chapter 7).

use super::basis::KnotVector;
use super::curve::{NurbsCurve, Point};
use crate::error::{Error, Result};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The quadratic arcs of one unit circle from one angle to another: breaks of the parameter on
/// [0, 1], poles as (cos, sin) coordinates, weights.
fn unit_arc(from: f64, to: f64) -> Result<(Vec<f64>, Vec<[f64; 2]>, Vec<f64>)> {
    let sweep = to - from;
    // A full turn may be a rounding error too long.
    if !(sweep.is_finite() && sweep != 0.0 && sweep.abs() <= TAU * (1.0 + 1e-15)) {
        let why = format!("an arc from {from} to {to} rad must sweep more than 0 and at most a full turn");
        return Err(Error::Argument { name: "angles", why });
    }
    let pieces = (sweep.abs() / FRAC_PI_2 - 1e-12).ceil().max(1.0) as usize;
    let half = 0.5 * sweep / pieces as f64;
    let breaks = (0..=pieces).map(|i| i as f64 / pieces as f64).collect();
    let mut poles = vec![[from.cos(), from.sin()]];
    let mut weights = vec![1.0];
    for i in 0..pieces {
        let middle = from + half * (2 * i + 1) as f64;
        let end = if i + 1 == pieces { to } else { middle + half };
        poles.push([middle.cos() / half.cos(), middle.sin() / half.cos()]);
        poles.push([end.cos(), end.sin()]);
        weights.extend([half.cos(), 1.0]);
    }
    Ok((breaks, poles, weights))
}

/// Knots, poles and weights of the arcs of one unit circle, for curves and surfaces of revolution.
pub(super) fn unit_arc_net(from: f64, to: f64) -> Result<(KnotVector, Vec<[f64; 2]>, Vec<f64>)> {
    let (breaks, poles, weights) = unit_arc(from, to)?;
    let mut multiplicities = vec![2; breaks.len()];
    (multiplicities[0], multiplicities[breaks.len() - 1]) = (3, 3);
    Ok((KnotVector::with_multiplicities(2, &breaks, &multiplicities)?, poles, weights))
}

impl<P: Point> NurbsCurve<P> {
    /// The arc `centre + x cos a + y sin a` for angles `a` (rad) from one to another, over [0, 1]:
    /// a circle where `x` and `y` are perpendicular and as long as the radius, otherwise an ellipse
    /// with these conjugate semi-diameters. `to` less than `from` runs clockwise.
    ///
    /// # Errors
    /// [`Error::Argument`] for an empty sweep or more than a turn.
    pub fn arc(centre: P, x: P, y: P, from: f64, to: f64) -> Result<Self> {
        let (knots, poles, weights) = unit_arc_net(from, to)?;
        let poles = poles.iter().map(|[c, s]| centre + x * *c + y * *s).collect();
        Self::new(knots, poles, Some(weights))
    }

    /// The conic segment from `start` to `end`, tangent there to the lines through `corner`, over
    /// [0, 1]: an arc of an ellipse for a weight below one, a parabola at one, a hyperbola above.
    ///
    /// # Errors
    /// [`Error::Spline`] for a weight that is not positive.
    pub fn conic(start: P, corner: P, end: P, weight: f64) -> Result<Self> {
        let weights = (weight != 1.0).then(|| vec![1.0, weight, 1.0]);
        Self::new(KnotVector::clamped(2, &[0.0, 1.0])?, vec![start, corner, end], weights)
    }

    /// The conic segment that also passes through `point` (A7.2).
    ///
    /// # Errors
    /// [`Error::Argument`] when `point` is not inside the triangle of the others.
    pub fn conic_through(start: P, corner: P, end: P, point: P) -> Result<Self> {
        let (a, b, d) = (start - corner, end - corner, point - corner);
        let (aa, ab, bb, ad, bd) = (a.dot(a), a.dot(b), b.dot(b), a.dot(d), b.dot(d));
        let det = aa * bb - ab * ab;
        let (first, last) = ((ad * bb - bd * ab) / det, (bd * aa - ad * ab) / det);
        let middle = 1.0 - first - last;
        let off = (d - a * first - b * last).length();
        if !(first > 0.0 && last > 0.0 && middle > 0.0 && off <= 1e-9 * (a.length() + b.length())) {
            let why = format!(
                "{point:?} must lie inside the triangle of the ends and the corner; its shares of them are \
                 {first}, {middle}, {last}, and it is {off:e} off their plane"
            );
            return Err(Error::Argument { name: "point", why });
        }
        Self::conic(start, corner, end, middle / (2.0 * (first * last).sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

    #[test]
    fn arcs_are_round() {
        let centre = DVec3::new(3.0, -2.0, 1.0);
        let (x, y) = (DVec3::new(0.0, 2.5, 0.0), DVec3::new(0.0, 0.0, 2.5));
        for (from, to) in [(0.0, TAU), (0.3, 1.2), (1.0, -2.5), (-3.0, 3.0), (0.0, FRAC_PI_2)] {
            let arc = NurbsCurve::arc(centre, x, y, from, to).unwrap();
            for i in 0..=100 {
                let p = arc.point(i as f64 / 100.0);
                assert!((p.distance(centre) - 2.5).abs() < 2e-15, "{from} to {to}: {}", p.distance(centre));
            }
            let end = centre + x * to.cos() + y * to.sin();
            assert!(arc.point(1.0).distance(end) < 1e-15);
            let sense = (arc.point(0.01) - arc.point(0.0)).dot(y * from.cos() - x * from.sin());
            assert_eq!(sense > 0.0, to > from, "{from} to {to}");
        }
        for sweep in [0.0, 7.0, f64::NAN] {
            assert!(NurbsCurve::arc(centre, x, y, 0.0, sweep).is_err(), "{sweep}");
        }
    }

    #[test]
    fn the_full_circle_has_the_nine_poles_of_example_7_2() {
        let circle = NurbsCurve::arc(DVec2::ZERO, DVec2::X, DVec2::Y, 0.0, TAU).unwrap();
        assert_eq!(circle.knots().flat(), [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0]);
        let square = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
        for (p, (x, y)) in circle.poles().iter().zip(square) {
            assert!((*p - DVec2::new(x as f64, y as f64)).length() < 1e-15, "{p}");
        }
    }

    #[test]
    fn conics_pass_through_their_point() {
        let (a, b, c) = (DVec2::new(0.0, 0.0), DVec2::new(1.0, 3.0), DVec2::new(4.0, 0.0));
        for point in [DVec2::new(1.2, 0.4), DVec2::new(1.0, 2.5), DVec2::new(2.5, 1.0)] {
            let conic = NurbsCurve::conic_through(a, b, c, point).unwrap();
            let near = (0..=100_000).map(|i| conic.point(i as f64 * 1e-5).distance(point));
            assert!(near.fold(f64::MAX, f64::min) < 1e-4, "{point}");
        }
        assert!(NurbsCurve::conic_through(a, b, c, DVec2::new(2.0, -0.1)).is_err());
        let parabola = NurbsCurve::conic(a, b, c, 1.0).unwrap();
        assert!(parabola.weights().is_none() && parabola.derivatives_to(0.5, 3)[3] == DVec2::ZERO);
    }
}
