//! Bézier pieces of curves and surfaces, with the bounds that their control points give.

use crate::error::Result;
use crate::nurbs::{Direction, KnotVector, NurbsCurve, NurbsSurface, Point};

/// One polynomial piece of a curve: homogeneous control points over a parameter interval.
#[derive(Debug, Clone)]
pub struct CurvePiece<P> {
    /// Parameters at both ends.
    pub range: [f64; 2],
    /// Control points times their weights.
    pub poles: Vec<P>,
    /// Weights; 1 without any.
    pub weights: Vec<f64>,
}

/// Knots with every inner one as often as the degree, by the number of times it is missing.
fn missing(knots: &KnotVector) -> Vec<(f64, usize)> {
    let (a, b) = knots.domain();
    let inner = knots.breaks_and_multiplicities().into_iter().filter(|&(t, _)| t > a && t < b);
    inner.map(|(t, m)| (t, knots.degree().saturating_sub(m))).filter(|&(_, times)| times > 0).collect()
}

/// The pieces of a curve, in order.
///
/// # Errors
/// As [`NurbsCurve::insert_knot`].
pub fn curve_pieces<P: Point>(curve: &NurbsCurve<P>) -> Result<Vec<CurvePiece<P>>> {
    let mut split = curve.clamped()?;
    for (t, times) in missing(split.knots()) {
        split = split.insert_knot(t, times)?;
    }
    let p = split.knots().degree();
    let piece = |(k, range): (usize, &[f64])| {
        let at = k * p..=k * p + p;
        let weights = split.weights().map_or_else(|| vec![1.0; p + 1], |w| w[at.clone()].to_vec());
        let poles = split.poles()[at].iter().zip(&weights).map(|(&x, &w)| x * w).collect();
        CurvePiece { range: [range[0], range[1]], poles, weights }
    };
    Ok(split.knots().breaks().windows(2).enumerate().map(piece).collect())
}

/// Halves homogeneous control points in place: `first` becomes the first half, the result is the
/// second (de Casteljau).
pub(in crate::ops) fn halve<T>(first: &mut [T]) -> Vec<T>
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let n = first.len();
    let mut second = first.to_vec();
    for level in 1..n {
        for i in 0..n - level {
            second[i] = (second[i] + second[i + 1]) * 0.5;
        }
        first[level] = second[0];
    }
    second
}

impl<P: Point> CurvePiece<P> {
    /// The control points, no longer homogeneous.
    pub fn points(&self) -> impl Iterator<Item = P> + '_ {
        self.poles.iter().zip(&self.weights).map(|(&x, &w)| x / w)
    }

    /// Both halves.
    pub fn halves(mut self) -> [Self; 2] {
        let [a, b] = self.range;
        let middle = 0.5 * (a + b);
        let (poles, weights) = (halve(&mut self.poles), halve(&mut self.weights));
        let second = Self { range: [middle, b], poles, weights };
        self.range[1] = middle;
        [self, second]
    }
}

/// One polynomial piece of a surface: homogeneous control points, `v` fastest, over a rectangle of
/// parameters.
#[derive(Debug, Clone)]
pub struct SurfacePiece {
    /// Parameters at both ends along u and along v.
    pub range: [[f64; 2]; 2],
    /// Control points along v.
    pub columns: usize,
    /// Control points times their weights.
    pub poles: Vec<glam::DVec3>,
    /// Weights; 1 without any.
    pub weights: Vec<f64>,
}

/// The pieces of a surface, `v` fastest.
///
/// # Errors
/// As [`NurbsSurface::refined`].
pub fn surface_pieces(surface: &NurbsSurface) -> Result<Vec<SurfacePiece>> {
    let mut split = surface.clamped()?;
    for direction in [Direction::U, Direction::V] {
        let new = missing(split.knots(direction)).into_iter();
        let new: Vec<f64> = new.flat_map(|(t, times)| std::iter::repeat_n(t, times)).collect();
        split = split.refined(direction, &new)?;
    }
    let (p, q, all) = (split.knots_u().degree(), split.knots_v().degree(), split.knots_v().len());
    let mut out = Vec::new();
    for (i, u) in split.knots_u().breaks().windows(2).enumerate() {
        for (j, v) in split.knots_v().breaks().windows(2).enumerate() {
            let at = (0..=p).flat_map(|a| (0..=q).map(move |b| (i * p + a) * all + j * q + b));
            let weights: Vec<f64> = at.clone().map(|k| split.weights().map_or(1.0, |w| w[k])).collect();
            let poles = at.zip(&weights).map(|(k, &w)| split.poles()[k] * w).collect();
            let range = [[u[0], u[1]], [v[0], v[1]]];
            out.push(SurfacePiece { range, columns: q + 1, poles, weights });
        }
    }
    Ok(out)
}

/// Swaps rows and columns of a net.
fn transposed<T: Copy>(net: &[T], columns: usize) -> Vec<T> {
    let rows = net.len() / columns;
    (0..net.len()).map(|k| net[(k % rows) * columns + k / rows]).collect()
}

/// Halves every row of a net; see [`halve`].
fn halve_rows<T>(net: &mut [T], columns: usize) -> Vec<T>
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    net.chunks_exact_mut(columns).flat_map(halve).collect()
}

impl SurfacePiece {
    /// The control points, no longer homogeneous.
    pub fn points(&self) -> impl Iterator<Item = glam::DVec3> + '_ {
        self.poles.iter().zip(&self.weights).map(|(&x, &w)| x / w)
    }

    /// Both halves along `direction`.
    pub fn halves(mut self, direction: Direction) -> [Self; 2] {
        if direction == Direction::U {
            return self.transposed().halves(Direction::V).map(|half| half.transposed());
        }
        let [a, b] = self.range[1];
        let middle = 0.5 * (a + b);
        let columns = self.columns;
        let (poles, weights) = (halve_rows(&mut self.poles, columns), halve_rows(&mut self.weights, columns));
        let second = Self { range: [self.range[0], [middle, b]], columns, poles, weights };
        self.range[1][1] = middle;
        [self, second]
    }

    fn transposed(self) -> Self {
        let rows = self.poles.len() / self.columns;
        Self {
            range: [self.range[1], self.range[0]],
            columns: rows,
            poles: transposed(&self.poles, self.columns),
            weights: transposed(&self.weights, self.columns),
        }
    }
}
