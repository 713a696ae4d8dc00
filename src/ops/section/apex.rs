//! Sides of surfaces that are one point, as the poles of a sphere: branches end there, though the
//! parameter along the side has no value there but a limit.

use super::pair::Pair;
use super::sheet::{Parts, Sheet};
use super::touch::on_plane;
use super::trace::Target;
use crate::error::Result;
use crate::ops::invert::SurfaceInverter;
use glam::{DVec2, DVec3};

/// Fraction of the tolerance within which a side is one point.
const POINT: f64 = 1e-3;

/// Such points of both sheets that lie on the other.
pub fn apexes(pair: &Pair) -> Result<Vec<Target>> {
    let mut targets = Vec::new();
    for k in 0..2 {
        let Sheet::Surface(parts) = &pair.sheets[k] else { continue };
        for (own, fixed, x) in sides(parts, POINT * pair.tolerance) {
            let (other, distance) = match &pair.sheets[1 - k] {
                Sheet::Plane { origin, x: e, y: f } => {
                    (on_plane(*origin, *e, *f, x), (x - *origin).dot(e.cross(*f)).abs())
                }
                Sheet::Surface(parts) => {
                    let nearest = SurfaceInverter::new(&parts.surface)?.nearest(x);
                    (nearest.at, nearest.distance)
                }
            };
            if distance <= pair.tolerance {
                let (mut at, mut known) = ([own; 2], [fixed; 2]);
                (at[1 - k], known[1 - k]) = (other, DVec2::ONE);
                targets.push(Target { at, x, known });
            }
        }
    }
    Ok(targets)
}

/// Sides that are one point: parameters, 1 for that which has a value there, and the point.
fn sides(parts: &Parts, tolerance: f64) -> impl Iterator<Item = (DVec2, DVec2, DVec3)> + '_ {
    let [low, high] = parts.domain();
    let poles = parts.surface.poles();
    let (n, m) = (parts.surface.knots_u().len(), parts.surface.knots_v().len());
    let all = [
        (0, 1, m, low, DVec2::X),
        ((n - 1) * m, 1, m, high, DVec2::X),
        (0, m, n, low, DVec2::Y),
        (m - 1, m, n, high, DVec2::Y),
    ];
    all.into_iter().filter_map(move |(first, step, count, at, fixed)| {
        let x = poles[first];
        let one = (0..count).all(|k| poles[first + k * step].distance(x) <= tolerance);
        one.then_some((at, fixed, x))
    })
}
