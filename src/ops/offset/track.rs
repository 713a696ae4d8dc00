//! The source of an offset as a row of short Bézier links, each with what its control points say
//! about where it lies and where it heads.

use super::bend::Bend;
use crate::error::{Error, Result};
use crate::nurbs::{NurbsCurve, Side};
use crate::ops::invert::bezier::{CurvePiece, curve_pieces};
use crate::ops::invert::check_size;
use crate::tolerance::PARAMETER_RELATIVE;
use glam::DVec2;
use std::ops::Range;
use std::rc::Rc;

/// Links turn by no more than this, in rad.
const TURN: f64 = 0.5;
/// Halvings of a piece at most.
const DEPTH: usize = 48;
/// Links of a source at most.
const LINKS: usize = 20_000;
/// Tolerances below this fraction of the largest coordinate are rounding.
const ROUNDING: f64 = 256.0 * f64::EPSILON;
/// Steps of this fraction of the coordinates have no direction worth the name.
const NOISE: f64 = 1e-9;
/// Ends closer than this fraction of the size are one.
const CLOSED: f64 = 1e-9;

/// A short stretch of the source. Angles and curvatures count positive towards the offset.
#[derive(Debug, Clone)]
pub struct Link {
    piece: CurvePiece<DVec2>,
    /// Both ends.
    pub ends: [DVec2; 2],
    /// Unit tangents at both ends.
    pub tangents: [DVec2; 2],
    /// Headings at both ends, counted on from link to link, in rad.
    pub headings: [f64; 2],
    /// Least and largest heading on the link.
    pub angles: [f64; 2],
    /// Unit tangents that enclose all others.
    pub edges: [DVec2; 2],
    /// The middle of the chord.
    pub centre: DVec2,
    /// Distance from there that holds the link.
    pub reach: f64,
    /// Distance from the chord that holds the link.
    pub tube: f64,
    /// Least and largest curvature times the offset's distance.
    pub bend: [f64; 2],
}

/// Angle from one direction to another, in rad.
pub fn turn(from: DVec2, to: DVec2) -> f64 {
    from.perp_dot(to).atan2(from.dot(to))
}

impl Link {
    /// `before` is the tangent before the link with its heading; `side` is 1 for an offset to the
    /// left and −1 for one to the right.
    fn new(piece: CurvePiece<DVec2>, (before, heading): (DVec2, f64), side: f64, bend: [f64; 2]) -> Self {
        let mut points = piece.points();
        let start = points.next().unwrap_or_default();
        let (mut first, mut last, mut edges, mut angles) = (None, before, [before; 2], [0.0f64; 2]);
        let (mut from, mut polygon) = (start, [start; 32]);
        let mut count = 1;
        for p in points {
            let step = p - from;
            (from, polygon[count]) = (p, p);
            count += 1;
            if step.length() <= NOISE * p.length() {
                continue;
            }
            let step = step.normalize();
            if first.is_none() {
                edges = [step; 2];
            }
            let angle = side * turn(*first.get_or_insert(step), step);
            if angle < angles[0] {
                (angles[0], edges[0]) = (angle, step);
            }
            if angle > angles[1] {
                (angles[1], edges[1]) = (angle, step);
            }
            last = step;
        }
        let first = first.unwrap_or(before);
        let heading = heading + side * turn(before, first);
        let (polygon, centre) = (&polygon[..count], 0.5 * (start + from));
        let reach = polygon.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
        let tube = polygon.iter().map(|&p| off_segment(p, [start, from])).fold(0.0, f64::max);
        Self {
            piece,
            ends: [start, from],
            tangents: [first, last],
            headings: [heading, heading + side * turn(first, last)],
            angles: angles.map(|a| heading + a),
            edges,
            centre,
            reach,
            tube,
            bend,
        }
    }

    /// Parameters at both ends.
    pub fn range(&self) -> [f64; 2] {
        self.piece.range
    }

    /// Both halves.
    pub fn halves(&self, side: f64) -> [Self; 2] {
        let [a, b] = self.piece.clone().halves();
        let a = Self::new(a, (self.tangents[0], self.headings[0]), side, self.bend);
        let b = Self::new(b, (a.tangents[1], a.headings[1]), side, self.bend);
        [a, b]
    }

    /// Both halves, with the tangent in the middle as the curve has it: differences of control points
    /// lose it as they shrink.
    pub fn halves_of(&self, curve: &NurbsCurve<DVec2>, side: f64) -> [Self; 2] {
        let [a, b] = self.halves(side);
        let middle = curve.derivatives(a.piece.range[1])[1].try_normalize().unwrap_or(a.tangents[1]);
        let heading = self.headings[0] + side * turn(self.tangents[0], middle);
        [
            a.between([self.tangents[0], middle], [self.headings[0], heading]),
            b.between([middle, self.tangents[1]], [heading, self.headings[1]]),
        ]
    }

    /// The link with better tangents at its ends.
    fn between(mut self, tangents: [DVec2; 2], headings: [f64; 2]) -> Self {
        for (tangent, heading) in tangents.into_iter().zip(headings) {
            if heading < self.angles[0] {
                (self.angles[0], self.edges[0]) = (heading, tangent);
            }
            if heading > self.angles[1] {
                (self.angles[1], self.edges[1]) = (heading, tangent);
            }
        }
        (self.tangents, self.headings) = (tangents, headings);
        self
    }

    /// How far the offset of the link may reach from any of its points.
    pub fn image(&self) -> f64 {
        let stretch = self.bend.map(|b| (1.0 - b).abs());
        2.0 * self.reach * stretch[0].max(stretch[1]) / TURN.cos()
    }

    fn is_wide(&self) -> bool {
        self.angles[1] - self.angles[0] > TURN
    }
}

/// Distance from a segment.
pub fn off_segment(p: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let chord = b - a;
    let squared = chord.length_squared();
    let s = if squared > 0.0 { ((p - a).dot(chord) / squared).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + chord * s)
}

/// The source of an offset.
#[derive(Debug)]
pub struct Track {
    /// The source, clamped.
    pub curve: NurbsCurve<DVec2>,
    /// Its links, in order.
    pub links: Vec<Rc<Link>>,
    /// By how much the heading jumps before each link; before the first one of an open curve 0.
    pub turns: Vec<f64>,
    /// Whether both ends are one point.
    pub closed: bool,
    /// 1 for an offset to the left, −1 for one to the right.
    pub side: f64,
    /// Signed distance of the offset.
    pub distance: f64,
    /// Turns beyond this angle are corners.
    pub sharp: f64,
    /// Curvature times distance up to which the offset runs forward.
    pub flat: f64,
}

impl Track {
    /// Prepares a source for the offset at a signed distance to a tolerance.
    ///
    /// # Errors
    /// [`Error::Spline`] for a curve that jumps, [`Error::Numerics`] for one that stands still, has
    /// coordinates beyond 1e150 or turns too often, [`Error::Argument`] for a tolerance that is lost in
    /// rounding.
    pub fn new(curve: &NurbsCurve<DVec2>, distance: f64, tolerance: f64) -> Result<Self> {
        let curve = curve.clamped()?;
        let (knots, (a, b)) = (curve.knots(), curve.knots().domain());
        let inner = knots.breaks_and_multiplicities().into_iter().filter(|&(t, _)| a < t && t < b);
        if let Some((t, _)) = inner.clone().find(|&(_, m)| m > knots.degree()) {
            return Err(Error::Spline { why: format!("the curve jumps at {t}: offset its parts") });
        }
        let fused = |w: &[f64]| w[1] - w[0] <= PARAMETER_RELATIVE * a.abs().max(b.abs());
        if let Some(w) = knots.breaks().windows(2).find(|w| fused(w)) {
            let why = format!("the knots {} and {} are as good as one: remove either", w[0], w[1]);
            return Err(Error::Spline { why });
        }
        let (low, high) =
            curve.poles().iter().fold((DVec2::MAX, DVec2::MIN), |(low, high), &p| (low.min(p), high.max(p)));
        check_size(&[low, high, DVec2::splat(distance)])?;
        let least = ROUNDING * low.abs().max(high.abs()).max(DVec2::splat(distance.abs())).max_element();
        if tolerance < least {
            let why = format!(
                "with coordinates and a distance that large at least {least:e} mm was expected, not {tolerance:e}"
            );
            return Err(Error::Argument { name: "tolerance", why });
        }
        let gap = curve.point(a).distance(curve.point(b));
        let relative = tolerance / distance.abs();
        let mut track = Self {
            links: Vec::new(),
            turns: Vec::new(),
            closed: gap <= CLOSED * low.distance(high),
            side: distance.signum(),
            distance,
            sharp: (0.1 * relative).clamp(1e-9, 1e-2),
            flat: 1.0 + 0.125 * relative,
            curve,
        };
        for piece in curve_pieces(&track.curve)? {
            track.add(piece, 0.25 * tolerance)?;
        }
        if track.closed {
            let ends = [track.links[track.links.len() - 1].tangents[1], track.links[0].tangents[0]];
            track.turns[0] = track.side * turn(ends[0], ends[1]);
        }
        Ok(track)
    }

    /// Adds the links of a piece: halved until each is nearly straight and lies on one side of the
    /// offset's cusps, or its offset is smaller than `smallest`.
    fn add(&mut self, piece: CurvePiece<DVec2>, smallest: f64) -> Result<()> {
        let mut rest = vec![(Bend::new(&piece), piece, 0)];
        while let Some((bend, piece, depth)) = rest.pop() {
            let before = self.links.last().map_or((DVec2::X, 0.0), |l| (l.tangents[1], l.headings[1]));
            let mut link = Link::new(piece, before, self.side, [0.0; 2]);
            let mut decided = !link.is_wide();
            if decided {
                let [low, high] = bend.curvatures().map(|k| self.distance * k);
                link.bend = [low.min(high), low.max(high)];
                let one_sided = link.bend[1] <= self.flat || link.bend[0] > 1.0;
                let is_finite = link.bend.iter().all(|b| b.is_finite());
                decided = is_finite && (one_sided || link.image() <= smallest);
            }
            if decided {
                let first = self.links.is_empty();
                self.turns.push(if first { 0.0 } else { link.headings[0] - before.1 });
                self.links.push(Rc::new(link));
            } else if self.links.len() + rest.len() >= LINKS {
                let why =
                    format!("the curve takes more than {LINKS} stretches that hardly turn: offset its parts");
                return Err(Error::Numerics { why });
            } else if depth < DEPTH {
                let ([a, b], [first, second]) = (link.piece.halves(), bend.halves());
                rest.extend([(second, b, depth + 1), (first, a, depth + 1)]);
            } else {
                let why = format!("the curve stands still at {}: it has no offset there", link.range()[0]);
                return Err(Error::Numerics { why });
            }
        }
        Ok(())
    }

    /// Point and two derivatives of the source, from one side.
    pub fn jet(&self, side: Side, t: f64) -> [DVec2; 3] {
        match side {
            Side::Above => self.curve.derivatives(t),
            Side::Below => {
                let jet = self.curve.derivatives_from(side, t, 2);
                [jet[0], jet[1], jet[2]]
            }
        }
    }

    /// By how much the heading grows over one turn of a closed curve.
    pub fn winding(&self) -> f64 {
        self.links[self.links.len() - 1].headings[1] + self.turns[0] - self.links[0].headings[0]
    }

    /// The stretches between corners and between knots as often as the degree, as ranges of links.
    pub fn stretches(&self) -> Vec<Range<usize>> {
        let knots = self.curve.knots();
        let starts = |j: &usize| {
            self.turns[*j].abs() > self.sharp
                || knots.multiplicity(self.links[*j].range()[0]) >= knots.degree()
        };
        let n = self.links.len();
        let mut bounds = vec![0];
        bounds.extend((1..n).filter(starts));
        bounds.push(n);
        bounds.windows(2).map(|w| w[0]..w[1]).collect()
    }
}
