//! The nearest points of a curve, globally: branch and bound over its Bézier pieces, as for
//! surfaces (Lüken 2022, algorithm 5, printed as a root search of the distance, made a sound
//! minimisation).

use super::batch::nearest_many;
use super::bezier::{CurvePiece, curve_pieces};
use super::search::{Index, Search, Shape, stationary};
use super::tree::{Bounds, joined};
use super::{Nearest, SAME, check_size};
use crate::error::Result;
use crate::nurbs::{NurbsCurve, Point, Side};

/// The smallest speed on a piece may be this fraction of the smallest one seen, squared.
const METRIC_MARGIN: f64 = 0.5;
/// The largest second derivative on a piece may be this many times the largest one seen.
const BEND_MARGIN: f64 = 1.5;
/// Pieces are prepared so small that their size stays below this fraction of the distance up to
/// which they are convex.
const SLACK: f64 = 0.5;
/// Places on a piece at which its derivatives are looked at.
const SAMPLES: usize = 5;
/// Halvings of a piece while preparing.
const DEPTH: usize = 8;
/// Newton steps at most.
const STEPS: usize = 40;

/// A tube around a chord that holds a stretch of the curve.
#[derive(Debug, Clone, Copy)]
pub struct Tube<P> {
    start: P,
    chord: P,
    /// 1 over the chord's squared length; 0 for a closed stretch.
    inverse: f64,
    radius: f64,
}

impl<P: Point> Tube<P> {
    fn new(points: &[P]) -> Self {
        let start = points[0];
        let chord = points[points.len() - 1] - start;
        let squared = chord.dot(chord);
        let inverse = if squared > 0.0 { 1.0 / squared } else { 0.0 };
        let mut tube = Self { start, chord, inverse, radius: 0.0 };
        tube.radius = points.iter().map(|&x| tube.off_chord(x)).fold(0.0, f64::max);
        tube
    }

    fn off_chord(&self, p: P) -> f64 {
        let r = p - self.start;
        let s = (r.dot(self.chord) * self.inverse).clamp(0.0, 1.0);
        (r - self.chord * s).length()
    }

    /// A lower bound of the squared distance to `p`.
    fn nearest_squared(&self, p: P) -> f64 {
        (self.off_chord(p) - self.radius).max(0.0).powi(2)
    }
}

/// A piece with its bounds.
#[derive(Debug, Clone)]
pub struct Arc<P> {
    piece: CurvePiece<P>,
    tube: Tube<P>,
    /// Point and first derivative in the middle.
    middle: [P; 2],
    /// Largest distance of a control point from the middle.
    size: f64,
    /// Distance up to which the squared distance is convex on the piece.
    convex: f64,
    depth: usize,
}

impl<P: Point> Arc<P> {
    fn new(curve: &NurbsCurve<P>, piece: CurvePiece<P>, depth: usize) -> Self {
        let points: Vec<P> = piece.points().collect();
        let [a, b] = piece.range;
        let (mut speed, mut bend) = (f64::INFINITY, 0.0f64);
        for k in 0..SAMPLES {
            let [_, d, dd] = jet(curve, a + (b - a) * k as f64 / (SAMPLES - 1) as f64, b);
            speed = speed.min(d.dot(d));
            bend = bend.max(dd.length());
        }
        let [c, d, _] = curve.derivatives(0.5 * (a + b));
        let size = points.iter().map(|&x| (x - c).length()).fold(0.0, f64::max);
        let convex = METRIC_MARGIN * speed / (BEND_MARGIN * bend).max(f64::MIN_POSITIVE);
        Self { tube: Tube::new(&points), piece, middle: [c, d], size, convex, depth }
    }

    fn halves(self, curve: &NurbsCurve<P>) -> [Self; 2] {
        self.piece.halves().map(|half| Self::new(curve, half, self.depth + 1))
    }

    /// The box around its control points.
    fn bounds(&self) -> Bounds {
        let of = |x: P| [x.coordinates(), x.coordinates()];
        self.piece.points().map(of).reduce(joined).unwrap_or_default()
    }

    fn start(&self, p: P) -> f64 {
        let [a, b] = self.piece.range;
        let [c, d] = self.middle;
        let step = (p - c).dot(d) / d.dot(d).max(f64::MIN_POSITIVE);
        (0.5 * (a + b) + step).clamp(a, b)
    }
}

/// Finds the nearest points of one curve; made once, asked often.
#[derive(Debug, Clone)]
pub struct CurveInverter<P: Point> {
    curve: NurbsCurve<P>,
    index: Index<Self>,
    extent: f64,
}

impl<P: Point> CurveInverter<P> {
    /// Prepares a curve.
    ///
    /// # Errors
    /// As [`NurbsCurve::insert_knot`] and [`check_size`].
    pub fn new(curve: &NurbsCurve<P>) -> Result<Self> {
        check_size(curve.poles())?;
        let curve = curve.clamped()?;
        let mut rest: Vec<Arc<P>> =
            curve_pieces(&curve)?.into_iter().rev().map(|p| Arc::new(&curve, p, 0)).collect();
        let mut arcs = Vec::new();
        while let Some(arc) = rest.pop() {
            if arc.depth < DEPTH && arc.size > SLACK * arc.convex {
                let [a, b] = arc.halves(&curve);
                rest.extend([b, a]);
            } else {
                arcs.push(arc);
            }
        }
        let extent = curve.poles().iter().map(|&x| (x - curve.poles()[0]).length()).fold(0.0, f64::max);
        Ok(Self { curve, index: Index::new(arcs), extent })
    }

    /// The curve.
    pub fn curve(&self) -> &NurbsCurve<P> {
        &self.curve
    }

    /// The nearest point to `p`, globally; `p` of a size that [`check_size`] allows.
    pub fn nearest(&self, p: P) -> Nearest<f64, P> {
        Search::new(self, &self.index, p, None).run().best
    }

    /// All points of the curve that are as near to `p` as the nearest, to within `tie` (in the
    /// unit of the points), the nearest first. Where a whole stretch is, some of its points.
    pub fn nearest_all(&self, p: P, tie: f64) -> Vec<Nearest<f64, P>> {
        Search::new(self, &self.index, p, Some(tie)).run().ties()
    }

    /// The nearest points to many, in their order. Points that lie together in space share what is
    /// found out about one of them.
    pub fn nearest_many(&self, points: &[P]) -> Vec<Nearest<f64, P>> {
        nearest_many(self, &self.index, points)
    }
}

impl<P: Point> Shape for CurveInverter<P> {
    type At = f64;
    type Point = P;
    type Piece = Arc<P>;
    type Hull = Tube<P>;

    fn extent(&self) -> f64 {
        self.extent
    }

    fn hull(arc: &Arc<P>) -> Tube<P> {
        arc.tube
    }

    fn bounds(arc: &Arc<P>) -> Bounds {
        arc.bounds()
    }

    fn bound(tube: &Tube<P>, p: P) -> f64 {
        tube.nearest_squared(p)
    }

    fn size(arc: &Arc<P>) -> f64 {
        arc.size
    }

    fn foot(&self, arc: &Arc<P>, p: P) -> (Nearest<f64, P>, bool) {
        let is_convex = (p - arc.middle[0]).length() + arc.size < arc.convex;
        (foot(&self.curve, p, arc.start(p), arc.piece.range), is_convex)
    }

    fn halves(&self, arc: Arc<P>) -> [Arc<P>; 2] {
        arc.halves(&self.curve)
    }

    fn is_minimum(&self, at: f64, p: P) -> bool {
        let [c, d, _] = self.curve.derivatives(at);
        let r = c - p;
        stationary(at, self.curve.knots().domain(), r.dot(d), r.length() * d.length())
    }

    fn same(&self, a: f64, b: f64) -> bool {
        let (first, last) = self.curve.knots().domain();
        (a - b).abs() < SAME * (last - first)
    }
}

/// Point and two derivatives on a piece that ends at `end`: there from before it, as at a kink those
/// of the next piece lead astray.
fn jet<P: Point>(curve: &NurbsCurve<P>, t: f64, end: f64) -> [P; 3] {
    if t < end {
        return curve.derivatives(t);
    }
    let jet = curve.derivatives_from(Side::Below, t, 2);
    [jet[0], jet[1], jet[2]]
}

/// The minimum of the distance within `range` from `start`: safeguarded Newton steps on
/// `(C − P)·C′`, with the second derivative `|C′|² + (C − P)·C″` (*The NURBS Book*, eq. 6.4).
fn foot<P: Point>(curve: &NurbsCurve<P>, p: P, start: f64, [a, b]: [f64; 2]) -> Nearest<f64, P> {
    let mut t = start;
    let [mut c, mut d, mut dd] = jet(curve, t, b);
    for _ in 0..STEPS {
        let r = c - p;
        let (gradient, speed) = (r.dot(d), d.dot(d));
        let bent = speed + r.dot(dd);
        let second = if bent > 0.1 * speed { bent } else { speed };
        // Derivatives over a tiny domain overflow: they tell of no way down.
        if !(gradient.is_finite() && second.is_finite()) {
            break;
        }
        let mut next = (t - gradient / second.max(f64::MIN_POSITIVE)).clamp(a, b);
        let mut at_next = jet(curve, next, b);
        let better = |x: P| (x - p).dot(x - p) <= r.dot(r) * (1.0 + 1e-14);
        for _ in 0..20 {
            if better(at_next[0]) {
                break;
            }
            next = 0.5 * (t + next);
            at_next = jet(curve, next, b);
        }
        let moved = (next - t).abs();
        t = next;
        [c, d, dd] = at_next;
        if moved <= 4.0 * f64::EPSILON * a.abs().max(b.abs()) {
            break;
        }
    }
    Nearest { at: t, point: c, distance: (c - p).length() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::nurbs::KnotVector;
    use glam::DVec2;

    #[test]
    fn coordinates_whose_squares_overflow_are_refused() {
        let line = |x: f64| {
            let knots = KnotVector::clamped(1, &[0.0, 1.0]).expect("knots");
            NurbsCurve::new(knots, vec![DVec2::ZERO, DVec2::new(x, 1.0)], None).expect("a line")
        };
        let refused = CurveInverter::new(&line(1e151));
        assert!(matches!(refused, Err(Error::Numerics { .. })), "1e151 was taken");
        let found = CurveInverter::new(&line(1e149)).expect("1e149 is small enough").nearest(DVec2::Y);
        assert!(found.distance <= 1.0, "the start is 1 away, not {}", found.distance);
    }
}
