//! B-spline and Bézier data as Open CASCADE stores them, and their evaluable NURBS forms.
//!
//! A periodic spline of degree `p` with distinct knots `k_1 … k_K`, multiplicities `m_1 = m_K`
//! has `n = m_1 + … + m_{K-1}` poles. Its *unwrapped* form repeats the first `p + 1 - m_1` poles
//! at the end and continues the knots by the period on both sides: the same polynomials on
//! `[k_1, k_K]` over an ordinary, unclamped knot vector.

use super::space::Space;
use crate::error::{Error, Result};
use crate::nurbs::basis::MAX_DEGREE;
use crate::nurbs::{KnotVector, NurbsCurve, NurbsSurface, Point};
use glam::DVec3;

/// Distinct knots of a spline with their multiplicities.
#[derive(Debug, Clone, PartialEq)]
pub struct SplineKnots {
    degree: usize,
    periodic: bool,
    knots: Vec<(f64, usize)>,
}

fn refuse<T>(why: String) -> Result<T> {
    Err(Error::Spline { why })
}

impl SplineKnots {
    /// Checks and takes knots with multiplicities.
    ///
    /// # Errors
    /// [`Error::Spline`] when the degree is 0 or above 25, there are fewer than two knots, they do
    /// not increase, a multiplicity is 0, above the degree inside or above the degree plus one at
    /// an end, or those at the ends of a periodic spline differ.
    pub fn new(degree: usize, periodic: bool, knots: Vec<(f64, usize)>) -> Result<Self> {
        if degree == 0 || degree > MAX_DEGREE {
            return refuse(format!("degree {degree} is not within 1..={MAX_DEGREE}"));
        }
        let (Some(&(_, first)), Some(&(_, last)), true) = (knots.first(), knots.last(), knots.len() > 1)
        else {
            return refuse(format!("{} knots: at least two are needed", knots.len()));
        };
        if let Some(i) = knots.windows(2).position(|w| w[0].0.partial_cmp(&w[1].0).is_none_or(|o| o.is_ge()))
        {
            return refuse(format!("knots do not increase from {} to {}", knots[i].0, knots[i + 1].0));
        }
        for (i, &(knot, m)) in knots.iter().enumerate() {
            let most = if i == 0 || i + 1 == knots.len() { degree + 1 } else { degree };
            if m == 0 || m > most {
                return refuse(format!("knot {knot} has multiplicity {m}: 1..={most} are possible there"));
            }
        }
        if periodic && first != last {
            return refuse(format!("a periodic spline with end multiplicities {first} and {last}"));
        }
        let knots = Self { degree, periodic, knots };
        if knots.pole_count() < 2 {
            return refuse(format!("too few knots for degree {degree}"));
        }
        Ok(knots)
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Whether the spline closes smoothly upon itself.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// Distinct knots with multiplicities, ascending.
    pub fn knots(&self) -> &[(f64, usize)] {
        &self.knots
    }

    /// Number of poles that belong to these knots.
    pub fn pole_count(&self) -> usize {
        let sum: usize = self.knots.iter().map(|k| k.1).sum();
        if self.periodic { sum - self.knots[0].1 } else { sum.saturating_sub(self.degree + 1) }
    }

    /// The period, if there is one.
    pub fn period(&self) -> Option<f64> {
        self.periodic.then(|| self.knots[self.knots.len() - 1].0 - self.knots[0].0)
    }

    /// The knots of the evaluable form.
    fn unwrapped(&self) -> Result<KnotVector> {
        let flat: Vec<f64> = self.knots.iter().flat_map(|&(k, m)| std::iter::repeat_n(k, m)).collect();
        let Some(period) = self.period() else {
            return KnotVector::new(self.degree, flat);
        };
        let (p, n, m) = (self.degree as i64, self.pole_count() as i64, self.knots[0].1 as i64);
        // Knot `p` of the unwrapped form is the last copy of the first knot.
        let unwrapped = (0..2 * p + n - m + 2).map(|i| {
            let j = i - p + m - 1;
            flat[j.rem_euclid(n) as usize] + j.div_euclid(n) as f64 * period
        });
        KnotVector::new(self.degree, unwrapped.collect())
    }

    /// Distinct knots of a flat knot vector.
    fn distinct(knots: &KnotVector) -> Self {
        let mut distinct: Vec<(f64, usize)> = Vec::new();
        for &k in knots.flat() {
            match distinct.last_mut() {
                Some((last, m)) if *last == k => *m += 1,
                _ => distinct.push((k, 1)),
            }
        }
        Self { degree: knots.degree(), periodic: false, knots: distinct }
    }

    /// `t` brought into the first period.
    fn reduce(&self, t: f64) -> f64 {
        let first = self.knots[0].0;
        match self.period() {
            Some(period) if t < first || t > first + period => t - ((t - first) / period).floor() * period,
            _ => t,
        }
    }
}

/// A B-spline curve as stored: possibly periodic, possibly rational.
#[derive(Debug, Clone, PartialEq)]
pub struct BSplineCurve<P: Point> {
    knots: SplineKnots,
    nurbs: NurbsCurve<P>,
}

impl<P: Space> BSplineCurve<P> {
    /// A curve from knots, poles and, if rational, weights.
    ///
    /// # Errors
    /// [`Error::Spline`] when the counts disagree or a value is not usable.
    pub fn new(knots: SplineKnots, poles: Vec<P>, weights: Option<Vec<f64>>) -> Result<Self> {
        check_count(&knots, poles.len())?;
        let unwrapped = knots.unwrapped()?;
        let (n, count) = (poles.len(), unwrapped.len());
        let wrap = |i: usize| i % n;
        let poles = (0..count).map(|i| poles[wrap(i)]).collect();
        let weights = match weights {
            Some(w) if w.len() == n => Some((0..count).map(|i| w[wrap(i)]).collect()),
            other => other,
        };
        Ok(Self { knots, nurbs: NurbsCurve::new(unwrapped, poles, weights)? })
    }

    /// The stored knots.
    pub fn knots(&self) -> &SplineKnots {
        &self.knots
    }

    /// The stored poles: of a periodic curve those of one period.
    pub fn poles(&self) -> &[P] {
        &self.nurbs.poles()[..self.knots.pole_count()]
    }

    /// The stored weights, if rational.
    pub fn weights(&self) -> Option<&[f64]> {
        self.nurbs.weights().map(|w| &w[..self.knots.pole_count()])
    }

    /// The evaluable form over one period; unclamped where the stored knots are.
    pub fn unwrapped(&self) -> &NurbsCurve<P> {
        &self.nurbs
    }

    /// The same curve over its domain with clamped knots, by exact knot insertion.
    ///
    /// # Errors
    /// [`Error::Spline`] when the knots cannot be clamped.
    pub fn to_nurbs(&self) -> Result<NurbsCurve<P>> {
        self.nurbs.clamped()
    }

    /// `t` brought into the first period of a periodic curve.
    pub fn reduce(&self, t: f64) -> f64 {
        self.knots.reduce(t)
    }
}

impl<P: Space> From<&NurbsCurve<P>> for BSplineCurve<P> {
    fn from(nurbs: &NurbsCurve<P>) -> Self {
        Self { knots: SplineKnots::distinct(nurbs.knots()), nurbs: nurbs.clone() }
    }
}

fn check_count(knots: &SplineKnots, poles: usize) -> Result<()> {
    let expected = knots.pole_count();
    if poles != expected {
        return refuse(format!("{poles} poles where knots and degree ask for {expected}"));
    }
    Ok(())
}

/// A B-spline surface as stored: possibly periodic, possibly rational.
#[derive(Debug, Clone, PartialEq)]
pub struct BSplineSurface {
    knots: [SplineKnots; 2],
    rational: [bool; 2],
    nurbs: NurbsSurface,
}

impl BSplineSurface {
    /// A surface from knots along `u` and `v`, poles (`v` fastest) and, if rational, weights.
    /// `rational` says along which parameter the weights vary; it is kept for writing.
    ///
    /// # Errors
    /// [`Error::Spline`] when the counts disagree or a value is not usable.
    pub fn new(
        knots: [SplineKnots; 2],
        rational: [bool; 2],
        poles: &[DVec3],
        weights: Option<&[f64]>,
    ) -> Result<Self> {
        let [n, m] = [knots[0].pole_count(), knots[1].pole_count()];
        if n.checked_mul(m) != Some(poles.len()) || weights.is_some_and(|w| w.len() != poles.len()) {
            return refuse(format!(
                "{} poles and {} weights where knots and degrees ask for {n} × {m}",
                poles.len(),
                weights.map_or(0, <[f64]>::len)
            ));
        }
        let (ku, kv) = (knots[0].unwrapped()?, knots[1].unwrapped()?);
        let columns = kv.len();
        let stored = (0..ku.len() * columns).map(|i| (i / columns % n) * m + i % columns % m);
        let weights = weights.map(|w| stored.clone().map(|i| w[i]).collect());
        let poles = stored.map(|i| poles[i]).collect();
        Ok(Self { knots, rational, nurbs: NurbsSurface::new(ku, kv, poles, weights)? })
    }

    /// The stored knots along `u` and `v`.
    pub fn knots(&self) -> &[SplineKnots; 2] {
        &self.knots
    }

    /// Along which parameter the weights are said to vary.
    pub fn rational(&self) -> [bool; 2] {
        self.rational
    }

    /// The stored number of poles along `u` and `v`.
    pub fn pole_counts(&self) -> [usize; 2] {
        [self.knots[0].pole_count(), self.knots[1].pole_count()]
    }

    /// The stored poles, `v` fastest: of a periodic surface those of one period.
    pub fn poles(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.stored().map(|i| self.nurbs.poles()[i])
    }

    /// The stored weights, if rational.
    pub fn weights(&self) -> Option<impl Iterator<Item = f64> + '_> {
        self.nurbs.weights().map(|w| self.stored().map(|i| w[i]))
    }

    /// Indices of the stored poles among the unwrapped ones.
    fn stored(&self) -> impl Iterator<Item = usize> + '_ {
        let [n, m] = self.pole_counts();
        let columns = self.nurbs.knots_v().len();
        (0..n).flat_map(move |i| (0..m).map(move |j| i * columns + j))
    }

    /// The evaluable form over one period; unclamped where the stored knots are.
    pub fn unwrapped(&self) -> &NurbsSurface {
        &self.nurbs
    }

    /// The same surface over its domain with clamped knots, by exact knot insertion.
    ///
    /// # Errors
    /// [`Error::Spline`] when the knots cannot be clamped.
    pub fn to_nurbs(&self) -> Result<NurbsSurface> {
        self.nurbs.clamped()
    }

    /// (u, v) brought into the first period along each periodic parameter.
    pub fn reduce(&self, u: f64, v: f64) -> (f64, f64) {
        (self.knots[0].reduce(u), self.knots[1].reduce(v))
    }
}

impl From<&NurbsSurface> for BSplineSurface {
    fn from(nurbs: &NurbsSurface) -> Self {
        let knots = [SplineKnots::distinct(nurbs.knots_u()), SplineKnots::distinct(nurbs.knots_v())];
        Self { knots, rational: [nurbs.weights().is_some(); 2], nurbs: nurbs.clone() }
    }
}

/// A Bézier curve over `[0, 1]`.
#[derive(Debug, Clone, PartialEq)]
pub struct BezierCurve<P: Point>(NurbsCurve<P>);

impl<P: Space> BezierCurve<P> {
    /// A curve from its poles and, if rational, weights.
    ///
    /// # Errors
    /// [`Error::Spline`] when there are fewer than 2 or more than 26 poles, or a value is not
    /// usable.
    pub fn new(poles: Vec<P>, weights: Option<Vec<f64>>) -> Result<Self> {
        let knots = KnotVector::clamped(poles.len().saturating_sub(1), &[0.0, 1.0])?;
        Ok(Self(NurbsCurve::new(knots, poles, weights)?))
    }

    /// The curve as NURBS.
    pub fn nurbs(&self) -> &NurbsCurve<P> {
        &self.0
    }
}

/// A Bézier surface over `[0, 1]²`.
#[derive(Debug, Clone, PartialEq)]
pub struct BezierSurface {
    rational: [bool; 2],
    nurbs: NurbsSurface,
}

impl BezierSurface {
    /// A surface from its degrees, poles (`v` fastest) and, if rational, weights; `rational` is
    /// kept for writing.
    ///
    /// # Errors
    /// [`Error::Spline`] when a degree is 0 or above 25, the counts disagree or a value is not
    /// usable.
    pub fn new(
        degrees: [usize; 2],
        rational: [bool; 2],
        poles: Vec<DVec3>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self> {
        let knots = |degree| KnotVector::clamped(degree, &[0.0, 1.0]);
        let nurbs = NurbsSurface::new(knots(degrees[0])?, knots(degrees[1])?, poles, weights)?;
        Ok(Self { rational, nurbs })
    }

    /// Along which parameter the weights are said to vary.
    pub fn rational(&self) -> [bool; 2] {
        self.rational
    }

    /// The surface as NURBS.
    pub fn nurbs(&self) -> &NurbsSurface {
        &self.nurbs
    }
}
