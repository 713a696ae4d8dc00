//! What a search found, each place once.

use super::contact::Contact;
use super::pairs::{Found, Search};
use super::{Crossing, Intersections, Kind, Overlap};
use crate::nurbs::Point;

/// Places between two parameters at which a loop is looked at.
const SAMPLES: usize = 8;
/// A loop smaller than so many tolerances is none.
const LOOP: f64 = 4.0;

impl<P: Point> Search<P> {
    /// Merges what belongs together.
    pub fn report(mut self) -> Intersections<P> {
        let overlaps = self.overlaps();
        let mut found = std::mem::take(&mut self.found);
        for f in &mut found {
            f.at = self.at_starts(f.at);
        }
        found.retain(|f| !self.is_in_contact(f) && !self.is_no_loop(f) && !self.is_in_cusp(f));
        if self.is_own() {
            found.iter_mut().filter(|f| f.at[0] > f.at[1]).for_each(Found::swap);
        }
        found.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]).then(a.at[1].total_cmp(&b.at[1])));
        let mut kept: Vec<Found<P>> = Vec::new();
        for f in found {
            match kept.iter_mut().find(|known| self.is_same(known, &f)) {
                Some(known) => known.merge(&f),
                None => kept.push(f),
            }
        }
        Intersections { crossings: kept.iter().map(Found::crossing).collect(), overlaps }
    }

    /// The starts of closed curves instead of their ends.
    fn at_starts(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|side| {
            let (tree, t) = (self.tree(side), at[side]);
            let [a, b] = tree.domain;
            if tree.closed && b - t <= 1e-12 * (b - a) { a } else { t }
        })
    }

    /// Whether two places are one.
    fn is_same(&self, f: &Found<P>, g: &Found<P>) -> bool {
        let reach = f.reach.min(g.reach);
        let near = |side: usize| {
            let tree = self.tree(side);
            let [a, b] = tree.domain;
            let apart = (f.at[side] - g.at[side]).abs();
            let apart = if tree.closed { apart.min(b - a - apart) } else { apart };
            apart * f.speeds[side].min(g.speeds[side]) <= reach || apart <= 1e-12 * (b - a)
        };
        near(0) && near(1) && (f.points[0] - g.points[0]).length() <= reach
    }

    /// Whether a place is part of an overlap, or a crossing that belongs to a touch.
    fn is_in_contact(&self, f: &Found<P>) -> bool {
        self.contacts.iter().any(|c| {
            c.is_overlap
                && (c.holds(f.at) || c.ends().iter().any(|end| self.is_near(f, self.at_starts(*end))))
                || c.is_touch && f.kind == Kind::Transversal && c.holds(f.at)
        })
    }

    fn is_near(&self, f: &Found<P>, at: [f64; 2]) -> bool {
        (0..2).all(|side| {
            let [a, b] = self.tree(side).domain;
            let apart = (f.at[side] - at[side]).abs();
            apart * f.speeds[side] <= f.reach || apart <= 1e-12 * (b - a)
        })
    }

    /// Whether the curve between both parameters, or the other way round a closed one, is not
    /// longer than what the tolerance takes for a point.
    fn is_no_loop(&self, f: &Found<P>) -> bool {
        if !self.is_own() {
            return false;
        }
        let tree = self.tree(0);
        let [a, b] = tree.domain;
        let [s, t] = [f.at[0].min(f.at[1]), f.at[0].max(f.at[1])];
        let near = |u: f64| (tree.point(u) - f.points[0]).length() <= LOOP * self.tolerance;
        let within =
            |from: f64, to: f64| (0..=SAMPLES).all(|k| near(from + (to - from) * k as f64 / SAMPLES as f64));
        within(s, t) || tree.closed && within(a, s) && within(t, b)
    }

    /// Overlaps of neighbouring spans as one.
    fn overlaps(&self) -> Vec<Overlap> {
        let as_overlap = |c: &Contact| {
            let [[s0, t0], [s1, t1]] = c.ends();
            Overlap { first: [s0, s1], second: [t0, t1] }
        };
        let mut all: Vec<Overlap> = self.contacts.iter().filter(|c| c.is_overlap).map(as_overlap).collect();
        all.sort_by(|a, b| a.first[0].total_cmp(&b.first[0]));
        let meet = |side: usize, s: f64, t: f64| {
            let tree = self.tree(side);
            let [a, b] = tree.domain;
            let apart = (tree.point(s) - tree.point(t)).length();
            (s - t).abs() <= 1e-3 * (b - a) && apart <= LOOP * self.tolerance
        };
        let mut out: Vec<Overlap> = Vec::new();
        for next in all {
            let follows = |o: &Overlap| {
                let rises = (o.second[1] - o.second[0]) * (next.second[1] - next.second[0]) > 0.0;
                rises && meet(0, o.first[1], next.first[0]) && meet(1, o.second[1], next.second[0])
            };
            match out.iter_mut().find(|o| follows(o)) {
                Some(known) => (known.first[1], known.second[1]) = (next.first[1], next.second[1]),
                None => out.push(next),
            }
        }
        out
    }
}

impl<P: Point> Found<P> {
    fn swap(&mut self) {
        self.at.swap(0, 1);
        self.points.swap(0, 1);
        self.speeds.swap(0, 1);
    }

    fn distance(&self) -> f64 {
        (self.points[1] - self.points[0]).length()
    }

    /// Takes the better of two places that are one.
    fn merge(&mut self, other: &Self) {
        let kind = if other.kind == Kind::Tangential { other.kind } else { self.kind };
        let reach = self.reach.max(other.reach);
        if other.distance() < self.distance() {
            *self = *other;
        }
        (self.kind, self.reach) = (kind, reach);
    }

    fn crossing(&self) -> Crossing<P> {
        let point = (self.points[0] + self.points[1]) * 0.5;
        Crossing { at: self.at, point, distance: self.distance(), kind: self.kind }
    }
}
