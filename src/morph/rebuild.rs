//! The output B-rep: new surfaces under the old pcurves, edge curves that run between their two
//! traces, vertices and tolerances to match. Topology is not touched.

use super::hot::{Hot, Joint, Side, store_planar_pcurves};
use super::represent::curve_breaks;
use crate::brep::{Brep, Curve3d, EdgeRepresentation, ShapeKind, Surface};
use crate::error::Result;
use crate::nurbs::NurbsSurface;
use crate::ops::approximate;
use crate::tolerance::CONFUSION_MM;
use glam::DVec3;
use rayon::prelude::*;

/// Samples at which an edge is measured. With fewer, Open CASCADE finds faces "unorientable".
pub const EDGE_SAMPLES: usize = 201;
/// Tolerances are this much above what was measured.
const MARGIN: f64 = 1.5;
/// What an approximated edge curve may miss, mm.
const CURVE_MM: f64 = 1e-6;
/// Spans of an edge's curve at most.
const SPAN_LIMIT: usize = 256;

/// An edge of the output.
#[derive(Debug, Clone)]
pub struct NewEdge {
    /// Its curve; none where it is a single point.
    pub curve: Option<crate::nurbs::NurbsCurve<DVec3>>,
    /// Largest distance among curve and traces, mm.
    pub gap_mm: f64,
    /// First and last points of the curve and of the traces.
    pub ends: [Vec<DVec3>; 2],
}

/// Points of a joint's side at parameter `t` on `surfaces` (by patch).
fn on_sides(joint: &Joint, surfaces: &[NurbsSurface], t: f64) -> impl Iterator<Item = DVec3> {
    joint.sides.iter().map(move |side| {
        let uv = side.pcurve.point(t);
        surfaces[side.patch].point(uv.x, uv.y)
    })
}

/// The new place of the curve's point at parameter `t`: moved as the joint's traces are in the
/// mean. (The traces themselves are rougher than the curve: they run through pcurves.)
fn moved(joint: &Joint, curve: &Curve3d, hot: &Hot, surfaces: &[NurbsSurface], t: f64) -> DVec3 {
    let displacement = |side: &Side| {
        let uv = side.pcurve.point(t);
        surfaces[side.patch].point(uv.x, uv.y) - hot.patches[side.patch].hot.point(uv.x, uv.y)
    };
    let sum: DVec3 = joint.sides.iter().map(displacement).sum();
    curve.point(t) + sum / joint.sides.len() as f64
}

/// Largest distance between any two of `points`.
fn spread(points: &[DVec3]) -> f64 {
    let pairs =
        points.iter().enumerate().flat_map(|(i, a)| points[..i].iter().map(move |b| (*a - *b).length()));
    pairs.fold(0.0, f64::max)
}

/// Largest distance among a curve and the traces of a joint, mm; `side` gives a point on a side
/// from its patch and parameters.
pub fn gap_mm(
    joint: &Joint,
    curve: Option<&dyn Fn(f64) -> DVec3>,
    side: impl Fn(usize, f64, f64) -> DVec3,
) -> f64 {
    let mut worst = 0.0f64;
    for k in 0..EDGE_SAMPLES {
        let t = joint.parameter(k as f64 / (EDGE_SAMPLES - 1) as f64);
        let mut points: Vec<DVec3> = curve.iter().map(|c| c(t)).collect();
        for s in &joint.sides {
            let uv = s.pcurve.point(t);
            points.push(side(s.patch, uv.x, uv.y));
        }
        worst = worst.max(spread(&points));
    }
    worst
}

/// The edges that go with new surfaces (by patch).
///
/// # Errors
/// As [`approximate::curve`].
pub fn new_edges(hot: &Hot, surfaces: &[NurbsSurface]) -> Result<Vec<NewEdge>> {
    let edge = |joint: &Joint| {
        let [a, b] = joint.range;
        let curve = match &joint.curve {
            Some(curve) if !joint.degenerated && !joint.sides.is_empty() => {
                let f = |t: f64| moved(joint, curve, hot, surfaces, t);
                Some(approximate::curve(f, curve_breaks(curve, a, b), CURVE_MM, SPAN_LIMIT)?.0)
            }
            _ => None,
        };
        let point = curve.as_ref().map(|c| move |t: f64| c.point(t));
        let gap_mm = gap_mm(joint, point.as_ref().map(|f| f as &dyn Fn(f64) -> DVec3), |p, u, v| {
            surfaces[p].point(u, v)
        });
        let ends = joint.range.map(|t| {
            let mut points: Vec<DVec3> = on_sides(joint, surfaces, t).collect();
            points.extend(curve.as_ref().map(|c| c.point(t)));
            points
        });
        Ok(NewEdge { curve, gap_mm, ends })
    };
    hot.joints.par_iter().map(edge).collect()
}

/// Writes new surfaces and edges into a copy of the B-rep.
pub fn rebuild(brep: &Brep, hot: &Hot, surfaces: &[NurbsSurface], edges: &[NewEdge]) -> Brep {
    let mut out = brep.clone();
    // Open CASCADE sets it when it has judged a shape, and clears it when it draws one.
    out.shapes.iter_mut().for_each(|shape| shape.flags.checked = false);
    store_planar_pcurves(&mut out, hot);
    for (patch, surface) in hot.patches.iter().zip(surfaces) {
        out.surfaces[patch.surface] = Surface::BSpline(surface.into());
    }
    for face in &hot.topology.faces {
        if let ShapeKind::Face(f) = &mut out.shapes[face.shape].kind {
            f.natural_restriction = false;
        }
    }
    // Vertices first take what their edges need, then may not be tighter than these.
    let mut vertices: Vec<Vec<DVec3>> = vec![Vec::new(); hot.topology.vertices.len()];
    let mut floors = vec![CONFUSION_MM; vertices.len()];
    for ((joint, edge), topology) in hot.joints.iter().zip(edges).zip(&hot.topology.edges) {
        let tolerance = (MARGIN * edge.gap_mm).max(CONFUSION_MM);
        set_edge(&mut out, topology.shape, joint, edge, tolerance);
        for (end, vertex) in joint.vertices.iter().enumerate() {
            if let Some(v) = *vertex {
                vertices[v].extend(&edge.ends[end]);
                floors[v] = floors[v].max(tolerance);
            }
        }
    }
    for ((points, floor), topology) in vertices.iter().zip(floors).zip(&hot.topology.vertices) {
        if points.is_empty() {
            continue;
        }
        let point = points.iter().sum::<DVec3>() / points.len() as f64;
        let reach = points.iter().map(|p| (*p - point).length()).fold(0.0, f64::max);
        if let ShapeKind::Vertex(v) = &mut out.shapes[topology.shape].kind {
            v.point = point;
            v.tolerance = (MARGIN * reach).max(floor);
        }
    }
    out
}

fn set_edge(out: &mut Brep, shape: usize, joint: &Joint, edge: &NewEdge, tolerance: f64) {
    let curve = edge.curve.as_ref().map(|c| {
        out.curves.push(Curve3d::BSpline(c.into()));
        out.curves.len() - 1
    });
    let ShapeKind::Edge(e) = &mut out.shapes[shape].kind else { return };
    e.tolerance = tolerance;
    e.same_parameter = true;
    e.same_range = true;
    if let Some(curve) = curve {
        e.representations.retain(|r| !matches!(r, EdgeRepresentation::Curve { .. }));
        e.representations.insert(0, EdgeRepresentation::Curve { curve, location: 0, range: joint.range });
    }
}

/// Largest tolerance of an edge or vertex, mm.
pub fn largest_tolerance_mm(brep: &Brep) -> f64 {
    let tolerance = |kind: &ShapeKind| match kind {
        ShapeKind::Edge(e) => e.tolerance,
        ShapeKind::Vertex(v) => v.tolerance,
        _ => 0.0,
    };
    brep.shapes.iter().map(|s| tolerance(&s.kind)).fold(0.0, f64::max)
}
