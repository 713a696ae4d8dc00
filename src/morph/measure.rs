//! Every figure of the report, measured on the result.

use super::associate::Match;
use super::coverage;
use super::hot::{Hot, Joint};
use super::rebuild::{EDGE_SAMPLES, NewEdge, gap_mm};
use super::report::{Change, EdgeReport, Spread};
use crate::brep::Brep;
use crate::nurbs::NurbsSurface;
use crate::ops::closest::foot;
use glam::DVec3;
use rayon::prelude::*;

/// An area element below this fraction of the derivatives' squares is rounding.
const DEGENERATE: f64 = 1e-9;

/// What one node on one face says of the result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeFigures {
    /// `S' − (S + factor · u)`, mm.
    pub deviation: DVec3,
    /// Distance of `S + factor · u` to the new face, re-projected, mm.
    pub distance: f64,
    /// Size of the displacement's gradient along the surface times the displacement, mm.
    pub second_order: f64,
    /// The normal turned against the input's.
    pub folded: bool,
}

/// Measures the result at every match.
pub fn at_nodes(
    hot: &Hot,
    brep: &Brep,
    cold: &[NurbsSurface],
    matches: &[Match],
    displacements: &[DVec3],
) -> Vec<NodeFigures> {
    let one = |m: &Match| {
        let patch = hot.faces[m.face as usize].patch;
        let (uv, u) = (m.foot.uv, displacements[m.node as usize]);
        let [_, au, av] = hot.patches[patch].hot.first_derivatives(uv.x, uv.y);
        let [s, bu, bv] = cold[patch].first_derivatives(uv.x, uv.y);
        let target = brep.surfaces[hot.patches[patch].surface].point(uv.x, uv.y) + u;
        let gradient = ((bu - au).length_squared() / au.length_squared().max(1e-30)
            + (bv - av).length_squared() / av.length_squared().max(1e-30))
        .sqrt();
        NodeFigures {
            deviation: s - target,
            distance: foot(&cold[patch], target, uv).distance,
            second_order: gradient * u.length(),
            folded: turned([au, av], [bu, bv]),
        }
    };
    matches.par_iter().map(one).collect()
}

/// The normal of two derivatives; zero at a pole, where only rounding is left of it.
fn regular_normal(du: DVec3, dv: DVec3) -> DVec3 {
    let normal = du.cross(dv);
    let regular = normal.length() > DEGENERATE * (du.length_squared() + dv.length_squared());
    if regular { normal } else { DVec3::ZERO }
}

/// Whether the normal of the derivatives `b` is turned against that of `a`.
fn turned([au, av]: [DVec3; 2], [bu, bv]: [DVec3; 2]) -> bool {
    bu.cross(bv).dot(regular_normal(au, av)) < 0.0
}

/// Number of places on the faces where the new normal is turned against the old one.
pub fn folded_samples(hot: &Hot, cold: &[NurbsSurface]) -> usize {
    let one = |face: usize| {
        let patch = hot.faces[face].patch;
        let at = |uv: glam::DVec2| {
            let [_, au, av] = hot.patches[patch].hot.first_derivatives(uv.x, uv.y);
            let [_, bu, bv] = cold[patch].first_derivatives(uv.x, uv.y);
            turned([au, av], [bu, bv])
        };
        coverage::samples(hot, face).iter().filter(|(uv, _)| at(*uv)).count()
    };
    (0..hot.faces.len()).into_par_iter().map(one).sum()
}

/// Mean and largest of some values.
pub fn spread(values: impl Iterator<Item = f64>) -> Spread {
    let (mut n, mut sum, mut max) = (0usize, 0.0, 0.0f64);
    for v in values {
        n += 1;
        sum += v;
        max = max.max(v);
    }
    Spread { mean: if n > 0 { sum / n as f64 } else { 0.0 }, max }
}

/// Largest angle between the outward normals along a joint, degrees; `normal` gives the surface
/// normal on a patch.
fn angle_deg(hot: &Hot, joint: &Joint, normal: impl Fn(usize, f64, f64) -> DVec3) -> f64 {
    let [a, b] = &joint.sides[..] else { return 0.0 };
    let outward = |side: &super::hot::Side, t: f64| {
        let uv = side.pcurve.point(t);
        let n = normal(side.patch, uv.x, uv.y).normalize_or_zero();
        if hot.faces[side.face].reversed { -n } else { n }
    };
    let at = |k: usize| {
        let t = joint.parameter(k as f64 / (EDGE_SAMPLES - 1) as f64);
        let (x, y) = (outward(a, t), outward(b, t));
        // A vanishing normal (the tip of a cone) has no angle.
        if x == DVec3::ZERO || y == DVec3::ZERO {
            0.0
        } else {
            x.cross(y).length().atan2(x.dot(y)).to_degrees()
        }
    };
    (0..EDGE_SAMPLES).map(at).fold(0.0, f64::max)
}

/// Largest angle along each joint of the input, degrees.
pub fn hot_angles_deg(hot: &Hot, brep: &Brep) -> Vec<f64> {
    let normal = |p: usize, u: f64, v: f64| {
        let d = brep.surfaces[hot.patches[p].surface].derivatives(u, v);
        regular_normal(d.u, d.v)
    };
    hot.joints.par_iter().map(|j| angle_deg(hot, j, normal)).collect()
}

/// The report of every edge.
pub fn edges(
    hot: &Hot,
    brep: &Brep,
    cold: &[NurbsSurface],
    new: &[NewEdge],
    hot_angles: &[f64],
    held: &[bool],
) -> Vec<EdgeReport> {
    let one = |index: usize| {
        let joint = &hot.joints[index];
        let curve = joint.curve.as_ref().filter(|_| !joint.degenerated).map(|c| move |t: f64| c.point(t));
        let before = gap_mm(joint, curve.as_ref().map(|f| f as &dyn Fn(f64) -> DVec3), |p, u, v| {
            brep.surfaces[hot.patches[p].surface].point(u, v)
        });
        let faces: Vec<usize> = joint.sides.iter().map(|s| s.face).collect();
        let (first, last) = (faces.first().copied().unwrap_or(0), faces.last().copied().unwrap_or(0));
        let after = angle_deg(hot, joint, |p, u, v| {
            let [_, du, dv] = cold[p].first_derivatives(u, v);
            regular_normal(du, dv)
        });
        EdgeReport {
            index: index + 1,
            faces: [first + 1, last + 1],
            gap_mm: Change { before, after: new[index].gap_mm },
            angle_deg: Change { before: hot_angles[index], after },
            tangent: faces.len() == 2 && hot_angles[index] < crate::tolerance::TANGENT_DEG,
            held: held[first] != held[last],
        }
    };
    (0..hot.joints.len()).into_par_iter().map(one).collect()
}
