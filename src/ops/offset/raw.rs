//! The untrimmed offset: elements along the stretches of the source and around its corners, and
//! probes, parts of elements with bounds on where they lie.

use super::Corner;
use super::track::{Link, Track, turn};
use crate::nurbs::Side;
use glam::DVec2;
use std::rc::Rc;

/// A smooth part of the untrimmed offset.
#[derive(Debug, Clone)]
pub enum Element {
    /// Along the source, over its own parameter.
    Stretch {
        /// First and last parameter.
        range: [f64; 2],
    },
    /// Around a corner, over [0, 1].
    Arc {
        /// Parameter of the corner.
        at: f64,
        /// The corner.
        centre: DVec2,
        /// From there to the arc's start.
        start: DVec2,
        /// The angle swept, in rad, positive to the left.
        turn: f64,
    },
    /// Straight on past a corner or towards it, over [0, 1].
    Line {
        /// Parameter of the corner.
        at: f64,
        /// Both ends.
        ends: [DVec2; 2],
    },
}

impl Element {
    /// First and last parameter.
    pub fn range(&self) -> [f64; 2] {
        match self {
            Element::Stretch { range } => *range,
            _ => [0.0, 1.0],
        }
    }

    /// Where the source stands while the element runs over `range`.
    pub fn source(&self, range: [f64; 2]) -> [f64; 2] {
        match *self {
            Element::Stretch { .. } => range,
            Element::Arc { at, .. } | Element::Line { at, .. } => [at; 2],
        }
    }

    /// Point and first derivative at `s`.
    pub fn jet(&self, track: &Track, s: f64) -> [DVec2; 2] {
        match *self {
            Element::Stretch { range } => {
                // At its end the stretch is still before the corner.
                let side = if s < range[1] { Side::Above } else { Side::Below };
                let [c, d, dd] = track.jet(side, s);
                let speed = d.length();
                let bend = track.distance * d.perp_dot(dd) / speed.powi(3);
                [c + d.perp() * (track.distance / speed), d * (1.0 - bend)]
            }
            Element::Arc { centre, start, turn, .. } => {
                let r = DVec2::from_angle(turn * s).rotate(start);
                [centre + r, r.perp() * turn]
            }
            Element::Line { ends: [a, b], .. } => [a.lerp(b, s), b - a],
        }
    }
}

/// What a probe is halved as.
#[derive(Debug, Clone)]
enum Form {
    Link(Rc<Link>),
    Arc { centre: DVec2, start: DVec2, turn: f64 },
    Line,
}

/// A part of an element with bounds.
#[derive(Debug, Clone)]
pub struct Probe {
    form: Form,
    /// Parameters at both ends.
    pub range: [f64; 2],
    /// Both ends.
    pub ends: [DVec2; 2],
    /// Headings of the source at both sides, least and largest.
    pub angles: [f64; 2],
    /// The middle of the chord.
    pub centre: DVec2,
    /// Distance from there that holds the probe.
    pub reach: f64,
    /// Distance from the chord that holds the probe.
    pub sag: f64,
    /// Least and largest curvature of the source times distance.
    pub bend: [f64; 2],
    /// The link below it, if any.
    pub own: Option<usize>,
    /// The number of links before it, and that of links up to its end.
    pub between: [usize; 2],
    /// Whether the source, prolonged by the element's feet, goes on smoothly backwards and forwards
    /// (an outward corner of less than a right angle is smooth enough).
    pub smooth: [bool; 2],
}

impl Probe {
    fn new(form: Form, range: [f64; 2], ends: [DVec2; 2], angles: [f64; 2], bend: [f64; 2]) -> Self {
        let chord = ends[0].distance(ends[1]);
        Self {
            form,
            range,
            ends,
            angles,
            centre: 0.5 * (ends[0] + ends[1]),
            reach: 0.5 * chord,
            sag: 0.5 * chord * (0.5 * (angles[1] - angles[0])).tan(),
            bend,
            own: None,
            between: [0; 2],
            smooth: [true; 2],
        }
    }

    fn of_link(link: Rc<Link>, track: &Track) -> Self {
        let end = |k: usize| link.ends[k] + link.tangents[k].perp() * track.distance;
        let (ends, angles, bend, range) = ([end(0), end(1)], link.angles, link.bend, link.range());
        let image = link.image();
        let mut probe = Self::new(Form::Link(link), range, ends, angles, bend);
        if bend[1] > track.flat {
            (probe.reach, probe.sag) = (image, image);
        }
        probe
    }

    fn of_arc(corner: [DVec2; 2], turn: f64, range: [f64; 2], angles: [f64; 2]) -> Self {
        let [centre, start] = corner;
        let ends = range.map(|s| centre + DVec2::from_angle(turn * s).rotate(start));
        Self::new(Form::Arc { centre, start, turn }, range, ends, angles, [0.0; 2])
    }

    /// Whether there is a parameter between both ends.
    pub fn is_divisible(&self) -> bool {
        let [a, b] = self.range;
        let middle = 0.5 * (a + b);
        a < middle && middle < b
    }

    /// Both halves.
    pub fn halves(&self, track: &Track) -> [Self; 2] {
        let [a, b] = self.range;
        let middle = 0.5 * (a + b);
        let angle = 0.5 * (self.angles[0] + self.angles[1]);
        let halves = match &self.form {
            Form::Link(link) => {
                link.halves_of(&track.curve, track.side).map(|half| Self::of_link(Rc::new(half), track))
            }
            Form::Arc { centre, start, turn } => {
                // Along an outward corner the heading falls.
                let arc = |range, angles| Self::of_arc([*centre, *start], *turn, range, angles);
                [arc([a, middle], [angle, self.angles[1]]), arc([middle, b], [self.angles[0], angle])]
            }
            Form::Line => {
                let line = |range, ends| Self::new(Form::Line, range, ends, self.angles, self.bend);
                let [p, q] = self.ends;
                [line([a, middle], [p, self.centre]), line([middle, b], [self.centre, q])]
            }
        };
        halves.map(|half| Self { own: self.own, between: self.between, smooth: self.smooth, ..half })
    }
}

/// An element with the probes that make it up.
pub type Probed = (Element, Vec<Probe>);

/// The elements of the offset in order; those around outward corners as `corner` says.
pub fn elements(track: &Track, corner: Corner) -> Vec<Probed> {
    let n = track.links.len();
    let mut out = Vec::new();
    for stretch in track.stretches() {
        let at = |j: usize| track.links[j].range();
        let range = [at(stretch.start)[0], at(stretch.end - 1)[1]];
        let end = stretch.end;
        let probe = |j: usize| Probe {
            own: Some(j),
            between: [j, j + 1],
            ..Probe::of_link(track.links[j].clone(), track)
        };
        out.push((Element::Stretch { range }, stretch.map(probe).collect()));
        if (end < n || track.closed) && track.turns[end % n] < -track.sharp {
            out.extend(around(track, end % n, corner));
        }
    }
    out
}

/// The elements around the outward corner before link `j`.
fn around(track: &Track, j: usize, corner: Corner) -> Vec<Probed> {
    let n = track.links.len();
    let (before, after) = (&track.links[(j + n - 1) % n], &track.links[j]);
    let (at, centre) = (before.range()[1], after.ends[0]);
    let normals = [before.tangents[1], after.tangents[0]].map(|t| t.perp() * track.distance);
    let swept = turn(normals[0], normals[1]);
    let headings = [after.headings[0] - track.turns[j], after.headings[0]];
    let place = |smooth, probe| Probe { between: [j, j], smooth, ..probe };
    let length = track.distance.abs() * (0.5 * swept.abs()).tan();
    match corner {
        Corner::Extension { limit } if length.hypot(track.distance) <= limit * track.distance.abs() => {
            let tip = centre + normals[0] + before.tangents[1] * length;
            let line = |ends, heading: f64, smooth| {
                let probe = Probe::new(Form::Line, [0.0, 1.0], ends, [heading; 2], [0.0; 2]);
                (Element::Line { at, ends }, vec![place(smooth, probe)])
            };
            vec![
                line([centre + normals[0], tip], headings[0], [true, false]),
                line([tip, centre + normals[1]], headings[1], [false, true]),
            ]
        }
        _ => {
            let (start, cuts) = (normals[0], (swept.abs() / 0.5).ceil().max(1.0) as usize);
            let part = |k: usize| {
                let range = [k, k + 1].map(|k| k as f64 / cuts as f64);
                let [late, early] = range.map(|s| headings[0] + s * (headings[1] - headings[0]));
                let probe = Probe::of_arc([centre, start], swept, range, [early, late]);
                place([true; 2], probe)
            };
            vec![(Element::Arc { at, centre, start, turn: swept }, (0..cuts).map(part).collect())]
        }
    }
}
