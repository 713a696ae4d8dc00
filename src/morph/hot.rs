//! The input solid as the morph sees it: patches (surfaces as splines), faces (trimmed parts of
//! patches) and joints (edges with a pcurve on each side).

use super::planar;
use super::represent::represent;
use super::space::Space;
use super::trim::Trim;
use crate::brep::{Brep, Coedge, Curve2d, Curve3d, EdgeRepresentation, ShapeKind, Surface, Topology};
use crate::error::{Error, Result};
use crate::nurbs::{KnotVector, NurbsSurface};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Chords of a pcurve may miss it by this much in space, mm.
const CHORD_MM: f64 = 2e-4;
/// Pieces of a pcurve at least and at most (as powers of two).
const PIECES: [u32; 2] = [3, 10];
/// Ends of pcurves this close in space are one point, mm.
const SNAP_MM: f64 = 1e-2;

/// One surface of the solid, as a spline.
#[derive(Debug, Clone)]
pub struct Patch {
    /// Index of the surface in the B-rep.
    pub surface: usize,
    /// Faces on it.
    pub faces: Vec<usize>,
    /// The spline, over the window that the faces need.
    pub hot: NurbsSurface,
    /// Where its displacement starts from: the spline's own knots where they are the input's, one
    /// span where they only approximate it.
    pub space: Space,
    /// Whether the spline's poles are the input's own.
    pub own_poles: bool,
    /// Number of poles of an input spline of such degree that a user may edit them.
    pub user_poles: Option<usize>,
    /// What the spline misses of the input surface, mm.
    pub error_mm: f64,
    /// Corners of the box that the faces cover in the parameter plane.
    pub window: [DVec2; 2],
}

/// A trimmed part of a patch.
#[derive(Debug, Clone)]
pub struct HotFace {
    /// Its patch.
    pub patch: usize,
    /// Its part of the parameter plane.
    pub trim: Trim,
    /// The outward normal is −(S_u × S_v).
    pub reversed: bool,
}

/// One side of a joint.
#[derive(Debug, Clone)]
pub struct Side {
    /// The face.
    pub face: usize,
    /// Its patch.
    pub patch: usize,
    /// The edge in the parameters of the patch.
    pub pcurve: Curve2d,
    /// The wire walks the edge backwards.
    pub reversed: bool,
    /// The B-rep stores no pcurve here (a plane).
    pub unstored: bool,
}

/// An edge.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Its curve in space; none where it is a single point.
    pub curve: Option<Curve3d>,
    /// First and last parameter, of the curve and of the pcurves.
    pub range: [f64; 2],
    /// Two sides, or one at a degenerate point.
    pub sides: Vec<Side>,
    /// Vertices at the first and the last parameter.
    pub vertices: [Option<usize>; 2],
    /// A single point, such as a sphere's pole.
    pub degenerated: bool,
}

impl Joint {
    /// The parameter at fraction `s` of the edge.
    pub fn parameter(&self, s: f64) -> f64 {
        self.range[0] + s * (self.range[1] - self.range[0])
    }
}

/// The whole solid.
#[derive(Debug, Clone)]
pub struct Hot {
    /// Faces, edges and vertices of the B-rep.
    pub topology: Topology,
    /// Surfaces.
    pub patches: Vec<Patch>,
    /// Faces, in the solid's order.
    pub faces: Vec<HotFace>,
    /// Edges, in the solid's order.
    pub joints: Vec<Joint>,
}

impl Hot {
    /// Looks at a B-rep that holds one solid, without locations.
    ///
    /// # Errors
    /// [`Error::Solid`] where the shell is open or not manifold, [`Error::Face`] for a face whose
    /// geometry cannot be used.
    pub fn new(brep: &Brep) -> Result<Self> {
        let topology = Topology::new(brep)?;
        let uses = coedges_of_edges(&topology);
        check_closed(&topology, &uses)?;
        let mut joints = joints(brep, &topology, &uses)?;
        let (windows, patch_of_face) = windows(brep, &topology, &joints)?;
        for joint in &mut joints {
            for side in &mut joint.sides {
                side.patch = patch_of_face[side.face];
            }
        }
        let patches =
            windows.into_par_iter().with_max_len(1).map(|w| w.patch(brep)).collect::<Result<Vec<_>>>()?;
        let faces = (0..topology.faces.len())
            .into_par_iter()
            .map(|f| hot_face(&topology, &joints, &patches, patch_of_face[f], f))
            .collect();
        Ok(Self { topology, patches, faces, joints })
    }
}

/// Where each edge is used: face and coedge.
fn coedges_of_edges(topology: &Topology) -> Vec<Vec<(usize, Coedge)>> {
    let mut uses = vec![Vec::new(); topology.edges.len()];
    for (f, face) in topology.faces.iter().enumerate() {
        for coedge in face.wires.iter().flatten() {
            uses[coedge.edge].push((f, coedge.clone()));
        }
    }
    uses
}

fn check_closed(topology: &Topology, uses: &[Vec<(usize, Coedge)>]) -> Result<()> {
    let bad = |e: usize| uses[e].len() != 2 && !topology.edges[e].degenerated && !uses[e].is_empty();
    let Some(first) = (0..uses.len()).find(|&e| bad(e)) else { return Ok(()) };
    let count = (0..uses.len()).filter(|&e| bad(e)).count();
    let faces: Vec<String> = uses[first].iter().map(|u| (u.0 + 1).to_string()).collect();
    Err(Error::Solid {
        why: format!(
            "the shell is not closed: {count} of {} edges do not join exactly two faces (first: edge {}, on face {}); \
             sew the faces into a solid first",
            uses.len(),
            first + 1,
            faces.join(", ")
        ),
    })
}

fn joints(brep: &Brep, topology: &Topology, uses: &[Vec<(usize, Coedge)>]) -> Result<Vec<Joint>> {
    topology
        .edges
        .iter()
        .zip(uses)
        .map(|(edge, uses)| {
            let curve = edge.curve.map(|c| brep.curves[c].clone());
            let sides = uses
                .iter()
                .map(|(f, coedge)| side(brep, topology, *f, coedge, curve.as_ref(), edge.range))
                .collect::<Result<_>>()?;
            Ok(Joint {
                curve,
                range: edge.range,
                sides,
                vertices: edge.vertices,
                degenerated: edge.degenerated,
            })
        })
        .collect()
}

fn side(
    brep: &Brep,
    topology: &Topology,
    face: usize,
    coedge: &Coedge,
    curve: Option<&Curve3d>,
    range: [f64; 2],
) -> Result<Side> {
    let fail = |why: &str| Error::Face { face: face + 1, why: format!("edge {}: {why}", coedge.edge + 1) };
    let (pcurve, unstored) =
        match (coedge.pcurve, curve, plane_of(&brep.surfaces[topology.faces[face].surface])) {
            (Some(p), ..) => (brep.curves2d[p].clone(), false),
            (None, Some(curve), Some(plane)) => (planar::pcurve(plane, curve, range)?, true),
            _ => {
                return Err(fail(
                    "has no pcurve; repair the solid (for example by exporting it again) and retry",
                ));
            }
        };
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (range[1] - range[0]).abs();
    if coedge.pcurve.is_some() && !(close(coedge.range[0], range[0]) && close(coedge.range[1], range[1])) {
        return Err(fail("curve and pcurve have different parameter ranges; repair the solid and retry"));
    }
    Ok(Side { face, patch: 0, pcurve, reversed: coedge.reversed, unstored })
}

fn plane_of(surface: &Surface) -> Option<&crate::brep::Frame<DVec3>> {
    match surface {
        Surface::Plane(frame) => Some(frame),
        Surface::Trimmed { basis, .. } => plane_of(basis),
        _ => None,
    }
}

/// A surface in use, with the window that its faces need.
struct Window {
    surface: usize,
    faces: Vec<usize>,
    corners: [DVec2; 2],
}

impl Window {
    fn patch(self, brep: &Brep) -> Result<Patch> {
        let [low, high] = self.corners;
        let r = represent(&brep.surfaces[self.surface], low, high)
            .map_err(|e| Error::Face { face: self.faces[0] + 1, why: e.to_string() })?;
        let start = |k: &KnotVector| -> Result<KnotVector> {
            let (a, b) = k.domain();
            if r.own_poles { Ok(k.clone()) } else { KnotVector::clamped(k.degree(), &[a, b]) }
        };
        Ok(Patch {
            space: Space { ku: start(r.surface.knots_u())?, kv: start(r.surface.knots_v())? },
            surface: self.surface,
            faces: self.faces,
            hot: r.surface,
            own_poles: r.own_poles,
            user_poles: r.user_poles,
            error_mm: r.error_mm,
            window: self.corners,
        })
    }
}

/// One window for each surface in use, and each face's place among them.
fn windows(brep: &Brep, topology: &Topology, joints: &[Joint]) -> Result<(Vec<Window>, Vec<usize>)> {
    let mut windows: Vec<Window> = Vec::new();
    let mut of_face = Vec::new();
    let boxes = outline_boxes(topology, joints);
    for (f, face) in topology.faces.iter().enumerate() {
        let [low, high] = if face.wires.is_empty() { whole(&brep.surfaces[face.surface]) } else { boxes[f] };
        let usable = low.is_finite() && high.is_finite() && low.cmplt(high).all();
        if !usable {
            return Err(Error::Face {
                face: f + 1,
                why: format!("its outline spans no area ({low} to {high})"),
            });
        }
        let at = windows.iter().position(|w| w.surface == face.surface).unwrap_or_else(|| {
            windows.push(Window { surface: face.surface, faces: Vec::new(), corners: [low, high] });
            windows.len() - 1
        });
        let window = &mut windows[at];
        window.faces.push(f);
        window.corners = [window.corners[0].min(low), window.corners[1].max(high)];
        of_face.push(at);
    }
    Ok((windows, of_face))
}

/// Boxes around the pcurves of each face.
fn outline_boxes(topology: &Topology, joints: &[Joint]) -> Vec<[DVec2; 2]> {
    let mut boxes = vec![[DVec2::MAX, DVec2::MIN]; topology.faces.len()];
    for joint in joints {
        for side in &joint.sides {
            let b = &mut boxes[side.face];
            for k in 0..=64 {
                let p = side.pcurve.point(joint.parameter(k as f64 / 64.0));
                *b = [b[0].min(p), b[1].max(p)];
            }
        }
    }
    boxes
}

/// The natural box of a surface that a face covers without wires.
fn whole(surface: &Surface) -> [DVec2; 2] {
    let [u, v] = surface.domain();
    [DVec2::new(u[0], v[0]), DVec2::new(u[1], v[1])]
}

fn hot_face(topology: &Topology, joints: &[Joint], patches: &[Patch], patch: usize, face: usize) -> HotFace {
    let hot = &patches[patch].hot;
    let mut lines = Vec::new();
    for joint in joints {
        for side in joint.sides.iter().filter(|s| s.face == face) {
            lines.push(polyline(hot, joint, side));
        }
    }
    let [low, high] = patches[patch].window;
    if lines.is_empty() {
        let corner = |x: f64, y: f64| DVec2::new(x, y);
        lines.push(vec![low, corner(high.x, low.y), high, corner(low.x, high.y), low]);
    }
    let d = hot.derivatives(0.5 * (low.x + high.x), 0.5 * (low.y + high.y));
    let limit = 1e-3 * (high - low);
    let snap = DVec2::new(SNAP_MM / d.u.length(), SNAP_MM / d.v.length()).min(limit);
    HotFace { patch, trim: Trim::new(&lines, snap), reversed: topology.faces[face].reversed }
}

/// The pcurve as chords that follow it in space.
fn polyline(hot: &NurbsSurface, joint: &Joint, side: &Side) -> Vec<DVec2> {
    let at = |s: f64| side.pcurve.point(joint.parameter(s));
    let on = |p: DVec2| hot.point(p.x, p.y);
    let mut out = vec![at(0.0)];
    let first = 1 << PIECES[0];
    // Depth first: (start, end, depth), the earliest piece on top.
    let mut stack: Vec<(f64, f64, u32)> = (0..first)
        .rev()
        .map(|k| (k as f64 / first as f64, (k + 1) as f64 / first as f64, PIECES[0]))
        .collect();
    while let Some((a, b, depth)) = stack.pop() {
        let middle = 0.5 * (a + b);
        let (pa, pb, pm) = (at(a), at(b), at(middle));
        if depth < PIECES[1] && (on(0.5 * (pa + pb)) - on(pm)).length() > CHORD_MM {
            stack.push((middle, b, depth + 1));
            stack.push((a, middle, depth + 1));
        } else {
            out.push(pb);
        }
    }
    out
}

/// Adds the pcurves that planes do not store: a plane that became a spline needs them.
pub fn store_planar_pcurves(brep: &mut Brep, hot: &Hot) {
    for (edge, joint) in hot.joints.iter().enumerate() {
        let shape = hot.topology.edges[edge].shape;
        let mut stored = Vec::new();
        for side in joint.sides.iter().filter(|s| s.unstored) {
            // Two faces on one plane share the pcurve of their common edge.
            if stored.contains(&side.patch) {
                continue;
            }
            stored.push(side.patch);
            let pcurve = brep.curves2d.len();
            brep.curves2d.push(side.pcurve.clone());
            let surface = hot.patches[side.patch].surface;
            let ends = (brep.version == 2).then(|| joint.range.map(|t| side.pcurve.point(t)));
            if let ShapeKind::Edge(e) = &mut brep.shapes[shape].kind {
                let range = joint.range;
                e.representations.push(EdgeRepresentation::Pcurve {
                    pcurve,
                    surface,
                    location: 0,
                    range,
                    ends,
                });
            }
        }
    }
}
