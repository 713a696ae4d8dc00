//! Parts of an untrimmed offset as NURBS: those of straight lines and circular arcs exactly, others
//! by quintic Hermite pieces to a tolerance.

use super::raw::Element;
use super::track::Track;
use crate::error::{Error, Result};
use crate::nurbs::{KnotVector, NurbsCurve, Side};
use glam::DVec2;

/// Places inside a piece at which its error is looked at.
const SAMPLES: [f64; 3] = [0.2, 0.5, 0.8];
/// The error between them may be so many times as large.
const MARGIN: f64 = 1.2;
/// Halvings at most.
const DEPTH: usize = 30;
/// Pieces of one stretch at most.
const PIECES: usize = 20_000;
/// A stretch is straight or round when it is so to this fraction of its coordinates.
const EXACT: f64 = 1e-14;

/// The part of an element over `range`. Along the source the parameter is that of the source;
/// elsewhere it grows from 0 at about the same speed.
///
/// # Errors
/// [`Error::Numerics`] where the source stands still.
pub fn part(track: &Track, element: &Element, range: [f64; 2], tolerance: f64) -> Result<NurbsCurve<DVec2>> {
    let [a, b] = range;
    let speed = |at: f64| track.curve.derivatives(at)[1].length().max(f64::MIN_POSITIVE);
    match *element {
        Element::Stretch { .. } => match exact(track, range)? {
            Some(curve) => Ok(curve),
            None => quintic(track, range, tolerance),
        },
        Element::Arc { at, centre, start, turn } => {
            let arc = NurbsCurve::arc(centre, start, start.perp(), turn * a, turn * b)?;
            arc.over(0.0, (b - a) * turn.abs() * start.length() / speed(at))
        }
        Element::Line { at, ends: [p, q] } => {
            let poles = vec![p.lerp(q, a), p.lerp(q, b)];
            let knots = KnotVector::clamped(1, &[0.0, (b - a) * p.distance(q) / speed(at)])?;
            NurbsCurve::new(knots, poles, None)
        }
    }
}

/// The offset of a straight or circular stretch; none of another one.
fn exact(track: &Track, [a, b]: [f64; 2]) -> Result<Option<NurbsCurve<DVec2>>> {
    let (curve, d) = (&track.curve, track.distance);
    let [start, middle, end] = [a, 0.5 * (a + b), b].map(|t| curve.point(t));
    let rounding = EXACT * start.abs().max(end.abs()).max(middle.abs()).max_element();
    let chord = end - start;
    let is_straight = |p: DVec2| (p - start).perp_dot(chord).abs() <= rounding * chord.length();
    if chord.length() > rounding && is_straight(middle) {
        let part = curve.part(a, b)?;
        let shift = chord.normalize_or_zero().perp() * d;
        let all = part.poles().iter().all(|&p| is_straight(p));
        return if all { part.mapped(|p| p + shift).map(Some) } else { Ok(None) };
    }
    let (x, y) = (middle - start, end - start);
    let det = 2.0 * x.perp_dot(y);
    let to_centre = (x.perp() * y.length_squared() - y.perp() * x.length_squared()) / det;
    let (centre, radius) = (start + to_centre, to_centre.length());
    // On each span the deviation is rational of twice the degree: so many zeros, and it vanishes.
    let is_round = |w: &[f64]| {
        let (low, high, n) = (w[0].max(a), w[1].min(b), 2 * curve.knots().degree() + 2);
        low >= high
            || (0..=n).all(|k| {
                let p = curve.point(low + (high - low) * k as f64 / n as f64);
                (p.distance(centre) - radius).abs() <= 4.0 * (rounding + EXACT * radius)
            })
    };
    if curve.weights().is_none() || !curve.knots().breaks().windows(2).all(is_round) {
        return Ok(None);
    }
    let scale = 1.0 - d * curve.curvature(0.5 * (a + b))?.signum() / radius;
    curve.part(a, b)?.mapped(|p| centre + (p - centre) * scale).map(Some)
}

/// The offset and its first two derivatives.
fn jet(track: &Track, side: Side, t: f64) -> Result<[DVec2; 3]> {
    let [c, d1, d2, d3]: [DVec2; 4] =
        track.curve.derivatives_from(side, t, 3).try_into().expect("three derivatives were asked for");
    let (squared, distance) = (d1.length_squared(), track.distance);
    let speed = squared.sqrt();
    if speed == 0.0 {
        return Err(Error::Numerics {
            why: format!("the curve stands still at {t}: it has no offset there"),
        });
    }
    let curvature = d1.perp_dot(d2) / (squared * speed);
    let change = d1.perp_dot(d3) / (squared * speed) - 3.0 * curvature * d1.dot(d2) / squared;
    let stretch = 1.0 - distance * curvature;
    Ok([c + d1.perp() * (distance / speed), d1 * stretch, d2 * stretch - d1 * (distance * change)])
}

/// A Bézier piece of degree five.
struct Piece {
    range: [f64; 2],
    poles: [DVec2; 6],
}

impl Piece {
    /// The piece with these ends and derivatives there.
    fn new([a, b]: [f64; 2], [start, end]: [&[DVec2; 3]; 2]) -> Self {
        let h = b - a;
        let one = |j: &[DVec2; 3], h: f64| j[0] + j[1] * (h / 5.0);
        let two = |j: &[DVec2; 3], h: f64| j[0] + j[1] * (0.4 * h) + j[2] * (h * h / 20.0);
        let poles = [start[0], one(start, h), two(start, h), two(end, -h), one(end, -h), end[0]];
        Self { range: [a, b], poles }
    }

    /// The point a share of the way along.
    fn point(&self, s: f64) -> DVec2 {
        let r = 1.0 - s;
        let weights = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        (0..6).map(|k| self.poles[k] * (weights[k] * s.powi(k as i32) * r.powi(5 - k as i32))).sum()
    }

    fn error(&self, track: &Track) -> f64 {
        let [a, b] = self.range;
        let element = Element::Stretch { range: self.range };
        let off = |&s: &f64| self.point(s).distance(element.jet(track, a + (b - a) * s)[0]);
        MARGIN * SAMPLES.iter().map(off).fold(0.0, f64::max)
    }
}

/// The offset of a stretch to a tolerance.
fn quintic(track: &Track, [a, b]: [f64; 2], tolerance: f64) -> Result<NurbsCurve<DVec2>> {
    let breaks = track.curve.knots().breaks();
    let mut nodes = vec![a];
    nodes.extend(breaks.into_iter().filter(|&t| a < t && t < b));
    nodes.push(b);
    let mut pieces = Vec::new();
    for w in nodes.windows(2) {
        let ends = [jet(track, Side::Above, w[0])?, jet(track, Side::Below, w[1])?];
        let mut rest = vec![([w[0], w[1]], ends, 0)];
        while let Some((range, [start, end], depth)) = rest.pop() {
            let piece = Piece::new(range, [&start, &end]);
            if depth == DEPTH || piece.error(track) <= tolerance {
                pieces.push(piece);
                continue;
            }
            if pieces.len() + rest.len() >= PIECES {
                let why = format!(
                    "the offset of the curve from {} to {} takes more than {PIECES} pieces: ask for a coarser tolerance than \
                     {tolerance:e} mm or offset parts of the curve",
                    w[0], w[1]
                );
                return Err(Error::Numerics { why });
            }
            let middle = 0.5 * (range[0] + range[1]);
            let between = jet(track, Side::Above, middle)?;
            rest.push(([middle, range[1]], [between, end], depth + 1));
            rest.push(([range[0], middle], [start, between], depth + 1));
        }
    }
    spline(&pieces, 0.01 * tolerance)
}

/// Pieces put together with as few knots as moves no pole by more than `slack`.
fn spline(pieces: &[Piece], slack: f64) -> Result<NurbsCurve<DVec2>> {
    let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
    let mut flat = vec![first.range[0]; 6];
    let mut poles = first.poles[..3].to_vec();
    for w in pieces.windows(2) {
        let ([a, t], b) = (w[0].range, w[1].range[1]);
        let (left, right) = (&w[0].poles, &w[1].poles);
        let (before, after) = (t - a, b - t);
        let joint = (left[4] * after + right[1] * before) / (before + after);
        // The pole of a triple knot, seen from both sides.
        let seen = [
            left[4] + (left[4] - left[3]) * (after / before),
            right[1] + (right[1] - right[2]) * (before / after),
        ];
        poles.push(left[3]);
        let multiplicity = if joint.distance(left[5]) > slack {
            poles.extend([left[4], left[5], right[1]]);
            5
        } else if seen[0].distance(seen[1]) > slack {
            poles.extend([left[4], right[1]]);
            4
        } else {
            poles.push(0.5 * (seen[0] + seen[1]));
            3
        };
        poles.push(right[2]);
        flat.extend(std::iter::repeat_n(t, multiplicity));
    }
    poles.extend(&last.poles[3..]);
    flat.extend([last.range[1]; 6]);
    NurbsCurve::new(KnotVector::new(5, flat)?, poles, None)
}
