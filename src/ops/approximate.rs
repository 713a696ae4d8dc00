//! Curves and surfaces approximated by splines to a tolerance, in their own parameters.
//!
//! Interpolation at the Greville abscissae; spans whose midpoints miss the tolerance are halved.
//! The tolerance holds at the sampled points, three in each span; nothing is guaranteed between.

use super::interpolate::Collocation;
use crate::error::Result;
use crate::nurbs::{KnotVector, NurbsCurve, NurbsSurface, Point};
use glam::DVec3;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Inner samples of a span at which the error is looked at.
const SAMPLES: [f64; 3] = [0.2, 0.5, 0.8];

/// Knots in the making: ascending breaks with the multiplicity of each inner one.
#[derive(Debug, Clone, PartialEq)]
pub struct Breaks {
    /// Degree of the spline.
    pub degree: usize,
    /// Break parameters with multiplicities (those of the ends are ignored).
    pub at: Vec<(f64, usize)>,
}

impl Breaks {
    /// Breaks with simple inner knots.
    pub fn simple(degree: usize, at: &[f64]) -> Self {
        Self { degree, at: at.iter().map(|&t| (t, 1)).collect() }
    }

    /// The clamped knot vector.
    ///
    /// # Errors
    /// As [`KnotVector::new`].
    pub fn knots(&self) -> Result<KnotVector> {
        let last = self.at.len() - 1;
        let mut flat = Vec::new();
        for (i, &(t, m)) in self.at.iter().enumerate() {
            let m = if i == 0 || i == last { self.degree + 1 } else { m };
            flat.extend(std::iter::repeat_n(t, m));
        }
        KnotVector::new(self.degree, flat)
    }

    /// Halves the marked spans (simple new knots).
    pub fn split(&mut self, marked: &[bool]) {
        self.split_near(marked, &[]);
    }

    /// Halves the marked spans, at one of the ascending `preferred` parameters where one lies in
    /// the middle third.
    pub fn split_near(&mut self, marked: &[bool], preferred: &[f64]) {
        let mut out = Vec::with_capacity(2 * self.at.len());
        for (i, w) in self.at.windows(2).enumerate() {
            out.push(w[0]);
            if marked[i] {
                let (middle, reach) = (0.5 * (w[0].0 + w[1].0), (w[1].0 - w[0].0) / 6.0);
                let after = preferred.partition_point(|&k| k < middle);
                let near = preferred[after.saturating_sub(1)..preferred.len().min(after + 1)].iter();
                let best = near.min_by(|a, b| (*a - middle).abs().total_cmp(&(*b - middle).abs()));
                out.push((best.copied().filter(|k| (k - middle).abs() < reach).unwrap_or(middle), 1));
            }
        }
        out.extend(self.at.last());
        self.at = out;
    }

    /// The spans that miss the tolerance, the worst of them where all would be too many.
    fn worst(errors: &[f64], tolerance: f64, limit: usize) -> Vec<bool> {
        let mut bad: Vec<usize> = (0..errors.len()).filter(|&i| errors[i] > tolerance).collect();
        bad.sort_by(|&a, &b| errors[b].total_cmp(&errors[a]).then(a.cmp(&b)));
        bad.truncate(limit.saturating_sub(errors.len()));
        let mut marked = vec![false; errors.len()];
        bad.into_iter().for_each(|i| marked[i] = true);
        marked
    }

    fn spans(&self) -> usize {
        self.at.len() - 1
    }

    fn samples(&self) -> Vec<f64> {
        self.at.windows(2).flat_map(|w| SAMPLES.map(|s| w[0].0 + s * (w[1].0 - w[0].0))).collect()
    }
}

/// Approximates `f` on the given breaks to `tolerance`, with at most `limit` spans; returns the
/// curve and the largest error seen.
///
/// # Errors
/// As [`Collocation::new`].
pub fn curve<P: Point + crate::linalg::banded::Rhs>(
    f: impl Fn(f64) -> P,
    mut breaks: Breaks,
    tolerance: f64,
    limit: usize,
) -> Result<(NurbsCurve<P>, f64)> {
    // Most of a round's parameters are those of the round before.
    let mut known: HashMap<u64, P> = HashMap::new();
    let mut f = |t: f64| *known.entry(t.to_bits()).or_insert_with(|| f(t));
    loop {
        let knots = breaks.knots()?;
        let collocation = Collocation::new(&knots)?;
        let mut poles: Vec<P> = collocation.points().iter().map(|&t| f(t)).collect();
        collocation.poles(&mut poles);
        let fitted = NurbsCurve::new(knots, poles, None)?;
        let errors: Vec<f64> = breaks.samples().iter().map(|&t| (fitted.point(t) - f(t)).length()).collect();
        let worst: Vec<f64> =
            errors.chunks(SAMPLES.len()).map(|e| e.iter().copied().fold(0.0, f64::max)).collect();
        let marked = Breaks::worst(&worst, tolerance, limit);
        if !marked.contains(&true) {
            return Ok((fitted, errors.into_iter().fold(0.0, f64::max)));
        }
        breaks.split(&marked);
    }
}

/// How fine a surface may become.
#[derive(Debug, Clone, Copy)]
pub struct Finest {
    /// Spans a direction.
    pub spans: usize,
    /// Spans along u times spans along v.
    pub patches: usize,
}

impl Finest {
    /// So many spans a direction.
    pub fn spans(spans: usize) -> Self {
        Self { spans, patches: spans * spans }
    }
}

/// Approximates `f` on the given breaks to `tolerance`, or as near as the limits allow; returns the
/// surface and the largest error seen.
///
/// # Errors
/// The first one of `f`, and as [`Collocation::new`].
pub fn surface(
    f: impl Fn(f64, f64) -> Result<DVec3>,
    mut u: Breaks,
    mut v: Breaks,
    tolerance: f64,
    limit: Finest,
) -> Result<(NurbsSurface, f64)> {
    // Many of a round's points are those of the round before.
    let mut known: HashMap<[u64; 2], DVec3> = HashMap::new();
    let mut grid = |us: &[f64], vs: &[f64]| -> Result<Vec<DVec3>> {
        let mut f = |a: f64, b: f64| match known.entry([a.to_bits(), b.to_bits()]) {
            Entry::Occupied(entry) => Ok(*entry.get()),
            Entry::Vacant(entry) => Ok(*entry.insert(f(a, b)?)),
        };
        us.iter().flat_map(|&a| vs.iter().map(move |&b| (a, b))).map(|(a, b)| f(a, b)).collect()
    };
    loop {
        let (ku, kv) = (u.knots()?, v.knots()?);
        let (cu, cv) = (Collocation::new(&ku)?, Collocation::new(&kv)?);
        let mut poles = grid(cu.points(), cv.points())?;
        Collocation::poles_tensor(&cu, &cv, &mut poles);
        let fitted = NurbsSurface::new(ku, kv, poles, None)?;
        // On a Greville line of one direction the error is that of the other direction alone.
        let mut error = |us: &[f64], vs: &[f64]| -> Result<Vec<f64>> {
            let pairs = fitted.points_on_grid(us, vs).into_iter().zip(grid(us, vs)?);
            Ok(pairs.map(|(a, b)| (a - b).length()).collect())
        };
        let (us, vs) = (u.samples(), v.samples());
        let (along_u, along_v) = (error(&us, cv.points())?, error(cu.points(), &vs)?);
        let worst = |errors: &mut dyn Iterator<Item = f64>| errors.fold(0.0, f64::max);
        let lines = along_u.chunks(SAMPLES.len() * cv.points().len());
        let error_u: Vec<f64> = lines.map(|e| worst(&mut e.iter().copied())).collect();
        let of_span = |s: usize| {
            let columns = SAMPLES.len() * s..SAMPLES.len() * (s + 1);
            worst(&mut along_v.chunks(vs.len()).flat_map(|row| &row[columns.clone()]).copied())
        };
        let error_v: Vec<f64> = (0..vs.len() / SAMPLES.len()).map(of_span).collect();
        let largest = error_u.iter().chain(&error_v).copied().fold(0.0, f64::max);
        let (mu, mv) = (
            Breaks::worst(&error_u, 0.5 * tolerance, limit.spans),
            Breaks::worst(&error_v, 0.5 * tolerance, limit.spans),
        );
        let more = |marked: &[bool]| marked.iter().filter(|&&m| m).count();
        let (nu, nv) = (more(&mu), more(&mv));
        if nu + nv == 0 || (u.spans() + nu) * (v.spans() + nv) > limit.patches {
            return Ok((fitted, largest));
        }
        u.split(&mu);
        v.split(&mv);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cylinder_keeps_its_angle_parameter() {
        let f = |a: f64, z: f64| Ok(DVec3::new(50.0 * a.cos(), 50.0 * a.sin(), z));
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let full = std::f64::consts::TAU;
            let (s, _) = surface(
                f,
                Breaks::simple(5, &[0.0, full]),
                Breaks::simple(3, &[0.0, 30.0]),
                tolerance,
                Finest::spans(500),
            )
            .unwrap();
            let mut worst = 0.0f64;
            for i in 0..=1000 {
                let a = full * i as f64 / 1000.0;
                worst = worst.max((s.point(a, 7.3) - f(a, 7.3).unwrap()).length());
            }
            assert!(worst < 1.5 * tolerance, "asked {tolerance}, got {worst}");
            assert_eq!(s.knots_v().len(), 4, "a straight direction needs one span");
        }
    }

    #[test]
    fn curve_error_follows_the_tolerance() {
        for tolerance in [1e-2, 1e-5, 1e-9] {
            let f = |t: f64| DVec3::new(t.cos(), t.sin(), (3.0 * t).exp().ln_1p());
            let (c, e) = curve(f, Breaks::simple(5, &[0.0, 3.0]), tolerance, 400).unwrap();
            assert!(e <= tolerance);
            let worst = (0..=500)
                .map(|i| 3.0 * i as f64 / 500.0)
                .map(|t| (c.point(t) - f(t)).length())
                .fold(0.0, f64::max);
            assert!(worst < 2.0 * tolerance, "asked {tolerance}, got {worst}");
        }
    }
}
