//! Sparse symmetric positive definite systems, factored by `faer`.

use crate::error::{Error, Result};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use glam::DVec3;
use rayon::prelude::*;

/// How the factorisation splits its work. A fixed number keeps every bit the same whatever the
/// number of threads that carry it out.
fn splits() -> Par {
    Par::rayon(2)
}

/// Something that can list the entries of a symmetric matrix, each time the same in the same order.
pub trait SymmetricEntries {
    /// Visits (i, j, value) for one of (i, j) and (j, i), in any order; repeated ones add up.
    fn for_each(&self, visit: impl FnMut(usize, usize, f64));
}

/// Columns that one task sorts.
const COLUMNS: usize = 1024;

/// A symmetric matrix as its lower triangle by columns.
#[derive(Debug, Clone)]
pub struct SymmetricMatrix {
    n: usize,
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl SymmetricMatrix {
    /// Sorts and sums the entries of a matrix of order `n`.
    pub fn new(n: usize, entries: &impl SymmetricEntries) -> Self {
        // Listing the entries twice is cheaper than keeping them all.
        let mut ends = vec![0usize; n + 1];
        entries.for_each(|i, j, _| ends[i.min(j) + 1] += 1);
        for j in 0..n {
            ends[j + 1] += ends[j];
        }
        let starts = ends.clone();
        let mut bucket = vec![(0u32, 0.0); starts[n]];
        entries.for_each(|i, j, value| {
            let at = &mut ends[i.min(j)];
            bucket[*at] = (i.max(j) as u32, value);
            *at += 1;
        });
        let tasks: Vec<_> = (0..n).step_by(COLUMNS).map(|first| first..n.min(first + COLUMNS)).collect();
        let parts: Vec<_> = tasks.into_par_iter().map(|columns| summed(&bucket, &starts, columns)).collect();
        let total = parts.iter().map(|p| p.rows.len()).sum();
        let (mut rows, mut values) = (Vec::with_capacity(total), Vec::with_capacity(total));
        let mut starts = vec![0usize];
        for part in parts {
            starts.extend(part.ends.iter().map(|end| rows.len() + end));
            rows.extend(part.rows);
            values.extend(part.values);
        }
        Self { n, starts, rows, values }
    }

    /// Order.
    pub fn order(&self) -> usize {
        self.n
    }

    /// Stored entries of the lower triangle.
    pub fn stored(&self) -> usize {
        self.values.len()
    }
}

/// Some columns of a matrix.
#[derive(Default)]
struct Columns {
    ends: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

/// Sorts and sums the bucketed entries of some columns.
fn summed(bucket: &[(u32, f64)], starts: &[usize], columns: std::ops::Range<usize>) -> Columns {
    let mut out = Columns::default();
    let mut column: Vec<(u32, f64)> = Vec::new();
    for j in columns {
        column.clear();
        column.extend_from_slice(&bucket[starts[j]..starts[j + 1]]);
        // Stable, so that equal rows are summed in the order in which they were listed.
        column.sort_by_key(|e| e.0);
        for &(row, value) in &column {
            let first = out.ends.last().copied().unwrap_or(0);
            match out.values.last_mut() {
                Some(last) if out.rows.len() > first && out.rows[out.rows.len() - 1] == row as usize => {
                    *last += value;
                }
                _ => {
                    out.rows.push(row as usize);
                    out.values.push(value);
                }
            }
        }
        out.ends.push(out.rows.len());
    }
    out
}

/// The Cholesky factor of a sparse matrix.
#[derive(Debug)]
pub struct SparseCholesky {
    n: usize,
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
}

impl SparseCholesky {
    /// Orders (minimum degree) and factors.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the matrix is not positive definite or memory runs out.
    pub fn new(matrix: &SymmetricMatrix) -> Result<Self> {
        let fail =
            |why: String| Error::Numerics { why: format!("sparse Cholesky of order {}: {why}", matrix.n) };
        let pattern =
            SymbolicSparseColMatRef::new_checked(matrix.n, matrix.n, &matrix.starts, None, &matrix.rows);
        let symbolic = factorize_symbolic_cholesky(
            pattern,
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|e| fail(format!("{e:?}")))?;
        let mut values = vec![0.0; symbolic.len_val()];
        let mut memory =
            MemBuffer::try_new(symbolic.factorize_numeric_llt_scratch::<f64>(splits(), Default::default()))
                .map_err(|e| fail(format!("{e:?}")))?;
        symbolic
            .factorize_numeric_llt::<f64>(
                &mut values,
                SparseColMatRef::new(pattern, &matrix.values),
                Side::Lower,
                LltRegularization::default(),
                splits(),
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|e| fail(format!("{e:?}")))?;
        Ok(Self { n: matrix.n, symbolic, values })
    }

    /// Stored values of the factor.
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// Solves for three right-hand sides, the coordinates of `x`, in place.
    ///
    /// # Errors
    /// [`Error::Numerics`] when memory runs out.
    pub fn solve(&self, x: &mut [DVec3]) -> Result<()> {
        let mut columns = vec![0.0; 3 * self.n];
        for (i, p) in x.iter().enumerate() {
            for c in 0..3 {
                columns[c * self.n + i] = p[c];
            }
        }
        let mut memory = MemBuffer::try_new(self.symbolic.solve_in_place_scratch::<f64>(3, splits()))
            .map_err(|e| Error::Numerics { why: format!("sparse solve: {e:?}") })?;
        LltRef::<'_, usize, f64>::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut columns, self.n, 3),
            splits(),
            MemStack::new(&mut memory),
        );
        for (i, p) in x.iter_mut().enumerate() {
            *p = DVec3::new(columns[i], columns[self.n + i], columns[2 * self.n + i]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Entries = Vec<(usize, usize, f64)>;

    impl SymmetricEntries for Entries {
        fn for_each(&self, mut visit: impl FnMut(usize, usize, f64)) {
            self.iter().for_each(|&(i, j, value)| visit(i, j, value));
        }
    }

    /// A five-point Laplacian plus one, which couples all unknowns.
    fn grid(m: usize) -> SymmetricMatrix {
        let mut entries = Entries::new();
        for i in 0..m {
            for j in 0..m {
                let k = i * m + j;
                entries.push((k, k, 5.0));
                if j + 1 < m {
                    entries.push((k, k + 1, -1.0));
                }
                if i + 1 < m {
                    entries.push((k + m, k, -0.5));
                    entries.push((k, k + m, -0.5));
                }
            }
        }
        SymmetricMatrix::new(m * m, &entries)
    }

    #[test]
    fn entries_are_sorted_and_summed() {
        let entries = vec![(2, 0, 1.0), (1, 1, 4.0), (0, 2, 0.5), (0, 0, 3.0), (0, 1, 2.0), (2, 2, 7.0)];
        let matrix = SymmetricMatrix::new(3, &entries);
        assert_eq!(matrix.starts, [0, 3, 4, 5]);
        assert_eq!(matrix.rows, [0, 1, 2, 1, 2]);
        assert_eq!(matrix.values, [3.0, 2.0, 1.5, 4.0, 7.0]);
    }

    #[test]
    fn solves_a_grid() {
        let m = 40;
        let matrix = grid(m);
        let expected: Vec<DVec3> =
            (0..m * m).map(|k| DVec3::new((k as f64).sin(), 1.0, k as f64 * 1e-3)).collect();
        let mut x = vec![DVec3::ZERO; m * m];
        for j in 0..m * m {
            for e in matrix.starts[j]..matrix.starts[j + 1] {
                let (i, v) = (matrix.rows[e], matrix.values[e]);
                x[i] += expected[j] * v;
                if i != j {
                    x[j] += expected[i] * v;
                }
            }
        }
        SparseCholesky::new(&matrix).unwrap().solve(&mut x).unwrap();
        for (a, b) in x.iter().zip(&expected) {
            assert!((*a - *b).length() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn refuses_an_indefinite_matrix() {
        let entries = vec![(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)];
        let error = SparseCholesky::new(&SymmetricMatrix::new(2, &entries)).unwrap_err().to_string();
        assert!(error.contains("order 2"), "{error}");
    }

    #[test]
    fn one_thread_and_two_give_the_same_bits() {
        let solve = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut x: Vec<DVec3> = (0..2500).map(|k| DVec3::splat((k as f64).cos())).collect();
                SparseCholesky::new(&grid(50)).unwrap().solve(&mut x).unwrap();
                x
            })
        };
        assert_eq!(solve(1), solve(2));
    }
}
