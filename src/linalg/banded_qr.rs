//! Least squares with banded rows, by Givens rotations row by row (George and Heath 1980; de Boor,
//! *A Practical Guide to Splines*, ch. XIV). Better conditioned than normal equations, and exact
//! for as many rows as unknowns.

use super::banded::Rhs;
use crate::error::{Error, Result};

/// Diagonal entries below this fraction of the largest entry of their column make the system
/// singular.
const SINGULAR: f64 = 1e-13;

/// A least squares problem in the making: the triangular factor of the rows seen so far.
#[derive(Debug, Clone)]
pub struct BandedQr<T> {
    width: usize,
    /// Row `i` holds columns `i .. i + width`.
    r: Vec<f64>,
    rhs: Vec<T>,
    /// Largest entry seen in each column.
    largest: Vec<f64>,
}

impl<T: Rhs> BandedQr<T> {
    /// No rows yet, for `n` unknowns of which at most `width` neighbours stand in one row; `zero`
    /// is the zero of the right-hand sides.
    pub fn new(n: usize, width: usize, zero: T) -> Self {
        Self { width, r: vec![0.0; n * width], rhs: vec![zero; n], largest: vec![0.0; n] }
    }

    /// One more row: at most `width` values from the column `first` on, and its right-hand side.
    pub fn add(&mut self, first: usize, values: &[f64], mut rhs: T) {
        let mut row = vec![0.0; self.width];
        row[..values.len()].copy_from_slice(values);
        for (k, value) in values.iter().enumerate() {
            self.largest[first + k] = self.largest[first + k].max(value.abs());
        }
        for i in first..self.rhs.len() {
            if row[0] != 0.0 {
                let own = &mut self.r[i * self.width..(i + 1) * self.width];
                let h = own[0].hypot(row[0]);
                let (c, s) = (own[0] / h, row[0] / h);
                for (a, b) in own.iter_mut().zip(&mut row) {
                    (*a, *b) = (c * *a + s * *b, c * *b - s * *a);
                }
                let mut turned = self.rhs[i] * c;
                turned += rhs * s;
                rhs *= c;
                rhs -= self.rhs[i] * s;
                self.rhs[i] = turned;
            }
            row.rotate_left(1);
            row[self.width - 1] = 0.0;
            if row.iter().all(|&x| x == 0.0) {
                break;
            }
        }
    }

    /// The unknowns.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the rows do not determine one of them.
    pub fn solve(mut self) -> Result<Vec<T>> {
        let n = self.rhs.len();
        for i in (0..n).rev() {
            let row = &self.r[i * self.width..(i + 1) * self.width];
            if row[0].abs() <= SINGULAR * self.largest[i] {
                let why = format!(
                    "banded least squares: unknown {} of {n} is not determined (pivot {:e}, entries up to {:e})",
                    i + 1,
                    row[0],
                    self.largest[i]
                );
                return Err(Error::Numerics { why });
            }
            for k in 1..self.width.min(n - i) {
                let t = self.rhs[i + k] * row[k];
                self.rhs[i] -= t;
            }
            self.rhs[i] *= 1.0 / row[0];
        }
        Ok(self.rhs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_fitted_as_by_hand() {
        // y ≈ a + b t at t = 0, 1, 2, 3 with y = 1, 2, 2, 4: a = 0.9, b = 0.9.
        let mut qr = BandedQr::new(2, 2, 0.0);
        for (t, y) in [(0.0, 1.0), (1.0, 2.0), (2.0, 2.0), (3.0, 4.0)] {
            qr.add(0, &[1.0, t], y);
        }
        let x = qr.solve().unwrap();
        assert!((x[0] - 0.9).abs() < 1e-14 && (x[1] - 0.9).abs() < 1e-14, "{x:?}");
    }

    #[test]
    fn rows_in_any_order_give_the_solution() {
        let expected = [1.0, -2.0, 3.0, 0.5, 4.0, -1.0];
        let mut qr = BandedQr::new(6, 3, 0.0);
        for i in [3usize, 0, 2, 1, 0, 3, 2] {
            for seed in 0..2 {
                let values: Vec<f64> = (0..3).map(|j| ((i * 7 + j * 3 + seed * 5) as f64).sin()).collect();
                let rhs = values.iter().zip(&expected[i..]).map(|(a, b)| a * b).sum();
                qr.add(i, &values, rhs);
            }
        }
        let x = qr.solve().unwrap();
        for (a, b) in x.iter().zip(expected) {
            assert!((a - b).abs() < 1e-12, "{x:?}");
        }
    }

    #[test]
    fn undetermined_unknowns_are_named() {
        let mut qr = BandedQr::new(3, 2, 0.0);
        qr.add(0, &[1.0, 1.0], 1.0);
        qr.add(0, &[1.0, -1.0], 1.0);
        assert!(qr.solve().unwrap_err().to_string().contains("unknown 3 of 3"));
    }
}
