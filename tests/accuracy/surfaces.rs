//! Points and derivatives of surfaces.

use super::exact;
use super::wild::{ENDS, Random, places, surface};
use bladesmith::nurbs::{NurbsSurface, Side, SurfaceDerivatives, SurfaceEvaluator};
use glam::{DVec2, DVec3};

/// The largest error of derivatives `[k][l]`, in units of the last place times the condition. From
/// the fourth order on the condition also counts how many weights each term holds: all share the
/// rounding of one denominator.
fn error(expected: &[exact::Jet], found: &[Vec<DVec3>]) -> f64 {
    let mut worst = 0.0f64;
    for (axis, jet) in expected.iter().enumerate() {
        for (k, row) in found.iter().enumerate() {
            for (l, d) in row.iter().enumerate() {
                let (value, size) = &jet[k][l];
                let size = if k + l > 3 { size * (k + l + 1) as f64 } else { *size };
                let off = exact::Fraction::of(d[axis]).minus(value).value();
                worst = worst.max(off.abs() / (f64::EPSILON * size + f64::MIN_POSITIVE));
            }
        }
    }
    worst
}

fn rows(d: SurfaceDerivatives) -> Vec<Vec<DVec3>> {
    vec![vec![d.s, d.v, d.vv], vec![d.u, d.uv], vec![d.uu]]
}

/// Whether all derivatives up to this order, and all ways to evaluate, are right.
fn check(s: &NurbsSurface, top: usize, sides: [Side; 2], what: &str) -> f64 {
    let (evaluator, mut worst) = (SurfaceEvaluator::new(s), 0.0f64);
    let us = places(s.knots_u(), &[0.37]);
    for (u, v) in us.iter().flat_map(|&u| places(s.knots_v(), &[0.8]).into_iter().map(move |v| (u, v))) {
        let spans = [s.knots_u().span_from(u, sides[0]), s.knots_v().span_from(v, sides[1])];
        let expected = exact::surface(s, spans, [u, v], top.max(2) + 1);
        let mut ways = vec![("from sides", s.derivatives_from(sides, u, v, top))];
        if sides == [Side::Above; 2] {
            let at = [DVec2::new(u, v)];
            ways.push(("all", s.derivatives_to(u, v, top)));
            ways.push(("two", rows(s.derivatives(u, v))));
            ways.push(("a point", vec![vec![s.point(u, v)]]));
            ways.push(("a batch of points", vec![evaluator.points(&at)]));
        }
        for (way, found) in ways {
            let off = error(&expected, &found);
            assert!(off <= 8.0, "{what}, {u} {v}, {sides:?}, {way}: off by {off} units");
            worst = worst.max(off);
        }
    }
    worst
}

#[test]
fn surfaces_are_right_to_eight_units_times_the_condition() {
    let (mut random, mut worst) = (Random(9), 0.0f64);
    for degree in 1..=9 {
        for case in 0..4 {
            let degrees = [degree, (4 * degree + case) % 9 + 1];
            let ends = [ENDS[(degree + case) % 3], ENDS[case % 3]];
            let s = surface(&mut random, degrees, ends, case % 2 == 0);
            let top = degrees[0].max(degrees[1]).min(if case == 0 { 9 } else { 3 });
            let all = [Side::Above, Side::Below];
            let sides = [all[case / 2], all[(degree + case) % 2]];
            for sides in [sides, [Side::Above; 2]] {
                worst =
                    worst.max(check(&s, top, sides, &format!("degrees {degrees:?}, {ends:?}, case {case}")));
            }
        }
    }
    println!("largest error: {worst} units times the condition");
}
