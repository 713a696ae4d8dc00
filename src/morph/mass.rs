//! Area, volume and centroid of the solid, integrated in the parameter planes of its faces.
//!
//! Volume and moments are surface integrals (divergence theorem); a surface integral over a
//! trimmed face is a line integral along its pcurves of the primitive in `u` (Green's theorem).
//! Gauss points sit in every knot span, so the result converges like the quadrature, not like a
//! triangulation.

use super::hot::{Hot, Joint, Side};
use super::pieces::{between_knots, for_quadrature};
use crate::nurbs::{BasisTable, IsoLine, NurbsSurface};
use glam::DVec3;
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
    let columns: Vec<Columns> =
        surfaces.iter().zip(&hot.patches).map(|(s, p)| Columns::new(s, p.window[0].x)).collect();
    let parts: Vec<Integrals> = sides
        .par_iter()
        .map(|(joint, side)| along_side(joint, side, &surfaces[side.patch], &columns[side.patch], origin))
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

/// `∮ F dv` along one pcurve, with `F` the primitive in `u` from the first of the `columns` on.
fn along_side(
    joint: &Joint,
    side: &Side,
    surface: &NurbsSurface,
    columns: &Columns,
    origin: DVec3,
) -> Integrals {
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let mut sum = [0.0; 6];
    let mut line: Option<IsoLine<'_, 2>> = None;
    let pieces = for_quadrature(joint, &side.pcurve, between_knots(joint, &[(side, ku, kv)]));
    for w in pieces.windows(2) {
        for (x, weight) in GAUSS {
            let t = joint.parameter(w[0] + x * (w[1] - w[0]));
            let [uv, along, _] = side.pcurve.derivatives(t);
            let dv = along.y * weight * (w[1] - w[0]) * (joint.range[1] - joint.range[0]);
            if dv == 0.0 {
                continue;
            }
            let line = line.get_or_insert_with(|| IsoLine::new(surface, uv.y));
            line.move_to(uv.y);
            let along = columns.integral(line, uv.x, origin);
            let dv = if side.reversed { -dv } else { dv };
            sum.iter_mut().zip(along).for_each(|(s, a)| *s += dv * a);
        }
    }
    sum
}

/// Gauss points in `u` for all lines of constant `v` of a patch.
struct Columns {
    /// The start of integration and the breaks beyond it.
    breaks: Vec<f64>,
    table: BasisTable<2>,
}

impl Columns {
    fn new(surface: &NurbsSurface, first: f64) -> Self {
        let mut breaks = vec![first];
        breaks.extend(surface.knots_u().breaks().into_iter().filter(|&b| b > first));
        let points = |w: &[f64]| GAUSS.map(|(x, _)| w[0] + x * (w[1] - w[0]));
        let points: Vec<f64> = breaks.windows(2).flat_map(points).collect();
        Self { table: BasisTable::new(surface.knots_u(), &points), breaks }
    }

    /// `∫ f du` from the first break to `last` along a line.
    fn integral(&self, line: &IsoLine<'_, 2>, last: f64, origin: DVec3) -> Integrals {
        let mut sum = [0.0; 6];
        let whole = self.breaks[1..].partition_point(|&b| b < last);
        for span in 0..whole {
            let length = self.breaks[span + 1] - self.breaks[span];
            for (k, (_, weight)) in GAUSS.iter().enumerate() {
                add(&line.jet(&self.table, span * GAUSS.len() + k), weight * length, origin, &mut sum);
            }
        }
        let (start, length) = (self.breaks[whole], last - self.breaks[whole]);
        for (x, weight) in GAUSS {
            add(&line.jet_at(start + x * length), weight * length, origin, &mut sum);
        }
        sum
    }
}

/// Adds the integrands of one point.
fn add(jet: &[[DVec3; 2]; 2], weight: f64, origin: DVec3, sum: &mut Integrals) {
    let (r, n) = (jet[0][0] - origin, jet[1][0].cross(jet[0][1]) * weight);
    sum[0] += weight;
    sum[1] += n.length() * weight.signum();
    sum[2] += r.dot(n) / 3.0;
    for k in 0..3 {
        sum[3 + k] += 0.5 * r[k] * r[k] * n[k];
    }
}
