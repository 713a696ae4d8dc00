//! One branch of an intersection, followed from a point on it to its ends.
//!
//! Steps are predicted to second order, corrected by Newton's method, and kept only when the
//! quintic through both ends agrees with corrected points between them: what leaps to another
//! branch does not.

use super::pair::{At, Cells, Cut, Kind, Node, Pair, joined};
use super::segment::Segment;
use glam::{DVec2, DVec3};

/// Fractions of a piece at which it is compared with the curve.
const SAMPLES: [f64; 3] = [0.25, 0.5, 0.75];
/// Pieces of one branch at most.
const LONGEST: usize = 20_000;
/// Fraction of the size below which steps are no longer shortened.
const SHORTEST: f64 = 1e-9;
/// Largest turn of a piece, as the cosine.
const TURN: f64 = 0.7;

/// A point at which branches end or meet.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    pub at: At,
    pub x: DVec3,
    /// 1 for each parameter that has a value there, 0 for those that only have a limit.
    pub known: At,
}

impl Target {
    /// A point with all its parameters.
    pub fn new(at: At, x: DVec3) -> Self {
        Self { at, x, known: [DVec2::ONE; 2] }
    }
}

/// Why a branch ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// At a border of a sheet.
    Border,
    /// Where it started.
    Closed,
    /// In a target, by number.
    Target(usize),
    /// The method fails here.
    Lost,
}

/// A branch in pieces.
#[derive(Debug, Clone)]
pub struct Path {
    pub kind: Kind,
    pub segments: Vec<Segment>,
    pub ends: [End; 2],
}

/// Follows branches of one kind.
#[derive(Debug)]
pub struct Tracer<'a> {
    pub pair: &'a Pair,
    pub kind: Kind,
    pub targets: &'a [Target],
}

/// What an attempted step gives.
enum Step {
    /// A piece.
    Piece(Segment),
    /// The last piece.
    End(Segment, End),
    /// Too long; a length that may do.
    Shorter(f64),
}

impl Tracer<'_> {
    /// The branch through a point; none where it has no direction there.
    pub fn branch(&self, at: At, x: DVec3) -> Option<Path> {
        let cells = self.pair.cells(at, [DVec2::ZERO; 2])?;
        let along = self.pair.direction(self.kind, &cells, at)?;
        let (mut segments, end) = self.half(at, x, along)?;
        if end == End::Closed {
            return Some(Path { kind: self.kind, segments, ends: [end; 2] });
        }
        let (back, start) = self.half(at, x, -along)?;
        let mut all: Vec<Segment> = back.into_iter().rev().map(Segment::reversed).collect();
        all.append(&mut segments);
        (!all.is_empty()).then_some(Path { kind: self.kind, segments: all, ends: [start, end] })
    }

    /// From a point in one direction.
    fn half(&self, at: At, x: DVec3, along: DVec3) -> Option<(Vec<Segment>, End)> {
        let mut segments: Vec<Segment> = Vec::new();
        let middle = self.pair.cells(at, [DVec2::ZERO; 2])?;
        let Some((mut from, mut cells)) = self.enter(&middle, at, x, along) else {
            return Some((segments, End::Border));
        };
        let start = Target::new(at, x);
        let longest = 0.1 * self.pair.size;
        let (mut h, mut gone) = ((0.2 / from.bend.length()).min(longest), 0.0);
        while segments.len() < LONGEST && !self.pair.is_spent() {
            // Beside a line between cells the first step may be rounding, with the start on any side.
            let closing = (gone > SHORTEST * self.pair.size).then_some(&start);
            match self.step(&from, &cells, h, closing) {
                Step::End(piece, end) => {
                    segments.push(piece);
                    return Some((segments, end));
                }
                Step::Piece(piece) => {
                    segments.push(piece);
                    gone += piece.length;
                    let ease = (self.pair.tolerance / piece.deviation).powf(1.0 / 6.0);
                    h = (piece.length * (0.8 * ease).clamp(0.5, 2.5)).min(longest);
                    match self.enter(&cells, piece.to.at, piece.to.x, piece.to.tangent) {
                        Some(next) => (from, cells) = next,
                        None => return Some((segments, End::Border)),
                    }
                }
                Step::Shorter(shorter) if shorter > SHORTEST * self.pair.size => h = shorter,
                Step::Shorter(_) => break,
            }
        }
        Some((segments, End::Lost))
    }

    /// The node at a point of `cells` as the cells have it into which the curve leads there.
    fn enter(&self, cells: &Cells, at: At, x: DVec3, along: DVec3) -> Option<(Node, Cells)> {
        let node = self.pair.node(self.kind, cells, (at, x), along)?;
        let next = self.pair.cells(at, node.first)?;
        if next == *cells {
            return Some((node, next));
        }
        let beyond = self.pair.node(self.kind, &next, (at, x), along)?;
        // At a ridge that the curve only touches it would lead back.
        (self.pair.cells(at, beyond.first)? == next).then_some((beyond, next))
    }

    fn step(&self, from: &Node, cells: &Cells, h: f64, start: Option<&Target>) -> Step {
        let targets = self.targets.iter().enumerate().map(|(i, t)| (t, End::Target(i)));
        for (target, end) in start.map(|t| (t, End::Closed)).into_iter().chain(targets) {
            let way = target.x - from.x;
            let (distance, ahead) = (way.length(), way.dot(from.tangent));
            if distance > 1.5 * h || ahead < 0.5 * distance || !self.is_near(from, target, distance) {
                continue;
            }
            // At the start the branch has a direction of its own.
            let to = match end {
                End::Closed => self.pair.node(self.kind, cells, (target.at, target.x), from.tangent),
                _ => self.limit(from, target, cells),
            };
            if let Some(piece) = to.and_then(|to| self.verified(from, to, cells).ok()) {
                return Step::End(piece, end);
            }
            return self.free(from, cells, h.min(0.5 * distance));
        }
        self.free(from, cells, h)
    }

    /// Whether the parameters of a target are where a way of that length may lead.
    fn is_near(&self, from: &Node, target: &Target, distance: f64) -> bool {
        (0..2).all(|k| {
            let (there, change) = (target.at[k] - from.at[k], from.first[k] * distance);
            let (there, change) = (there * target.known[k], change * target.known[k]);
            (there - change).length() <= 0.7 * (change.length() + there.length())
        })
    }

    /// The node in a target where the sheets touch: the limit of nodes before it.
    fn limit(&self, from: &Node, target: &Target, cells: &Cells) -> Option<Node> {
        let way = from.x.distance(target.x);
        let back = (target.x - from.x).normalize();
        let near = |fraction: f64| {
            // From the target back towards the node, with the node's slope.
            let t = 1.0 - fraction;
            let guess = [0, 1].map(|k| {
                let slope = from.first[k] * way;
                let bend = from.second[k] * (0.5 * way * way);
                let to_target = target.at[k] - from.at[k] - slope;
                from.at[k]
                    + slope * t
                    + (to_target * target.known[k] + bend * (DVec2::ONE - target.known[k])) * (t * t)
            });
            let cut = Cut::Across { point: target.x - back * (way * fraction), direction: back };
            let place = self.pair.point(self.kind, cells, guess, cut)?;
            self.pair.node(self.kind, cells, place, back)
        };
        let nodes = [(3.0, near(0.03)?), (-3.0, near(0.06)?), (1.0, near(0.09)?)];
        let limit = Node::sum(&nodes);
        let at =
            [0, 1].map(|k| target.at[k] * target.known[k] + limit.at[k] * (DVec2::ONE - target.known[k]));
        Some(Node { at, x: target.x, ..limit })
    }

    /// A step of about `h`, at most to the border of the cells.
    fn free(&self, from: &Node, cells: &Cells, h: f64) -> Step {
        let guess = |h: f64| [0, 1].map(|k| from.at[k] + from.first[k] * h + from.second[k] * (0.5 * h * h));
        let cut = Cut::Across {
            point: from.x + from.tangent * h + from.bend * (0.5 * h * h),
            direction: (from.tangent + from.bend * h).normalize_or(from.tangent),
        };
        let Some((mut at, mut x)) = self.pair.point(self.kind, cells, guess(h), cut) else {
            return Step::Shorter(0.5 * h);
        };
        // Where two lines are near, the first found need not be the first met.
        for _ in 0..2 {
            let Some((line, fraction)) = self.leaving(from, at, cells) else { break };
            match self.pair.point(self.kind, cells, guess(h * fraction), line) {
                Some(on) if on.1.distance(from.x) <= 1.2 * h => (at, x) = on,
                _ => return Step::Shorter(0.5 * h),
            }
        }
        if self.leaving(from, at, cells).is_some() {
            return Step::Shorter(0.5 * h);
        }
        let Some(to) = self.pair.node(self.kind, cells, (at, x), from.tangent) else {
            return Step::Shorter(0.5 * h);
        };
        match self.verified(from, to, cells) {
            Ok(piece) => Step::Piece(piece),
            Err(shorter) => Step::Shorter(shorter),
        }
    }

    /// The first line between cells that lies between a node and the point it leads to, and the
    /// fraction of the way.
    fn leaving(&self, from: &Node, to: At, cells: &Cells) -> Option<(Cut, f64)> {
        let (a, b) = (joined(from.at), joined(to));
        let low = joined(cells.each_ref().map(|c| c.low));
        let high = joined(cells.each_ref().map(|c| c.high));
        let slack = joined(cells.each_ref().map(|c| c.slack));
        let line = |index: usize| {
            let value = if b[index] < low[index] - slack[index] {
                low[index]
            } else if b[index] > high[index] + slack[index] {
                high[index]
            } else {
                return None;
            };
            let fraction = ((value - a[index]) / (b[index] - a[index])).clamp(0.0, 1.0);
            Some((Cut::Parameter { index, value }, fraction))
        };
        (0..4).filter_map(line).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The piece between two nodes if it keeps the tolerance; otherwise a length that may do.
    fn verified(&self, from: &Node, to: Node, cells: &Cells) -> Result<Segment, f64> {
        let mut piece = Segment::new(*from, to);
        let short = 0.5 * piece.length.min(from.x.distance(to.x));
        if from.tangent.dot(to.tangent) < TURN || piece.length > 2.0 * from.x.distance(to.x) {
            return Err(short);
        }
        for t in SAMPLES {
            let ([x, d], at) = piece.at(t);
            if !(0..2).all(|k| cells[k].part_holds(at[k])) {
                return Err(short);
            }
            let cut = Cut::Across { point: x, direction: d.normalize_or(from.tangent) };
            let (_, exact) = self.pair.point(self.kind, cells, at, cut).ok_or(short)?;
            let sheets = self.pair.jets(cells, at);
            let worst = sheets.iter().map(|s| s.s.distance(x)).fold(x.distance(exact), f64::max);
            piece.deviation = piece.deviation.max(worst);
        }
        if piece.deviation <= self.pair.tolerance {
            return Ok(piece);
        }
        let ease = (self.pair.tolerance / piece.deviation).powf(1.0 / 6.0);
        Err(2.0 * short * (0.8 * ease).clamp(0.2, 0.7))
    }
}
