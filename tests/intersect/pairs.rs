//! Two curves that cross.

use super::sample::{Random, brute_force, curve};
use bladesmith::nurbs::{KnotVector, NurbsCurve};
use bladesmith::ops::intersect::{Intersections, Kind, curves};
use glam::DVec2;

const TOLERANCE: f64 = 1e-9;

/// Every crossing of brute force must be there, and every one that is there must be one.
fn check(
    case: &str,
    a: &NurbsCurve<DVec2>,
    b: &NurbsCurve<DVec2>,
    all: &Intersections<DVec2>,
    roots: &[[f64; 2]],
) {
    assert!(all.overlaps.is_empty(), "{case}: {:?}", all.overlaps);
    for root in roots {
        let near = |at: [f64; 2]| (at[0] - root[0]).abs() < 1e-6 && (at[1] - root[1]).abs() < 1e-6;
        let times = all.crossings.iter().filter(|c| near(c.at)).count();
        assert_eq!(times, 1, "{case}: {root:?} among {:?}", all.crossings);
    }
    for (k, c) in all.crossings.iter().enumerate() {
        let gap = a.point(c.at[0]).distance(b.point(c.at[1]));
        assert!(gap <= 2.0 * TOLERANCE, "{case}: {c:?} is {gap} wide");
        assert!(c.point.distance(a.point(c.at[0])) <= TOLERANCE, "{case}: {c:?}");
        for d in &all.crossings[..k] {
            let apart = (c.at[0] - d.at[0]).abs().max((c.at[1] - d.at[1]).abs());
            assert!(apart > 1e-8, "{case}: {c:?} and {d:?}");
        }
    }
}

#[test]
fn random_pairs_have_the_crossings_of_brute_force() {
    let mut random = Random(11);
    let (mut total, mut more) = (0, 0);
    for case in 0..2000 {
        let a = curve(&mut random, 1 + case % 7, case % 3 == 0);
        let b = curve(&mut random, 1 + case / 7 % 7, case % 4 == 0);
        let roots = brute_force(&a, &b, 24);
        let all = curves(&a, &b, TOLERANCE).unwrap();
        check(&format!("pair {case}"), &a, &b, &all, &roots);
        total += roots.len();
        more += all.crossings.len() - roots.len();
    }
    assert!(total > 8_000, "{total} crossings say little");
    // Brute force misses some near touches.
    assert!(more * 1000 < total, "{more} crossings more than the {total} of brute force");
}

#[test]
fn size_and_place_do_not_matter() {
    let mut random = Random(5);
    for case in 0..60 {
        let a = curve(&mut random, 3, case % 2 == 0);
        let b = curve(&mut random, 2 + case % 3, false);
        let expected = curves(&a, &b, TOLERANCE).unwrap();
        for size in [1e-4, 1.0, 1e3] {
            let moved = |p: DVec2| p * size + DVec2::new(1e3, -700.0);
            let (a, b) = (a.mapped(moved).unwrap(), b.mapped(moved).unwrap());
            let all = curves(&a, &b, 1e-8 * size).unwrap();
            assert_eq!(all.crossings.len(), expected.crossings.len(), "case {case}, size {size}");
            for (c, d) in all.crossings.iter().zip(&expected.crossings) {
                let apart = (c.at[0] - d.at[0]).abs().max((c.at[1] - d.at[1]).abs());
                assert!(apart < 1e-6, "case {case}, size {size}: {c:?}, {d:?}");
            }
        }
    }
}

fn line(points: &[[f64; 2]]) -> NurbsCurve<DVec2> {
    let breaks: Vec<f64> = (0..points.len()).map(|k| k as f64).collect();
    let poles = points.iter().map(|&p| p.into()).collect();
    NurbsCurve::new(KnotVector::clamped(1, &breaks).unwrap(), poles, None).unwrap()
}

#[test]
fn crossings_on_knots_corners_and_ends_are_reported_once() {
    let zigzag = line(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [3.0, 1.0], [4.0, 0.0]]);
    let cases = [
        (line(&[[1.0, -1.0], [1.0, 3.0]]), vec![1.0], "through a corner"),
        (line(&[[1.0, -1.0], [1.0, 1.0], [1.0, 3.0]]), vec![1.0], "corner on a knot"),
        (line(&[[0.0, 1.0], [4.0, 1.0]]), vec![1.0, 3.0], "two corners on a line"),
        (line(&[[2.0, 0.0], [2.0, -1.0]]), vec![2.0], "an end on a corner"),
        (line(&[[0.0, 0.0], [-1.0, 5.0]]), vec![0.0], "an end on an end"),
        (line(&[[0.5, 0.5], [0.5, -2.0]]), vec![0.5], "an end within"),
        (line(&[[4.0, 0.0], [5.0, 1.0]]), vec![4.0], "the last end"),
        (line(&[[0.5, -1.0], [0.5, 0.4999]]), vec![], "just short of it"),
    ];
    for (other, expected, what) in cases {
        let all = curves(&zigzag, &other, 1e-9).unwrap();
        let at: Vec<f64> = all.crossings.iter().map(|c| c.at[0]).collect();
        assert_eq!(at.len(), expected.len(), "{what}: {all:?}");
        for (a, b) in at.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-9, "{what}: {all:?}");
        }
        assert!(all.overlaps.is_empty(), "{what}: {all:?}");
        assert!(all.crossings.iter().all(|c| c.kind == Kind::Transversal), "{what}: {all:?}");
    }
}

#[test]
fn the_seam_of_a_closed_curve_is_one_place() {
    let circle = NurbsCurve::arc(DVec2::ZERO, DVec2::X, DVec2::Y, 0.0, std::f64::consts::TAU).unwrap();
    let through = line(&[[-2.0, 0.0], [2.0, 0.0]]);
    let all = curves(&circle, &through, 1e-9).unwrap();
    assert_eq!(all.crossings.len(), 2, "{all:?}");
    assert_eq!(all.crossings[0].at[0], 0.0, "{all:?}");
    let swapped = curves(&through, &circle, 1e-9).unwrap();
    assert_eq!(swapped.crossings.len(), 2, "{swapped:?}");
}

#[test]
fn the_symmetric_cubic_has_its_three_roots() {
    // A bisection that stops when the middles of both curves meet finds the middle one only.
    let knots = || KnotVector::clamped(3, &[-1.0, 1.0]).unwrap();
    let poles = [[-1.0, -0.5], [-1.0 / 3.0, 1.5], [1.0 / 3.0, -1.5], [1.0, 0.5]];
    let cubic = NurbsCurve::new(knots(), poles.iter().map(|&p| DVec2::from(p)).collect(), None).unwrap();
    let axis = line(&[[-1.0, 0.0], [1.0, 0.0]]).over(-1.0, 1.0).unwrap();
    let all = curves(&cubic, &axis, 1e-9).unwrap();
    assert_eq!(all.crossings.len(), 3, "{all:?}");
    assert!(all.crossings[1].at[0].abs() < 1e-12, "{all:?}");
}

#[test]
fn bad_tolerances_are_refused() {
    let a = line(&[[0.0, 0.0], [1.0, 0.0]]);
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let why = curves(&a, &a, tolerance).unwrap_err().to_string();
        assert!(why.contains("tolerance"), "{why}");
    }
}
