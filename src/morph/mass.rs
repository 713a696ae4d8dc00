//! Area, volume and centroid of the solid, integrated in the parameter planes of its faces.
//!
//! Volume and moments are surface integrals (divergence theorem); a surface integral over a
//! trimmed face is a line integral along its pcurves of the primitive in `u` (Green's theorem).
//! Gauss points sit in every knot span, so the result converges like the quadrature, not like a
//! triangulation.

use super::hot::{Hot, Joint, Side};
use super::pieces::{between_knots, for_quadrature};
use crate::nurbs::NurbsSurface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Gauss-Legendre points and weights on (0, 1).
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Integral properties.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Mass {
    /// Surface area, mm².
    pub area: f64,
    /// Volume, mm³.
    pub volume: f64,
    /// Centre of volume, mm.
    pub centroid: DVec3,
}

/// Parameter area, area, volume and first moments of a piece.
type Integrals = [f64; 6];

/// The properties of the solid with these surfaces (by patch).
pub fn mass(hot: &Hot, surfaces: &[NurbsSurface]) -> Mass {
    let mut sides: Vec<(&Joint, &Side)> =
        hot.joints.iter().flat_map(|j| j.sides.iter().map(move |s| (j, s))).collect();
    sides.sort_by_key(|(_, s)| s.face);
    // Moments about a point of the part lose less to cancellation than about the origin.
    let origin = surfaces.first().map_or(DVec3::ZERO, |s| s.poles()[0]);
    let parts: Vec<Integrals> = sides
        .par_iter()
        .map(|(joint, side)| {
            along_side(joint, side, &surfaces[side.patch], hot.patches[side.patch].window[0].x, origin)
        })
        .collect();
    let mut faces = vec![[0.0; 6]; hot.faces.len()];
    for ((_, side), part) in sides.iter().zip(parts) {
        for (f, p) in faces[side.face].iter_mut().zip(part) {
            *f += p;
        }
    }
    let mut total = [0.0; 6];
    for (face, integrals) in hot.faces.iter().zip(&faces) {
        // Outlines run with the material on their left; should they not, both signs turn.
        let sign = integrals[0].signum();
        let outward = if face.reversed { -sign } else { sign };
        total[1] += sign * integrals[1];
        for k in 2..6 {
            total[k] += outward * integrals[k];
        }
    }
    let moments = DVec3::new(total[3], total[4], total[5]);
    Mass { area: total[1], volume: total[2], centroid: origin + moments / total[2] }
}

/// `∮ F dv` along one pcurve, with `F` the primitive in `u` from `u_first` on.
fn along_side(joint: &Joint, side: &Side, surface: &NurbsSurface, u_first: f64, origin: DVec3) -> Integrals {
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let breaks = ku.breaks();
    let mut sum = [0.0; 6];
    let pieces = for_quadrature(joint, &side.pcurve, between_knots(joint, &[(side, ku, kv)]));
    for w in pieces.windows(2) {
        for (x, weight) in GAUSS {
            let t = joint.parameter(w[0] + x * (w[1] - w[0]));
            let [uv, along, _] = side.pcurve.derivatives(t);
            let dv = along.y * weight * (w[1] - w[0]) * (joint.range[1] - joint.range[0]);
            if dv != 0.0 {
                add_line(
                    surface,
                    &breaks,
                    u_first,
                    uv,
                    if side.reversed { -dv } else { dv },
                    origin,
                    &mut sum,
                );
            }
        }
    }
    sum
}

/// Adds `dv · ∫ f du` from `u_first` to `uv.x` at `v = uv.y`.
fn add_line(
    surface: &NurbsSurface,
    breaks: &[f64],
    u_first: f64,
    uv: DVec2,
    dv: f64,
    origin: DVec3,
    sum: &mut Integrals,
) {
    let mut a = u_first;
    let mut add = |a: f64, b: f64| {
        for (x, weight) in GAUSS {
            let d = surface.first_derivatives(a + x * (b - a), uv.y);
            let (r, n) = (d[0] - origin, d[1].cross(d[2]) * (weight * (b - a) * dv));
            sum[0] += weight * (b - a) * dv;
            sum[1] += d[1].cross(d[2]).length() * (weight * (b - a) * dv);
            sum[2] += r.dot(n) / 3.0;
            for k in 0..3 {
                sum[3 + k] += 0.5 * r[k] * r[k] * n[k];
            }
        }
    };
    for &b in breaks.iter().filter(|&&b| b > u_first && b < uv.x) {
        add(a, b);
        a = b;
    }
    add(a, uv.x);
}
