//! The search that curves and surfaces share: branch and bound over pieces, the nearest first.

use super::Nearest;
use crate::nurbs::Point;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The smallest metric on a piece may be this fraction of the smallest one seen.
pub const METRIC_MARGIN: f64 = 0.5;
/// The largest second derivatives on a piece may be this many times the largest ones seen.
pub const BEND_MARGIN: f64 = 1.5;
/// Pieces are prepared so small that their size stays below this fraction of the distance up to
/// which they are convex.
pub const SLACK: f64 = 0.5;
/// Pieces below this fraction of the coordinates are points.
const SMALLEST: f64 = 1e-10;
/// A slope of the squared distance below this fraction of speed times distance is zero.
const SLOPE: f64 = 1e-9;
/// Halvings in one query at most: only a point from which a whole arc or cap is equally far, the
/// centre of a sphere, asks for more, and then any of its points is right.
const HALVINGS: usize = 4096;

/// A curve or surface whose nearest points are sought.
pub trait Shape {
    /// Parameters.
    type At: Copy;
    /// Points.
    type Point: Point;
    /// Pieces with their bounds.
    type Piece: Clone;

    /// A lower bound of the squared distance from a piece.
    fn bound(piece: &Self::Piece, p: Self::Point) -> f64;
    /// Whether the squared distance is convex on the piece.
    fn is_convex(piece: &Self::Piece, p: Self::Point) -> bool;
    /// Size of the piece, in the unit of the points.
    fn size(piece: &Self::Piece) -> f64;
    /// A local minimum of the distance within the piece; the only one where it is convex.
    fn foot(&self, piece: &Self::Piece, p: Self::Point) -> Nearest<Self::At, Self::Point>;
    /// Both halves of a piece.
    fn halves(&self, piece: Self::Piece) -> [Self::Piece; 2];
    /// Whether the distance has a minimum there: the ends of pieces alone are none.
    fn is_minimum(&self, at: Self::At, p: Self::Point) -> bool;
    /// Whether both parameters are one place.
    fn same(&self, a: Self::At, b: Self::At) -> bool;
}

/// What stands below a node of a tree of pieces.
pub enum Below<'t, T> {
    /// Pieces.
    Pieces(&'t [T]),
    /// Two nodes.
    Nodes([usize; 2]),
}

/// One query.
pub struct Search<'a, S: Shape> {
    shape: &'a S,
    p: S::Point,
    /// The nearest point so far.
    pub best: Nearest<S::At, S::Point>,
    best_squared: f64,
    tie: Option<f64>,
    found: Vec<Nearest<S::At, S::Point>>,
    rest: BinaryHeap<Pending<S::Piece>>,
}

impl<'a, S: Shape> Search<'a, S> {
    /// For the nearest point to `p`, and with `tie` for all that are as near to within so much.
    pub fn new(shape: &'a S, start: S::At, p: S::Point, tie: Option<f64>) -> Self {
        let best = Nearest { at: start, point: p, distance: f64::INFINITY };
        let (best_squared, found, rest) = (f64::INFINITY, Vec::new(), BinaryHeap::new());
        Self { shape, p, best, best_squared, tie, found, rest }
    }

    /// Visits a tree from node 0, the nearer child first; `bound` is a lower bound of the squared
    /// distance from a node.
    pub fn descend<'t>(
        &mut self,
        below: impl Fn(usize) -> Below<'t, S::Piece>,
        bound: impl Fn(usize, S::Point) -> f64,
    ) where
        S::Piece: 't,
    {
        let mut stack = [(0usize, 0.0f64); 64];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (at, least) = stack[height];
            if self.excludes(least) {
                continue;
            }
            match below(at) {
                Below::Pieces(pieces) => pieces.iter().for_each(|piece| self.visit(piece)),
                Below::Nodes([a, b]) => {
                    let (a, b) = ((a, bound(a, self.p)), (b, bound(b, self.p)));
                    (stack[height], stack[height + 1]) = if a.1 <= b.1 { (b, a) } else { (a, b) };
                    height += 2;
                }
            }
        }
        self.finish();
    }

    /// Whether nothing at so large a squared distance is wanted.
    fn excludes(&self, squared: f64) -> bool {
        match self.tie {
            None => squared >= self.best_squared,
            Some(tie) => squared.sqrt() > self.best.distance + tie,
        }
    }

    fn visit(&mut self, piece: &S::Piece) {
        let bound = S::bound(piece, self.p);
        if self.excludes(bound) {
            return;
        }
        let found = self.shape.foot(piece, self.p);
        if found.distance < self.best.distance {
            (self.best, self.best_squared) = (found, found.distance * found.distance);
        }
        if self.tie.is_some_and(|tie| found.distance <= self.best.distance + tie) {
            self.found.push(found);
        }
        if !S::is_convex(piece, self.p) && S::size(piece) > SMALLEST * (1.0 + self.p.length()) {
            self.rest.push(Pending { bound, piece: piece.clone() });
        }
    }

    /// Halves the pieces on which there may be more minima.
    fn finish(&mut self) {
        for _ in 0..HALVINGS {
            let Some(next) = self.rest.pop() else { break };
            if self.excludes(next.bound) {
                break;
            }
            self.shape.halves(next.piece).iter().for_each(|half| self.visit(half));
        }
    }

    /// The nearest points found, each place once, the nearest first.
    pub fn ties(mut self) -> Vec<Nearest<S::At, S::Point>> {
        let reach = self.best.distance + self.tie.unwrap_or(0.0);
        self.found.retain(|f| f.distance <= reach && self.shape.is_minimum(f.at, self.p));
        self.found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let mut out: Vec<Nearest<S::At, S::Point>> = Vec::new();
        for f in self.found {
            if !out.iter().any(|known| self.shape.same(known.at, f.at)) {
                out.push(f);
            }
        }
        out
    }
}

/// Whether a parameter at which the squared distance rises by `slope` for each unit of `scale` is a
/// minimum within `range`.
pub fn stationary(t: f64, range: (f64, f64), slope: f64, scale: f64) -> bool {
    let steep = SLOPE * scale;
    (slope <= steep || t <= range.0) && (slope >= -steep || t >= range.1)
}

/// A piece that waits to be halved, the nearest first.
struct Pending<T> {
    bound: f64,
    piece: T,
}

impl<T> PartialEq for Pending<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<T> Eq for Pending<T> {}

impl<T> PartialOrd for Pending<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Pending<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}
