//! Knot vectors and B-spline basis functions with derivatives.

use crate::error::{Error, Result};

/// Highest degree that the basis routines carry (Open CASCADE's limit).
pub const MAX_DEGREE: usize = 25;

/// A non-decreasing flat knot vector `u_0 ..= u_{n+p+1}` with its degree `p`.
///
/// Not necessarily clamped: the domain is `[u_p, u_{n+1}]`.
#[derive(Debug, Clone, PartialEq)]
pub struct KnotVector {
    degree: usize,
    flat: Vec<f64>,
}

impl KnotVector {
    /// Checks and takes a flat knot vector.
    ///
    /// # Errors
    /// [`Error::Spline`] when the degree is 0 or above [`MAX_DEGREE`], the knots decrease or are
    /// not finite, there are fewer than `2 (degree + 1)`, or the domain is empty.
    pub fn new(degree: usize, flat: Vec<f64>) -> Result<Self> {
        let fail = |why: String| Err(Error::Spline { why });
        if degree == 0 || degree > MAX_DEGREE {
            return fail(format!("degree {degree} is not within 1..={MAX_DEGREE}"));
        }
        if flat.len() < 2 * (degree + 1) {
            return fail(format!(
                "{} knots are too few for degree {degree}: at least {} are needed",
                flat.len(),
                2 * (degree + 1)
            ));
        }
        if let Some(i) = flat.iter().position(|k| !k.is_finite()) {
            return fail(format!("knot {i} is {}", flat[i]));
        }
        if let Some(i) = flat.windows(2).position(|w| w[1] < w[0]) {
            return fail(format!("knots decrease from {} to {} at {i}", flat[i], flat[i + 1]));
        }
        let knots = Self { degree, flat };
        let (a, b) = knots.domain();
        if a >= b {
            return fail(format!("the knot domain [{a}, {b}] is empty"));
        }
        Ok(knots)
    }

    /// Clamped knots over distinct `breaks` (ascending), inner ones simple.
    ///
    /// # Errors
    /// As [`KnotVector::new`].
    pub fn clamped(degree: usize, breaks: &[f64]) -> Result<Self> {
        let (Some(&a), Some(&b)) = (breaks.first(), breaks.last()) else {
            return Err(Error::Spline { why: "no breaks".into() });
        };
        let mut flat = vec![a; degree];
        flat.extend_from_slice(breaks);
        flat.extend(std::iter::repeat_n(b, degree));
        Self::new(degree, flat)
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots, repeated by multiplicity.
    pub fn flat(&self) -> &[f64] {
        &self.flat
    }

    /// Number of basis functions (poles).
    pub fn len(&self) -> usize {
        self.flat.len() - self.degree - 1
    }

    /// Never true: a knot vector has at least one span.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        (self.flat[self.degree], self.flat[self.flat.len() - 1 - self.degree])
    }

    /// Distinct knots inside and at the ends of the domain, ascending.
    pub fn breaks(&self) -> Vec<f64> {
        let mut out = self.flat[self.degree..self.flat.len() - self.degree].to_vec();
        out.dedup();
        out
    }

    /// Distinct knots of the domain with their multiplicities.
    pub fn breaks_and_multiplicities(&self) -> Vec<(f64, usize)> {
        let (a, b) = self.domain();
        let mut out: Vec<(f64, usize)> = Vec::new();
        for &k in self.flat.iter().filter(|&&k| k >= a && k <= b) {
            match out.last_mut() {
                Some((last, m)) if *last == k => *m += 1,
                _ => out.push((k, 1)),
            }
        }
        out
    }

    /// Index `i` of the span `[u_i, u_{i+1})` that holds `u` (A2.1); the last span is closed, and
    /// parameters outside the domain get the nearest span.
    pub fn span(&self, u: f64) -> usize {
        let (p, n) = (self.degree, self.len() - 1);
        if u >= self.flat[n + 1] {
            let end = self.flat[n + 1];
            return self.flat[..=n].partition_point(|&k| k < end).max(p + 1) - 1;
        }
        if u <= self.flat[p] {
            let start = self.flat[p];
            return self.flat.partition_point(|&k| k <= start) - 1;
        }
        self.flat[..=n + 1].partition_point(|&k| k <= u) - 1
    }

    /// The `degree + 1` basis functions that do not vanish on `span` (A2.2).
    pub fn basis(&self, span: usize, u: f64, out: &mut [f64]) {
        let p = self.degree;
        let k = &self.flat;
        let (mut left, mut right) = ([0.0; MAX_DEGREE + 1], [0.0; MAX_DEGREE + 1]);
        out[0] = 1.0;
        for j in 1..=p {
            left[j] = u - k[span + 1 - j];
            right[j] = k[span + j] - u;
            let mut saved = 0.0;
            for r in 0..j {
                let t = out[r] / (right[r + 1] + left[j - r]);
                out[r] = saved + right[r + 1] * t;
                saved = left[j - r] * t;
            }
            out[j] = saved;
        }
    }

    /// Basis functions and derivatives up to `order` (A2.3): `out[d * (degree + 1) + j]` is the
    /// `d`-th derivative of the `j`-th function that does not vanish on `span`.
    pub fn basis_derivatives(&self, span: usize, u: f64, order: usize, out: &mut [f64]) {
        let p = self.degree;
        let w = p + 1;
        let k = &self.flat;
        let mut ndu = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
        let (mut left, mut right) = ([0.0; MAX_DEGREE + 1], [0.0; MAX_DEGREE + 1]);
        ndu[0][0] = 1.0;
        for j in 1..=p {
            left[j] = u - k[span + 1 - j];
            right[j] = k[span + j] - u;
            let mut saved = 0.0;
            for r in 0..j {
                ndu[j][r] = right[r + 1] + left[j - r];
                let t = ndu[r][j - 1] / ndu[j][r];
                ndu[r][j] = saved + right[r + 1] * t;
                saved = left[j - r] * t;
            }
            ndu[j][j] = saved;
        }
        out[..(order + 1) * w].fill(0.0);
        for j in 0..=p {
            out[j] = ndu[j][p];
        }
        let top = order.min(p);
        for r in 0..=p {
            let mut a = [[0.0; MAX_DEGREE + 1]; 2];
            let (mut s1, mut s2) = (0, 1);
            a[0][0] = 1.0;
            for d in 1..=top {
                let mut sum = 0.0;
                let pd = p - d;
                if r >= d {
                    a[s2][0] = a[s1][0] / ndu[pd + 1][r - d];
                    sum = a[s2][0] * ndu[r - d][pd];
                }
                let j1 = if r + 1 >= d { 1 } else { d - r };
                let j2 = if r <= pd + 1 { d - 1 } else { p - r };
                for j in j1..=j2 {
                    a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[pd + 1][r + j - d];
                    sum += a[s2][j] * ndu[r + j - d][pd];
                }
                if r <= pd {
                    a[s2][d] = -a[s1][d - 1] / ndu[pd + 1][r];
                    sum += a[s2][d] * ndu[r][pd];
                }
                out[d * w + r] = sum;
                std::mem::swap(&mut s1, &mut s2);
            }
        }
        let mut factor = p as f64;
        for d in 1..=top {
            for j in 0..=p {
                out[d * w + j] *= factor;
            }
            factor *= (p - d) as f64;
        }
    }

    /// Greville abscissae: the mean of `degree` consecutive knots for each pole.
    pub fn greville(&self) -> Vec<f64> {
        let p = self.degree;
        (0..self.len()).map(|i| self.flat[i + 1..=i + p].iter().sum::<f64>() / p as f64).collect()
    }
}
