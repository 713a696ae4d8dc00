//! Weighted least squares curves with end conditions, and smoothing splines.

use super::conditions::{check_supports, row};
use crate::error::{Error, Result};
use crate::linalg::BandedQr;
use crate::linalg::banded::Rhs;
use crate::nurbs::length::GAUSS;
use crate::nurbs::{KnotVector, NurbsCurve, Point};

/// A point that a curve shall come near to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<P> {
    /// The parameter at which it shall.
    pub parameter: f64,
    /// The point.
    pub point: P,
    /// How much its squared distance counts; not negative.
    pub weight: f64,
}

fn check<P: Point>(samples: &[Sample<P>], knots: &KnotVector) -> Result<Vec<f64>> {
    let (a, b) = knots.domain();
    let usable = |s: &Sample<P>| {
        (a..=b).contains(&s.parameter) && s.point.is_finite() && s.weight.is_finite() && s.weight >= 0.0
    };
    if let Some(i) = samples.iter().position(|s| !usable(s)) {
        let why = format!(
            "sample {} is {:?}: its parameter must lie in [{a}, {b}], its weight must not be negative",
            i + 1,
            samples[i]
        );
        return Err(Error::Argument { name: "samples", why });
    }
    let mut parameters: Vec<f64> = samples.iter().filter(|s| s.weight > 0.0).map(|s| s.parameter).collect();
    parameters.sort_by(f64::total_cmp);
    Ok(parameters)
}

/// Poles at one end that meet the derivatives `[point, first, …]` there, outermost first.
fn end_poles<P: Point + Rhs>(knots: &KnotVector, last: bool, ends: &[P]) -> Result<Vec<P>> {
    let ((a, b), flat, p) = (knots.domain(), knots.flat(), knots.degree());
    let clamped = flat[0] == a && flat[flat.len() - 1] == b;
    if !clamped || ends.len() > p + 1 {
        let why = format!(
            "{} end conditions need clamped knots and a degree of at least that less one",
            ends.len()
        );
        return Err(Error::Argument { name: "ends", why });
    }
    let mut poles: Vec<P> = Vec::new();
    for (order, &value) in ends.iter().enumerate() {
        let (_, mut n) = row(knots, if last { b } else { a }, order);
        if last {
            n.reverse();
        }
        let rest = poles.iter().zip(&n).fold(value, |sum, (&pole, &n)| sum - pole * n);
        poles.push(rest / n[order]);
    }
    Ok(poles)
}

/// The curve over the knots with the least sum of weighted squared distances to the samples, among
/// those with the given derivatives (point first, then first derivative and so on; none for free
/// ends) at the start and the end.
///
/// # Errors
/// [`Error::Argument`] for samples that cannot be used or more end conditions than poles;
/// [`Error::Spline`] where samples are too few or badly placed for the knots (Schoenberg-Whitney).
pub fn fit<P: Point + Rhs>(
    knots: KnotVector,
    samples: &[Sample<P>],
    start: &[P],
    end: &[P],
) -> Result<NurbsCurve<P>> {
    let parameters = check(samples, &knots)?;
    let (n, width) = (knots.len(), knots.degree() + 1);
    let (first_poles, mut last_poles) = (end_poles(&knots, false, start)?, end_poles(&knots, true, end)?);
    last_poles.reverse();
    let free = start.len()..n.saturating_sub(end.len());
    if free.start > free.end {
        let why = format!("{} end conditions for {n} poles", start.len() + end.len());
        return Err(Error::Argument { name: "ends", why });
    }
    if start.is_empty() && end.is_empty() {
        check_supports(&knots, &parameters)?;
    }
    let known = |i: usize| match i {
        i if i < free.start => first_poles[i],
        i => last_poles[i - free.end],
    };
    let mut qr = BandedQr::new(free.len(), width, P::default());
    for s in samples.iter().filter(|s| s.weight > 0.0) {
        let (first, values) = row(&knots, s.parameter, 0);
        let root = s.weight.sqrt();
        let (mut rest, mut free_values) = (s.point, Vec::with_capacity(width));
        for (i, value) in (first..).zip(values) {
            match free.contains(&i) {
                true => free_values.push(value * root),
                false => rest = rest - known(i) * value,
            }
        }
        qr.add(first.clamp(free.start, free.end) - free.start, &free_values, rest * root);
    }
    let middle = qr.solve()?;
    let poles = first_poles.iter().chain(&middle).chain(&last_poles).copied().collect();
    NurbsCurve::new(knots, poles, None)
}

/// The curve over the knots with the least sum of weighted squared distances plus `smoothing` times
/// the integral of the squared second derivative (Reinsch 1967, on given knots). Large `smoothing`
/// leads to the straight line of regression.
///
/// # Errors
/// [`Error::Argument`] for samples that cannot be used, degree 1 or a `smoothing` that is not
/// positive; [`Error::Numerics`] for less than two different parameters.
pub fn smooth<P: Point + Rhs>(
    knots: KnotVector,
    samples: &[Sample<P>],
    smoothing: f64,
) -> Result<NurbsCurve<P>> {
    check(samples, &knots)?;
    if !(smoothing.is_finite() && smoothing > 0.0) || knots.degree() < 2 {
        let why = format!(
            "a positive number and a degree above 1 were expected, not {smoothing} and {}",
            knots.degree()
        );
        return Err(Error::Argument { name: "smoothing", why });
    }
    let mut qr = BandedQr::new(knots.len(), knots.degree() + 1, P::default());
    for s in samples.iter().filter(|s| s.weight > 0.0) {
        let (first, values) = row(&knots, s.parameter, 0);
        let root = s.weight.sqrt();
        qr.add(first, &values.iter().map(|x| x * root).collect::<Vec<_>>(), s.point * root);
    }
    for span in knots.breaks().windows(2) {
        let (middle, half) = (0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0]));
        for (x, weight) in GAUSS.into_iter().flat_map(|(x, w)| [(-x, w), (x, w)]) {
            let (first, values) = row(&knots, middle + half * x, 2);
            let root = (smoothing * weight * half).sqrt();
            qr.add(first, &values.iter().map(|x| x * root).collect::<Vec<_>>(), P::default());
        }
    }
    NurbsCurve::new(knots, qr.solve()?, None)
}

/// The smoothest curve over the knots whose weighted squared distances sum up to no more than
/// `residual`, and the smoothing that made it: the largest to a relative 1e-3.
///
/// # Errors
/// As [`smooth`]; [`Error::Numerics`] when even hardly any smoothing leaves more than `residual`.
pub fn smooth_within<P: Point + Rhs>(
    knots: &KnotVector,
    samples: &[Sample<P>],
    residual: f64,
) -> Result<(NurbsCurve<P>, f64)> {
    let of = |exponent: f64| {
        let curve = smooth(knots.clone(), samples, exponent.exp())?;
        let each = samples.iter().map(|s| s.weight * (curve.point(s.parameter) - s.point).length().powi(2));
        Ok((each.sum::<f64>(), curve))
    };
    // The second derivative scales with the square of the domain, its integral with the cube.
    let (a, b) = knots.domain();
    let unit = 3.0 * (b - a).ln() + samples.iter().map(|s| s.weight).sum::<f64>().ln();
    let (mut low, mut high) = (unit - 40.0, unit + 20.0);
    let (least, mut best) = of(low)?;
    if least.is_nan() || least > residual {
        let why = format!("the knots leave a sum of squares of {least:e}, above {residual:e}: refine them");
        return Err(Error::Numerics { why });
    }
    while high - low > 1e-3 {
        let middle = 0.5 * (low + high);
        match of(middle)? {
            (left, curve) if left <= residual => (low, best) = (middle, curve),
            _ => high = middle,
        }
    }
    Ok((best, low.exp()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn knots(degree: usize, spans: usize) -> KnotVector {
        KnotVector::clamped(degree, &(0..=spans).map(|i| i as f64 / spans as f64).collect::<Vec<_>>())
            .unwrap()
    }

    fn samples(count: usize, noise: f64) -> Vec<Sample<DVec2>> {
        let at = |i: usize| {
            let t = i as f64 / (count - 1) as f64;
            let off = noise * DVec2::new((i as f64 * 12.9898).sin(), (i as f64 * 78.233).sin());
            let weight = 1.0 + (i % 3) as f64;
            Sample { parameter: t, point: DVec2::new(t, (5.0 * t).sin()) + off, weight }
        };
        (0..count).map(at).collect()
    }

    fn sum(curve: &NurbsCurve<DVec2>, samples: &[Sample<DVec2>]) -> f64 {
        samples.iter().map(|s| s.weight * (curve.point(s.parameter) - s.point).length_squared()).sum()
    }

    #[test]
    fn no_pole_can_be_moved_for_a_better_fit() {
        let all = samples(60, 0.1);
        let curve = fit(knots(3, 6), &all, &[], &[]).unwrap();
        let least = sum(&curve, &all);
        for i in 0..curve.poles().len() {
            for step in [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y] {
                let mut poles = curve.poles().to_vec();
                poles[i] += step * 1e-4;
                let moved = NurbsCurve::new(curve.knots().clone(), poles, None).unwrap();
                assert!(sum(&moved, &all) > least, "pole {i} moved by {step}");
            }
        }
    }

    #[test]
    fn ends_are_met_and_a_spline_comes_back() {
        let poles = (0..9).map(|i| DVec2::new(i as f64, (i * i % 5) as f64)).collect();
        let given = NurbsCurve::new(knots(3, 6), poles, None).unwrap();
        let at = |i: usize| i as f64 / 40.0;
        let all: Vec<_> =
            (0..=40).map(|i| Sample { parameter: at(i), point: given.point(at(i)), weight: 2.0 }).collect();
        let (start, end) = (given.derivatives_to(0.0, 2), given.derivatives_to(1.0, 1));
        for (first, last) in [(0, 0), (1, 1), (3, 2), (0, 2), (2, 0)] {
            let curve = fit(knots(3, 6), &all, &start[..first], &end[..last]).unwrap();
            for (a, b) in curve.poles().iter().zip(given.poles()) {
                assert!((*a - *b).length() < 1e-12, "{first}, {last}: {a} {b}");
            }
        }
        let other = [DVec2::new(-1.0, 2.0), DVec2::new(3.0, 4.0)];
        let bent = fit(knots(3, 6), &all, &other, &other).unwrap();
        for (k, want) in other.into_iter().enumerate() {
            for t in [0.0, 1.0] {
                assert!((bent.derivatives_to(t, 1)[k] - want).length() < 1e-12, "order {k} at {t}");
            }
        }
    }

    #[test]
    fn too_few_samples_are_refused() {
        let few: Vec<_> = samples(60, 0.0).into_iter().filter(|s| s.parameter < 0.6).collect();
        let message = fit(knots(3, 6), &few, &[], &[]).unwrap_err().to_string();
        assert!(message.contains("Schoenberg-Whitney"), "{message}");
        let mut bad = samples(60, 0.0);
        bad[7].weight = -1.0;
        assert!(fit(knots(3, 6), &bad, &[], &[]).unwrap_err().to_string().contains("sample 8"));
    }

    #[test]
    fn smoothing_leads_from_the_fit_to_the_line() {
        let all = samples(60, 0.1);
        let free = sum(&fit(knots(3, 6), &all, &[], &[]).unwrap(), &all);
        let hardly = sum(&smooth(knots(3, 6), &all, 1e-12).unwrap(), &all);
        assert!((hardly - free).abs() < 1e-6 * free, "{hardly} {free}");
        let mut last = free;
        for exponent in -8..4 {
            let now = sum(&smooth(knots(3, 6), &all, 10f64.powi(exponent)).unwrap(), &all);
            assert!(now >= last * (1.0 - 1e-9), "{now} after {last}");
            last = now;
        }
        let line = smooth(knots(3, 6), &all, 1e9).unwrap();
        for i in 0..=10 {
            assert!(line.derivatives(i as f64 / 10.0)[2].length() < 1e-6);
        }
    }

    #[test]
    fn the_residual_asked_for_is_reached() {
        let all = samples(60, 0.1);
        for residual in [0.7, 2.0, 10.0] {
            let (curve, smoothing) = smooth_within(&knots(3, 12), &all, residual).unwrap();
            let is = sum(&curve, &all);
            assert!(is <= residual && is > 0.99 * residual, "{is} of {residual} at {smoothing}");
        }
        assert!(smooth_within(&knots(3, 12), &all, 1e-6).is_err());
    }
}
