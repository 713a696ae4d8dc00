//! The nearest points of a curve, globally: branch and bound over its Bézier pieces, as for
//! surfaces (Lüken 2022, algorithm 5, printed as a root search of the distance, made a sound
//! minimisation).

use super::bezier::{CurvePiece, curve_pieces};
use super::{HALVINGS, Nearest, Pending, SAME, distinct, stationary};
use crate::error::Result;
use crate::nurbs::{NurbsCurve, Point};
use std::collections::BinaryHeap;

/// Places on a piece at which its derivatives are looked at.
const SAMPLES: usize = 5;
/// The smallest speed squared on a piece may be this fraction of the smallest one seen.
const SPEED_MARGIN: f64 = 0.5;
/// The largest second derivative on a piece may be this many times the largest one seen.
const BEND_MARGIN: f64 = 1.5;
/// Pieces are prepared so small that their size stays below this fraction of the distance up to
/// which they are convex.
const SLACK: f64 = 0.5;
/// Halvings of a piece while preparing.
const DEPTH: usize = 8;
/// Pieces below this fraction of the coordinates are points.
const SMALLEST: f64 = 1e-10;
/// Newton steps at most.
const STEPS: usize = 40;

/// A tube around a chord that holds a stretch of the curve.
#[derive(Debug, Clone, Copy)]
struct Tube<P> {
    start: P,
    chord: P,
    /// 1 over the chord's squared length; 0 for a closed stretch.
    inverse: f64,
    radius: f64,
}

impl<P: Point> Tube<P> {
    fn new(points: &[P]) -> Self {
        let start = points[0];
        let chord = points[points.len() - 1] - start;
        let squared = chord.dot(chord);
        let inverse = if squared > 0.0 { 1.0 / squared } else { 0.0 };
        let mut tube = Self { start, chord, inverse, radius: 0.0 };
        tube.radius = points.iter().map(|&x| tube.off_chord(x)).fold(0.0, f64::max);
        tube
    }

    fn off_chord(&self, p: P) -> f64 {
        let r = p - self.start;
        let s = (r.dot(self.chord) * self.inverse).clamp(0.0, 1.0);
        (r - self.chord * s).length()
    }

    /// A lower bound of the distance to `p`.
    fn nearest(&self, p: P) -> f64 {
        (self.off_chord(p) - self.radius).max(0.0)
    }
}

/// A piece with its bounds.
#[derive(Debug, Clone)]
struct Arc<P> {
    piece: CurvePiece<P>,
    tube: Tube<P>,
    /// Point and first derivative in the middle.
    middle: [P; 2],
    /// Largest distance of a control point from the middle.
    size: f64,
    /// Distance up to which the squared distance is convex on the piece.
    convex: f64,
    depth: usize,
}

impl<P: Point> Arc<P> {
    fn new(curve: &NurbsCurve<P>, piece: CurvePiece<P>, depth: usize) -> Self {
        let points: Vec<P> = piece.points().collect();
        let [a, b] = piece.range;
        let (mut speed, mut bend) = (f64::INFINITY, 0.0f64);
        for k in 0..SAMPLES {
            let [_, d, dd] = curve.derivatives(a + (b - a) * k as f64 / (SAMPLES - 1) as f64);
            speed = speed.min(d.dot(d));
            bend = bend.max(dd.length());
        }
        let [c, d, _] = curve.derivatives(0.5 * (a + b));
        let size = points.iter().map(|&x| (x - c).length()).fold(0.0, f64::max);
        let convex = SPEED_MARGIN * speed / (BEND_MARGIN * bend).max(f64::MIN_POSITIVE);
        Self { tube: Tube::new(&points), piece, middle: [c, d], size, convex, depth }
    }

    fn halves(self, curve: &NurbsCurve<P>) -> [Self; 2] {
        self.piece.halves().map(|half| Self::new(curve, half, self.depth + 1))
    }

    fn is_convex(&self, p: P) -> bool {
        (p - self.middle[0]).length() + self.size < self.convex
    }

    fn start(&self, p: P) -> f64 {
        let [a, b] = self.piece.range;
        let [c, d] = self.middle;
        let step = (p - c).dot(d) / d.dot(d).max(f64::MIN_POSITIVE);
        (0.5 * (a + b) + step).clamp(a, b)
    }
}

/// Finds the nearest points of one curve; made once, asked often.
#[derive(Debug, Clone)]
pub struct CurveInverter<P: Point> {
    curve: NurbsCurve<P>,
    arcs: Vec<Arc<P>>,
    /// Tubes of the implicit binary tree over the arcs: node `k` has the children `2k + 1` and
    /// `2k + 2`; leaves are the arcs, from node `arcs.len() − 1` on.
    tubes: Vec<Tube<P>>,
}

impl<P: Point> CurveInverter<P> {
    /// Prepares a curve.
    ///
    /// # Errors
    /// As [`NurbsCurve::insert_knot`].
    pub fn new(curve: &NurbsCurve<P>) -> Result<Self> {
        let curve = curve.clamped()?;
        let mut rest: Vec<Arc<P>> =
            curve_pieces(&curve)?.into_iter().rev().map(|p| Arc::new(&curve, p, 0)).collect();
        let mut arcs = Vec::new();
        while let Some(arc) = rest.pop() {
            if arc.depth < DEPTH && arc.size > SLACK * arc.convex {
                let [a, b] = arc.halves(&curve);
                rest.extend([b, a]);
            } else {
                arcs.push(arc);
            }
        }
        let mut this = Self { curve, arcs, tubes: Vec::new() };
        this.build();
        Ok(this)
    }

    /// The curve.
    pub fn curve(&self) -> &NurbsCurve<P> {
        &self.curve
    }

    /// Arcs below a node, as a range of leaves; leaves of a complete tree wrap around its last
    /// level, so a node's arcs are gathered from its children.
    fn build(&mut self) {
        let n = self.arcs.len();
        let mut points: Vec<Vec<P>> = vec![Vec::new(); n - 1];
        points.extend(self.arcs.iter().map(|arc| arc.piece.points().collect::<Vec<P>>()));
        for k in (0..n - 1).rev() {
            let (a, b) = (points[2 * k + 1].clone(), &points[2 * k + 2]);
            points[k] = a.into_iter().chain(b.iter().copied()).collect();
        }
        self.tubes = points.iter().map(|p| Tube::new(p)).collect();
    }

    /// The nearest point to `p`, globally.
    pub fn nearest(&self, p: P) -> Nearest<f64, P> {
        let mut search = Search::new(&self.curve, p, None);
        self.descend(&mut search);
        search.best
    }

    /// All points of the curve that are as near to `p` as the nearest, to within `tie` (in the
    /// unit of the points), the nearest first. Where a whole stretch is, some of its points.
    pub fn nearest_all(&self, p: P, tie: f64) -> Vec<Nearest<f64, P>> {
        let mut search = Search::new(&self.curve, p, Some(tie));
        self.descend(&mut search);
        search.ties()
    }

    fn descend(&self, search: &mut Search<'_, P>) {
        let inner = self.arcs.len() - 1;
        let mut stack = [(0usize, 0.0f64); 64];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (at, bound) = stack[height];
            if search.excludes(bound) {
                continue;
            }
            if at >= inner {
                search.visit(&self.arcs[at - inner]);
                continue;
            }
            let child = |k: usize| (k, self.tubes[k].nearest(search.p));
            let (a, b) = (child(2 * at + 1), child(2 * at + 2));
            let (near, far) = if a.1 <= b.1 { (a, b) } else { (b, a) };
            stack[height] = far;
            stack[height + 1] = near;
            height += 2;
        }
        search.finish();
    }
}

/// One query.
struct Search<'a, P: Point> {
    curve: &'a NurbsCurve<P>,
    p: P,
    best: Nearest<f64, P>,
    tie: Option<f64>,
    found: Vec<Nearest<f64, P>>,
    rest: BinaryHeap<Pending<Arc<P>>>,
}

impl<'a, P: Point> Search<'a, P> {
    fn new(curve: &'a NurbsCurve<P>, p: P, tie: Option<f64>) -> Self {
        let best = Nearest { at: 0.0, point: P::default(), distance: f64::INFINITY };
        Self { curve, p, best, tie, found: Vec::new(), rest: BinaryHeap::new() }
    }

    /// Whether nothing at so large a distance is wanted.
    fn excludes(&self, distance: f64) -> bool {
        match self.tie {
            None => distance >= self.best.distance,
            Some(tie) => distance > self.best.distance + tie,
        }
    }

    fn take(&mut self, found: Nearest<f64, P>) {
        if found.distance < self.best.distance {
            self.best = found;
        }
        if self.tie.is_some_and(|tie| found.distance <= self.best.distance + tie) {
            self.found.push(found);
        }
    }

    fn visit(&mut self, arc: &Arc<P>) {
        if self.excludes(arc.tube.nearest(self.p)) {
            return;
        }
        self.take(foot(self.curve, self.p, arc.start(self.p), arc.piece.range));
        if !arc.is_convex(self.p) && arc.size > SMALLEST * (1.0 + self.p.length()) {
            self.rest.push(Pending { bound: arc.tube.nearest(self.p), piece: arc.clone() });
        }
    }

    /// Halves the pieces on which there may be more minima.
    fn finish(&mut self) {
        for _ in 0..HALVINGS {
            let Some(next) = self.rest.pop() else { break };
            if self.excludes(next.bound) {
                break;
            }
            next.piece.halves(self.curve).iter().for_each(|half| self.visit(half));
        }
    }

    fn ties(mut self) -> Vec<Nearest<f64, P>> {
        let reach = self.best.distance + self.tie.unwrap_or(0.0);
        self.found.retain(|f| f.distance <= reach);
        self.found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let (a, b) = self.curve.knots().domain();
        // The ends of pieces are no minima of the curve.
        self.found.retain(|f| {
            let [c, d, _] = self.curve.derivatives(f.at);
            let r = c - self.p;
            stationary(f.at, (a, b), r.dot(d), r.length() * d.length())
        });
        distinct(self.found, |x, y| (x.at - y.at).abs() < SAME * (b - a))
    }
}

/// The minimum of the distance within `range` from `start`: safeguarded Newton steps on
/// `(C − P)·C′`, with the second derivative `|C′|² + (C − P)·C″` (*The NURBS Book*, eq. 6.4).
fn foot<P: Point>(curve: &NurbsCurve<P>, p: P, start: f64, [a, b]: [f64; 2]) -> Nearest<f64, P> {
    let mut t = start;
    let [mut c, mut d, mut dd] = curve.derivatives(t);
    for _ in 0..STEPS {
        let r = c - p;
        let (gradient, speed) = (r.dot(d), d.dot(d));
        let bent = speed + r.dot(dd);
        let second = if bent > 0.1 * speed { bent } else { speed };
        let mut next = (t - gradient / second.max(f64::MIN_POSITIVE)).clamp(a, b);
        let mut jet = curve.derivatives(next);
        let better = |x: P| (x - p).dot(x - p) <= r.dot(r) * (1.0 + 1e-14);
        for _ in 0..20 {
            if better(jet[0]) {
                break;
            }
            next = 0.5 * (t + next);
            jet = curve.derivatives(next);
        }
        let moved = (next - t).abs();
        t = next;
        [c, d, dd] = jet;
        if moved <= 4.0 * f64::EPSILON * a.abs().max(b.abs()) {
            break;
        }
    }
    Nearest { at: t, point: c, distance: (c - p).length() }
}
