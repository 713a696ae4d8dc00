//! Curves projected onto surfaces: to the nearest points, or along a direction.

use super::approximate::{self, Breaks};
use super::closest;
use super::invert::SurfaceInverter;
use super::section;
use crate::error::{Error, Result};
use crate::nurbs::{NurbsCurve, NurbsSurface};
use glam::{DVec2, DVec3};

/// Places in each span of a curve from which its feet are followed.
const PLACES: usize = 32;
/// Halvings that find the end of a part.
const HALVINGS: u32 = 50;
/// Fraction of the tolerance to which the end of a part is found.
const EXACT: f64 = 1e-3;
/// Spans of a projected curve at most.
const SPANS: usize = 2000;
/// Degree of a projected curve.
const DEGREE: usize = 5;
/// Breaks nearer to each other than this fraction of a part are one.
const SAME: f64 = 1e-10;
/// Fraction of the tolerance by which a foot may miss the perpendicular.
const UPRIGHT: f64 = 0.1;
/// A foot that moves by more than this many times the way of its point has leapt.
const LEAP: f64 = 20.0;

/// A part of a curve on a surface.
#[derive(Debug, Clone)]
pub struct Projection {
    /// The projected curve.
    pub curve: NurbsCurve<DVec3>,
    /// Its parameters on the surface, over the same parameter.
    pub parameters: NurbsCurve<DVec2>,
    /// The largest distance seen of the curve and of the points at its parameters from the true
    /// projection, in mm.
    pub deviation_mm: f64,
}

/// The points of the surface nearest to those of the curve, to a tolerance in mm: one part for each
/// stretch over which the nearest point is the foot of a perpendicular and moves without leap, over
/// the parameter of the curve. Stretches shorter than a thirtieth of a span may be missed.
///
/// # Errors
/// [`Error::Argument`] for a tolerance that is not positive; [`Error::Numerics`] when it is not met.
pub fn to_nearest(
    curve: &NurbsCurve<DVec3>,
    surface: &NurbsSurface,
    tolerance: f64,
) -> Result<Vec<Projection>> {
    if tolerance.is_nan() || tolerance <= 0.0 {
        let why = format!("a positive length in mm was expected, not {tolerance}");
        return Err(Error::Argument { name: "tolerance", why });
    }
    let feet = Feet { curve: curve.clamped()?, inverter: SurfaceInverter::new(surface)?, tolerance };
    feet.parts().iter().map(|part| feet.fitted(part)).collect()
}

/// The points of the surface on lines along `direction` through points of the curve, all of them,
/// to a tolerance in mm; each part over its length.
///
/// # Errors
/// As [`section::with_surface`]; [`Error::Argument`] for no direction or one along which the
/// curve runs, so that its lines do not make a surface.
pub fn along(
    curve: &NurbsCurve<DVec3>,
    surface: &NurbsSurface,
    direction: DVec3,
    tolerance: f64,
) -> Result<Vec<Projection>> {
    let fail = |why: String| Err(Error::Argument { name: "direction", why });
    let Some(direction) = direction.try_normalize() else {
        return fail(format!("a direction was expected, not {direction}"));
    };
    let (a, b) = curve.knots().domain();
    let tangent = |k: usize| curve.derivatives(a + (b - a) * k as f64 / 64.0)[1].normalize_or_zero();
    if (0..=64).all(|k| tangent(k).cross(direction).length() < 1e-9) {
        return fail("the curve is a line along it: its projection is a point".into());
    }
    let extent = |points: &[DVec3]| {
        let along = points.iter().map(|p| p.dot(direction));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
    };
    let ((low, high), (from, to)) = (extent(surface.poles()), extent(curve.poles()));
    let margin = 0.01 * (high - low).max(to - from).max(tolerance);
    let moved = |by: f64| curve.mapped(|p| p + direction * by);
    let lines = NurbsSurface::ruled(&moved(low - to - margin)?, &moved(high - from + margin)?)?;
    let found = section::with_surface(surface, &lines, tolerance)?;
    if let Some(uv) = found.uncertain.first() {
        let why = format!("the lines touch the surface too closely to decide at (u, v) = {uv}");
        return Err(Error::Numerics { why });
    }
    let part = |branch: section::Branch| {
        let [parameters, _] = branch.parameters;
        Projection { curve: branch.curve, parameters, deviation_mm: branch.deviation_mm }
    };
    Ok(found.branches.into_iter().map(part).collect())
}

/// A curve over a surface.
struct Feet {
    curve: NurbsCurve<DVec3>,
    inverter: SurfaceInverter,
    tolerance: f64,
}

/// Parameters of the curve with those of the feet, ascending.
type Part = Vec<(f64, DVec2)>;

impl Feet {
    /// The nearest point of the whole surface, if it is the foot of a perpendicular.
    fn foot(&self, t: f64) -> Option<DVec2> {
        let p = self.curve.point(t);
        // Between patches the nearest point is only as good as its distance: sharpen it.
        let surface = self.inverter.surface();
        let found = closest::foot(surface, p, self.inverter.nearest(p).at);
        let [s, u, v] = surface.first_derivatives(found.uv.x, found.uv.y);
        let way = p - s;
        // How far the foot is from where the perpendicular would stand.
        let upright = |d: DVec3| way.dot(d).abs() <= UPRIGHT * self.tolerance * d.length();
        (upright(u) && upright(v)).then_some(found.uv)
    }

    /// Whether the foot moves steadily between two parameters.
    fn is_steady(&self, a: (f64, DVec2), b: (f64, DVec2)) -> bool {
        let surface = self.inverter.surface();
        let (p, q) = (self.curve.point(a.0), self.curve.point(b.0));
        let reached = closest::foot(surface, q, a.1);
        let way = surface.point(a.1.x, a.1.y).distance(reached.point);
        let there = surface.point(b.1.x, b.1.y);
        way <= LEAP * p.distance(q) + self.tolerance && reached.point.distance(there) <= self.tolerance
    }

    fn parts(&self) -> Vec<Part> {
        let breaks = self.curve.knots().breaks();
        let at = |w: &[f64], k: usize| w[0] + (w[1] - w[0]) * k as f64 / PLACES as f64;
        let mut ts: Vec<f64> = breaks.windows(2).flat_map(|w| (0..PLACES).map(move |k| at(w, k))).collect();
        ts.extend(breaks.last());
        let mut parts: Vec<Part> = Vec::new();
        let mut before: Option<(f64, DVec2)> = None;
        let mut previous = ts[0];
        for &t in &ts {
            let here = self.foot(t).map(|uv| (t, uv));
            match (before, here) {
                (Some(a), Some(b)) if self.is_steady(a, b) => parts.last_mut().expect("begun before").push(b),
                (a, b) => {
                    if let Some(a) = a {
                        let end = self.end(a, t);
                        parts.last_mut().expect("begun before").push(end);
                    }
                    if let Some(b) = b {
                        parts.push(if t > ts[0] { vec![self.end(b, previous), b] } else { vec![b] });
                    }
                }
            }
            (before, previous) = (here, t);
        }
        parts.iter_mut().for_each(|part| part.dedup_by(|a, b| a.0 <= b.0));
        parts.retain(|part| part.len() > 1);
        parts
    }

    /// The last place towards `t` to which the foot at `from` moves steadily.
    fn end(&self, from: (f64, DVec2), t: f64) -> (f64, DVec2) {
        let (mut good, mut bad) = (from, t);
        for _ in 0..HALVINGS {
            if self.curve.point(good.0).distance(self.curve.point(bad)) <= EXACT * self.tolerance {
                break;
            }
            let middle = 0.5 * (good.0 + bad);
            match self.foot(middle).map(|uv| (middle, uv)) {
                Some(next) if self.is_steady(good, next) => good = next,
                _ => bad = middle,
            }
        }
        good
    }

    /// The foot at `t` from the nearest ones known.
    fn near(&self, part: &Part, t: f64) -> DVec2 {
        let after = part.partition_point(|p| p.0 < t).clamp(1, part.len() - 1);
        let (a, b) = (part[after - 1], part[after]);
        let guess = a.1.lerp(b.1, ((t - a.0) / (b.0 - a.0)).clamp(0.0, 1.0));
        closest::foot(self.inverter.surface(), self.curve.point(t), guess).uv
    }

    /// Where the feet cross knots of the surface, with the multiplicity of a break there: a foot is
    /// less smooth by one than the surface.
    fn crossings(&self, part: &Part) -> Vec<(f64, usize)> {
        let surface = self.inverter.surface();
        let mut found = Vec::new();
        for (direction, knots) in [surface.knots_u(), surface.knots_v()].into_iter().enumerate() {
            let breaks = knots.breaks_and_multiplicities();
            for &(knot, m) in &breaks[1..breaks.len() - 1] {
                let multiplicity = (DEGREE + 1 + m).saturating_sub(knots.degree()).min(DEGREE);
                let side = |uv: DVec2| uv[direction] - knot;
                for w in part.windows(2).filter(|w| side(w[0].1) * side(w[1].1) < 0.0 && multiplicity > 0) {
                    let (mut a, mut b) = (w[0].0, w[1].0);
                    for _ in 0..HALVINGS {
                        let middle = 0.5 * (a + b);
                        let same = side(self.near(part, middle)) * side(w[0].1) > 0.0;
                        if same { a = middle } else { b = middle }
                    }
                    found.push((0.5 * (a + b), multiplicity));
                }
            }
        }
        found
    }

    fn fitted(&self, part: &Part) -> Result<Projection> {
        let surface = self.inverter.surface();
        let (first, last) = (part[0].0, part[part.len() - 1].0);
        let knots = self.curve.knots();
        let inner = knots.breaks_and_multiplicities().into_iter().filter(|&(t, _)| t > first && t < last);
        let multiplicity = |m: usize| (DEGREE + m).saturating_sub(knots.degree()).clamp(1, DEGREE);
        let mut at = vec![(first, 1)];
        at.extend(inner.map(|(t, m)| (t, multiplicity(m))));
        at.extend(self.crossings(part));
        at.push((last, 1));
        let at = merged(at);
        // Parameters in mm, for one tolerance.
        let speeds = part.iter().map(|p| surface.first_derivatives(p.1.x, p.1.y));
        let scale = speeds
            .fold(DVec2::splat(f64::MIN_POSITIVE), |s, [_, u, v]| s.max(DVec2::new(u.length(), v.length())));
        let mut asked = 0.25 * self.tolerance;
        let mut deviation = f64::INFINITY;
        for _ in 0..4 {
            let breaks = || Breaks { degree: DEGREE, at: at.clone() };
            let (scaled, _) = approximate::curve(|t| self.near(part, t) * scale, breaks(), asked, SPANS)?;
            let parameters = scaled.mapped(|p| p / scale)?;
            let point = |t: f64| {
                let uv = self.near(part, t);
                surface.point(uv.x, uv.y)
            };
            let (curve, _) = approximate::curve(point, breaks(), asked, SPANS)?;
            deviation = self.deviation(part, &curve, &parameters);
            if deviation <= self.tolerance {
                return Ok(Projection { curve, parameters, deviation_mm: deviation });
            }
            asked *= (0.5 * self.tolerance / deviation).max(0.1);
        }
        let (tolerance, why) = (self.tolerance, "the projected curve stays");
        Err(Error::Numerics { why: format!("{why} {deviation:e} mm off, more than {tolerance:e}") })
    }

    /// The largest distance from the feet at seven places in each span of either curve.
    fn deviation(&self, part: &Part, curve: &NurbsCurve<DVec3>, parameters: &NurbsCurve<DVec2>) -> f64 {
        let surface = self.inverter.surface();
        let at = |w: &[f64], k: usize| w[0] + (w[1] - w[0]) * k as f64 / 8.0;
        let breaks = [curve.knots().breaks(), parameters.knots().breaks()];
        let places = breaks.iter().flat_map(|b| b.windows(2)).flat_map(|w| (1..8).map(move |k| at(w, k)));
        let error = |t: f64| {
            let (uv, on) = (self.near(part, t), parameters.point(t));
            let exact = surface.point(uv.x, uv.y);
            exact.distance(curve.point(t)).max(exact.distance(surface.point(on.x, on.y)))
        };
        places.map(error).fold(0.0, f64::max)
    }
}

/// Breaks in ascending order, neighbours that are one with the larger multiplicity.
fn merged(mut at: Vec<(f64, usize)>) -> Vec<(f64, usize)> {
    at.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (first, last) = (at[0].0, at[at.len() - 1].0);
    let same = SAME * (last - first);
    at.dedup_by(|next, kept| {
        let one = next.0 - kept.0 <= same;
        if one {
            *kept = (if next.0 == last { last } else { kept.0 }, kept.1.max(next.1));
        }
        one
    });
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;
    use std::f64::consts::TAU;

    fn line(a: DVec3, b: DVec3) -> NurbsCurve<DVec3> {
        NurbsCurve::new(KnotVector::clamped(1, &[0.0, 1.0]).unwrap(), vec![a, b], None).unwrap()
    }

    fn pipe() -> NurbsSurface {
        let start = DVec3::new(0.0, -1.0, 0.0);
        NurbsSurface::revolved(&line(start, start + DVec3::Z * 2.0), DVec3::ZERO, DVec3::Z, TAU).unwrap()
    }

    #[test]
    fn a_line_lands_on_a_cylinder_where_its_radii_do() {
        for (scale, away) in [(1.0, 0.0), (1e-3, 1.0), (1e4, 0.0), (1.0, 1e3)] {
            let shift = DVec3::new(away, away, -away);
            let place = |p: DVec3| p * scale + shift;
            let surface = pipe().mapped(place).unwrap();
            let curve = line(DVec3::new(-1.0, 2.0, -0.5), DVec3::new(2.0, 1.5, 2.5)).mapped(place).unwrap();
            let tolerance = 1e-7 * scale;
            let found = to_nearest(&curve, &surface, tolerance).unwrap();
            assert_eq!(found.len(), 1, "{scale}: the line passes below and above");
            let (a, b) = found[0].curve.knots().domain();
            // Height 0 at a sixth of the line, height 2 at five sixths.
            assert!((a - 1.0 / 6.0).abs() < 1e-6 && (b - 5.0 / 6.0).abs() < 1e-6, "{scale}: {a} {b}");
            assert!(found[0].deviation_mm <= tolerance);
            for k in 0..=500 {
                let t = a + (b - a) * k as f64 / 500.0;
                let p = (curve.point(t) - shift) / scale;
                let expected = place(p.truncate().normalize().extend(p.z));
                let uv = found[0].parameters.point(t);
                for got in [found[0].curve.point(t), surface.point(uv.x, uv.y)] {
                    let off = got.distance(expected);
                    assert!(off < 2.0 * tolerance, "{scale}: {off} off at {t}");
                }
            }
        }
    }

    #[test]
    fn a_circle_through_a_flat_patch_lands_in_two_parts() {
        let flat = NurbsSurface::ruled(
            &line(DVec3::new(-0.5, -3.0, 0.0), DVec3::new(0.5, -3.0, 0.0)),
            &line(DVec3::new(-0.5, 3.0, 0.0), DVec3::new(0.5, 3.0, 0.0)),
        )
        .unwrap();
        let circle = NurbsCurve::arc(DVec3::Z, DVec3::X, DVec3::Y, 0.0, TAU).unwrap();
        let found = to_nearest(&circle, &flat, 1e-8).unwrap();
        assert_eq!(found.len(), 2);
        for part in &found {
            let length = part.curve.length(1e-10).unwrap();
            assert!((length - TAU / 6.0).abs() < 1e-6, "{length}, not a sixth of the circle");
        }
        let all = along(&circle, &flat, DVec3::Z, 1e-8).unwrap();
        let length: f64 = all.iter().map(|part| part.curve.length(1e-10).unwrap()).sum();
        assert!((length - TAU / 3.0).abs() < 1e-6, "{length}, not a third of the circle");
    }

    #[test]
    fn a_surface_with_creases_of_its_curvature_takes_few_spans() {
        let knots = KnotVector::with_multiplicities(3, &[0.0, 0.4, 1.0], &[4, 2, 4]).unwrap();
        let heights = [0.0, 0.06, 0.02, 0.01, 0.08, 0.0];
        let line = KnotVector::clamped(1, &[0.0, 1.0]).unwrap();
        let pole = |i: usize| DVec3::new(0.2 * (i / 2) as f64, (i % 2) as f64, heights[i / 2]);
        let poles: Vec<DVec3> = (0..12).map(pole).collect();
        let surface = NurbsSurface::new(knots, line, poles, None).unwrap();
        let above = self::line(DVec3::new(0.1, 0.1, 0.2), DVec3::new(0.9, 0.8, 0.25));
        let found = to_nearest(&above, &surface, 1e-9).unwrap();
        assert_eq!(found.len(), 1);
        assert!(found[0].deviation_mm <= 1e-9);
        let count = found[0].curve.poles().len();
        assert!(count < 250, "{count} poles");
        for k in 0..=300 {
            let t = k as f64 / 300.0;
            let nearest = SurfaceInverter::new(&surface).unwrap().nearest(above.point(t));
            let off = found[0].curve.point(t).distance(nearest.point);
            assert!(off < 1e-7, "{off} off at {t}");
        }
    }

    #[test]
    fn along_a_direction_both_sides_of_a_cylinder_are_hit() {
        let surface = pipe();
        let curve = line(DVec3::new(-0.5, 4.0, 0.5), DVec3::new(0.7, 4.0, 1.5));
        let found = along(&curve, &surface, DVec3::Y, 1e-7).unwrap();
        let mut lengths = [0.0; 2];
        for part in &found {
            let (a, b) = part.curve.knots().domain();
            let middle = part.curve.point(0.5 * (a + b));
            lengths[usize::from(middle.y > 0.0)] += part.curve.length(1e-9).unwrap();
            for k in 0..=100 {
                let p = part.curve.point(a + (b - a) * k as f64 / 100.0);
                let off = (p.truncate().length() - 1.0).abs().max((p.z - 0.5 - (p.x + 0.5) / 1.2).abs());
                assert!(off < 1e-6, "{off} at {p}");
            }
        }
        let at = |k: usize| {
            let x = -0.5 + 1.2 * k as f64 / 1e5;
            DVec3::new(x, (1.0 - x * x).sqrt(), 0.5 + (x + 0.5) / 1.2)
        };
        let expected: f64 = (0..100_000).map(|k| at(k).distance(at(k + 1))).sum();
        assert!(lengths.iter().all(|l| (l - expected).abs() < 1e-5), "{lengths:?}, not {expected}");
        assert!(along(&curve, &surface, DVec3::ZERO, 1e-7).is_err());
        assert!(along(&line(DVec3::ZERO, DVec3::Y), &surface, DVec3::Y, 1e-7).is_err());
        assert!(to_nearest(&curve, &surface, 0.0).is_err());
    }
}
