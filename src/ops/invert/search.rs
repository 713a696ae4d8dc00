//! The search that curves and surfaces share: branch and bound over pieces, the nearest first.

use super::Nearest;
use super::tree::{Bounds, Neighbour, Neighbours, Tree};
use crate::nurbs::Point;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::OnceLock;

/// Pieces below this fraction of the whole are points.
const SMALLEST: f64 = 1e-10;
/// A slope of the squared distance below this fraction of speed times distance is zero.
const SLOPE: f64 = 1e-9;
/// Halvings in one query at most: only a point from which a whole arc or cap is equally far, the
/// centre of a sphere, asks for more, and then any of its points is right.
const HALVINGS: usize = 4096;

/// Steps from a piece to a nearer one, at most.
const WALK: usize = 8;

/// A curve or surface whose nearest points are sought.
pub trait Shape {
    /// Parameters.
    type At: Copy + Default;
    /// Points.
    type Point: Point;
    /// Pieces with their bounds.
    type Piece: Clone + std::fmt::Debug;
    /// What holds a piece.
    type Hull: Copy + std::fmt::Debug;

    /// Size of the whole, in the unit of the points.
    fn extent(&self) -> f64;
    /// What holds a piece.
    fn hull(piece: &Self::Piece) -> Self::Hull;
    /// A box around a piece.
    fn bounds(piece: &Self::Piece) -> Bounds;
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

/// The pieces of a shape, so that near ones are found.
#[derive(Debug, Clone)]
pub struct Index<S: Shape> {
    pieces: Vec<S::Piece>,
    /// Side by side for the search.
    hulls: Vec<S::Hull>,
    tree: Tree,
    neighbours: OnceLock<Neighbours>,
}

impl<S: Shape> Index<S> {
    /// Of all pieces.
    pub fn new(mut pieces: Vec<S::Piece>) -> Self {
        let tree = Tree::new(&mut pieces, S::bounds);
        let hulls = pieces.iter().map(S::hull).collect();
        Self { pieces, hulls, tree, neighbours: OnceLock::new() }
    }

    fn neighbours(&self) -> &Neighbours {
        self.neighbours.get_or_init(|| {
            let boxes: Vec<Bounds> = self.pieces.iter().map(S::bounds).collect();
            Neighbours::new(&self.tree, &boxes)
        })
    }
}

/// One query.
pub struct Search<'a, S: Shape> {
    shape: &'a S,
    index: &'a Index<S>,
    p: S::Point,
    /// The nearest point so far.
    pub best: Nearest<S::At, S::Point>,
    /// The piece that it is on, or was before that was halved.
    pub nearest: usize,
    /// Beyond this squared distance nothing matters.
    reach_squared: f64,
    tie: Option<f64>,
    found: Vec<Nearest<S::At, S::Point>>,
    rest: BinaryHeap<Pending<S::Piece>>,
}

impl<'a, S: Shape> Search<'a, S> {
    /// For the nearest point to `p`, and with `tie` for all that are as near to within so much.
    pub fn new(shape: &'a S, index: &'a Index<S>, p: S::Point, tie: Option<f64>) -> Self {
        let best = Nearest { at: S::At::default(), point: p, distance: f64::INFINITY };
        let (found, rest) = (Vec::new(), BinaryHeap::new());
        Self { shape, index, p, best, nearest: 0, reach_squared: f64::INFINITY, tie, found, rest }
    }

    /// Finds what is nearest among all pieces.
    pub fn run(mut self) -> Self {
        self.descend();
        self.finish();
        self
    }

    /// The same where some piece is known from which the nearest cannot be far; `near` is scratch.
    ///
    /// A point of a piece at the distance `a` from `p` is at least as far from any other piece as the
    /// boxes of both are apart, and `p` by up to `a` less.
    pub fn run_near(mut self, guess: usize, near: &mut Vec<(f64, Neighbour)>) -> Self {
        let neighbours = self.index.neighbours();
        let Some(guess) = self.walk(neighbours, guess, near) else { return self.run() };
        let a = self.visit_leaf(guess, 0.0);
        let reach = neighbours.reach(guess);
        if reach > a {
            near.retain(|(bound, n)| n.leaf != guess && *bound <= self.reach_squared);
            near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            for (bound, n) in &*near {
                if n.gap <= a + self.best.distance {
                    self.visit_leaf(n.leaf, *bound);
                }
            }
        }
        if reach <= a + self.best.distance {
            self.descend();
        }
        self.finish();
        self
    }

    /// From piece to nearer piece, if it is not too far; `near` are those around the last.
    fn walk(
        &self,
        neighbours: &Neighbours,
        mut guess: usize,
        near: &mut Vec<(f64, Neighbour)>,
    ) -> Option<usize> {
        let bound = |leaf: usize| S::bound(&self.index.hulls[leaf], self.p);
        let mut least = bound(guess);
        for _ in 0..WALK {
            near.clear();
            near.extend(neighbours.of(guess).iter().map(|n| (bound(n.leaf), *n)));
            let from = guess;
            for &(bound, n) in near.iter() {
                if bound < least {
                    (least, guess) = (bound, n.leaf);
                }
            }
            if guess == from {
                return Some(guess);
            }
        }
        None
    }

    /// Visits the pieces of the tree, the nearest first.
    fn descend(&mut self) {
        let (index, p) = (self.index, self.p);
        let bound = |leaf: usize| S::bound(&index.hulls[leaf], p);
        index.tree.descend([p.coordinates(); 2], self.reach_squared, bound, |leaf, bound| {
            self.visit_leaf(leaf, bound);
            self.reach_squared
        });
    }

    /// Returns the distance of the foot there.
    fn visit_leaf(&mut self, leaf: usize, bound: f64) -> f64 {
        let before = self.best.distance;
        let distance = self.visit(&self.index.pieces[leaf], bound);
        if self.best.distance < before {
            self.nearest = leaf;
        }
        distance
    }

    fn improve(&mut self, best: Nearest<S::At, S::Point>) {
        let reach = best.distance + self.tie.unwrap_or(0.0);
        (self.best, self.reach_squared) = (best, reach * reach);
    }

    /// Returns the distance of the foot there.
    fn visit(&mut self, piece: &S::Piece, bound: f64) -> f64 {
        if bound > self.reach_squared {
            return f64::INFINITY;
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
        found.distance
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
