//! Stretches along which two pieces with parallel tangents stay within the tolerance: touches and
//! overlaps.

use super::Kind;
use super::approach::{Place, foot, nearest};
use super::pairs::{Found, Search};
use crate::nurbs::Point;

/// A contact is followed to where the distance is so many times the tolerance: what is within the
/// tolerance next to it is then a part of it.
const REACH: f64 = 2.0;
/// Two pieces are beside each other if their distance varies by this part of what it is above the
/// tolerance, at the ends and at places between.
const EVEN: f64 = 0.03;
/// Such places, plus one.
const PLACES: usize = 10;
/// Steps in which one side of a contact is followed.
const STEPS: usize = 24;
/// The last step towards where a contact ends, as a part of the longest.
const SMALLEST: f64 = 1.0 / 4096.0;
/// Bisections that find the place of parallel tangents.
const BISECTIONS: usize = 60;
/// A contact not longer than so many tolerances is a point.
const SHORT: f64 = 8.0;
/// Places of one span no further apart, in its parameter of 0 to 1, are one.
const ONE: f64 = 1e-8;
/// How far from the line between its samples a contact may be, as a part of their parameters.
const SLACK: f64 = 0.2;

/// A stretch within [`REACH`] tolerances.
#[derive(Debug, Clone)]
pub struct Contact {
    /// Parameters on both curves, ascending on the first.
    pub track: Vec<[f64; 2]>,
    /// Whether it goes on to the end of a span on both sides and is no point.
    pub is_overlap: bool,
    /// Whether the tangents are parallel within the tolerance.
    pub is_touch: bool,
}

/// How one side of a contact ends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    /// Within a span: the curves part.
    Parts,
    /// At the end of a span.
    Span,
    /// Where both places on one curve become one.
    Cusp,
}

impl Contact {
    /// Parameters of the first and last place.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.track[0], self.track[self.track.len() - 1]]
    }

    /// Whether a place is one of the contact.
    pub fn holds(&self, [s, t]: [f64; 2]) -> bool {
        let [first, last] = self.ends();
        let rounding = 1e-9 * (last[0] - first[0]);
        if s < first[0] - rounding || s > last[0] + rounding {
            return false;
        }
        let k = self.track.partition_point(|p| p[0] <= s).clamp(1, self.track.len().max(2) - 1);
        let ([s0, t0], [s1, t1]) = (self.track[k - 1], self.track[k.min(self.track.len() - 1)]);
        let share = if s1 > s0 { (s - s0) / (s1 - s0) } else { 0.5 };
        let middle = t0 + (t1 - t0) * share;
        let slack = SLACK * (last[1] - first[1]).abs() / STEPS as f64;
        (t - middle).abs() <= slack + SLACK * (t1 - t0).abs()
    }
}

impl<P: Point> Search<P> {
    /// Whether all that two pieces with a parallel tangent have in common is one contact; it is
    /// then kept.
    pub fn touch(&mut self, pair: [usize; 2]) -> bool {
        let Some([low, high]) = self.common(pair) else { return false };
        let reach = REACH * self.tolerance;
        let pieces = self.pieces(pair);
        let ends = [low, high].map(|at| Place::new(pieces, at).distance());
        if ends.iter().any(|distance| *distance > reach) {
            return self.is_beside(pair, [low, high], ends);
        }
        let on = |share: f64| {
            let u = low[0] + (high[0] - low[0]) * share;
            let v = low[1] + (high[1] - low[1]) * share;
            [u, foot(pieces[1], pieces[0].0.at(pieces[0].1, u)[0], v)]
        };
        let inner = [0.25, 0.5, 0.75].map(on);
        if inner.iter().any(|at| Place::new(pieces, *at).distance() > reach) {
            return false;
        }
        let global = |at: [f64; 2]| [0, 1].map(|k| pieces[k].0.parameter(pieces[k].1, at[k]));
        let ends = [global(low), global(high)];
        if !self.contacts.iter().any(|c| ends.iter().all(|at| c.holds(*at))) {
            self.follow(pair, global(inner[1]));
        }
        true
    }

    /// Whether two pieces keep so even a distance that they cannot come nearer between the places
    /// looked at.
    fn is_beside(&self, pair: [usize; 2], [low, high]: [[f64; 2]; 2], ends: [f64; 2]) -> bool {
        let [first, second] = self.pieces(pair);
        let is_even = |[least, most]: [f64; 2]| most - least <= EVEN * (least - self.tolerance);
        let mut range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        for k in 1..PLACES {
            if !is_even(range) {
                return false;
            }
            let share = k as f64 / PLACES as f64;
            let [u, v] = [0, 1].map(|side| low[side] + (high[side] - low[side]) * share);
            let point = first.0.at(first.1, u)[0];
            let distance = (second.0.at(second.1, foot(second, point, v))[0] - point).length();
            range = [range[0].min(distance), range[1].max(distance)];
        }
        is_even(range)
    }

    /// The ends of the stretch that two pieces have in common, if both are graphs over one line:
    /// an end of one piece and its foot on the other.
    fn common(&self, pair: [usize; 2]) -> Option<[[f64; 2]; 2]> {
        let [a, b] = self.nodes(pair).map(|n| n.cone);
        let sense = if a.axis.dot(b.axis) < 0.0 { -1.0 } else { 1.0 };
        if !a.agrees(&b, sense) {
            return None;
        }
        let line = a.axis + b.axis * sense;
        let pieces = self.pieces(pair);
        let [p, q] = pieces.map(|(tree, k)| tree.points(k));
        let (p, q) = ([p[0], p[p.len() - 1]], [q[0], q[q.len() - 1]]);
        let from = |x: P| (x - p[0]).dot(line);
        let ends = if sense > 0.0 { [0.0, 1.0] } else { [1.0, 0.0] };
        let at = |side: usize, inner_first: bool| {
            let other = if sense > 0.0 { q[side] } else { q[1 - side] };
            match inner_first {
                true => [side as f64, foot(pieces[1], p[side], ends[side])],
                false => [foot(pieces[0], other, side as f64), ends[side]],
            }
        };
        let [q_low, q_high] = if sense > 0.0 { q } else { [q[1], q[0]] };
        Some([at(0, from(p[0]) >= from(q_low)), at(1, from(p[1]) <= from(q_high))])
    }

    /// Follows a contact to both sides within the spans it lies in, and keeps it.
    fn follow(&mut self, pair: [usize; 2], at: [f64; 2]) {
        let Some(spans) = self.spans(pair) else { return };
        let start = [0, 1].map(|side| self.tree(side).local(spans[side], at[side]));
        let (mut track, low) = self.march(spans, start, 0.0);
        track.reverse();
        let (after, high) = self.march(spans, start, 1.0);
        track.push(start);
        track.extend(after);
        track.dedup();
        let long = self.extent(spans, &track) > SHORT * self.tolerance;
        let is_overlap = ![low, high].contains(&End::Parts) && long && self.is_within(spans, &track);
        let is_single = !is_overlap && ![low, high].contains(&End::Cusp);
        if is_single {
            track = self.even(spans, &track);
        }
        let is_touch = is_single && self.settle(spans, &track);
        let global = |at: &[f64; 2]| [0, 1].map(|k| self.tree(k).parameter(spans[k], at[k]));
        let track = track.iter().map(global).collect();
        self.contacts.push(Contact { track, is_overlap, is_touch });
    }

    /// A short contact in even steps.
    fn even(&self, spans: [usize; 2], track: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let [first, second] = self.pieces(spans);
        let ([u0, mut v], [u1, v1]) = (track[0], track[track.len() - 1]);
        let mut even = vec![track[0]];
        for k in 1..STEPS {
            let u = u0 + (u1 - u0) * k as f64 / STEPS as f64;
            v = foot(second, first.0.at(first.1, u)[0], v);
            even.push([u, v]);
        }
        even.push([u1, v1]);
        even
    }

    fn spans(&self, pair: [usize; 2]) -> Option<[usize; 2]> {
        let [a, b] = self.nodes(pair).map(|n| n.span);
        Some([a?, b?])
    }

    /// Whether a track keeps to the tolerance itself.
    fn is_within(&self, spans: [usize; 2], track: &[[f64; 2]]) -> bool {
        let pieces = self.pieces(spans);
        track.iter().all(|at| Place::new(pieces, *at).distance() <= self.tolerance)
    }

    /// The largest distance of the first curve's points of a track from the first of them.
    fn extent(&self, spans: [usize; 2], track: &[[f64; 2]]) -> f64 {
        let point = |u: f64| self.tree(0).at(spans[0], u)[0];
        let first = point(track[0][0]);
        track.iter().map(|at| (point(at[0]) - first).length()).fold(0.0, f64::max)
    }

    /// Whether a place is on the arms of a cusp, which stay within reach of each other up to its tip.
    pub fn is_in_cusp(&self, f: &Found<P>) -> bool {
        let tree = self.tree(0);
        let mut at = [f.at[0].min(f.at[1]), f.at[0].max(f.at[1])];
        while self.is_own() && at[0] < at[1] {
            let spans = tree.spans_between(at);
            let local = |k: usize, t: f64| tree.local(spans[k], t);
            let (track, end) = self.march(spans, [local(0, at[0]), local(1, at[1])], 1.0);
            let Some(last) = track.last().filter(|_| end != End::Parts) else { return false };
            let next = [0, 1].map(|k| tree.parameter(spans[k], last[k]));
            if next[0] <= at[0] && next[1] >= at[1] {
                return false;
            }
            at = next;
        }
        self.is_own()
    }

    /// Whether two places, followed from `start`, have become one place of one span.
    fn is_one(&self, spans: [usize; 2], start: [f64; 2], at: [f64; 2]) -> bool {
        let between = (at[1] - at[0]) * (start[1] - start[0]).signum();
        self.is_own() && spans[0] == spans[1] && between < ONE
    }

    /// Places from `start` towards an end of the first span, and how they end: at it, or at one of
    /// the other span, too.
    fn march(&self, spans: [usize; 2], start: [f64; 2], end: f64) -> (Vec<[f64; 2]>, End) {
        let pieces = self.pieces(spans);
        let reach = REACH * self.tolerance;
        let on = |u: f64, from: &Place<P>, slope: f64| {
            let v = (from.at[1] + slope * (u - from.at[0])).clamp(0.0, 1.0);
            Place::new(pieces, [u, foot(pieces[1], pieces[0].0.at(pieces[0].1, u)[0], v)])
        };
        let mut track = Vec::new();
        let mut last = Place::new(pieces, start);
        // Later that of the last step: at a cusp there are no tangents.
        let [d, e] = last.derivatives;
        let mut slope = d.dot(e) / e.dot(e).max(f64::MIN_POSITIVE);
        let longest = (end - start[0]) / STEPS as f64;
        let (mut by, mut is_cusp) = (longest, false);
        while by.abs() > longest.abs() * SMALLEST {
            let is_last = (end - last.at[0]).abs() <= by.abs();
            let next = on(if is_last { end } else { last.at[0] + by }, &last, slope);
            is_cusp = self.is_one(spans, start, next.at);
            if is_cusp {
                by *= 0.5;
                continue;
            }
            // Within the reach the first curve may already be behind the end of the second.
            if next.at[1] == 0.0 || next.at[1] == 1.0 {
                let u = foot(pieces[0], next.points[1], last.at[0]);
                let place = Place::new(pieces, [u, next.at[1]]);
                if place.distance() <= reach {
                    track.push(place.at);
                    return (track, End::Span);
                }
            }
            if next.distance() <= reach {
                track.push(next.at);
                if is_last {
                    return (track, End::Span);
                }
                slope = (next.at[1] - last.at[1]) / (next.at[0] - last.at[0]);
                last = next;
                by = if (2.0 * by).abs() < longest.abs() { 2.0 * by } else { longest };
                continue;
            }
            by *= 0.5;
        }
        if is_cusp {
            track.push([0.5 * (last.at[0] + last.at[1]); 2]);
            return (track, End::Cusp);
        }
        (track, if longest == 0.0 { End::Span } else { End::Parts })
    }

    /// Keeps the places of a contact at which the curves meet: that of parallel tangents if it is
    /// within the tolerance, otherwise what is on either side of it.
    fn settle(&mut self, spans: [usize; 2], track: &[[f64; 2]]) -> bool {
        let turn = self.parallel(spans, track);
        if let Some(place) = turn.filter(|place| place.distance() <= self.tolerance) {
            self.push(spans, &place, Kind::Tangential);
            return true;
        }
        let split = turn.map_or(track.len(), |place| track.partition_point(|at| at[0] <= place.at[0]));
        let mut touches = false;
        for side in [&track[..split], &track[split..]] {
            touches |= self.settle_side(spans, side, track);
        }
        touches
    }

    fn settle_side(&mut self, spans: [usize; 2], side: &[[f64; 2]], track: &[[f64; 2]]) -> bool {
        let pieces = self.pieces(spans);
        let places = side.iter().map(|at| Place::new(pieces, *at));
        let Some(best) = places.min_by(|a, b| a.distance().total_cmp(&b.distance())) else { return false };
        let refined = nearest(pieces, best.at);
        let place = if refined.distance() <= best.distance() { refined } else { best };
        if place.distance() > self.tolerance {
            return false;
        }
        // A crossing at an angle leaves the contact where the angle says, a touch later.
        let far = self.tree(0).at(spans[0], track[0][0])[0] - place.points[0];
        let last = self.tree(0).at(spans[0], track[track.len() - 1][0])[0] - place.points[0];
        let extent = far.length().max(last.length());
        let touches = place.sine() * extent < 0.5 * REACH * self.tolerance;
        self.push(spans, &place, if touches { Kind::Tangential } else { Kind::Transversal });
        touches
    }

    /// The place of a contact at which the tangents are parallel, as seen across the contact where
    /// it is widest.
    fn parallel(&self, spans: [usize; 2], track: &[[f64; 2]]) -> Option<Place<P>> {
        let pieces = self.pieces(spans);
        let places: Vec<Place<P>> = track.iter().map(|at| Place::new(pieces, *at)).collect();
        let widest = places.iter().max_by(|a, b| a.distance().total_cmp(&b.distance()))?;
        let across = widest.points[1] - widest.points[0];
        let slope = |place: &Place<P>| {
            let [d, e] = place.derivatives;
            let sense = if d.dot(e) < 0.0 { -1.0 } else { 1.0 };
            d.dot(across) / d.length() - sense * e.dot(across) / e.length()
        };
        let turns = places.windows(2).filter(|w| slope(&w[0]) * slope(&w[1]) <= 0.0);
        let bisect = |w: &[Place<P>]| {
            let (mut low, mut high) = (w[0], w[1]);
            let rising = slope(&low) < slope(&high);
            for _ in 0..BISECTIONS {
                let at = [0, 1].map(|k| 0.5 * (low.at[k] + high.at[k]));
                let v = foot(pieces[1], pieces[0].0.at(pieces[0].1, at[0])[0], at[1]);
                let place = Place::new(pieces, [at[0], v]);
                if (slope(&place) < 0.0) == rising {
                    low = place;
                } else {
                    high = place;
                }
            }
            low
        };
        turns.map(bisect).min_by(|a, b| a.distance().total_cmp(&b.distance()))
    }
}
