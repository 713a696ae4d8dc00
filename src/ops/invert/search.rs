//! The search that curves and surfaces share: branch and bound over pieces, the nearest first.

use super::Nearest;
use super::tree::Tree;
use crate::nurbs::Point;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Pieces below this fraction of the whole are points.
const SMALLEST: f64 = 1e-10;
/// A slope of the squared distance below this fraction of speed times distance is zero.
const SLOPE: f64 = 1e-9;
/// Halvings in one query at most: only a point from which a whole arc or cap is equally far, the
/// centre of a sphere, asks for more, and then any of its points is right.
const HALVINGS: usize = 4096;

/// A curve or surface whose nearest points are sought.
pub trait Shape {
    /// Parameters.
    type At: Copy + Default;
    /// Points.
    type Point: Point;
    /// Pieces with their bounds.
    type Piece: Clone;
    /// What holds a piece.
    type Hull: Copy;

    /// Size of the whole, in the unit of the points.
    fn extent(&self) -> f64;
    /// What holds a piece.
    fn hull(piece: &Self::Piece) -> Self::Hull;
    /// A lower bound of the squared distance from a hull.
    fn bound(hull: &Self::Hull, p: Self::Point) -> f64;
    /// Size of the piece, in the unit of the points.
    fn size(piece: &Self::Piece) -> f64;
    /// A local minimum of the distance within the piece, and whether nothing on it is nearer.
    fn foot(&self, piece: &Self::Piece, p: Self::Point) -> (Nearest<Self::At, Self::Point>, bool);
    /// Both halves of a piece.
    fn halves(&self, piece: Self::Piece) -> [Self::Piece; 2];
    /// Whether the distance has a minimum there: the ends of pieces alone are none.
    fn is_minimum(&self, at: Self::At, p: Self::Point) -> bool;
    /// Whether both parameters are one place.
    fn same(&self, a: Self::At, b: Self::At) -> bool;
}

/// One query.
pub struct Search<'a, S: Shape> {
    shape: &'a S,
    p: S::Point,
    /// The nearest point so far.
    pub best: Nearest<S::At, S::Point>,
    /// Beyond this squared distance nothing matters.
    reach_squared: f64,
    tie: Option<f64>,
    found: Vec<Nearest<S::At, S::Point>>,
    rest: BinaryHeap<Pending<S::Piece>>,
}

impl<'a, S: Shape> Search<'a, S> {
    /// For the nearest point to `p`, and with `tie` for all that are as near to within so much.
    /// `known` is some point of the shape, if one is known.
    pub fn new(shape: &'a S, p: S::Point, tie: Option<f64>, known: Option<Nearest<S::At, S::Point>>) -> Self {
        let none = Nearest { at: S::At::default(), point: p, distance: f64::INFINITY };
        let best = known.map_or(none, |k| Nearest { distance: (k.point - p).length(), ..k });
        let mut search =
            Self { shape, p, best, reach_squared: 0.0, tie, found: Vec::new(), rest: BinaryHeap::new() };
        search.improve(best);
        search
    }

    /// Visits the pieces of a tree, the nearest first; their hulls stand side by side.
    pub fn descend(&mut self, tree: &Tree, pieces: &[S::Piece], hulls: &[S::Hull]) {
        let p = self.p;
        let bound = |leaf: usize| S::bound(&hulls[leaf], p);
        tree.descend(p.coordinates(), self.reach_squared, bound, |leaf, bound| {
            self.visit(&pieces[leaf], bound);
            self.reach_squared
        });
        self.finish();
    }

    fn improve(&mut self, best: Nearest<S::At, S::Point>) {
        let reach = best.distance + self.tie.unwrap_or(0.0);
        (self.best, self.reach_squared) = (best, reach * reach);
    }

    fn visit(&mut self, piece: &S::Piece, bound: f64) {
        if bound > self.reach_squared {
            return;
        }
        let (found, only) = self.shape.foot(piece, self.p);
        if found.distance < self.best.distance {
            self.improve(found);
        }
        if self.tie.is_some_and(|tie| found.distance <= self.best.distance + tie) {
            self.found.push(found);
        }
        let rounding = f64::EPSILON * self.p.length();
        if !only && S::size(piece) > SMALLEST * self.shape.extent() + rounding {
            self.rest.push(Pending { bound, piece: piece.clone() });
        }
    }

    /// Halves the pieces on which there may be more minima.
    fn finish(&mut self) {
        for _ in 0..HALVINGS {
            let Some(next) = self.rest.pop() else { break };
            if next.bound > self.reach_squared {
                break;
            }
            for half in self.shape.halves(next.piece) {
                let bound = S::bound(&S::hull(&half), self.p);
                self.visit(&half, bound);
            }
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
