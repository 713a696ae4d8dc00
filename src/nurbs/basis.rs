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
        // What is not a number gets the first span.
        p + self.flat[p..=n + 1].partition_point(|&k| k <= u).max(1) - 1
    }

    /// The `degree + 1` basis functions that do not vanish on `span` (A2.2).
    pub fn basis(&self, span: usize, u: f64, out: &mut [f64]) {
        match self.degree {
            2 => self.basis_of::<2>(span, u, out),
            3 => self.basis_of::<3>(span, u, out),
            4 => self.basis_of::<4>(span, u, out),
            5 => self.basis_of::<5>(span, u, out),
            _ => self.basis_of_any(span, u, out),
        }
    }

    fn basis_of_any(&self, span: usize, u: f64, out: &mut [f64]) {
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

    fn basis_of<const P: usize>(&self, span: usize, u: f64, out: &mut [f64]) {
        let mut last = Stage::start();
        let near = self.near::<P>(span);
        for j in 1..=P {
            last = last.raised(j, u, &near);
        }
        out[..=P].copy_from_slice(&last.n[..=P]);
    }

    /// The `P` knots on either side of the inside of `span`.
    fn near<const P: usize>(&self, span: usize) -> [[f64; P]; 2] {
        [
            std::array::from_fn(|r| self.flat[span + 1 - P + r]),
            std::array::from_fn(|r| self.flat[span + 1 + r]),
        ]
    }

    /// Basis functions and derivatives up to `order` (A2.3): `out[d * (degree + 1) + j]` is the
    /// `d`-th derivative of the `j`-th function that does not vanish on `span`.
    pub fn basis_derivatives(&self, span: usize, u: f64, order: usize, out: &mut [f64]) {
        match (order, self.degree) {
            (0, _) => self.basis(span, u, out),
            (1 | 2, 2) => self.derivatives_of::<2>(span, u, order, out),
            (1 | 2, 3) => self.derivatives_of::<3>(span, u, order, out),
            (1 | 2, 4) => self.derivatives_of::<4>(span, u, order, out),
            (1 | 2, 5) => self.derivatives_of::<5>(span, u, order, out),
            // Small work arrays keep the lower degrees in a few cache lines.
            (_, ..8) => self.basis_derivatives_sized::<8>(span, u, order, out),
            _ => self.basis_derivatives_sized::<{ MAX_DEGREE + 1 }>(span, u, order, out),
        }
    }

    /// The span of `u` with the functions there and their derivatives below the `K`-th, each in a
    /// row of at least `degree + 1`.
    #[inline(always)]
    pub(super) fn functions<const K: usize, const W: usize>(&self, u: f64) -> (usize, [[f64; W]; K]) {
        let (span, w) = (self.span(u), self.degree + 1);
        let mut n = [[0.0; W]; K];
        let flat = n.as_flattened_mut();
        self.basis_derivatives(span, u, K - 1, flat);
        if w < W {
            for k in (1..K).rev() {
                flat.copy_within(k * w..(k + 1) * w, k * W);
            }
        }
        (span, n)
    }

    /// The same for a degree known beforehand and up to two derivatives, which are differences of
    /// what the recurrence divides on its way (eq. 2.7).
    fn derivatives_of<const P: usize>(&self, span: usize, u: f64, order: usize, out: &mut [f64]) {
        let near = self.near::<P>(span);
        let mut lower = Stage::start();
        for j in 1..P {
            lower = lower.raised(j, u, &near);
        }
        let last = lower.raised(P, u, &near);
        out[..=P].copy_from_slice(&last.n[..=P]);
        let degree = P as f64;
        last.differences(P, degree, &mut out[P + 1..]);
        if order == 2 {
            // Derivatives of the functions of degree P − 1, divided as those were.
            let mut slopes = Stage::start();
            lower.differences(P - 1, degree - 1.0, &mut slopes.n);
            for r in 0..P {
                slopes.divided[r] = slopes.n[r] / (near[1][r] - near[0][r]);
            }
            slopes.differences(P, degree, &mut out[2 * (P + 1)..]);
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

/// Widest degree of the unrolled recurrence, plus one.
const WIDE: usize = 6;

/// The functions of one degree on a span, with those of the degree below divided by the length of
/// their supports.
#[derive(Clone, Copy)]
struct Stage {
    n: [f64; WIDE],
    divided: [f64; WIDE],
}

impl Stage {
    /// Degree 0.
    fn start() -> Self {
        let mut n = [0.0; WIDE];
        n[0] = 1.0;
        Self { n, divided: [0.0; WIDE] }
    }

    /// From degree `j - 1` to `j` at `u`; `near` are the knots below and above.
    #[inline(always)]
    fn raised<const P: usize>(&self, j: usize, u: f64, near: &[[f64; P]; 2]) -> Self {
        let mut next = Self { n: [0.0; WIDE], divided: [0.0; WIDE] };
        for r in 0..j {
            let (left, right) = (near[0][P + r - j], near[1][r]);
            let t = self.n[r] / (right - left);
            next.divided[r] = t;
            next.n[r] += (right - u) * t;
            next.n[r + 1] = (u - left) * t;
        }
        next
    }

    /// `factor · (divided[r - 1] - divided[r])` for the `p + 1` functions of degree `p`.
    #[inline(always)]
    fn differences(&self, p: usize, factor: f64, out: &mut [f64]) {
        out[0] = -factor * self.divided[0];
        for r in 1..p {
            out[r] = factor * (self.divided[r - 1] - self.divided[r]);
        }
        out[p] = factor * self.divided[p - 1];
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
    fn unrolled_degrees_equal_the_general_recurrence() {
        for degree in 1..=5 {
            let knots = KnotVector::new(degree, {
                let mut flat: Vec<f64> = (0..=degree).map(|i| -0.1 * (degree - i) as f64).collect();
                flat.extend([0.3, 0.3, 0.45, 1.0]);
                flat.extend((1..=degree).map(|i| 1.0 + 0.2 * i as f64));
                flat
            })
            .unwrap();
            for step in 0..=60 {
                let u = step as f64 / 60.0;
                let span = knots.span(u);
                let (mut fast, mut general) = ([f64::NAN; 18], [0.0; 18]);
                knots.basis_derivatives(span, u, 2, &mut fast);
                knots.basis_derivatives_sized::<8>(span, u, 2, &mut general);
                for k in 0..3 * (degree + 1) {
                    let size = general[k].abs().max(1.0);
                    assert!(
                        (fast[k] - general[k]).abs() < 1e-13 * size,
                        "degree {degree}, u {u}, entry {k}: {} instead of {}",
                        fast[k],
                        general[k]
                    );
                }
                let mut values = [f64::NAN; 6];
                knots.basis(span, u, &mut values);
                assert_eq!(values[..=degree], fast[..=degree], "degree {degree}, u {u}");
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
