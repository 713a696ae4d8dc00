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

/// How the factorisation splits its work. A fixed number keeps every bit the same whatever the
/// number of threads that carry it out.
fn splits() -> Par {
    Par::rayon(2)
}

/// Collects entries of a symmetric matrix, in any order, repeated ones added up.
#[derive(Debug, Clone)]
pub struct SymmetricBuilder {
    n: usize,
    entries: Vec<(u32, u32, f64)>,
}

/// A symmetric matrix as its lower triangle by columns.
#[derive(Debug, Clone)]
pub struct SymmetricMatrix {
    n: usize,
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl SymmetricBuilder {
    /// An empty matrix of order `n`.
    pub fn new(n: usize) -> Self {
        Self { n, entries: Vec::new() }
    }

    /// Makes room for `count` more entries.
    pub fn reserve(&mut self, count: usize) {
        self.entries.reserve(count);
    }

    /// Adds `value` at (i, j) and, for i ≠ j, at (j, i).
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        let (row, column) = if i >= j { (i, j) } else { (j, i) };
        self.entries.push((column as u32, row as u32, value));
    }

    /// Sorts and sums the entries.
    pub fn build(self) -> SymmetricMatrix {
        let n = self.n;
        let mut starts = vec![0usize; n + 1];
        for e in &self.entries {
            starts[e.0 as usize + 1] += 1;
        }
        for j in 0..n {
            starts[j + 1] += starts[j];
        }
        let mut fill = starts.clone();
        let mut bucket = vec![(0u32, 0.0); self.entries.len()];
        for (column, row, value) in self.entries {
            let at = &mut fill[column as usize];
            bucket[*at] = (row, value);
            *at += 1;
        }
        let (mut rows, mut values) = (Vec::with_capacity(bucket.len()), Vec::with_capacity(bucket.len()));
        let mut place = vec![usize::MAX; n];
        let mut out_starts = vec![0usize; n + 1];
        let mut column = Vec::new();
        for j in 0..n {
            column.clear();
            for &(row, value) in &bucket[starts[j]..starts[j + 1]] {
                let slot = &mut place[row as usize];
                if *slot == usize::MAX {
                    *slot = column.len();
                    column.push((row, value));
                } else {
                    column[*slot].1 += value;
                }
            }
            for &(row, _) in &column {
                place[row as usize] = usize::MAX;
            }
            column.sort_unstable_by_key(|e: &(u32, f64)| e.0);
            rows.extend(column.iter().map(|e| e.0 as usize));
            values.extend(column.iter().map(|e| e.1));
            out_starts[j + 1] = rows.len();
        }
        SymmetricMatrix { n, starts: out_starts, rows, values }
    }
}

impl SymmetricMatrix {
    /// Order.
    pub fn order(&self) -> usize {
        self.n
    }

    /// Stored entries of the lower triangle.
    pub fn stored(&self) -> usize {
        self.values.len()
    }
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

    /// A five-point Laplacian plus one, which couples all unknowns.
    fn grid(m: usize) -> SymmetricMatrix {
        let mut b = SymmetricBuilder::new(m * m);
        for i in 0..m {
            for j in 0..m {
                let k = i * m + j;
                b.add(k, k, 5.0);
                if j + 1 < m {
                    b.add(k, k + 1, -1.0);
                }
                if i + 1 < m {
                    b.add(k + m, k, -0.5);
                    b.add(k, k + m, -0.5);
                }
            }
        }
        b.build()
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
        let mut b = SymmetricBuilder::new(2);
        b.add(0, 0, 1.0);
        b.add(1, 0, 2.0);
        b.add(1, 1, 1.0);
        let error = SparseCholesky::new(&b.build()).unwrap_err().to_string();
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
