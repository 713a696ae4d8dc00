//! What is in a part, in a reader's terms.

use crate::brep::{Brep, FaceTopology, Surface, Topology};
use glam::{DVec2, DVec3};
use serde::Serialize;

/// Solids and faces with what matters to a morph. Numbered from 1; lengths in mm.
#[derive(Serialize)]
pub(super) struct PartInfo {
    solids: Vec<SolidInfo>,
    faces: Vec<FaceInfo>,
    edges: usize,
    vertices: usize,
    bounding_box_mm: Option<[[f64; 3]; 2]>,
}

#[derive(Serialize)]
struct SolidInfo {
    index: usize,
    closed: bool,
    faces: Vec<usize>,
}

#[derive(Serialize)]
struct FaceInfo {
    index: usize,
    surface: &'static str,
    degree: Option<[usize; 2]>,
    poles: Option<[usize; 2]>,
    rational: bool,
}

impl PartInfo {
    /// Describes a part whose locations are baked into its geometry.
    pub(super) fn new(brep: &Brep, topology: &Topology) -> Self {
        let solids = topology.solids.iter().enumerate().map(|(i, solid)| SolidInfo {
            index: i + 1,
            closed: is_closed(topology, &solid.faces),
            faces: solid.faces.iter().map(|face| face + 1).collect(),
        });
        let faces = topology.faces.iter().enumerate();
        Self {
            solids: solids.collect(),
            faces: faces.map(|(i, face)| FaceInfo::new(i + 1, &brep.surfaces[face.surface])).collect(),
            edges: topology.edges.len(),
            vertices: topology.vertices.len(),
            bounding_box_mm: bounding_box(brep, topology),
        }
    }
}

impl FaceInfo {
    fn new(index: usize, surface: &Surface) -> Self {
        let kind = surface.kind_name();
        let plain = Self { index, surface: kind, degree: None, poles: None, rational: false };
        match surface {
            Surface::Trimmed { basis, .. } => Self::new(index, basis),
            Surface::BSpline(spline) => Self {
                degree: Some([0, 1].map(|k| spline.knots()[k].degree())),
                poles: Some(spline.pole_counts()),
                rational: spline.weights().is_some(),
                ..plain
            },
            Surface::Bezier(bezier) => {
                let (u, v) = (bezier.nurbs().knots_u(), bezier.nurbs().knots_v());
                Self {
                    degree: Some([u.degree(), v.degree()]),
                    poles: Some([u.len(), v.len()]),
                    rational: bezier.nurbs().weights().is_some(),
                    ..plain
                }
            }
            _ => plain,
        }
    }
}

/// Whether every edge of these faces is used twice by them.
fn is_closed(topology: &Topology, faces: &[usize]) -> bool {
    let mut uses = vec![0; topology.edges.len()];
    for coedge in faces.iter().flat_map(|&face| topology.faces[face].wires.iter().flatten()) {
        uses[coedge.edge] += 1;
    }
    uses.iter().zip(&topology.edges).all(|(&uses, edge)| edge.degenerated || uses == 0 || uses == 2)
}

/// Points on an edge or across a face, each way.
const SAMPLES: usize = 33;

/// Box of the vertices and of samples on edges and faces; `None` without vertices.
fn bounding_box(brep: &Brep, topology: &Topology) -> Option<[[f64; 3]; 2]> {
    let mut points: Vec<DVec3> = topology.vertices.iter().map(|vertex| vertex.point).collect();
    for edge in &topology.edges {
        if let Some(curve) = edge.curve {
            points.extend(steps(edge.range).map(|t| brep.curves[curve].point(t)));
        }
    }
    for face in &topology.faces {
        let surface = &brep.surfaces[face.surface];
        points.extend(inner_parameters(brep, face).into_iter().map(|uv| surface.point(uv.x, uv.y)));
    }
    let first = *points.first()?;
    let (low, high) = points.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
    Some([low.to_array(), high.to_array()])
}

fn steps(range: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..SAMPLES).map(move |i| range[0] + (range[1] - range[0]) * i as f64 / (SAMPLES - 1) as f64)
}

/// Surface parameters on a grid within the face's wires; none where an edge has no trace, which is
/// so on planes only, whose extreme points lie on the edges.
fn inner_parameters(brep: &Brep, face: &FaceTopology) -> Vec<DVec2> {
    let mut segments: Vec<[DVec2; 2]> = Vec::new();
    for coedge in face.wires.iter().flatten() {
        let Some(pcurve) = coedge.pcurve else { return Vec::new() };
        let trace: Vec<DVec2> = steps(coedge.range).map(|t| brep.curves2d[pcurve].point(t)).collect();
        segments.extend(trace.windows(2).map(|pair| [pair[0], pair[1]]));
    }
    let Some(&[first, _]) = segments.first() else { return Vec::new() };
    let ends = segments.iter().flatten();
    let (low, high) = ends.fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
    let centre = |i: usize, j: usize| DVec2::new(i as f64 + 0.5, j as f64 + 0.5) / SAMPLES as f64;
    let grid = (0..SAMPLES * SAMPLES).map(|k| low + (high - low) * centre(k / SAMPLES, k % SAMPLES));
    grid.filter(|&uv| is_inside(&segments, uv)).collect()
}

/// Even-odd rule: a ray towards larger `u` crosses the segments an odd number of times.
fn is_inside(segments: &[[DVec2; 2]], p: DVec2) -> bool {
    let crossed = segments
        .iter()
        .filter(|[a, b]| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x));
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_are_outside() {
        let ring = |r: f64| {
            let corner = move |k: usize| r * DVec2::from_angle(k as f64 * std::f64::consts::FRAC_PI_2);
            (0..4).map(move |k| [corner(k), corner(k + 1)])
        };
        let segments: Vec<_> = ring(1.0).chain(ring(0.5)).collect();
        assert!(is_inside(&segments, DVec2::new(0.6, 0.1)));
        assert!(!is_inside(&segments, DVec2::new(0.1, 0.1)));
        assert!(!is_inside(&segments, DVec2::new(0.9, 0.9)));
    }
}
