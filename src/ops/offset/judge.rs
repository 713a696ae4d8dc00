//! Which parts of an untrimmed offset keep their distance from a curve.
//!
//! A probe, a part of the offset with bounds, is halved until it is certain that all of its points keep
//! the distance or that none does; what falls short by no more than a part of the tolerance may count
//! as either. No intersection is sought: wherever the distance is lost, to another stretch, an end or a
//! corner, is found.
//!
//! Probe and curve are compared chord by chord, and that one is halved which leaves more uncertain: the
//! probe by how far its distance from the chord varies, the curve by how far it leaves the chord. As the
//! latter shrinks with the square of the length, a few stretches of the curve suffice even where it
//! touches the circle of the distance around the probe.
//!
//! Near its own foot the source is always exactly as far as asked, and no bound decides. There it
//! keeps out of the circle because it bends less than the circle does while it turns by less than a
//! right angle (along the tangent, the sine of the heading grows with the bend), and beyond that as
//! long as it heads away from the centre.

use super::raw::{Element, Probe};
use super::track::{Link, Track, off_segment};
use crate::error::{Error, Result};
use crate::ops::invert::CurveInverter;
use glam::DVec2;
use std::cell::Cell;
use std::f64::consts::FRAC_PI_2;
use std::rc::Rc;

/// Newton steps to a cut at most.
const STEPS: usize = 30;
/// A foot is an end or a corner where its slope, as the cosine of an angle, is larger than this.
const SLOPE: f64 = 1e-6;
/// A probe keeps the distance when it falls short by no more than this share of the tolerance.
const KEEPS: f64 = 0.6;
/// A probe loses the distance when it falls short by more than this share of the tolerance.
const LOSES: f64 = 0.2;
/// What is uncertain by this share of the tolerance is as good as certain.
const CERTAIN: f64 = 0.05;
/// Comparisons of a probe with a stretch of the curve at most, in all.
const COMPARISONS: usize = 4_000_000;
/// Steps of this fraction of the parameter are rounding.
const ROUNDING: f64 = 2.0 * f64::EPSILON;
/// Steps of this fraction of the parameter's range that no longer shrink are rounding.
const SETTLED: f64 = 1e-9;

/// A link, or part of one, that may come too near, with the number of the whole one.
type Candidate = (usize, Rc<Link>);

/// Where the distance of an element to a curve passes through what was asked.
#[derive(Debug, Clone, Copy)]
pub struct Cut {
    /// Parameter on the element.
    pub at: f64,
    /// Parameter of the foot on the curve.
    pub foot: f64,
    /// Whether the curve has a tangent there, perpendicular to the line from the foot.
    pub tangent: bool,
}

/// A part of an element that keeps the distance.
#[derive(Debug, Clone, Copy)]
pub struct Kept {
    /// Parameters at both ends.
    pub range: [f64; 2],
    /// What it was cut at, at both ends; none at the ends of the element.
    pub cuts: [Option<Cut>; 2],
}

/// Judges probes by their distance from one curve.
pub struct Judge<'a> {
    source: &'a Track,
    target: &'a Track,
    inverter: &'a CurveInverter<DVec2>,
    own: bool,
    tolerance: f64,
    comparisons: Cell<usize>,
}

impl<'a> Judge<'a> {
    /// Keeps the offset of `source` away from `target`, which may be the same, with its nearest points;
    /// distances may fall short by `tolerance`.
    pub fn new(
        source: &'a Track,
        target: &'a Track,
        inverter: &'a CurveInverter<DVec2>,
        tolerance: f64,
    ) -> Self {
        let own = std::ptr::eq(source, target);
        Self { source, target, inverter, own, tolerance, comparisons: Cell::new(0) }
    }

    /// The parts of an element that keep the distance, in order.
    ///
    /// # Errors
    /// [`Error::Numerics`] where that takes too many comparisons.
    pub fn kept(&self, element: &Element, probes: &[Probe]) -> Result<Vec<Kept>> {
        let mut leaves: Vec<([f64; 2], bool)> = Vec::new();
        let all = Rc::new(self.target.links.iter().cloned().enumerate().collect());
        for probe in probes {
            self.judge(probe, &all, |range, keeps| match leaves.last_mut() {
                Some((last, kept)) if *kept == keeps => last[1] = range[1],
                _ => leaves.push((range, keeps)),
            })?;
        }
        let mut out = Vec::new();
        for (i, &(range, keeps)) in leaves.iter().enumerate() {
            if keeps {
                let lost = [i.checked_sub(1).map(|k| leaves[k].0), leaves.get(i + 1).map(|l| l.0)];
                let cut = |k: usize| lost[k].and_then(|lost| self.cut(element, range, lost, k));
                let cuts = [cut(0), cut(1)];
                let at = |k: usize| cuts[k].map_or(range[k], |c| c.at);
                out.push(Kept { range: [at(0), at(1)], cuts });
            }
        }
        out.retain(|kept| kept.range[0] < kept.range[1]);
        Ok(out)
    }

    /// Tells `leaf` the verdict on each part of a probe, in order.
    fn judge(
        &self,
        probe: &Probe,
        all: &Rc<Vec<Candidate>>,
        mut leaf: impl FnMut([f64; 2], bool),
    ) -> Result<()> {
        let mut stack = vec![(probe.clone(), all.clone())];
        while let Some((probe, known)) = stack.pop() {
            let rest = if probe.bend[0] > 1.0 { None } else { self.candidates(&probe, &known)? };
            match rest {
                Some(rest) if rest.is_empty() => leaf(probe.range, true),
                Some(rest) if probe.is_divisible() => {
                    let rest = Rc::new(rest);
                    let [first, second] = probe.halves(self.source);
                    stack.extend([(second, rest.clone()), (first, rest)]);
                }
                _ => leaf(probe.range, false),
            }
        }
        Ok(())
    }

    /// Those of the candidates that may come too near to the probe, halved while they leave more
    /// uncertain than the probe does; none where one comes too near to all of it.
    fn candidates(&self, probe: &Probe, known: &[Candidate]) -> Result<Option<Vec<Candidate>>> {
        let distance = self.source.distance.abs();
        let [keeps, loses] = [KEEPS, LOSES].map(|share| distance - share * self.tolerance);
        let smallest = CERTAIN * self.tolerance;
        let n = self.target.links.len();
        let is_own = self.own && probe.bend[1] <= self.source.flat;
        let [back, forth] = if is_own { [self.certain(probe, 0), self.certain(probe, 1)] } else { [0; 2] };
        let is_certain = |root: usize| {
            let before = (probe.between[0] + n - 1 - root) % n;
            let after = (root + n - probe.between[1] % n) % n;
            before < back || after < forth || (is_own && probe.own == Some(root))
        };
        let (mut out, mut stack) = (Vec::new(), Vec::new());
        self.spend(known.len(), probe)?;
        for (root, link) in known.iter().filter(|(root, _)| !is_certain(*root)) {
            stack.push(link.clone());
            while let Some(link) = stack.pop() {
                self.spend(1, probe)?;
                if probe.centre.distance(link.centre) - probe.reach - link.reach >= keeps {
                    continue;
                }
                let [near, far] = distances(probe.ends, link.ends);
                let slack = probe.sag + link.tube;
                if near - slack >= keeps {
                    continue;
                }
                if far + slack < loses {
                    return Ok(None);
                }
                let varies = far - near + 2.0 * probe.sag;
                if link.tube > (0.25 * varies).max(smallest) && link.reach > smallest {
                    stack.extend(link.halves(self.target.side).map(Rc::new));
                } else if probe.reach > smallest {
                    out.push((*root, link));
                } else {
                    return Ok(None);
                }
            }
        }
        Ok(Some(out))
    }

    /// Counts comparisons of a probe.
    fn spend(&self, comparisons: usize, probe: &Probe) -> Result<()> {
        let spent = self.comparisons.get() + comparisons;
        self.comparisons.set(spent);
        if spent <= COMPARISONS {
            return Ok(());
        }
        let why = format!(
            "the offset by {} mm is still undecided at the parameter {} after {COMPARISONS} comparisons: ask for \
             a coarser tolerance than {:e} mm or offset parts of the curve",
            self.source.distance, probe.range[0], self.tolerance
        );
        Err(Error::Numerics { why })
    }

    /// How many links, going from the probe backwards (0) or forwards (1) along the source, keep out
    /// of all its circles for sure.
    fn certain(&self, probe: &Probe, way: usize) -> usize {
        let (track, n) = (self.target, self.target.links.len());
        let most = match (track.closed, way) {
            (true, _) => n - usize::from(probe.own.is_some()),
            (false, 0) => probe.between[0],
            (false, _) => n - probe.between[1],
        };
        let [least, largest] = probe.angles;
        let mut smooth = probe.smooth[way];
        for k in 0..most {
            let (j, shift) = if way == 1 {
                let j = probe.between[1] + k;
                (j % n, if j >= n { track.winding() } else { 0.0 })
            } else {
                let j = probe.between[0] + n - 1 - k;
                (j % n, if j < n { -track.winding() } else { 0.0 })
            };
            let link = &track.links[j];
            let joint = track.turns[if way == 1 { j } else { (j + 1) % n }];
            let [low, high] = link.angles.map(|a| a + shift);
            smooth = smooth
                && joint <= track.sharp
                && link.bend[1] <= track.flat
                && high - least <= FRAC_PI_2
                && largest - low <= FRAC_PI_2;
            // Backwards the tangents point the other way.
            let (from, sign) = if way == 1 { (link.ends[0], 1.0) } else { (link.ends[1], -1.0) };
            let away = |e: &DVec2, c: &DVec2| sign * e.dot(from - *c) >= probe.sag;
            let leaves = || link.edges.iter().all(|e| probe.ends.iter().all(|c| away(e, c)));
            if !smooth && !leaves() {
                return k;
            }
        }
        most
    }

    /// The cut at one end of a kept part, next to one that is lost: where the distance from the foot
    /// that is too near has grown to what was asked.
    fn cut(&self, element: &Element, kept: [f64; 2], lost: [f64; 2], end: usize) -> Option<Cut> {
        let (low, high) = (kept[0].min(lost[0]), kept[1].max(lost[1]));
        let (a, b) = self.target.curve.knots().domain();
        let mut s = kept[end];
        let [p, _] = element.jet(self.source, s);
        let mut u = self.inverter.nearest(p).at;
        let [c, d, _] = self.target.curve.derivatives(u);
        let tangent = (p - c).dot(d).abs() <= SLOPE * (p - c).length() * d.length();
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let [p, along] = element.jet(self.source, s);
            let [c, d, dd] = self.target.curve.derivatives(u);
            let r = p - c;
            // |r|² is as asked, and r is perpendicular to the curve unless the foot is a corner.
            let excess = DVec2::new(r.length_squared() - self.source.distance.powi(2), r.dot(d));
            let by_s = DVec2::new(2.0 * r.dot(along), along.dot(d));
            let by_u = DVec2::new(-2.0 * r.dot(d), r.dot(dd) - d.length_squared());
            let step = if tangent {
                DVec2::new(excess.perp_dot(by_u), by_s.perp_dot(excess)) / by_s.perp_dot(by_u)
            } else {
                DVec2::new(excess.x / by_s.x, 0.0)
            };
            (s, u) = (s - step.x, (u - step.y).clamp(a, b));
            if !(low..=high).contains(&s) || u.is_nan() {
                return None;
            }
            let moved = step.x.abs();
            if moved <= ROUNDING * s.abs() || (moved <= SETTLED * (high - low) && moved >= last) {
                // What is given up must be too near, or this is the cut of another place.
                let [given_up, _] = element.jet(self.source, 0.5 * (s + kept[end]));
                let least = self.source.distance.abs() - 0.01 * self.tolerance;
                let is_here = self.inverter.nearest(given_up).distance < least || s == kept[end];
                return is_here.then_some(Cut { at: s, foot: u, tangent });
            }
            last = moved;
        }
        None
    }
}

/// Least and largest distance of the points of one segment from another one.
fn distances([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> [f64; 2] {
    let ends = [off_segment(a, [c, d]), off_segment(b, [c, d])];
    let far = ends[0].max(ends[1]);
    let side = |p: DVec2, q: DVec2, x: DVec2| (q - p).perp_dot(x - p);
    if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
        return [0.0, far];
    }
    let near = off_segment(c, [a, b]).min(off_segment(d, [a, b]));
    [near.min(ends[0]).min(ends[1]), far]
}
