//! Offset surfaces as B-splines to a tolerance.
//!
//! The offset `S + d·n` is approximated in the parameters of the surface, over its knots and as many
//! more as the tolerance asks for, with degrees 3 and 5, of which the one with fewer poles is kept.

use super::approximate::{self, Breaks, Finest};
use crate::error::{Error, Result};
use crate::nurbs::{Direction, KnotVector, NurbsSurface, Side, SurfaceDerivatives};
use glam::DVec3;

/// How fine an offset may become: enough for a blade to a nanometre, and a second of work.
const FINEST: Finest = Finest { spans: 300, patches: 10_000 };
/// Fits at most, each to a closer tolerance than the one before.
const FITS: usize = 4;
/// Places in each span at which bending and error are looked at.
const PLACES: usize = 5;
/// Places of sharpest bend from which a sharper one is sought, and steps from each.
const CLIMBS: usize = 16;
const STEPS: usize = 30;
/// Normals that differ by more than this, in rad, make a kink.
const KINK: f64 = 1e-6;
/// Derivatives shorter than this fraction of the size over the domain vanish.
const VANISHING: f64 = 1e-9;

/// An offset surface.
#[derive(Debug, Clone)]
pub struct OffsetSurface {
    /// Over the same domain as the surface: points of equal parameters belong together.
    pub surface: NurbsSurface,
    /// The largest distance from the true offset at equal parameters, in mm, at five by five places
    /// in each span.
    pub deviation_mm: f64,
}

/// The surface at a distance in mm along the normals `S_u × S_v` (against them if negative), to a
/// tolerance in mm; at 0 the surface itself. Sides that are one point, as the poles of a sphere, are
/// allowed.
///
/// # Errors
/// [`Error::Argument`] for a distance that is not finite or a tolerance that is not positive, and
/// where the offset would fold: where the distance reaches the smallest radius of curvature.
/// [`Error::Spline`] for surfaces with a kink: split them there. [`Error::Numerics`] where the surface
/// has no normal, and when the tolerance is not met with 300 spans a direction or 10,000 patches.
///
/// Not guaranteed: radii are looked at in five by five places in each span, and uphill from the
/// sharpest of these. A fold between them mostly shows as a tolerance that is not met.
pub fn offset(surface: &NurbsSurface, distance: f64, tolerance: f64) -> Result<OffsetSurface> {
    check(distance, tolerance)?;
    let surface = surface.clamped()?;
    check_kinks(&surface)?;
    let (us, vs) = (places(surface.knots_u()), places(surface.knots_v()));
    if distance == 0.0 {
        return Ok(OffsetSurface { surface, deviation_mm: 0.0 });
    }
    check_folds(&surface, distance, &us, &vs)?;
    let [cubic, quintic] = [3, 5].map(|degree| approximated(&surface, distance, tolerance, degree));
    match (cubic, quintic) {
        (Ok(a), Ok(b)) => Ok(if b.surface.poles().len() < a.surface.poles().len() { b } else { a }),
        (Ok(found), _) | (_, Ok(found)) => Ok(found),
        (_, Err(error)) => Err(error),
    }
}

fn check(distance: f64, tolerance: f64) -> Result<()> {
    if !distance.is_finite() {
        return Err(Error::Argument {
            name: "distance",
            why: format!("a length in mm was expected, not {distance}"),
        });
    }
    if tolerance.is_nan() || tolerance <= 0.0 {
        let why = format!("a positive length in mm was expected, not {tolerance}");
        return Err(Error::Argument { name: "tolerance", why });
    }
    Ok(())
}

/// Parameters evenly in each span, ends included.
fn places(knots: &KnotVector) -> Vec<f64> {
    let breaks = knots.breaks();
    let at = |w: &[f64], k: usize| w[0] + (w[1] - w[0]) * k as f64 / PLACES as f64;
    let mut out: Vec<f64> = breaks.windows(2).flat_map(|w| (0..PLACES).map(move |k| at(w, k))).collect();
    out.extend(breaks.last());
    out
}

/// Whether the derivatives along u and along v are nothing against each other.
fn vanishing(surface: &NurbsSurface, d: &SurfaceDerivatives) -> [bool; 2] {
    let reach = |d: DVec3, (a, b): (f64, f64)| d.length() * (b - a);
    let (u, v) = (reach(d.u, surface.knots_u().domain()), reach(d.v, surface.knots_v().domain()));
    [u < VANISHING * v, v < VANISHING * u]
}

/// The unit normal; at a side that is one point, its limit.
fn normal(surface: &NurbsSurface, d: &SurfaceDerivatives, u: f64, v: f64) -> Result<DVec3> {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let [flat_u, flat_v] = vanishing(surface, d);
    // Near such a side the derivative along it grows as the mixed one times the distance from it.
    let limit = match (flat_u, flat_v) {
        (true, false) if v == v0 => d.uv.cross(d.v),
        (true, false) if v == v1 => d.v.cross(d.uv),
        (false, true) if u == u0 => d.u.cross(d.uv),
        (false, true) if u == u1 => d.uv.cross(d.u),
        _ => return d.unit_normal(),
    };
    limit.try_normalize().map_or_else(|| d.unit_normal(), Ok)
}

/// The largest angle in rad between normals of both sides, where there are any.
fn largest_angle(below: &[DVec3], above: &[DVec3]) -> f64 {
    let longest = below.iter().map(|n| n.length()).fold(0.0, f64::max);
    let pairs = below.iter().zip(above).filter(|(a, b)| a.length().min(b.length()) > 1e-6 * longest);
    pairs.map(|(a, b)| a.cross(*b).length().atan2(a.dot(*b))).fold(0.0, f64::max)
}

/// Refuses surfaces whose normals jump across a knot.
fn check_kinks(surface: &NurbsSurface) -> Result<()> {
    for direction in [Direction::U, Direction::V] {
        let (knots, other) = match direction {
            Direction::U => (surface.knots_u(), surface.knots_v()),
            Direction::V => (surface.knots_v(), surface.knots_u()),
        };
        let (a, b) = knots.domain();
        let sharp = |&(t, m): &(f64, usize)| t > a && t < b && m >= knots.degree();
        for (t, _) in knots.breaks_and_multiplicities().into_iter().filter(sharp) {
            let normals = |side: Side| -> Vec<DVec3> {
                let of = |d: Vec<Vec<DVec3>>| d[1][0].cross(d[0][1]);
                let at = |s: f64| match direction {
                    Direction::U => of(surface.derivatives_from([side, Side::Above], t, s, 1)),
                    Direction::V => of(surface.derivatives_from([Side::Above, side], s, t, 1)),
                };
                places(other).into_iter().map(at).collect()
            };
            let angle = largest_angle(&normals(Side::Below), &normals(Side::Above));
            if angle > KINK {
                let why = format!(
                    "the surface has a kink of {:.3}° along {direction:?} = {t}: split it there and offset the parts",
                    angle.to_degrees()
                );
                return Err(Error::Spline { why });
            }
        }
    }
    Ok(())
}

/// The principal curvature towards the offset times its distance: from 1 on the offset folds. None
/// where a side is one point: the formulas have no value there, but its surroundings have.
fn bend(surface: &NurbsSurface, d: &SurfaceDerivatives, distance: f64) -> Option<f64> {
    if vanishing(surface, d).contains(&true) {
        return None;
    }
    let [low, high] = d.principal_curvatures().ok()?.curvatures;
    Some(if distance > 0.0 { high } else { low } * distance)
}

/// Refuses distances that reach a centre of curvature, as far as a search uphill from the places of
/// sharpest bend tells.
fn check_folds(surface: &NurbsSurface, distance: f64, us: &[f64], vs: &[f64]) -> Result<()> {
    let grid = surface.derivatives_on_grid(us, vs);
    let place = |k: usize| [us[k / vs.len()], vs[k % vs.len()]];
    let found = grid.iter().enumerate().filter_map(|(k, d)| Some((bend(surface, d, distance)?, place(k))));
    let mut sharpest: Vec<(f64, [f64; 2])> = found.collect();
    sharpest.sort_by(|a, b| b.0.total_cmp(&a.0));
    sharpest.truncate(CLIMBS);
    let steps = [us, vs].map(|t| t.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max));
    let climbed = sharpest.into_iter().map(|start| climb(surface, distance, start, steps));
    let Some((bend, [u, v])) = climbed.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|top| top.0 >= 1.0) else {
        return Ok(());
    };
    let why = format!(
        "{distance} mm reaches the centre of curvature at (u, v) = ({u}, {v}), where the radius is {} mm: the \
         offset would fold",
        (distance / bend).abs()
    );
    Err(Error::Argument { name: "distance", why })
}

/// The sharpest bend near a start, by steps along u and v that are halved where none leads uphill;
/// no further than to a fold.
fn climb(
    surface: &NurbsSurface,
    distance: f64,
    start: (f64, [f64; 2]),
    mut steps: [f64; 2],
) -> (f64, [f64; 2]) {
    let domains = [surface.knots_u().domain(), surface.knots_v().domain()];
    let mut top = start;
    for _ in 0..STEPS {
        if top.0 >= 1.0 {
            break;
        }
        let at = |k: usize, by: f64| {
            let mut uv = top.1;
            uv[k] = (uv[k] + by).clamp(domains[k].0, domains[k].1);
            let d = surface.derivatives(uv[0], uv[1]);
            bend(surface, &d, distance).map(|bend| (bend, uv))
        };
        let around = [at(0, steps[0]), at(0, -steps[0]), at(1, steps[1]), at(1, -steps[1])];
        match around.into_iter().flatten().max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some(next) if next.0 > top.0 => top = next,
            _ => steps = steps.map(|step| 0.5 * step),
        }
    }
    top
}

/// Knots of a degree that let the offset be as rough as the normals are.
fn breaks(knots: &KnotVector, degree: usize) -> Breaks {
    let multiplicity = |m: usize| (degree + m + 1).saturating_sub(knots.degree()).clamp(1, degree);
    let at = knots.breaks_and_multiplicities().into_iter().map(|(t, m)| (t, multiplicity(m)));
    Breaks { degree, at: at.collect() }
}

fn approximated(
    surface: &NurbsSurface,
    distance: f64,
    tolerance: f64,
    degree: usize,
) -> Result<OffsetSurface> {
    let point = |u: f64, v: f64| {
        let d = surface.derivatives(u, v);
        Ok(d.s + normal(surface, &d, u, v)? * distance)
    };
    let mut asked = 0.5 * tolerance;
    let mut deviation = f64::INFINITY;
    for _ in 0..FITS {
        let (u, v) = (breaks(surface.knots_u(), degree), breaks(surface.knots_v(), degree));
        let (fitted, seen) = approximate::surface(point, u, v, asked, FINEST)?;
        if seen > tolerance {
            deviation = seen;
            break;
        }
        deviation = self::deviation(&fitted, point)?;
        if deviation <= tolerance {
            return Ok(OffsetSurface { surface: fitted, deviation_mm: deviation });
        }
        asked *= (0.5 * tolerance / deviation).max(0.1);
    }
    let Finest { spans, patches } = FINEST;
    let why = format!(
        "the offset by {distance} mm stays {deviation:e} mm off with {spans} spans a direction or {patches} in \
         all, more than {tolerance:e}: ask for a coarser tolerance or offset parts of the surface"
    );
    Err(Error::Numerics { why })
}

/// The largest distance between a surface and points of equal parameters, as far as is looked at.
fn deviation(fitted: &NurbsSurface, point: impl Fn(f64, f64) -> Result<DVec3>) -> Result<f64> {
    let (us, vs) = (places(fitted.knots_u()), places(fitted.knots_v()));
    let mut largest = 0.0f64;
    for (k, p) in fitted.points_on_grid(&us, &vs).into_iter().enumerate() {
        largest = largest.max(p.distance(point(us[k / vs.len()], vs[k % vs.len()])?));
    }
    Ok(largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::NurbsCurve;
    use std::f64::consts::{FRAC_PI_2, TAU};

    fn line(a: DVec3, b: DVec3) -> NurbsCurve<DVec3> {
        NurbsCurve::new(KnotVector::clamped(1, &[0.0, 1.0]).unwrap(), vec![a, b], None).unwrap()
    }

    fn sphere() -> NurbsSurface {
        let arc = NurbsCurve::arc(DVec3::ZERO, DVec3::X, DVec3::Z, -FRAC_PI_2, FRAC_PI_2).unwrap();
        NurbsSurface::revolved(&arc, DVec3::ZERO, DVec3::Z, TAU).unwrap()
    }

    fn wave() -> NurbsSurface {
        let ku = KnotVector::clamped(3, &[0.0, 1.0, 2.0, 3.0, 4.0]).unwrap();
        let kv = KnotVector::clamped(2, &[0.0, 1.0, 2.5]).unwrap();
        let poles = ku.greville().into_iter().flat_map(|u| {
            kv.greville().into_iter().map(move |v| DVec3::new(u, v, 0.3 * (2.0 * u).sin() * v.cos()))
        });
        NurbsSurface::new(ku, kv.clone(), poles.collect(), None).unwrap()
    }

    fn each(surface: &NurbsSurface, n: usize, mut f: impl FnMut(f64, f64)) {
        let (u, v) = (surface.knots_u().domain(), surface.knots_v().domain());
        for k in 0..=n * n {
            let (i, j) = ((k % n) as f64 / n as f64, (k as f64 * 0.618_033).fract());
            f(u.0 + (u.1 - u.0) * i, v.0 + (v.1 - v.0) * j);
        }
    }

    #[test]
    fn offsets_of_spheres_cylinders_and_planes_are_such() {
        for (scale, away) in [(1.0, 0.0), (1e-3, 1.0), (1e4, 0.0), (1.0, 1e3)] {
            let tolerance = 1e-7 * scale;
            let centre = DVec3::new(away, -away, 0.5 * away);
            let placed = |s: NurbsSurface| s.mapped(|p| p * scale + centre).unwrap();
            let ball = offset(&placed(sphere()), 0.2 * scale, tolerance).unwrap();
            let radius = if sphere().derivatives(0.3, 0.3).normal().dot(sphere().point(0.3, 0.3)) > 0.0 {
                1.2
            } else {
                0.8
            };
            assert!(ball.deviation_mm <= tolerance);
            each(&ball.surface, 50, |u, v| {
                let off = ball.surface.point(u, v).distance(centre) - radius * scale;
                assert!(off.abs() < 2.0 * tolerance, "{scale}: {off} off the sphere at ({u}, {v})");
            });
            let pipe = NurbsSurface::revolved(
                &line(DVec3::X, DVec3::new(1.0, 0.0, 2.0)),
                DVec3::ZERO,
                DVec3::Z,
                TAU,
            );
            let pipe = placed(pipe.unwrap());
            let side = |d: f64| {
                let found = offset(&pipe, d * scale, tolerance).unwrap().surface;
                let p = found.point(0.4, 0.3) - centre;
                p.truncate().length() / scale
            };
            let (a, b) = (side(0.25), side(-0.25));
            assert!((a.max(b) - 1.25).abs() < 2e-7 && (a.min(b) - 0.75).abs() < 2e-7, "{scale}: {a} {b}");
        }
        let plane =
            NurbsSurface::ruled(&line(DVec3::ZERO, DVec3::X), &line(DVec3::Y, DVec3::X + DVec3::Y)).unwrap();
        let found = offset(&plane, 2.0, 1e-9).unwrap();
        assert!(found.surface.poles().iter().all(|p| (p.z - 2.0).abs() < 1e-14));
    }

    #[test]
    fn the_offset_of_a_wave_keeps_its_distance_between_the_knots() {
        let surface = wave();
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let found = offset(&surface, -0.15, tolerance).unwrap();
            assert!(found.deviation_mm <= tolerance);
            each(&surface, 70, |u, v| {
                let expected = surface.point(u, v) - surface.normal(u, v).unwrap() * 0.15;
                let off = found.surface.point(u, v).distance(expected);
                assert!(off < 1.5 * tolerance, "{off} at ({u}, {v}), asked {tolerance}");
            });
        }
    }

    #[test]
    fn folds_kinks_and_missing_normals_are_refused() {
        let error = offset(&wave(), 3.0, 1e-5).unwrap_err().to_string();
        assert!(error.contains("fold"), "{error}");
        let knots = KnotVector::new(1, vec![0.0, 0.0, 1.0, 2.0, 2.0]).unwrap();
        let roof = NurbsCurve::new(knots, vec![DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0), DVec3::X * 2.0], None)
            .unwrap();
        let roof = NurbsSurface::ruled(&roof, &roof.mapped(|p| p + DVec3::Y).unwrap()).unwrap();
        let error = offset(&roof, 0.1, 1e-5).unwrap_err().to_string();
        assert!(error.contains("kink") && error.contains("90.000") && error.contains("U = 1"), "{error}");
        // A nose that is sharp only between the places looked at.
        let knots = KnotVector::clamped(3, &[0.0, 1.0]).unwrap();
        let poles = [DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::new(0.05, 1.0, 0.0), DVec3::X];
        let nose = NurbsCurve::new(knots, poles.to_vec(), None).unwrap();
        let nose = NurbsSurface::ruled(&nose, &nose.mapped(|p| p + DVec3::Z).unwrap()).unwrap();
        let sides = [0.05, -0.05].map(|d| offset(&nose, d, 1e-4).err().map(|e| e.to_string()));
        let folds = sides.iter().flatten().filter(|e| e.contains("fold") && e.contains("(0.5, "));
        assert_eq!(folds.count(), 1, "{sides:?}");
        let edge = line(DVec3::ZERO, DVec3::X);
        let nothing = NurbsSurface::ruled(&edge, &edge).unwrap();
        assert!(matches!(offset(&nothing, 0.1, 1e-5), Err(Error::Numerics { .. })));
        assert_eq!(offset(&sphere(), 0.0, 1e-5).unwrap().surface, sphere());
        assert!(offset(&wave(), f64::NAN, 1e-5).is_err() && offset(&wave(), 0.1, 0.0).is_err());
    }
}
