//! Curves through points with derivative conditions of any order.

use super::parametrise::averaged_knots;
use crate::error::{Error, Result};
use crate::linalg::BandedQr;
use crate::linalg::banded::Rhs;
use crate::nurbs::basis::MAX_DEGREE;
use crate::nurbs::{KnotVector, NurbsCurve, Point};

/// What a curve shall be at one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition<P> {
    /// The parameter.
    pub parameter: f64,
    /// Order of the derivative; 0 is the point.
    pub order: usize,
    /// The derivative there.
    pub value: P,
}

impl<P> Condition<P> {
    /// The curve passes a point.
    pub fn point(parameter: f64, value: P) -> Self {
        Self { parameter, order: 0, value }
    }
}

/// First function and the derivatives of the `degree + 1` functions at a parameter.
pub(super) fn row(knots: &KnotVector, t: f64, order: usize) -> (usize, Vec<f64>) {
    let (p, span) = (knots.degree(), knots.span(t));
    let mut n = vec![0.0; (order + 1) * (p + 1)];
    knots.basis_derivatives(span, t, order, &mut n);
    (span - p, n[order * (p + 1)..].to_vec())
}

/// Checks that each function finds a parameter of its own inside its support, ascending ones for
/// ascending functions (Schoenberg and Whitney 1953): otherwise there is no such spline, or a wild
/// one. `parameters` ascend; at least as many as functions.
pub(super) fn check_supports(knots: &KnotVector, parameters: &[f64]) -> Result<()> {
    let (flat, p, (a, b)) = (knots.flat(), knots.degree(), knots.domain());
    let inside = |i: usize, t: f64| {
        let (low, high) = (flat[i], flat[i + p + 1]);
        // At a clamped end the outermost function does not vanish.
        (low < t && t < high)
            || (t == a && flat[i + p] == a && i == 0)
            || (t == b && flat[i + 1] == b && i + 1 == knots.len())
    };
    let mut next = 0;
    for i in 0..knots.len() {
        while next < parameters.len() && !inside(i, parameters[next]) {
            // Those beyond the support are left for later functions.
            if parameters[next] >= flat[i + p + 1] && !(i + 1 == knots.len()) {
                break;
            }
            next += 1;
        }
        if next == parameters.len() || !inside(i, parameters[next]) {
            let why = format!(
                "function {} of {} lives on [{}, {}] and finds no condition of its own there \
                 (Schoenberg-Whitney): move knots or parameters, or add a condition",
                i + 1,
                knots.len(),
                flat[i],
                flat[i + p + 1]
            );
            return Err(Error::Spline { why });
        }
        next += 1;
    }
    Ok(())
}

/// Conditions in ascending order, each once and of an order that the degree has.
fn sorted<P: Point>(conditions: &[Condition<P>], degree: usize) -> Result<Vec<Condition<P>>> {
    let fail = |why: String| Err(Error::Argument { name: "conditions", why });
    let mut all = conditions.to_vec();
    all.sort_by(|a, b| a.parameter.total_cmp(&b.parameter).then(a.order.cmp(&b.order)));
    for c in &all {
        if !c.parameter.is_finite() || !c.value.is_finite() {
            return fail(format!("parameter {} with value {:?} is not finite", c.parameter, c.value));
        }
        if c.order > degree {
            return fail(format!(
                "order {} at parameter {} is above the degree {degree}",
                c.order, c.parameter
            ));
        }
    }
    match all.windows(2).find(|w| w[0].parameter == w[1].parameter && w[0].order == w[1].order) {
        Some(w) => fail(format!("two conditions of order {} at parameter {}", w[0].order, w[0].parameter)),
        None => Ok(all),
    }
}

/// The spline of a degree, with knots averaged over the conditions, that meets them all.
///
/// # Errors
/// As [`interpolate_over`], and as [`averaged_knots`].
pub fn interpolate<P: Point + Rhs>(degree: usize, conditions: &[Condition<P>]) -> Result<NurbsCurve<P>> {
    let parameters: Vec<f64> = sorted(conditions, degree)?.iter().map(|c| c.parameter).collect();
    interpolate_over(averaged_knots(degree, &parameters)?, conditions)
}

/// The spline over the given knots that meets the conditions, as many as there are functions.
///
/// # Errors
/// [`Error::Argument`] for conditions that are not finite, doubled, outside the domain or too many
/// or too few; [`Error::Spline`] where the Schoenberg-Whitney condition fails; [`Error::Numerics`]
/// where conditions on derivatives alone do not determine the spline.
pub fn interpolate_over<P: Point + Rhs>(
    knots: KnotVector,
    conditions: &[Condition<P>],
) -> Result<NurbsCurve<P>> {
    let all = sorted(conditions, knots.degree())?;
    let ((a, b), n) = (knots.domain(), knots.len());
    let fail = |why: String| Err(Error::Argument { name: "conditions", why });
    if all.len() != n {
        return fail(format!("{} conditions for {n} poles", all.len()));
    }
    if let Some(c) = all.iter().find(|c| c.parameter < a || c.parameter > b) {
        return fail(format!("parameter {} is outside the domain [{a}, {b}]", c.parameter));
    }
    let groups = all.chunk_by(|x, y| x.parameter == y.parameter);
    check_supports(&knots, &spread(&knots, groups.map(|g| (g[0].parameter, g.len())))?)?;
    let mut qr = BandedQr::new(n, knots.degree() + 1, P::default());
    for c in &all {
        let (first, values) = row(&knots, c.parameter, c.order);
        // Derivatives are large where spans are short: rows of one size are easier to compare.
        let scale = 1.0 / values.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let scaled: Vec<f64> = values.iter().map(|x| x * scale).collect();
        qr.add(first, &scaled, c.value * scale);
    }
    NurbsCurve::new(knots, qr.solve()?, None)
}

/// Parameters of several conditions moved apart a little towards the inside, as the points whose
/// limit derivatives are: so the rule for points serves conditions on derivatives.
fn spread(knots: &KnotVector, groups: impl Iterator<Item = (f64, usize)>) -> Result<Vec<f64>> {
    let (a, b) = knots.domain();
    let breaks = knots.breaks();
    let shortest = breaks.windows(2).map(|w| w[1] - w[0]).fold(f64::MAX, f64::min);
    let step = 1e-3 * shortest / MAX_DEGREE as f64;
    let mut out = Vec::new();
    for (t, count) in groups {
        let first = match t {
            t if t == a => t,
            t if t == b => t - (count - 1) as f64 * step,
            t => t - 0.5 * (count - 1) as f64 * step,
        };
        out.extend((0..count).map(|k| if t == b && k + 1 == count { b } else { first + k as f64 * step }));
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ops::parametrise::{Spacing, parameters};
    use glam::{DVec2, DVec3};

    #[test]
    fn the_curve_of_example_9_1_passes_its_points() {
        let points = [(0.0, 0.0), (3.0, 4.0), (-1.0, 4.0), (-4.0, 0.0), (-4.0, -3.0)];
        let points = points.map(|(x, y)| DVec2::new(x, y));
        let t = parameters(&points, Spacing::ChordLength).unwrap();
        let conditions: Vec<_> = t.iter().zip(points).map(|(&t, p)| Condition::point(t, p)).collect();
        let curve = interpolate(3, &conditions).unwrap();
        assert_eq!(curve.poles().len(), 5);
        for c in conditions {
            assert!((curve.point(c.parameter) - c.value).length() < 1e-14, "{}", c.parameter);
        }
    }

    #[test]
    fn derivatives_of_any_order_are_met() {
        let of = |t: f64| [DVec3::new(t.cos(), t.sin(), t), DVec3::new(-t.sin(), t.cos(), 1.0)];
        let mut conditions = Vec::new();
        for t in [0.0, 0.4, 1.1, 1.5] {
            for order in 0..2 {
                conditions.push(Condition { parameter: t, order, value: of(t)[order] });
            }
        }
        for (t, order) in [(0.0, 2), (1.5, 2), (1.5, 3)] {
            let value = DVec3::new(0.1, 0.2, 0.3 * order as f64);
            conditions.push(Condition { parameter: t, order, value });
        }
        let curve = interpolate(5, &conditions).unwrap();
        for c in &conditions {
            let is = curve.derivatives_to(c.parameter, c.order)[c.order];
            assert!(
                (is - c.value).length() < 1e-10,
                "order {} at {}: {is} {}",
                c.order,
                c.parameter,
                c.value
            );
        }
    }

    #[test]
    fn interpolation_gains_a_power_for_each_degree() {
        let error = |degree: usize, count: usize| {
            let at = |i: usize| i as f64 / (count - 1) as f64;
            let f = |t: f64| DVec2::new((3.0 * t).cos(), (3.0 * t).sin());
            let conditions: Vec<_> = (0..count).map(|i| Condition::point(at(i), f(at(i)))).collect();
            let curve = interpolate(degree, &conditions).unwrap();
            (0..=999).map(|i| i as f64 / 999.0).map(|t| (curve.point(t) - f(t)).length()).fold(0.0, f64::max)
        };
        for degree in [2, 3, 5] {
            let gain = error(degree, 20) / error(degree, 40);
            assert!(gain > 0.7 * 2f64.powi(degree as i32 + 1), "degree {degree} gained {gain}");
        }
    }

    #[test]
    fn conditions_that_determine_no_curve_are_refused() {
        let knots = KnotVector::clamped(2, &[0.0, 0.5, 0.6, 1.0]).unwrap();
        let at =
            |ts: &[f64]| -> Vec<_> { ts.iter().map(|&t| Condition::point(t, DVec2::splat(t))).collect() };
        let message = |ts: &[f64]| interpolate_over(knots.clone(), &at(ts)).unwrap_err().to_string();
        assert!(message(&[0.0, 0.7, 0.8, 0.9, 1.0]).contains("function 2 of 5"));
        assert!(message(&[0.0, 0.1, 0.2, 0.3, 1.0]).contains("Schoenberg-Whitney"));
        assert!(message(&[0.1, 0.2, 0.55, 0.9, 1.1]).contains("outside"));
        assert!(message(&[0.0, 0.2, 0.2, 0.9, 1.0]).contains("two conditions"));
        assert!(message(&[0.0, 0.2, 0.9, 1.0]).contains("4 conditions for 5 poles"));
        assert!(interpolate_over(knots.clone(), &at(&[0.0, 0.3, 0.55, 0.8, 1.0])).is_ok());
    }
}
