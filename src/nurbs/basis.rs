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
        // Small work arrays keep the usual degrees in a few cache lines.
        if self.degree < 8 {
            self.basis_derivatives_sized::<8>(span, u, order, out);
        } else {
            self.basis_derivatives_sized::<{ MAX_DEGREE + 1 }>(span, u, order, out);
        }
    }

    fn basis_derivatives_sized<const W: usize>(&self, span: usize, u: f64, order: usize, out: &mut [f64]) {
        let p = self.degree;
        let w = p + 1;
        let ndu = self.basis_triangle::<W>(span, u);
        out[..(order + 1) * w].fill(0.0);
        for j in 0..=p {
            out[j] = ndu[j][p];
        }
        let top = order.min(p);
        for r in 0..=p {
            let mut a = [[0.0; W]; 2];
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

    /// Basis functions of all degrees (upper triangle, by column) and knot differences (lower).
    fn basis_triangle<const W: usize>(&self, span: usize, u: f64) -> [[f64; W]; W] {
        let k = &self.flat;
        let mut ndu = [[0.0; W]; W];
        let (mut left, mut right) = ([0.0; W], [0.0; W]);
        ndu[0][0] = 1.0;
        for j in 1..=self.degree {
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
        ndu
    }

    /// Greville abscissae: the mean of `degree` consecutive knots for each pole.
    pub fn greville(&self) -> Vec<f64> {
        let p = self.degree;
        (0..self.len()).map(|i| self.flat[i + 1..=i + p].iter().sum::<f64>() / p as f64).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cox-de Boor, literally, as an oracle.
    fn naive(k: &[f64], i: usize, p: usize, u: f64) -> f64 {
        if p == 0 {
            return if k[i] <= u && u < k[i + 1] { 1.0 } else { 0.0 };
        }
        let part = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
        part(u - k[i], k[i + p] - k[i]) * naive(k, i, p - 1, u)
            + part(k[i + p + 1] - u, k[i + p + 1] - k[i + 1]) * naive(k, i + 1, p - 1, u)
    }

    #[test]
    fn basis_equals_cox_de_boor() {
        for degree in 1..=9 {
            let knots = KnotVector::clamped(degree, &[0.0, 0.3, 0.35, 1.0, 2.5]).unwrap();
            for step in 0..50 {
                let u = 2.4999 * step as f64 / 49.0;
                let span = knots.span(u);
                let mut n = [0.0; MAX_DEGREE + 1];
                knots.basis(span, u, &mut n);
                for j in 0..=degree {
                    let expected = naive(knots.flat(), span - degree + j, degree, u);
                    assert!((n[j] - expected).abs() < 1e-13, "degree {degree}, u {u}: {} {expected}", n[j]);
                }
            }
        }
    }

    #[test]
    fn derivatives_follow_the_degree_below() {
        for degree in [2, 3, 5, 11] {
            let knots = KnotVector::clamped(degree, &[0.0, 0.3, 0.3, 0.7, 1.0]).unwrap();
            for u in [0.0, 0.1, 0.3, 0.55, 0.9, 1.0] {
                let span = knots.span(u);
                let mut n = [0.0; 3 * (MAX_DEGREE + 1)];
                knots.basis_derivatives(span, u, 2, &mut n);
                let w = degree + 1;
                for d in 1..3 {
                    let sum: f64 = n[d * w..(d + 1) * w].iter().sum();
                    let size: f64 = n[d * w..(d + 1) * w].iter().map(|x| x.abs()).sum();
                    assert!(
                        sum.abs() < 1e-12 * size,
                        "derivative {d} of one is {sum} (degree {degree}, u {u})"
                    );
                }
                // The identity is a spline with Greville poles: its derivative is one.
                let g = knots.greville();
                let slope: f64 = (0..w).map(|j| n[w + j] * g[span - degree + j]).sum();
                assert!((slope - 1.0).abs() < 1e-12, "slope {slope} (degree {degree}, u {u})");
            }
        }
    }

    #[test]
    fn ends_belong_to_the_nearest_span() {
        let knots = KnotVector::clamped(3, &[0.0, 1.0, 2.0]).unwrap();
        assert_eq!(knots.span(2.0), 4);
        assert_eq!(knots.span(3.0), 4);
        assert_eq!(knots.span(-1.0), 3);
        assert_eq!(knots.span(1.0), 4);
    }

    #[test]
    fn unusable_knots_are_refused_with_figures() {
        let message = |r: Result<KnotVector>| r.unwrap_err().to_string();
        assert!(message(KnotVector::new(3, vec![0.0; 4])).contains("too few"));
        assert!(message(KnotVector::new(1, vec![0.0, 0.0, f64::NAN, 1.0])).contains("NaN"));
        assert!(message(KnotVector::new(1, vec![0.0, 0.5, 0.4, 1.0])).contains("0.5"));
        assert!(message(KnotVector::new(1, vec![0.0; 4])).contains("empty"));
    }
}
