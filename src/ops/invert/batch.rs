//! Many nearest points: neighbours in space follow each other, and each search begins where the last
//! one ended.

use super::Nearest;
use super::search::{Index, Search, Shape};
use crate::nurbs::Point;

/// Bits of a cell's number along each axis.
const BITS: u32 = 10;
/// Cells along the longest axis.
const CELLS: f64 = (1 << BITS) as f64 - 1.0;

/// The nearest points to many, in their order.
pub fn nearest_many<S: Shape>(
    shape: &S,
    index: &Index<S>,
    points: &[S::Point],
) -> Vec<Nearest<S::At, S::Point>> {
    let mut found = vec![None; points.len()];
    let (mut last, mut near) = (None, Vec::new());
    for k in coherent(points) {
        let search = Search::new(shape, index, points[k], None);
        let search = match last {
            Some(piece) => search.run_near(piece, &mut near),
            None => search.run(),
        };
        last = Some(search.nearest);
        found[k] = Some(search.best);
    }
    found.into_iter().flatten().collect()
}

/// An order in which neighbours in space follow each other: by cells of a grid around the points,
/// numbered by interleaving the bits of their coordinates (Morton 1966).
fn coherent<P: Point>(points: &[P]) -> Vec<usize> {
    let Some(&first) = points.first() else { return Vec::new() };
    let (low, high) = points.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
    let scale = CELLS / (high - low).max_element().max(f64::MIN_POSITIVE);
    let spread = |x: f64| {
        let bits = x as u64;
        (0..BITS).fold(0, |key, k| key | (bits >> k & 1) << (3 * k))
    };
    let key = |(k, &p): (usize, &P)| {
        let [x, y, z] = ((p - low) * scale).coordinates();
        (spread(x) | spread(y) << 1 | spread(z) << 2, k)
    };
    let mut keys: Vec<(u64, usize)> = points.iter().enumerate().map(key).collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, k)| k).collect()
}
