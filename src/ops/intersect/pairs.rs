//! The search over pairs of pieces.

use super::approach::{Piece, Place, nearest};
use super::contact::Contact;
use super::tree::{Node, Tree};
use super::{Intersections, Kind};
use crate::error::{Error, Result};
use crate::nurbs::Point;

/// Pairs looked at in one search, at most.
const PAIRS: usize = 1_000_000;
/// A piece not longer than this part of the tolerance is a point.
const POINT: f64 = 0.25;
/// The smallest tolerance, in units of the rounding of coordinates.
const ROUNDINGS: f64 = 4.0;

/// A place found, with parameters of the curves.
#[derive(Debug, Clone, Copy)]
pub struct Found<P> {
    /// Parameters on both curves.
    pub at: [f64; 2],
    /// The points.
    pub points: [P; 2],
    /// How far along each curve the distance stays within the tolerance.
    pub reach: f64,
    /// Speeds over the parameters.
    pub speeds: [f64; 2],
    /// How the curves meet.
    pub kind: Kind,
}

/// One search: two curves, or one with itself.
#[derive(Debug)]
pub struct Search<P: Point> {
    trees: Vec<Tree<P>>,
    pub(super) tolerance: f64,
    pub(super) found: Vec<Found<P>>,
    pub(super) contacts: Vec<Contact>,
}

impl<P: Point> Search<P> {
    /// Over two trees or, for self-intersections, one.
    pub fn new(trees: Vec<Tree<P>>, tolerance: f64) -> Self {
        let grain = trees.iter().map(|t| t.grain).fold(0.0, f64::max);
        let tolerance = tolerance.max(ROUNDINGS * grain);
        Self { trees, tolerance, found: Vec::new(), contacts: Vec::new() }
    }

    /// The curve of one side of a pair.
    pub fn tree(&self, side: usize) -> &Tree<P> {
        &self.trees[side.min(self.trees.len() - 1)]
    }

    /// Whether a curve is searched with itself.
    pub fn is_own(&self) -> bool {
        self.trees.len() == 1
    }

    /// A pair of pieces.
    pub fn pieces(&self, pair: [usize; 2]) -> [Piece<'_, P>; 2] {
        [(self.tree(0), pair[0]), (self.tree(1), pair[1])]
    }

    /// Both nodes of a pair.
    pub fn nodes(&self, [i, j]: [usize; 2]) -> [&Node<P>; 2] {
        [self.tree(0).node(i), self.tree(1).node(j)]
    }

    /// All intersections.
    ///
    /// # Errors
    /// [`Error::Numerics`] when there are too many pairs.
    pub fn run(mut self) -> Result<Intersections<P>> {
        let mut rest = vec![[self.tree(0).root, self.tree(1).root]];
        let mut seen = 0;
        while let Some(pair) = rest.pop() {
            self.visit(pair, &mut rest);
            seen += 1;
            if seen > PAIRS {
                let why = format!(
                    "the curves are within {:e} of each other in too many places: ask for a smaller tolerance",
                    self.tolerance
                );
                return Err(Error::Numerics { why });
            }
        }
        Ok(self.report())
    }

    fn visit(&mut self, pair: [usize; 2], rest: &mut Vec<[usize; 2]>) {
        let same = self.is_own() && pair[0] == pair[1];
        if same {
            return self.visit_same(pair[0], rest);
        }
        if self.is_apart(pair) {
            return;
        }
        let [a, b] = self.nodes(pair);
        if a.span.is_none() || b.span.is_none() {
            return self.split(pair, rest);
        }
        let crosses = a.cone.is_apart(&b.cone);
        if self.is_own() && self.meets_only_where_joined(pair, crosses) {
            return;
        }
        if crosses && self.cross(pair, false) || !crosses && self.touch(pair) {
            return;
        }
        if self.is_point(pair) {
            self.cross(pair, true);
            return;
        }
        self.split(pair, rest);
    }

    /// A stretch with itself: none that turns by less than half a turn meets itself.
    fn visit_same(&mut self, k: usize, rest: &mut Vec<[usize; 2]>) {
        let (tree, node) = (self.tree(0), self.tree(0).node(k));
        if node.cone.cosine > 1e-12 || node.size <= self.tolerance * POINT || !tree.is_divisible(k) {
            return;
        }
        let [a, b] = self.trees[0].children(k);
        rest.extend([[a, a], [b, b], [a, b]]);
    }

    /// Whether two stretches of one curve that share an end have no other point in common.
    fn meets_only_where_joined(&self, pair: [usize; 2], crosses: bool) -> bool {
        let (tree, [a, b]) = (self.tree(0), self.nodes(pair));
        let [before, after] = pair.map(|k| tree.points(k));
        let apart = |p: P, q: P| (p - q).length() > self.tolerance;
        let inner = a.range[1] == b.range[0] && !apart(before[before.len() - 1], after[0]);
        let seam = tree.closed && [a.range[0], b.range[1]] == tree.domain;
        (inner != seam) && (crosses || a.cone.agrees(&b.cone, 1.0))
    }

    /// Whether both pieces are short enough to be points.
    fn is_point(&self, pair: [usize; 2]) -> bool {
        let small = |side: usize| {
            let tree = self.tree(side);
            tree.node(pair[side]).size <= POINT * self.tolerance || !tree.is_divisible(pair[side])
        };
        small(0) && small(1)
    }

    /// Halves the longer of both, nodes of several spans first.
    fn split(&mut self, [i, j]: [usize; 2], rest: &mut Vec<[usize; 2]>) {
        let [a, b] = self.nodes([i, j]);
        let second = self.trees.len() - 1;
        let larger = match (a.span, b.span) {
            (None, Some(_)) => true,
            (Some(_), None) => false,
            _ => a.size >= b.size,
        };
        let first = match (self.tree(0).is_divisible(i), self.tree(1).is_divisible(j)) {
            (true, true) => larger,
            (divisible, _) => divisible,
        };
        if first {
            rest.extend(self.trees[0].children(i).map(|i| [i, j]));
        } else {
            rest.extend(self.trees[second].children(j).map(|j| [i, j]));
        }
    }

    /// Whether no points of both are within the tolerance, as boxes show.
    fn is_apart(&self, pair: [usize; 2]) -> bool {
        let [a, b] = self.nodes(pair);
        let gap = (a.low - b.high).max(b.low - a.high);
        if gap.max_element() > self.tolerance {
            return true;
        }
        if a.span.is_none() || b.span.is_none() {
            return false;
        }
        let between = (b.low + b.high - a.low - a.high) * 0.5;
        let across = |e: P, v: P| v - e * v.dot(e);
        let [e, f] = [a.cone.axis, b.cone.axis];
        let normal = across(e, between);
        self.is_apart_along(pair, normal)
            || self.is_apart_along(pair, across(f, between))
            || P::DIMENSION > 2 && {
                let along = across(e, f);
                let squared = along.dot(along);
                squared > 0.0 && self.is_apart_along(pair, normal - along * (normal.dot(along) / squared))
            }
    }

    fn is_apart_along(&self, pair: [usize; 2], direction: P) -> bool {
        let [a, b] = [self.tree(0).points(pair[0]), self.tree(1).points(pair[1])];
        let extent = |points: &[P]| {
            let along = points.iter().map(|&p| (p - a[0]).dot(direction));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        let (a, b) = (extent(a), extent(b));
        let gap = (b[0] - a[1]).max(a[0] - b[1]);
        gap > 0.0 && gap * gap > self.tolerance * self.tolerance * direction.dot(direction)
    }

    /// Looks for the crossing of two pieces that have one at most; whether there is one.
    fn cross(&mut self, pair: [usize; 2], points: bool) -> bool {
        let pieces = self.pieces(pair);
        let place = nearest(pieces, [0.5; 2]);
        if place.distance() > self.tolerance {
            return false;
        }
        let touches = points && place.sine() < 1e-3;
        let kind = if touches { Kind::Tangential } else { Kind::Transversal };
        self.push(pair, &place, kind);
        true
    }

    /// Keeps a place on two pieces.
    pub fn push(&mut self, pair: [usize; 2], place: &Place<P>, kind: Kind) {
        let ranges = self.nodes(pair).map(|n| n.range[1] - n.range[0]);
        let at = [0, 1].map(|side| self.tree(side).parameter(pair[side], place.at[side]));
        let speeds = [0, 1].map(|side| place.derivatives[side].length() / ranges[side]);
        let reach = 2.0 * self.tolerance / place.sine().max(1e-8);
        self.found.push(Found { at, points: place.points, reach, speeds, kind });
    }
}
