//! Rows of node numbers and vectors: bringing them into order and finding nodes by number.

use glam::DVec3;

/// Node numbers with a vector each, in the order of the file.
#[derive(Debug, Default, Clone, PartialEq)]
pub(super) struct Rows {
    /// Node numbers.
    pub ids: Vec<i64>,
    /// Coordinates or displacements, as many as `ids`.
    pub values: Vec<DVec3>,
}

impl Rows {
    /// Appends a row.
    pub fn push(&mut self, id: i64, value: DVec3) {
        self.ids.push(id);
        self.values.push(value);
    }

    /// Removes all rows and keeps the memory.
    pub fn clear(&mut self) {
        self.ids.clear();
        self.values.clear();
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Sorts by number and keeps the last row of each; returns the numbers that had differing rows.
    pub fn sort(&mut self) -> Vec<i64> {
        if self.ids.is_sorted_by(|a, b| a < b) {
            return Vec::new();
        }
        let mut order: Vec<usize> = (0..self.len()).collect();
        order.sort_by_key(|&row| self.ids[row]);
        let mut sorted = Rows::default();
        let mut conflicts = Vec::new();
        for same in order.chunk_by(|&a, &b| self.ids[a] == self.ids[b]) {
            let (id, value) = (self.ids[same[0]], self.values[same[same.len() - 1]]);
            let differs = |v: DVec3| v != value && !(v.is_nan() && value.is_nan());
            if same.iter().any(|&row| differs(self.values[row])) {
                conflicts.push(id);
            }
            sorted.push(id, value);
        }
        *self = sorted;
        conflicts
    }
}

/// Finds nodes by number in an ascending list.
pub(super) struct NodeIndex<'a> {
    ids: &'a [i64],
    /// Place of each number from the first on, where the numbers are dense enough for a table.
    table: Option<Vec<u32>>,
}

impl<'a> NodeIndex<'a> {
    /// Numbers a table may hold for each node.
    const SPARSEST: u64 = 16;

    /// Indexes ascending numbers.
    pub fn new(ids: &'a [i64]) -> Self {
        let span = match (ids.first(), ids.last()) {
            (Some(first), Some(last)) => last.abs_diff(*first),
            _ => 0,
        };
        let table = (span < Self::SPARSEST * ids.len() as u64).then(|| {
            let mut table = vec![u32::MAX; span as usize + 1];
            for (place, id) in ids.iter().enumerate() {
                table[(id - ids[0]) as usize] = place as u32;
            }
            table
        });
        Self { ids, table }
    }

    /// The place of a number.
    pub fn find(&self, id: i64) -> Option<u32> {
        match &self.table {
            Some(table) => {
                let offset = usize::try_from(id.checked_sub(self.ids[0])?).ok()?;
                table.get(offset).copied().filter(|&place| place != u32::MAX)
            }
            None => self.ids.binary_search(&id).ok().map(|place| place as u32),
        }
    }
}

/// Which nodes these are, for messages: `node 7`, or `3 nodes (3, 50, 300)`.
pub(super) fn named(ids: &[i64]) -> String {
    if let [id] = ids { format!("node {id}") } else { format!("{} nodes ({})", ids.len(), first_few(ids)) }
}

/// The first few numbers of a list, for messages.
pub(super) fn first_few(ids: &[i64]) -> String {
    const SHOWN: usize = 8;
    let shown: Vec<String> = ids.iter().take(SHOWN).map(i64::to_string).collect();
    let more = if ids.len() > SHOWN { ", …" } else { "" };
    format!("{}{more}", shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(list: &[(i64, f64)]) -> Rows {
        let mut rows = Rows::default();
        list.iter().for_each(|&(id, x)| rows.push(id, DVec3::X * x));
        rows
    }

    #[test]
    fn sorting_keeps_the_last_of_equal_numbers_and_names_conflicts() {
        let mut shuffled = rows(&[(7, 1.0), (3, 2.0), (7, 5.0), (3, 2.0), (1, 0.0)]);
        assert_eq!(shuffled.sort(), [7]);
        assert_eq!(shuffled, rows(&[(1, 0.0), (3, 2.0), (7, 5.0)]));
    }

    #[test]
    fn numbers_are_found_in_dense_and_in_sparse_lists() {
        for ids in [vec![5, 6, 9], vec![-3, 4, 2_500_000], vec![i64::MIN, 0, i64::MAX], vec![8], vec![]] {
            let index = NodeIndex::new(&ids);
            for (place, &id) in ids.iter().enumerate() {
                assert_eq!(index.find(id), Some(place as u32), "{id} in {ids:?}");
            }
            assert_eq!((index.find(7), index.find(i64::MIN + 1)), (None, None), "{ids:?}");
        }
    }
}
