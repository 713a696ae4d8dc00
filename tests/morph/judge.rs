//! What the output B-rep's own text says, measured without the code that made it.

use crate::solids::{hot, inside};
use bladesmith::brep::{Brep, parse};
use bladesmith::morph::hot::{Hot, Joint};
use glam::DVec3;

/// Figures in mm and degrees.
#[derive(Debug, Clone, Copy, Default)]
pub struct Verdict {
    /// Largest error of a face's, an edge's or a vertex' point.
    pub error: f64,
    /// Largest distance among an edge's curve and traces.
    pub gap: f64,
    /// The same on the input.
    pub gap_before: f64,
    /// Largest growth of the angle between the faces at a tangent edge.
    pub opened_deg: f64,
    /// Samples at which a normal is turned by a right angle or more against the field's.
    pub folded: usize,
    /// Largest excess of an edge's gap over its tolerance.
    pub beyond_tolerance: f64,
}

/// Angles below this are tangent joints.
const TANGENT_DEG: f64 = 1.0;

/// Reads back what is written and judges it against `x + u(x)`.
pub fn judge(before: &Brep, after: &Brep, u: impl Fn(DVec3) -> DVec3) -> Verdict {
    let after = parse("output", &after.write()).unwrap_or_else(|error| panic!("{error}"));
    let (old, new) = (hot(before), hot(&after));
    assert_same_topology(&old, &new);
    let mut verdict = Verdict::default();
    for face in 0..old.faces.len() {
        let (a, b) = (&before.surfaces[surface(&old, face)], &after.surfaces[surface(&new, face)]);
        for uv in inside(&old, face, 24) {
            let (hot, cold) = (a.derivatives(uv.x, uv.y), b.derivatives(uv.x, uv.y));
            let to = |x: DVec3| x + u(x);
            verdict.error = verdict.error.max((cold.s - to(hot.s)).length());
            let step = |d: DVec3| (to(hot.s + 1e-4 * d) - to(hot.s - 1e-4 * d)) / 2e-4;
            verdict.folded += usize::from(cold.normal().dot(step(hot.u).cross(step(hot.v))) <= 0.0);
        }
    }
    for (old, new) in old.topology.vertices.iter().zip(&new.topology.vertices) {
        verdict.error = verdict.error.max((new.point - old.point - u(old.point)).length());
    }
    for (e, (a, b)) in old.joints.iter().zip(&new.joints).enumerate() {
        let (gap, error) = along(&after, &new, (a, b), &u);
        verdict.gap = verdict.gap.max(gap);
        verdict.gap_before = verdict.gap_before.max(along(before, &old, (a, a), |_| DVec3::ZERO).0);
        verdict.error = verdict.error.max(error);
        verdict.beyond_tolerance = verdict.beyond_tolerance.max(gap - new.topology.edges[e].tolerance);
        let [was, is] = [angle_deg(before, &old, a), angle_deg(&after, &new, b)];
        if was < TANGENT_DEG {
            verdict.opened_deg = verdict.opened_deg.max(is - was);
        }
    }
    verdict
}

/// Index of a face's surface.
fn surface(hot: &Hot, face: usize) -> usize {
    hot.topology.faces[face].surface
}

fn assert_same_topology(old: &Hot, new: &Hot) {
    type Outline = (bool, Vec<Vec<(usize, bool)>>);
    let outline = |h: &Hot| -> Vec<Outline> {
        let wire = |w: &Vec<bladesmith::brep::Coedge>| w.iter().map(|c| (c.edge, c.reversed)).collect();
        h.topology.faces.iter().map(|f| (f.reversed, f.wires.iter().map(wire).collect())).collect()
    };
    assert_eq!(outline(old), outline(new), "other faces, wires or edges");
    let ends = |h: &Hot| -> Vec<_> { h.topology.edges.iter().map(|e| (e.vertices, e.range)).collect() };
    assert_eq!(ends(old), ends(new), "other ends of edges");
}

/// Largest gap along an edge, and largest error of its curve.
fn along(brep: &Brep, hot: &Hot, (a, b): (&Joint, &Joint), u: impl Fn(DVec3) -> DVec3) -> (f64, f64) {
    let (mut gap, mut error) = (0.0f64, 0.0f64);
    for k in 0..=150 {
        let t = b.parameter(f64::from(k) / 150.0);
        let mut points: Vec<DVec3> = b.curve.iter().map(|c| c.point(t)).collect();
        if let (Some(was), Some(is)) = (&a.curve, points.first()) {
            error = error.max((*is - was.point(t) - u(was.point(t))).length());
        }
        points.extend(b.sides.iter().map(|side| {
            let uv = side.pcurve.point(t);
            brep.surfaces[surface(hot, side.face)].point(uv.x, uv.y)
        }));
        for p in &points {
            gap = points.iter().map(|q| (*p - *q).length()).fold(gap, f64::max);
        }
    }
    (gap, error)
}

/// Largest angle between the outward normals along an edge; 0 where a normal vanishes.
fn angle_deg(brep: &Brep, hot: &Hot, joint: &Joint) -> f64 {
    let [a, b] = &joint.sides[..] else { return 0.0 };
    let normal = |side: &bladesmith::morph::hot::Side, t: f64| {
        let uv = side.pcurve.point(t);
        let d = brep.surfaces[surface(hot, side.face)].derivatives(uv.x, uv.y);
        let pole = d.normal().length() < 1e-9 * (d.u.length_squared() + d.v.length_squared());
        let n = if pole { DVec3::ZERO } else { d.normal() };
        if hot.faces[side.face].reversed { -n } else { n }
    };
    let at = |k: u32| {
        let t = joint.parameter(f64::from(k) / 150.0);
        let (x, y) = (normal(a, t), normal(b, t));
        let vanishes = x == DVec3::ZERO || y == DVec3::ZERO;
        if vanishes { 0.0 } else { x.cross(y).length().atan2(x.dot(y)).to_degrees() }
    };
    (0..=150).map(at).fold(0.0, f64::max)
}
