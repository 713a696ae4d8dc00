//! Arc length and its inverse.

use super::curve::{NurbsCurve, Point};
use crate::error::{Error, Result};

/// Gauss-Legendre points and weights on [-1, 1] (Abramowitz and Stegun, table 25.4).
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// Halvings of one span at most.
const DEPTH: usize = 40;

/// Pieces of a curve at most: smooth ones take a few a span, cusps some dozens.
const PIECES: usize = 1 << 16;

/// A curve with the length up to each of its breaks, for going back and forth between parameter
/// and length.
#[derive(Debug, Clone)]
pub struct ArcLength<'a, P: Point> {
    curve: &'a NurbsCurve<P>,
    tolerance: f64,
    /// (parameter, length from the start), ascending.
    marks: Vec<(f64, f64)>,
}

impl<'a, P: Point> ArcLength<'a, P> {
    /// Measures the curve to `tolerance`, in mm, over all of it. The bound is on the estimated
    /// error, and no smaller than rounding allows.
    ///
    /// # Errors
    /// [`Error::Argument`] for a tolerance that is not positive; [`Error::Numerics`] for one that
    /// cannot be reached, and where the length overflows.
    pub fn new(curve: &'a NurbsCurve<P>, tolerance: f64) -> Result<Self> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            let why = format!("a positive length in mm was expected, not {tolerance}");
            return Err(Error::Argument { name: "tolerance", why });
        }
        let breaks = curve.knots().breaks();
        let (a, b) = curve.knots().domain();
        let mut marks = vec![(a, 0.0)];
        let measured = ArcLength { curve, tolerance, marks: Vec::new() };
        for w in breaks.windows(2) {
            measured.mark(w[0], w[1], tolerance * (w[1] - w[0]) / (b - a), DEPTH, &mut marks);
        }
        let total = marks[marks.len() - 1].1;
        if marks.len() > PIECES || !total.is_finite() {
            let why = format!(
                "the length, about {total} mm, cannot be measured to {tolerance:e} mm with {PIECES} pieces: \
                 give a larger tolerance"
            );
            return Err(Error::Numerics { why });
        }
        Ok(Self { marks, ..measured })
    }

    /// The whole length, in mm.
    pub fn total(&self) -> f64 {
        self.marks[self.marks.len() - 1].1
    }

    /// The length from the start to `t`, in mm.
    pub fn to(&self, t: f64) -> f64 {
        let after = self.marks.partition_point(|m| m.0 <= t).clamp(1, self.marks.len() - 1);
        let (from, length) = self.marks[after - 1];
        length + self.gauss(from, t)
    }

    /// The parameter at a length from the start; lengths beyond the ends give the ends.
    pub fn parameter(&self, length: f64) -> f64 {
        let after = self.marks.partition_point(|m| m.1 <= length).clamp(1, self.marks.len() - 1);
        let ((mut a, la), (mut b, lb)) = (self.marks[after - 1], self.marks[after]);
        if length <= la || lb <= la {
            return a;
        }
        if length >= lb {
            return b;
        }
        let start = a;
        let mut t = a + (b - a) * (length - la) / (lb - la);
        for _ in 0..100 {
            let excess = la + self.gauss(start, t) - length;
            let speed = self.speed(t);
            let newton = t - excess / speed;
            if excess.abs() < 1e-3 * self.tolerance && speed > 0.0 {
                return newton.clamp(a, b);
            }
            if excess > 0.0 {
                b = t
            } else {
                a = t
            }
            let next = if newton > a && newton < b { newton } else { 0.5 * (a + b) };
            if next == t {
                return t;
            }
            t = next;
        }
        t
    }

    fn speed(&self, t: f64) -> f64 {
        self.curve.derivatives(t)[1].length()
    }

    fn gauss(&self, a: f64, b: f64) -> f64 {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let pair = |&(x, w): &(f64, f64)| w * (self.speed(middle - half * x) + self.speed(middle + half * x));
        half * GAUSS.iter().map(pair).sum::<f64>()
    }

    /// Halves the interval until both halves sum to the whole.
    fn mark(&self, a: f64, b: f64, tolerance: f64, depth: usize, marks: &mut Vec<(f64, f64)>) {
        let middle = 0.5 * (a + b);
        let (whole, first, second) = (self.gauss(a, b), self.gauss(a, middle), self.gauss(middle, b));
        let error = (first + second - whole).abs();
        let done = error <= tolerance.max(8.0 * f64::EPSILON * whole);
        if depth == 0 || done || error.is_nan() || marks.len() > PIECES {
            let before = marks[marks.len() - 1].1;
            marks.extend([(middle, before + first), (b, before + first + second)]);
        } else {
            self.mark(a, middle, 0.5 * tolerance, depth - 1, marks);
            self.mark(middle, b, 0.5 * tolerance, depth - 1, marks);
        }
    }
}

impl<P: Point> NurbsCurve<P> {
    /// The length of the curve to `tolerance`, both in mm.
    ///
    /// # Errors
    /// As [`ArcLength::new`].
    pub fn length(&self, tolerance: f64) -> Result<f64> {
        Ok(ArcLength::new(self, tolerance)?.total())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;
    use glam::DVec2;

    fn quarter() -> NurbsCurve<DVec2> {
        let poles = vec![DVec2::X, DVec2::ONE, DVec2::Y];
        let weights = Some(vec![1.0, 0.5f64.sqrt(), 1.0]);
        NurbsCurve::new(KnotVector::clamped(2, &[0.0, 1.0]).unwrap(), poles, weights).unwrap()
    }

    /// (t², t³): stands still at the start.
    fn cusp() -> NurbsCurve<DVec2> {
        let poles = [(0.0, 0.0), (0.0, 0.0), (1.0 / 3.0, 0.0), (1.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
        NurbsCurve::new(KnotVector::clamped(3, &[0.0, 1.0]).unwrap(), poles.to_vec(), None).unwrap()
    }

    #[test]
    fn lengths_follow_the_tolerance() {
        let exact = (13f64.powf(1.5) - 8.0) / 27.0;
        for exponent in [0, 3, 6, 9, 12] {
            let tolerance = 10f64.powi(-exponent);
            let (arc, semicubic) = (quarter().length(tolerance).unwrap(), cusp().length(tolerance).unwrap());
            assert!((arc - std::f64::consts::FRAC_PI_2).abs() < tolerance, "{arc} to {tolerance}");
            assert!((semicubic - exact).abs() < tolerance, "{semicubic} {exact} to {tolerance}");
        }
    }

    #[test]
    fn parameter_and_length_go_back_and_forth() {
        for curve in [quarter(), cusp()] {
            let length = ArcLength::new(&curve, 1e-12).unwrap();
            for i in 0..=50 {
                let s = length.total() * i as f64 / 50.0;
                let t = length.parameter(s);
                assert!((length.to(t) - s).abs() < 1e-12, "{s} came back as {} from {t}", length.to(t));
            }
            assert_eq!((length.parameter(-1.0), length.parameter(9.0)), (0.0, 1.0));
        }
        let arc = ArcLength::new(&quarter(), 1e-12).unwrap().parameter(std::f64::consts::FRAC_PI_4);
        assert!((arc - 0.5).abs() < 1e-12, "{arc}");
    }

    #[test]
    fn a_tolerance_must_be_positive() {
        assert!(matches!(quarter().length(0.0), Err(Error::Argument { .. })));
    }

    #[test]
    fn a_length_that_overflows_is_refused() {
        let poles = vec![DVec2::ZERO, DVec2::splat(1e300), DVec2::splat(-1e300)];
        let curve = NurbsCurve::new(KnotVector::clamped(2, &[0.0, 1e-20]).unwrap(), poles, None).unwrap();
        assert!(matches!(curve.length(1e-9), Err(Error::Numerics { .. })));
    }
}
