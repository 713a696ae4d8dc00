//! The map from one interval onto several (Lüken 2022, after definition 2.3.14; printed without
//! the starts of the intervals and with ends that count twice).

use crate::error::{Error, Result};

/// Maps a domain onto a union of intervals in it: each interval takes the part of the domain up to
/// the middle of the gap to its neighbours, linearly; a cell's start belongs to it, its end only if
/// it is the last one.
#[derive(Debug, Clone, PartialEq)]
pub struct DomainMap {
    /// Where the cells start, and the end of the domain.
    cells: Vec<f64>,
    intervals: Vec<[f64; 2]>,
}

impl DomainMap {
    /// The map of `domain` onto ascending intervals that do not overlap.
    ///
    /// # Errors
    /// [`Error::Argument`] when there is none, or they are empty, overlap or leave the domain.
    pub fn new(domain: [f64; 2], intervals: Vec<[f64; 2]>) -> Result<Self> {
        let fail = |why: String| Err(Error::Argument { name: "intervals", why });
        let (Some(first), Some(last)) = (intervals.first(), intervals.last()) else {
            return fail("at least one is needed".into());
        };
        if !(domain[0] <= first[0] && last[1] <= domain[1]) {
            return fail(format!("{first:?} to {last:?} leave the domain {domain:?}"));
        }
        if let Some(empty) = intervals.iter().find(|i| i[0].is_nan() || i[1].is_nan() || i[0] >= i[1]) {
            return fail(format!("{empty:?} is empty"));
        }
        if let Some(w) = intervals.windows(2).find(|w| w[1][0] < w[0][1]) {
            return fail(format!("{:?} and {:?} overlap or do not ascend", w[0], w[1]));
        }
        let mut cells = vec![domain[0]];
        cells.extend(intervals.windows(2).map(|w| 0.5 * (w[0][1] + w[1][0])));
        cells.push(domain[1]);
        Ok(Self { cells, intervals })
    }

    /// The map of `domain` onto the union of intervals, in any order; empty ones are left out.
    ///
    /// # Errors
    /// [`Error::Argument`] when there is none, or they leave the domain.
    pub fn onto(domain: [f64; 2], intervals: impl IntoIterator<Item = [f64; 2]>) -> Result<Self> {
        let mut kept: Vec<[f64; 2]> = intervals.into_iter().filter(|s| s[0] < s[1]).collect();
        kept.sort_by(|a, b| a[0].total_cmp(&b[0]));
        kept.dedup_by(|next, last| {
            let touches = next[0] <= last[1];
            if touches {
                last[1] = last[1].max(next[1]);
            }
            touches
        });
        Self::new(domain, kept)
    }

    /// The intervals.
    pub fn intervals(&self) -> &[[f64; 2]] {
        &self.intervals
    }

    /// Where `t` is mapped to; beyond the domain as its ends.
    pub fn at(&self, t: f64) -> f64 {
        let i = self.cells.partition_point(|&c| c <= t).clamp(1, self.intervals.len()) - 1;
        let ([s, e], [from, to]) = (self.intervals[i], [self.cells[i], self.cells[i + 1]]);
        let share = ((t - from) / (to - from)).clamp(0.0, 1.0);
        s * (1.0 - share) + e * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_reaches_each_interval_and_nothing_else() {
        let map = DomainMap::new([0.0, 1.0], vec![[0.0, 0.2], [0.5, 1.0]]).unwrap();
        // The cells meet at 0.35; print gives 0.619, 0.538 and 0.769.
        for (t, expected) in
            [(0.0, 0.0), (0.175, 0.1), (0.35, 0.5), (0.7, 0.5 + 0.5 * 0.35 / 0.65), (1.0, 1.0)]
        {
            assert!((map.at(t) - expected).abs() < 1e-15, "{t}: {} instead of {expected}", map.at(t));
        }
        assert!((map.at(0.7) - 0.769).abs() < 1e-3 && map.at(0.35 - 1e-12) < 0.2 + 1e-15);
        for i in 0..=1000 {
            let x = map.at(i as f64 * 1e-3);
            assert!((0.0..=0.2).contains(&x) || (0.5..=1.0).contains(&x), "{x}");
        }
    }

    #[test]
    fn intervals_in_any_order_are_united() {
        let map = DomainMap::onto([0.0, 4.0], [[2.0, 3.0], [0.0, 1.0], [2.5, 3.5], [1.0, 1.0]]).unwrap();
        assert_eq!(map.intervals(), [[0.0, 1.0], [2.0, 3.5]]);
        assert!(DomainMap::onto([0.0, 4.0], [[1.0, 1.0]]).is_err());
    }

    #[test]
    fn unusable_intervals_are_refused() {
        for bad in
            [vec![], vec![[0.3, 0.3]], vec![[0.0, 0.6], [0.5, 1.0]], vec![[0.5, 1.1]], vec![[0.1, f64::NAN]]]
        {
            assert!(DomainMap::new([0.0, 1.0], bad.clone()).is_err(), "{bad:?}");
        }
    }
}
