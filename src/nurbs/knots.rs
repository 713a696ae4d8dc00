//! Knot vectors of other kinds (periodic, from multiplicities) and what reshaping asks of them.

use super::basis::KnotVector;
use crate::error::{Error, Result};

impl KnotVector {
    /// Knots from distinct `breaks` and how often each stands; clamped or not as these say.
    ///
    /// # Errors
    /// [`Error::Spline`] when the counts disagree, and as [`KnotVector::new`].
    pub fn with_multiplicities(degree: usize, breaks: &[f64], multiplicities: &[usize]) -> Result<Self> {
        if breaks.len() != multiplicities.len() {
            let why = format!("{} multiplicities for {} breaks", multiplicities.len(), breaks.len());
            return Err(Error::Spline { why });
        }
        let each = breaks.iter().zip(multiplicities);
        Self::new(degree, each.flat_map(|(&t, &m)| std::iter::repeat_n(t, m)).collect())
    }

    /// The unclamped knots of a closed curve with the period `[first break, last break]`, inner
    /// knots and the seam simple. The last `degree` poles repeat the first ones:
    /// [`KnotVector::wrapped`] makes them.
    ///
    /// # Errors
    /// [`Error::Spline`] for less than two breaks, and as [`KnotVector::new`].
    pub fn periodic(degree: usize, breaks: &[f64]) -> Result<Self> {
        let spans = breaks.len().saturating_sub(1);
        if spans == 0 {
            return Err(Error::Spline { why: "a period needs at least two breaks".into() });
        }
        let period = breaks[spans] - breaks[0];
        let at = |i: isize| {
            let turns = i.div_euclid(spans as isize);
            breaks[i.rem_euclid(spans as isize) as usize] + turns as f64 * period
        };
        let p = degree as isize;
        let mut flat: Vec<f64> = (-p..=spans as isize + p).map(at).collect();
        // The end of the domain as given, not as rounded.
        flat[spans + degree] = breaks[spans];
        Self::new(degree, flat)
    }

    /// Poles or weights of one period, repeated until there is one for each function.
    pub fn wrapped<T: Copy>(&self, period: &[T]) -> Vec<T> {
        period.iter().copied().cycle().take(self.len()).collect()
    }

    /// How often `t` stands among the knots.
    pub fn multiplicity(&self, t: f64) -> usize {
        let flat = self.flat();
        flat.partition_point(|&k| k <= t) - flat.partition_point(|&k| k < t)
    }

    /// The parameter of the domain that `t` stands for on a closed curve.
    pub fn reduced(&self, t: f64) -> f64 {
        let (a, b) = self.domain();
        if (a..=b).contains(&t) { t } else { (a + (t - a).rem_euclid(b - a)).min(b) }
    }

    /// The knots of the curve run backwards over the same domain.
    pub fn reversed(&self) -> Self {
        let (a, b) = self.domain();
        let mirrored = |&k: &f64| match k {
            k if k == a => b,
            k if k == b => a,
            // Rounding must not move them past the ends, nor out of the numbers.
            k if k < a => (a + (b - k)).clamp(b, f64::MAX),
            k if k > b => (a + (b - k)).clamp(-f64::MAX, a),
            k => (a + (b - k)).clamp(a, b),
        };
        let flat = self.flat().iter().rev().map(mirrored).collect();
        Self::new(self.degree(), flat).expect("mirrored knots ascend as well")
    }

    /// The same knots stretched to the domain `[a, b]`.
    ///
    /// # Errors
    /// [`Error::Spline`] for an empty or unusable domain.
    pub fn over(&self, a: f64, b: f64) -> Result<Self> {
        let (from, to) = self.domain();
        let scale = (b - a) / (to - from);
        let moved = |&k: &f64| match k {
            k if k == from => a,
            k if k == to => b,
            k => a + (k - from) * scale,
        };
        Self::new(self.degree(), self.flat().iter().map(moved).collect())
    }

    /// Inner knots that `self` lacks to have all of `other`, repeated as needed.
    pub fn missing(&self, other: &Self) -> Vec<f64> {
        let (a, b) = self.domain();
        let inner = other.breaks_and_multiplicities().into_iter().filter(|&(t, _)| a < t && t < b);
        inner.flat_map(|(t, m)| std::iter::repeat_n(t, m.saturating_sub(self.multiplicity(t)))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::{NurbsCurve, Side};
    use glam::DVec2;

    #[test]
    fn a_periodic_curve_closes_with_all_its_derivatives() {
        for degree in 1..=5 {
            let knots = KnotVector::periodic(degree, &[0.5, 0.9, 1.0, 1.7, 2.1, 2.5, 3.5]).unwrap();
            assert_eq!(knots.domain(), (0.5, 3.5));
            let period: Vec<DVec2> = (0..6).map(|i| DVec2::from_angle(i as f64) * (1.0 + i as f64)).collect();
            let curve = NurbsCurve::new(knots.clone(), knots.wrapped(&period), None).unwrap();
            let (start, end) =
                (curve.derivatives_to(0.5, degree - 1), curve.derivatives_from(Side::Below, 3.5, degree - 1));
            for (k, (a, b)) in start.iter().zip(&end).enumerate() {
                assert!(
                    (*a - *b).length() < 1e-11 * a.length().max(1.0),
                    "degree {degree}, order {k}: {a} {b}"
                );
            }
        }
    }

    #[test]
    fn parameters_of_a_closed_curve_come_back_into_the_domain() {
        let knots = KnotVector::periodic(3, &[0.0, 1.0, 2.0, 3.0]).unwrap();
        for (t, expected) in [(0.0, 0.0), (3.0, 3.0), (-0.5, 2.5), (7.25, 1.25), (-1e-300, 3.0)] {
            assert_eq!(knots.reduced(t), expected, "{t}");
        }
    }

    #[test]
    fn missing_knots_are_counted() {
        let a = KnotVector::with_multiplicities(3, &[0.0, 1.0, 2.0, 4.0], &[4, 1, 2, 4]).unwrap();
        let b = KnotVector::with_multiplicities(3, &[0.0, 1.0, 3.0, 4.0], &[4, 3, 1, 4]).unwrap();
        assert_eq!(a.missing(&b), [1.0, 1.0, 3.0]);
        assert_eq!(b.missing(&a), [2.0, 2.0]);
        assert_eq!(a.multiplicity(2.0), 2);
        assert_eq!(a.reversed().flat(), [0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 3.0, 4.0, 4.0, 4.0, 4.0]);
        assert_eq!(a.over(1.0, 2.0).unwrap().flat()[3..8], [1.0, 1.25, 1.5, 1.5, 2.0]);
    }
}
