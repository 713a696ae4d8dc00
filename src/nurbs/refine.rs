//! Exact reshaping by knot insertion: of one knot (Boehm 1980; *The NURBS Book*, section 5.2) and of
//! many at once by polar forms.

use super::basis::KnotVector;
use super::curve::{NurbsCurve, Point};
use super::derivatives::Side;
use super::surface::NurbsSurface;
use crate::error::{Error, Result};
use glam::DVec3;
use std::ops::{Add, Mul};

/// Homogeneous poles of a curve (one column) or surface; knots are inserted along the rows.
#[derive(Clone)]
pub(super) struct Net<P: Point> {
    columns: usize,
    poles: Vec<P>,
    weights: Option<Vec<f64>>,
}

impl<P: Point> Net<P> {
    pub(super) fn new(columns: usize, poles: &[P], weights: Option<&[f64]>) -> Self {
        let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
        let poles = poles.iter().enumerate().map(|(i, &p)| p * weight(i)).collect();
        Self { columns, poles, weights: weights.map(<[f64]>::to_vec) }
    }

    pub(super) fn transposed(&self) -> Self {
        let rows = self.poles.len() / self.columns;
        let order = || (0..self.poles.len()).map(|i| (i % rows) * self.columns + i / rows);
        Self {
            columns: rows,
            poles: order().map(|i| self.poles[i]).collect(),
            weights: self.weights.as_ref().map(|w| order().map(|i| w[i]).collect()),
        }
    }

    /// One more row: row `i` becomes `share[i]` of row `i` and the rest of row `i - 1`.
    fn insert(&mut self, share: &[f64]) {
        self.poles = blend(&self.poles, self.columns, share);
        self.weights = self.weights.as_ref().map(|w| blend(w, self.columns, share));
    }

    /// As many rows as there are entries, each the sum of shares of the old ones.
    pub(super) fn combine(&mut self, shares: &[Vec<(usize, f64)>]) {
        self.poles = combined(&self.poles, self.columns, shares);
        self.weights = self.weights.as_ref().map(|w| combined(w, self.columns, shares));
    }

    /// Bound of the distance between what this net and another with the same knots and as many
    /// rows stand for.
    pub(super) fn distance(&self, other: &Self) -> f64 {
        let Some((w, v)) = self.weights.as_ref().zip(other.weights.as_ref()) else {
            return self.poles.iter().zip(&other.poles).map(|(&a, &b)| (a - b).length()).fold(0.0, f64::max);
        };
        let smallest = w.iter().chain(v).copied().fold(f64::MAX, f64::min);
        let far = self.poles.iter().zip(w).map(|(&a, &w)| (a / w).length()).fold(0.0, f64::max);
        let each =
            (0..w.len()).map(|i| (self.poles[i] - other.poles[i]).length() + far * (w[i] - v[i]).abs());
        each.fold(0.0, f64::max) / smallest
    }

    pub(super) fn keep_rows(&mut self, rows: std::ops::Range<usize>) {
        let range = rows.start * self.columns..rows.end * self.columns;
        self.poles = self.poles[range.clone()].to_vec();
        self.weights = self.weights.as_ref().map(|w| w[range].to_vec());
    }

    /// Poles and weights, no longer homogeneous.
    pub(super) fn project(self) -> (Vec<P>, Option<Vec<f64>>) {
        let poles = match &self.weights {
            None => self.poles,
            Some(w) => self.poles.iter().zip(w).map(|(&p, &w)| p / w).collect(),
        };
        (poles, self.weights)
    }
}

fn blend<T>(old: &[T], columns: usize, share: &[f64]) -> Vec<T>
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T>,
{
    let entry = |i: usize| match share[i / columns] {
        1.0 => old[i],
        0.0 => old[i - columns],
        a => old[i] * a + old[i - columns] * (1.0 - a),
    };
    (0..share.len() * columns).map(entry).collect()
}

fn combined<T>(old: &[T], columns: usize, shares: &[Vec<(usize, f64)>]) -> Vec<T>
where
    T: Copy + Default + Add<Output = T> + Mul<f64, Output = T>,
{
    let entry = |row: &[(usize, f64)], c: usize| match row {
        [(i, 1.0)] => old[i * columns + c],
        _ => row.iter().fold(T::default(), |sum, &(i, share)| sum + old[i * columns + c] * share),
    };
    shares.iter().flat_map(|row| (0..columns).map(move |c| entry(row, c))).collect()
}

/// Inserts `t` until it has at least this multiplicity.
pub(super) fn raise<P: Point>(
    knots: KnotVector,
    net: &mut Net<P>,
    t: f64,
    multiplicity: usize,
) -> Result<KnotVector> {
    let p = knots.degree();
    let mut flat = knots.flat().to_vec();
    let present = flat.iter().filter(|&&k| k == t).count();
    for s in present..multiplicity {
        let span = flat.partition_point(|&k| k <= t) - 1;
        let share = |i: usize| match i {
            i if i + p <= span => 1.0,
            i if i + s <= span => (t - flat[i]) / (flat[i + p] - flat[i]),
            _ => 0.0,
        };
        let shares: Vec<f64> = (0..flat.len() - p).map(share).collect();
        net.insert(&shares);
        flat.insert(span + 1, t);
    }
    KnotVector::new(p, flat)
}

/// Clamps knots and net at both ends of the domain.
fn clamp<P: Point>(knots: &KnotVector, net: &mut Net<P>) -> Result<KnotVector> {
    window(knots, net, knots.domain())
}

/// Cuts knots and net to a part of the domain, clamped.
pub(super) fn window<P: Point>(
    knots: &KnotVector,
    net: &mut Net<P>,
    (a, b): (f64, f64),
) -> Result<KnotVector> {
    let p = knots.degree();
    let knots = raise(knots.clone(), net, a, p)?;
    let knots = raise(knots, net, b, p)?;
    let flat = knots.flat();
    let start = flat.partition_point(|&k| k <= a) - 1;
    let end = flat.partition_point(|&k| k < b);
    net.keep_rows(start - p..end);
    let mut clamped = vec![a];
    clamped.extend_from_slice(&flat[start + 1 - p..end + p]);
    clamped.push(b);
    KnotVector::new(p, clamped)
}

/// The polar form of the segment over a span at `p` arguments, as shares of the poles
/// (Ramshaw, *Blossoms are polar forms*, 1989). Arguments
/// far from the span come last: there the knots taken are the widest.
pub(super) fn polar_form(knots: &KnotVector, span: usize, arguments: &mut [f64]) -> Vec<(usize, f64)> {
    let (p, u) = (knots.degree(), knots.flat());
    let middle = 0.5 * (u[span] + u[span + 1]);
    arguments.sort_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()));
    // shares[k] is that of pole span - p + k.
    let mut shares = vec![0.0; p + 1];
    shares[p] = 1.0;
    for (r, &a) in (1..=p).zip(arguments.iter()) {
        for k in p - r..=p {
            let i = span + k - p;
            let own = if k > p - r { shares[k] * ((a - u[i]) / (u[i + r] - u[i])) } else { 0.0 };
            let next =
                if k < p { shares[k + 1] * ((u[i + r + 1] - a) / (u[i + r + 1] - u[i + 1])) } else { 0.0 };
            shares[k] = own + next;
        }
    }
    shares.into_iter().enumerate().map(|(k, s)| (span + k - p, s)).filter(|(_, s)| *s != 0.0).collect()
}

/// Inserts all knots, ascending, at once: a pole is the polar form at the knots within its support.
pub(super) fn insert_all<P: Point>(knots: &KnotVector, net: &mut Net<P>, new: &[f64]) -> Result<KnotVector> {
    if let Some(w) = new.windows(2).find(|w| w[1].is_nan() || w[1] < w[0]) {
        return Err(Error::Spline { why: format!("knots to insert must ascend: {} follows {}", w[1], w[0]) });
    }
    for same in new.chunk_by(|a, b| a == b) {
        check_insertion(knots, same[0], same.len())?;
    }
    let (p, old) = (knots.degree(), knots.flat());
    let mut flat = [old, new].concat();
    flat.sort_by(f64::total_cmp);
    // How many of the first knots are old ones; of equal ones these come first.
    let mut known = vec![0; flat.len() + 1];
    for (i, &t) in flat.iter().enumerate() {
        known[i + 1] = known[i] + usize::from(old.get(known[i]) == Some(&t));
    }
    let row = |j: usize| {
        let (inner, end) = (&flat[j + 1..=j + p], flat[j + p + 1]);
        if known[j + p + 1] - known[j + 1] == p {
            return vec![(known[j + 1] - 1, 1.0)];
        }
        let middle = inner.iter().sum::<f64>() / p as f64;
        let side = if middle < end { Side::Above } else { Side::Below };
        polar_form(knots, knots.span_from(middle, side), &mut inner.to_vec())
    };
    let rows: Vec<_> = (0..flat.len() - p - 1).map(row).collect();
    net.combine(&rows);
    KnotVector::new(p, flat)
}

/// Whether both ends are knots exactly once more than the degree: with further ones the poles at the
/// ends have no part in the curve.
fn is_clamped(knots: &KnotVector) -> bool {
    let (flat, p) = (knots.flat(), knots.degree());
    let (a, b) = knots.domain();
    let is_end = |k: &f64| *k == a || *k == b;
    flat[0] == a && flat[flat.len() - 1] == b && flat.iter().filter(|k| is_end(k)).count() == 2 * (p + 1)
}

/// Refuses to insert outside the domain or beyond the degree.
fn check_insertion(knots: &KnotVector, t: f64, times: usize) -> Result<usize> {
    let (a, b) = knots.domain();
    let present = knots.flat().iter().filter(|&&k| k == t).count();
    if !(a < t && t < b) || present + times > knots.degree() {
        return Err(Error::Spline {
            why: format!(
                "knot {t} cannot be inserted {times} times: it must lie inside ({a}, {b}) and end with a \
                 multiplicity of at most {}; it has {present}",
                knots.degree()
            ),
        });
    }
    Ok(present + times)
}

impl<P: Point> NurbsCurve<P> {
    pub(super) fn reshape(
        &self,
        change: impl FnOnce(&KnotVector, &mut Net<P>) -> Result<KnotVector>,
    ) -> Result<Self> {
        Ok(self.reshape_within(|knots, net| Ok((change(knots, net)?, 0.0)))?.0)
    }

    /// A change that moves the shape, with the bound of that movement.
    pub(super) fn reshape_within(
        &self,
        change: impl FnOnce(&KnotVector, &mut Net<P>) -> Result<(KnotVector, f64)>,
    ) -> Result<(Self, f64)> {
        let mut net = Net::new(1, self.poles(), self.weights());
        let (knots, moved) = change(self.knots(), &mut net)?;
        let (poles, weights) = net.project();
        Ok((Self::new(knots, poles, weights)?, moved))
    }

    /// The same curve with the knot `t` inserted so many more times.
    ///
    /// # Errors
    /// [`Error::Spline`] when `t` is not inside the domain or its multiplicity would exceed the
    /// degree.
    pub fn insert_knot(&self, t: f64, times: usize) -> Result<Self> {
        let multiplicity = check_insertion(self.knots(), t, times)?;
        self.reshape(|knots, net| raise(knots.clone(), net, t, multiplicity))
    }

    /// The same curve with all these knots, ascending, inserted.
    ///
    /// # Errors
    /// As [`NurbsCurve::insert_knot`], for each; also when they do not ascend.
    pub fn refined(&self, new: &[f64]) -> Result<Self> {
        self.reshape(|knots, net| insert_all(knots, net, new))
    }

    /// The same curve over its domain with `degree + 1` equal knots at both ends.
    ///
    /// # Errors
    /// [`Error::Spline`] when rounding leaves no usable knots.
    pub fn clamped(&self) -> Result<Self> {
        if is_clamped(self.knots()) { Ok(self.clone()) } else { self.reshape(clamp) }
    }
}

/// Direction of a surface's parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// The first parameter.
    U,
    /// The second parameter.
    V,
}

impl NurbsSurface {
    pub(super) fn reshape(
        &self,
        direction: Direction,
        change: impl FnOnce(&KnotVector, &mut Net<DVec3>) -> Result<KnotVector>,
    ) -> Result<Self> {
        Ok(self.reshape_within(direction, |knots, net| Ok((change(knots, net)?, 0.0)))?.0)
    }

    /// A change that moves the shape, with the bound of that movement.
    pub(super) fn reshape_within(
        &self,
        direction: Direction,
        change: impl FnOnce(&KnotVector, &mut Net<DVec3>) -> Result<(KnotVector, f64)>,
    ) -> Result<(Self, f64)> {
        let mut net = Net::new(self.knots_v().len(), self.poles(), self.weights());
        let (mut ku, mut kv) = (self.knots_u().clone(), self.knots_v().clone());
        let moved;
        match direction {
            Direction::U => (ku, moved) = change(&ku, &mut net)?,
            Direction::V => {
                net = net.transposed();
                (kv, moved) = change(&kv, &mut net)?;
                net = net.transposed();
            }
        }
        let (poles, weights) = net.project();
        Ok((Self::new(ku, kv, poles, weights)?, moved))
    }

    /// The same surface with the knot `t` inserted so many more times along `direction`.
    ///
    /// # Errors
    /// [`Error::Spline`] when `t` is not inside the domain or its multiplicity would exceed the
    /// degree.
    pub fn insert_knot(&self, direction: Direction, t: f64, times: usize) -> Result<Self> {
        let multiplicity = check_insertion(self.knots(direction), t, times)?;
        self.reshape(direction, |knots, net| raise(knots.clone(), net, t, multiplicity))
    }

    /// The same surface with all these knots, ascending, inserted along `direction`.
    ///
    /// # Errors
    /// As [`NurbsSurface::insert_knot`], for each; also when they do not ascend.
    pub fn refined(&self, direction: Direction, new: &[f64]) -> Result<Self> {
        self.reshape(direction, |knots, net| insert_all(knots, net, new))
    }

    /// Knots along `direction`.
    pub fn knots(&self, direction: Direction) -> &KnotVector {
        match direction {
            Direction::U => self.knots_u(),
            Direction::V => self.knots_v(),
        }
    }

    /// The same surface over its domain with `degree + 1` equal knots at all ends.
    ///
    /// # Errors
    /// [`Error::Spline`] when rounding leaves no usable knots.
    pub fn clamped(&self) -> Result<Self> {
        let mut surface = self.clone();
        if !is_clamped(self.knots_u()) {
            surface = surface.reshape(Direction::U, clamp)?;
        }
        if !is_clamped(self.knots_v()) {
            surface = surface.reshape(Direction::V, clamp)?;
        }
        Ok(surface)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unclamped_curve() -> NurbsCurve<DVec3> {
        let flat = vec![-0.5, -0.2, -0.2, 0.0, 0.3, 0.3, 0.7, 1.0, 1.2, 1.9, 2.0];
        let poles = (0..7).map(|i| DVec3::new(i as f64, (i * i) as f64 * 0.3, (i as f64).sin())).collect();
        let weights = Some(vec![1.0, 2.0, 0.5, 1.0, 1.5, 0.8, 1.2]);
        NurbsCurve::new(KnotVector::new(3, flat).unwrap(), poles, weights).unwrap()
    }

    #[test]
    fn clamping_drops_poles_without_a_part_in_the_curve() {
        let flat = vec![0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0, 1.0];
        let poles: Vec<DVec3> = (0..7).map(|i| DVec3::new(i as f64, (i * i) as f64, 1.0)).collect();
        let curve = NurbsCurve::new(KnotVector::new(2, flat).unwrap(), poles.clone(), None).unwrap();
        let clamped = curve.clamped().unwrap();
        assert_eq!(clamped.knots().flat(), [0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0]);
        assert_eq!(clamped.poles(), &poles[1..5]);
        for t in [0.0, 0.3, 0.4, 0.9, 1.0] {
            assert_eq!(clamped.point(t), curve.point(t), "at {t}");
        }
    }

    fn saddle() -> NurbsSurface {
        let ku = KnotVector::new(2, vec![-1.0, -0.3, 0.0, 0.4, 1.0, 1.5, 2.0]).unwrap();
        let kv = KnotVector::clamped(3, &[0.0, 0.5, 2.0]).unwrap();
        let poles = (0..4 * 5)
            .map(|i| {
                let (x, y) = ((i / 5) as f64, (i % 5) as f64);
                DVec3::new(x, y, x * y - 0.1 * x * x)
            })
            .collect();
        NurbsSurface::new(ku, kv, poles, Some((0..20).map(|i| 1.0 + 0.1 * (i % 3) as f64).collect())).unwrap()
    }

    #[test]
    fn clamping_keeps_the_curve() {
        let curve = unclamped_curve();
        let clamped = curve.clamped().unwrap();
        assert_eq!(clamped.knots().domain(), curve.knots().domain());
        assert_eq!(clamped.knots().flat()[..4], [0.0; 4]);
        assert!(clamped.poles()[0].distance(curve.point(0.0)) < 1e-14);
        for i in 0..=50 {
            let t = i as f64 / 50.0;
            let gap = clamped.point(t).distance(curve.point(t));
            assert!(gap < 1e-13, "{gap} at {t}");
        }
    }

    #[test]
    fn knot_insertion_keeps_the_surface() {
        let surface = saddle();
        let refined = surface.insert_knot(Direction::U, 0.7, 2).unwrap();
        let refined = refined.insert_knot(Direction::V, 0.5, 1).unwrap().clamped().unwrap();
        assert_eq!((refined.knots_u().len(), refined.knots_v().len()), (6, 6));
        for i in 0..=20 {
            for j in 0..=20 {
                let (u, v) = (i as f64 / 20.0, j as f64 / 10.0);
                let gap = refined.point(u, v).distance(surface.point(u, v));
                assert!(gap < 1e-13, "{gap} at ({u}, {v})");
            }
        }
    }

    #[test]
    fn many_knots_at_once_keep_the_surface() {
        let surface = saddle();
        let new: Vec<f64> = (1..40).map(|i| i as f64 / 20.0).filter(|t| *t != 0.5).collect();
        let refined = surface.refined(Direction::V, &new).unwrap();
        assert_eq!(refined.knots(Direction::V).len(), 5 + new.len());
        for i in 0..=400 {
            let (u, v) = ((i % 21) as f64 / 20.0, i as f64 / 200.0);
            let gap = refined.point(u, v).distance(surface.point(u, v));
            assert!(gap < 1e-14 * 10.0, "{gap} at ({u}, {v})");
        }
        assert!(surface.refined(Direction::U, &[0.7, 0.2]).is_err());
    }

    #[test]
    fn too_many_insertions_are_refused() {
        let curve = unclamped_curve();
        for (t, times) in [(0.3, 2), (0.0, 1), (1.5, 1), (f64::NAN, 1)] {
            assert!(matches!(curve.insert_knot(t, times), Err(Error::Spline { .. })), "{t} × {times}");
        }
    }
}
