//! Fours of twice the digits: unevaluated sums of two (Dekker 1971).

use super::wide::Four;

/// Splits a double into two halves of its digits.
const SPLIT: f64 = 134_217_729.0;

/// `high + low`, the latter of the size of the former's rounding.
#[derive(Clone, Copy)]
pub(super) struct Double<F> {
    pub high: F,
    pub low: F,
}

impl<F: Four> Double<F> {
    #[inline(always)]
    pub(super) fn of(high: F) -> Self {
        Self { high, low: F::splat(0.0) }
    }

    /// `a - b`, exactly.
    #[inline(always)]
    pub(super) fn difference(a: F, b: F) -> Self {
        let high = a - b;
        let part = high - a;
        Self { high, low: (a - (high - part)) - (b + part) }
    }

    /// `a · b`, exactly.
    #[inline(always)]
    pub(super) fn product(a: F, b: F) -> Self {
        let halves = |x: F| {
            let scaled = x * F::splat(SPLIT);
            let high = scaled - (scaled - x);
            (high, x - high)
        };
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        let high = a * b;
        Self { high, low: a2 * b2 - (((high - a1 * b1) - a2 * b1) - a1 * b2) }
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Self) -> Self {
        let exact = Self::difference(self.high, other.high);
        Self { high: exact.high, low: exact.low + (self.low - other.low) }
    }

    #[inline(always)]
    pub(super) fn times(self, other: Self) -> Self {
        let exact = Self::product(self.high, other.high);
        Self { high: exact.high, low: exact.low + (self.high * other.low + self.low * other.high) }
    }

    /// The nearest single number.
    #[inline(always)]
    pub(super) fn rounded(self) -> F {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use super::super::wide::{self, Work};
    use super::*;

    struct ThirdOfThree<'a>(&'a mut [[f64; 4]; 2]);

    impl Work for ThirdOfThree<'_> {
        #[inline(always)]
        fn run<F: Four>(self) {
            let third = Double { high: F::splat(1.0 / 3.0), low: F::splat(f64::EPSILON / 12.0) };
            let rest = third.times(Double::of(F::splat(3.0))).minus(Double::of(F::splat(1.0)));
            rest.rounded().store(&mut self.0[0]);
            Double::difference(F::splat(1.0), F::splat(1e-30)).low.store(&mut self.0[1]);
        }
    }

    #[test]
    fn digits_beyond_the_sixteenth_are_kept() {
        let mut out = [[0.0; 4]; 2];
        wide::run(ThirdOfThree(&mut out));
        assert!(out[0].iter().all(|x| x.abs() < 1e-31), "3 · 1/3 - 1 is {:?}", out[0]);
        assert_eq!(out[1], [-1e-30; 4]);
    }
}
