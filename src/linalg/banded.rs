//! Banded systems: spline collocation (LU) and spline normal equations (Cholesky).
//!
//! Neither pivots. B-spline collocation at Schoenberg-Whitney points is totally positive, so
//! elimination without interchanges is stable (de Boor, *A Practical Guide to Splines*, 1978).

use crate::error::{Error, Result};
use std::ops::{AddAssign, Mul, MulAssign, SubAssign};

/// A right-hand side: a number or a vector of numbers.
pub trait Rhs: Copy + Mul<f64, Output = Self> + SubAssign + AddAssign + MulAssign<f64> {}
impl<T: Copy + Mul<f64, Output = T> + SubAssign + AddAssign + MulAssign<f64>> Rhs for T {}

/// LU factors of a square matrix with at most `half` off-diagonals on either side.
#[derive(Debug, Clone)]
pub struct BandedLu {
    n: usize,
    half: usize,
    /// Row `i` holds columns `i - half ..= i + half`.
    a: Vec<f64>,
}

impl BandedLu {
    /// Factors the matrix whose rows are (first column, values).
    ///
    /// # Errors
    /// [`Error::Numerics`] on a vanishing pivot.
    pub fn new(rows: &[(usize, Vec<f64>)]) -> Result<Self> {
        let n = rows.len();
        let mut half = 0;
        for (i, (first, values)) in rows.iter().enumerate() {
            half = half.max(i.saturating_sub(*first)).max((first + values.len() - 1).saturating_sub(i));
        }
        let width = 2 * half + 1;
        let mut a = vec![0.0; n * width];
        for (i, (first, values)) in rows.iter().enumerate() {
            for (j, &v) in values.iter().enumerate() {
                a[i * width + first + j + half - i] = v;
            }
        }
        for k in 0..n {
            let pivot = a[k * width + half];
            if pivot.abs() < 1e-14 {
                return Err(Error::Numerics { why: format!("banded LU: pivot {pivot:e} at row {k} of {n}") });
            }
            for i in k + 1..n.min(k + half + 1) {
                let factor = a[i * width + k + half - i] / pivot;
                a[i * width + k + half - i] = factor;
                for j in 1..=half {
                    a[i * width + k + half - i + j] -= factor * a[k * width + half + j];
                }
            }
        }
        Ok(Self { n, half, a })
    }

    /// Solves in place for the entries `start, start + stride, …` of `x`.
    pub fn solve_strided<T: Rhs>(&self, x: &mut [T], start: usize, stride: usize) {
        let width = 2 * self.half + 1;
        for i in 0..self.n {
            for k in i.saturating_sub(self.half)..i {
                let t = x[start + k * stride] * self.a[i * width + k + self.half - i];
                x[start + i * stride] -= t;
            }
        }
        for i in (0..self.n).rev() {
            for k in i + 1..self.n.min(i + self.half + 1) {
                let t = x[start + k * stride] * self.a[i * width + k + self.half - i];
                x[start + i * stride] -= t;
            }
            x[start + i * stride] *= 1.0 / self.a[i * width + self.half];
        }
    }
}

/// A symmetric positive definite banded matrix, lower part by row, and then its Cholesky factor.
#[derive(Debug, Clone)]
pub struct BandedCholesky {
    n: usize,
    half: usize,
    /// Row `i` holds columns `i - half ..= i`.
    a: Vec<f64>,
}

impl BandedCholesky {
    /// A zero matrix of order `n` with `half` sub-diagonals.
    pub fn zeros(n: usize, half: usize) -> Self {
        let half = half.min(n.saturating_sub(1));
        Self { n, half, a: vec![0.0; n * (half + 1)] }
    }

    /// Adds `value` at (row, column) with `column <= row`.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.a[row * (self.half + 1) + column + self.half - row] += value;
    }

    /// Replaces the matrix by its factor.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the matrix is not positive definite.
    pub fn factor(&mut self) -> Result<()> {
        let width = self.half + 1;
        for i in 0..self.n {
            let (above, rest) = self.a.split_at_mut(i * width);
            let row = &mut rest[..width];
            let first = i.saturating_sub(self.half);
            for k in first..i {
                let other = &above[k * width..(k + 1) * width];
                let from = first.max(k.saturating_sub(self.half));
                let (ro, oo) = (from + self.half - i, from + self.half - k);
                let length = k - from;
                let dot: f64 =
                    row[ro..ro + length].iter().zip(&other[oo..oo + length]).map(|(a, b)| a * b).sum();
                row[k + self.half - i] = (row[k + self.half - i] - dot) / other[self.half];
            }
            let square: f64 = row[..self.half].iter().map(|a| a * a).sum();
            let pivot = row[self.half] - square;
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(Error::Numerics {
                    why: format!("banded Cholesky: pivot {pivot:e} at row {i} of {}", self.n),
                });
            }
            row[self.half] = pivot.sqrt();
        }
        Ok(())
    }

    /// Solves in place after [`factor`](Self::factor).
    pub fn solve<T: Rhs>(&self, x: &mut [T]) {
        let width = self.half + 1;
        for i in 0..self.n {
            let row = &self.a[i * width..(i + 1) * width];
            for k in i.saturating_sub(self.half)..i {
                let t = x[k] * row[k + self.half - i];
                x[i] -= t;
            }
            x[i] *= 1.0 / row[self.half];
        }
        for i in (0..self.n).rev() {
            let row = &self.a[i * width..(i + 1) * width];
            x[i] *= 1.0 / row[self.half];
            for k in i.saturating_sub(self.half)..i {
                let t = x[i] * row[k + self.half - i];
                x[k] -= t;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lu_solves_a_banded_system() {
        let rows: Vec<(usize, Vec<f64>)> = (0..6usize)
            .map(|i| {
                let first = i.saturating_sub(1);
                let last = (i + 2).min(5);
                (first, (first..=last).map(|j| if j == i { 5.0 } else { 1.0 / (1.0 + j as f64) }).collect())
            })
            .collect();
        let expected = [1.0, -2.0, 3.0, 0.5, 4.0, -1.0];
        let mut x: Vec<f64> =
            rows.iter().map(|(f, v)| v.iter().enumerate().map(|(j, a)| a * expected[f + j]).sum()).collect();
        BandedLu::new(&rows).unwrap().solve_strided(&mut x, 0, 1);
        for (a, b) in x.iter().zip(expected) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
    }

    #[test]
    fn cholesky_solves_and_refuses() {
        let mut m = BandedCholesky::zeros(5, 2);
        for i in 0..5 {
            m.add(i, i, 4.0);
            if i > 0 {
                m.add(i, i - 1, 1.0);
            }
            if i > 1 {
                m.add(i, i - 2, -0.5);
            }
        }
        m.factor().unwrap();
        // A·(1,1,1,1,1)
        let mut x = vec![4.5, 5.5, 5.0, 5.5, 4.5];
        m.solve(&mut x);
        assert!(x.iter().all(|v| (v - 1.0f64).abs() < 1e-14), "{x:?}");
        let mut bad = BandedCholesky::zeros(2, 1);
        bad.add(0, 0, 1.0);
        bad.add(1, 0, 2.0);
        bad.add(1, 1, 1.0);
        assert!(bad.factor().unwrap_err().to_string().contains("row 1 of 2"));
    }
}
