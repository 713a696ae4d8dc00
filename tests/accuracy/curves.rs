//! Points and all derivatives of curves.

use super::exact;
use super::wild::{ENDS, Ends, Random, curve, places};
use bladesmith::nurbs::{CurveEvaluator, KnotVector, NurbsCurve, Point, Side};
use glam::{DVec2, DVec3};

/// The largest error of derivatives from order 0 on, in units of the last place times the condition.
fn error<P: Point>(expected: &[exact::Jet], found: &[P]) -> f64 {
    let mut worst = 0.0f64;
    for (axis, jet) in expected.iter().enumerate() {
        for (order, d) in found.iter().enumerate() {
            let (value, size) = &jet[order][0];
            let off = exact::Fraction::of(d.coordinates()[axis]).minus(value).value();
            worst = worst.max(off.abs() / (f64::EPSILON * size + f64::MIN_POSITIVE));
        }
    }
    worst
}

/// The largest error among all ways to evaluate.
fn check<P: Point>(c: &NurbsCurve<P>, what: &str) -> f64 {
    let (p, evaluator) = (c.knots().degree(), CurveEvaluator::new(c));
    let mut worst = 0.0f64;
    for t in places(c.knots(), &[0.013, 0.37, 0.99]) {
        for side in [Side::Above, Side::Below] {
            let expected = exact::curve(c, c.knots().span_from(t, side), t, p + 1);
            let mut ways = vec![("from a side", c.derivatives_from(side, t, p))];
            if side == Side::Above {
                ways.push(("all", c.derivatives_to(t, p)));
                ways.push(("two", c.derivatives(t)[..p.min(2) + 1].to_vec()));
                ways.push(("a batch", evaluator.derivatives(&[t])[0][..p.min(2) + 1].to_vec()));
                ways.push(("a point", vec![c.point(t)]));
                ways.push(("a batch of points", evaluator.points(&[t])));
            }
            for (way, found) in ways {
                let off = error(&expected, &found);
                assert!(off <= 8.0, "{what}, t {t}, {side:?}, {way}: off by {off} units");
                worst = worst.max(off);
            }
        }
    }
    worst
}

#[test]
fn curves_are_right_to_eight_units_times_the_condition() {
    let (mut random, mut worst) = (Random(7), 0.0f64);
    for degree in 1..=9 {
        for (ends, rational) in ENDS.into_iter().flat_map(|ends| [(ends, false), (ends, true)]) {
            for case in 0..2 {
                let what = format!("degree {degree}, {ends:?}, rational {rational}, case {case}");
                let off = match case {
                    0 => check(&curve::<DVec2>(&mut random, degree, ends, rational), &what),
                    _ => check(&curve::<DVec3>(&mut random, degree, ends, rational), &what),
                };
                worst = worst.max(off);
            }
        }
    }
    println!("largest error: {worst} units times the condition");
}

#[test]
fn the_ends_of_a_clamped_curve_are_its_poles() {
    let mut random = Random(8);
    for degree in 1..=9 {
        let c = curve::<DVec3>(&mut random, degree, Ends::Clamped, true);
        let (a, b) = c.knots().domain();
        let off = |p: DVec3, pole: DVec3| ((p - pole) / pole).abs().max_element() / f64::EPSILON;
        assert!(off(c.point(a), c.poles()[0]) <= 1.0, "degree {degree}: {}", c.point(a));
        assert!(off(c.point(b), c.poles()[c.poles().len() - 1]) <= 1.0, "degree {degree}: {}", c.point(b));
    }
}

/// Where print compares with `t` instead of a knot, every function is no number.
#[test]
fn functions_of_the_printed_example_are_its_fractions() {
    let knots = KnotVector::clamped(2, &[0.0, 0.5, 1.0]).expect("knots");
    for (t, expected) in [
        (0.0, [1.0, 0.0, 0.0, 0.0]),
        (0.25, [0.25, 0.625, 0.125, 0.0]),
        (0.5, [0.0, 0.5, 0.5, 0.0]),
        (1.0, [0.0, 0.0, 0.0, 1.0]),
    ] {
        let mut all = [0.0; 4];
        let first = knots.span(t) - 2;
        let mut some = [0.0; 3];
        knots.basis(first + 2, t, &mut some);
        all[first..first + 3].copy_from_slice(&some);
        assert_eq!(all, expected, "at {t}");
    }
}

/// The hull holds a rational curve, too, as long as no weight is negative; such are refused.
#[test]
fn curves_stay_in_the_box_of_the_poles_of_their_span() {
    let mut random = Random(9);
    for degree in 1..=9 {
        let c = curve::<DVec3>(&mut random, degree, ENDS[degree % 3], true);
        for t in places(c.knots(), &[0.2, 0.5, 0.9]) {
            let span = c.knots().span(t);
            let poles = &c.poles()[span - degree..=span];
            let (low, high) = poles.iter().fold((poles[0], poles[0]), |(a, b), p| (a.min(*p), b.max(*p)));
            let rounding = 1e-14 * high.abs().max(low.abs());
            let p = c.point(t);
            let within = p.cmpge(low - rounding).all() && p.cmple(high + rounding).all();
            assert!(within, "degree {degree} at {t}: {p} is not between {low} and {high}");
        }
        for wrong in [-1.0, 0.0] {
            let mut weights = c.weights().expect("weights").to_vec();
            weights[1] = wrong;
            let why = NurbsCurve::new(c.knots().clone(), c.poles().to_vec(), Some(weights)).unwrap_err();
            assert!(why.to_string().contains("weight 2 is"), "{why}");
        }
    }
}
