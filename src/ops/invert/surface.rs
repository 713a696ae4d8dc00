//! The nearest points of a surface, globally: branch and bound over its Bézier pieces.
//!
//! Each piece carries a box around its control points, a lower bound of the distance by the convex
//! hull property, and the distance up to which the squared distance is convex on it. Within that
//! distance one Newton search finds the piece's only minimum; beyond it the piece is halved. The
//! descent that Newton steps alone promise (*The NURBS Book*, section 6.1) is local and depends on
//! its start.

use super::bezier::{SurfacePiece, surface_pieces};
use super::search::{BEND_MARGIN, Below, METRIC_MARGIN, SLACK, Search, Shape, stationary};
use super::{Nearest, SAME};
use crate::error::Result;
use crate::nurbs::{Direction, NurbsSurface, SurfaceDerivatives};
use crate::ops::closest::foot_within;
use glam::{DMat3, DVec2, DVec3};

/// Places along each side of a piece at which its derivatives are looked at.
const SAMPLES: usize = 3;
/// Halvings of a piece while preparing: more are left to the query that needs them.
const DEPTH: usize = 6;
/// Pieces in a leaf of the tree.
const LEAF: usize = 2;

/// A piece with its bounds.
#[derive(Debug, Clone)]
pub struct Patch {
    piece: SurfacePiece,
    low: DVec2,
    high: DVec2,
    centre: DVec3,
    /// Rows: directions of the box.
    frame: DMat3,
    /// The box around the control points in that frame.
    box_low: DVec3,
    box_high: DVec3,
    /// Largest distance of a control point from `centre`.
    radius: f64,
    /// Distance up to which the squared distance is convex on the piece; 0 if unknown.
    convex: f64,
    /// First derivatives in the middle.
    tangents: [DVec3; 2],
    depth: usize,
}

impl Patch {
    fn new(surface: &NurbsSurface, piece: SurfacePiece, depth: usize) -> Self {
        let [[u0, u1], [v0, v1]] = piece.range;
        let (low, high) = (DVec2::new(u0, v0), DVec2::new(u1, v1));
        let middle = 0.5 * (low + high);
        let d = surface.derivatives(middle.x, middle.y);
        let normal = d.normal().try_normalize();
        let (e1, n) = match (d.u.try_normalize(), normal) {
            (Some(e1), Some(n)) => (e1, n),
            _ => (DVec3::X, DVec3::Z),
        };
        let frame = DMat3::from_cols(e1, n.cross(e1), n).transpose();
        let (mut box_low, mut box_high, mut radius) = (DVec3::MAX, DVec3::MIN, 0.0f64);
        for x in piece.points() {
            let local = frame * (x - d.s);
            (box_low, box_high) = (box_low.min(local), box_high.max(local));
            radius = radius.max(local.length());
        }
        let convex = convex_distance(surface, low, high);
        let tangents = [d.u, d.v];
        Self { piece, low, high, centre: d.s, frame, box_low, box_high, radius, convex, tangents, depth }
    }

    /// A lower bound of the squared distance to `p`.
    fn nearest_squared(&self, p: DVec3) -> f64 {
        let local = self.frame * (p - self.centre);
        (self.box_low - local).max(local - self.box_high).max(DVec3::ZERO).length_squared()
    }

    /// Where the tangent plane in the middle is nearest to `p`, within the piece.
    fn start(&self, p: DVec3) -> DVec2 {
        let ([a, b], r) = (self.tangents, p - self.centre);
        let (guu, guv, gvv) = (a.dot(a), a.dot(b), b.dot(b));
        let det = guu * gvv - guv * guv;
        let middle = 0.5 * (self.low + self.high);
        if det <= 1e-12 * guu * gvv {
            return middle;
        }
        let (x, y) = (r.dot(a), r.dot(b));
        let step = DVec2::new(gvv * x - guv * y, guu * y - guv * x) / det;
        (middle + step).clamp(self.low, self.high)
    }

    /// Both halves, across the longer side.
    fn halves(self, surface: &NurbsSurface) -> [Self; 2] {
        let sides = self.high - self.low;
        let along = [self.tangents[0].length() * sides.x, self.tangents[1].length() * sides.y];
        // Where a side is degenerate, its parameter tells nothing.
        let direction = if along[0] >= along[1] { Direction::U } else { Direction::V };
        self.piece.halves(direction).map(|half| Self::new(surface, half, self.depth + 1))
    }

    fn corners(&self) -> [DVec3; 2] {
        let axes = self.frame.transpose();
        let middle = self.centre + axes * (0.5 * (self.box_low + self.box_high));
        let half = 0.5 * (self.box_high - self.box_low);
        let reach = axes.x_axis.abs() * half.x + axes.y_axis.abs() * half.y + axes.z_axis.abs() * half.z;
        [middle - reach, middle + reach]
    }
}

/// Distance of a point up to which its squared distance to the surface is convex over a rectangle:
/// the Hessian `G + (S − P)·S_ij` stays positive as long as `|S − P|` is less than the smallest
/// eigenvalue of `G` over the largest second derivative, in scaled parameters.
fn convex_distance(surface: &NurbsSurface, low: DVec2, high: DVec2) -> f64 {
    let at = |i: usize| i as f64 / (SAMPLES - 1) as f64;
    let place = |k: usize| low + (high - low) * DVec2::new(at(k / SAMPLES), at(k % SAMPLES));
    let all: [SurfaceDerivatives; SAMPLES * SAMPLES] = std::array::from_fn(|k| {
        let uv = place(k);
        surface.derivatives(uv.x, uv.y)
    });
    let scale = |f: fn(&SurfaceDerivatives) -> DVec3| {
        all.iter().map(|d| f(d).length()).sum::<f64>() / all.len() as f64
    };
    let (a, b) = (scale(|d| d.u), scale(|d| d.v));
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    let (mut metric, mut bend) = (f64::INFINITY, 0.0f64);
    for d in &all {
        let (u, v) = (d.u / a, d.v / b);
        let (guu, guv, gvv) = (u.dot(u), u.dot(v), v.dot(v));
        let mean = 0.5 * (guu + gvv);
        metric = metric.min(mean - (0.25 * (guu - gvv).powi(2) + guv * guv).sqrt());
        let (uu, uv, vv) = (d.uu / (a * a), d.uv / (a * b), d.vv / (b * b));
        bend = bend.max((uu.length_squared() + 2.0 * uv.length_squared() + vv.length_squared()).sqrt());
    }
    METRIC_MARGIN * metric / (BEND_MARGIN * bend).max(f64::MIN_POSITIVE)
}

/// A node of the tree over the patches.
#[derive(Debug, Clone, Copy)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// First patch and number of patches of a leaf; otherwise the first of two children, and 0.
    first: u32,
    count: u32,
}

impl Node {
    fn nearest_squared(&self, p: DVec3) -> f64 {
        (self.low - p).max(p - self.high).max(DVec3::ZERO).length_squared()
    }
}

/// Finds the nearest points of one surface; made once, asked often.
#[derive(Debug, Clone)]
pub struct SurfaceInverter {
    surface: NurbsSurface,
    patches: Vec<Patch>,
    nodes: Vec<Node>,
}

impl SurfaceInverter {
    /// Prepares a surface.
    ///
    /// # Errors
    /// As [`NurbsSurface::insert_knot`].
    pub fn new(surface: &NurbsSurface) -> Result<Self> {
        let surface = surface.clamped()?;
        let mut patches = Vec::new();
        let mut rest: Vec<Patch> =
            surface_pieces(&surface)?.into_iter().map(|p| Patch::new(&surface, p, 0)).collect();
        while let Some(patch) = rest.pop() {
            if patch.depth < DEPTH && patch.radius > SLACK * patch.convex {
                rest.extend(patch.halves(&surface));
            } else {
                patches.push(patch);
            }
        }
        let mut this = Self { surface, patches, nodes: Vec::new() };
        this.build();
        Ok(this)
    }

    /// The surface.
    pub fn surface(&self) -> &NurbsSurface {
        &self.surface
    }

    fn build(&mut self) {
        self.nodes.push(Node { low: DVec3::ZERO, high: DVec3::ZERO, first: 0, count: 0 });
        let mut rest = vec![(0usize, 0..self.patches.len())];
        while let Some((at, range)) = rest.pop() {
            let own = &mut self.patches[range.clone()];
            let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
            for [a, b] in own.iter().map(Patch::corners) {
                (low, high) = (low.min(a), high.max(b));
            }
            if range.len() <= LEAF {
                let (first, count) = (range.start as u32, range.len() as u32);
                self.nodes[at] = Node { low, high, first, count };
                continue;
            }
            let size = high - low;
            let axis = if size.x >= size.y.max(size.z) {
                0
            } else if size.y >= size.z {
                1
            } else {
                2
            };
            let half = range.len() / 2;
            own.select_nth_unstable_by(half, |a, b| a.centre[axis].total_cmp(&b.centre[axis]));
            let first = self.nodes.len();
            self.nodes[at] = Node { low, high, first: first as u32, count: 0 };
            let empty = self.nodes[at];
            self.nodes.extend([empty, empty]);
            rest.push((first, range.start..range.start + half));
            rest.push((first + 1, range.start + half..range.end));
        }
    }

    /// The nearest point to `p`, globally.
    pub fn nearest(&self, p: DVec3) -> Nearest<DVec2, DVec3> {
        self.search(p, None).best
    }

    /// All points of the surface that are as near to `p` as the nearest, to within `tie_mm`, the
    /// nearest first. Where a whole curve or area is, some of its points.
    pub fn nearest_all(&self, p: DVec3, tie_mm: f64) -> Vec<Nearest<DVec2, DVec3>> {
        self.search(p, Some(tie_mm)).ties()
    }

    fn search(&self, p: DVec3, tie_mm: Option<f64>) -> Search<'_, NurbsSurface> {
        let mut search = Search::new(&self.surface, DVec2::ZERO, p, tie_mm);
        let below = |at: usize| {
            let Node { first, count, .. } = self.nodes[at];
            let first = first as usize;
            match count as usize {
                0 => Below::Nodes([first, first + 1]),
                count => Below::Pieces(&self.patches[first..first + count]),
            }
        };
        search.descend(below, |at, p| self.nodes[at].nearest_squared(p));
        search
    }
}

impl Shape for NurbsSurface {
    type At = DVec2;
    type Point = DVec3;
    type Piece = Patch;

    fn bound(patch: &Patch, p: DVec3) -> f64 {
        patch.nearest_squared(p)
    }

    fn is_convex(patch: &Patch, p: DVec3) -> bool {
        (p - patch.centre).length() + patch.radius < patch.convex
    }

    fn size(patch: &Patch) -> f64 {
        patch.radius
    }

    fn foot(&self, patch: &Patch, p: DVec3) -> Nearest<DVec2, DVec3> {
        let foot = foot_within(self, p, patch.start(p), [patch.low, patch.high]);
        Nearest { at: foot.uv, point: foot.point, distance: foot.distance }
    }

    fn halves(&self, patch: Patch) -> [Patch; 2] {
        patch.halves(self)
    }

    fn is_minimum(&self, at: DVec2, p: DVec3) -> bool {
        let [s, u, v] = self.first_derivatives(at.x, at.y);
        let r = s - p;
        stationary(at.x, self.knots_u().domain(), r.dot(u), r.length() * u.length())
            && stationary(at.y, self.knots_v().domain(), r.dot(v), r.length() * v.length())
    }

    fn same(&self, a: DVec2, b: DVec2) -> bool {
        let [ku, kv] = [self.knots_u().domain(), self.knots_v().domain()];
        ((a - b) / DVec2::new(ku.1 - ku.0, kv.1 - kv.0)).length() < SAME
    }
}
