//! Curves that meet themselves.

use super::sample::{Random, brute_force, curve};
use bladesmith::nurbs::{KnotVector, NurbsCurve};
use bladesmith::ops::intersect::{Overlap, self_intersections};
use bladesmith::ops::offset::Offset;
use glam::DVec2;
use std::f64::consts::TAU;

fn bezier(poles: &[[f64; 2]]) -> NurbsCurve<DVec2> {
    let knots = KnotVector::clamped(poles.len() - 1, &[0.0, 1.0]).unwrap();
    NurbsCurve::new(knots, poles.iter().map(|&p| p.into()).collect(), None).unwrap()
}

#[test]
fn random_curves_have_the_loops_of_brute_force() {
    let mut random = Random(7);
    let mut total = 0;
    for case in 0..500 {
        let c = curve(&mut random, 1 + case % 7, case % 3 == 0);
        let mut roots = brute_force(&c, &c, 48);
        roots.retain(|r| r[1] - r[0] > 1e-5);
        let all = self_intersections(&c, 1e-10).unwrap();
        assert!(all.overlaps.is_empty(), "curve {case}: {:?}", all.overlaps);
        for root in &roots {
            let near = |at: [f64; 2]| (at[0] - root[0]).abs() < 1e-6 && (at[1] - root[1]).abs() < 1e-6;
            let times = all.crossings.iter().filter(|c| near(c.at)).count();
            assert_eq!(times, 1, "curve {case}: {root:?} among {:?}", all.crossings);
        }
        for x in &all.crossings {
            let gap = c.point(x.at[0]).distance(c.point(x.at[1]));
            assert!(x.at[0] < x.at[1] && gap < 2e-10, "curve {case}: {x:?} is {gap} wide");
        }
        assert!(all.crossings.len() <= roots.len() + 1, "curve {case}: {:?}, {roots:?}", all.crossings);
        total += roots.len();
    }
    assert!(total > 500, "{total} loops say little");
}

#[test]
fn a_loop_within_one_span_is_found() {
    let all = self_intersections(&bezier(&[[0.0, 0.0], [3.0, 2.0], [-2.0, 2.0], [1.0, 0.0]]), 1e-9).unwrap();
    assert_eq!(all.crossings.len(), 1, "{all:?}");
    let [s, t] = all.crossings[0].at;
    assert!((s + t - 1.0).abs() < 1e-12 && s < t, "{all:?}");
}

#[test]
fn narrow_loops_are_found_however_narrow() {
    // x = t³ − h²t, y = t² − h²: a loop of width h², from t = −h to h.
    for h in [0.3, 1e-2, 1e-3] {
        let knots = KnotVector::clamped(3, &[-1.0, 1.0]).unwrap();
        let (e, g) = (1.0 - h * h, h * h);
        // Poles by blossoms.
        let poles = [[-e, e], [1.0 + g / 3.0, -1.0 / 3.0 - g], [-1.0 - g / 3.0, -1.0 / 3.0 - g], [e, e]];
        let c: NurbsCurve<DVec2> =
            NurbsCurve::new(knots, poles.iter().map(|&p| DVec2::from(p)).collect(), None).unwrap();
        let all = self_intersections(&c, 1e-10).unwrap();
        assert_eq!(all.crossings.len(), 1, "{h}: {all:?}");
        let [s, t] = all.crossings[0].at;
        assert!((s + h).abs() < 1e-7 && (t - h).abs() < 1e-7, "{h}: {all:?}");
    }
}

#[test]
fn seams_corners_and_cusps_are_no_loops() {
    let circle = NurbsCurve::arc(DVec2::ZERO, DVec2::X, DVec2::Y, 0.0, TAU).unwrap();
    let cusp = bezier(&[[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]);
    let square = NurbsCurve::new(
        KnotVector::clamped(1, &[0.0, 1.0, 2.0, 3.0, 4.0]).unwrap(),
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]].map(DVec2::from).to_vec(),
        None,
    )
    .unwrap();
    let drop = bezier(&[[0.0, 0.0], [3.0, 3.0], [-3.0, 3.0], [0.0, 0.0]]);
    let needle = NurbsCurve::new(
        KnotVector::clamped(1, &[0.0, 1.0, 2.0]).unwrap(),
        [[0.0, 0.0], [1.0, 1e-6], [0.0, 2e-3]].map(DVec2::from).to_vec(),
        None,
    )
    .unwrap();
    for (c, what) in
        [(circle, "circle"), (cusp, "cusp"), (square, "square"), (drop, "drop"), (needle, "needle")]
    {
        for tolerance in [1e-10, 1e-7, 1e-5] {
            let all = self_intersections(&c, tolerance).unwrap();
            assert!(all.crossings.is_empty() && all.overlaps.is_empty(), "{what}, {tolerance}: {all:?}");
        }
    }
}

/// The two arms of a cusp stay within the tolerance of each other for a while; that is no place
/// which the curve passes twice.
#[test]
fn cusps_anywhere_are_no_loops() {
    let cusp = bezier(&[[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]);
    for (from, to) in [(0.0, 0.77), (0.1, 0.93), (0.31, 1.0)] {
        for size in [1e-3, 1.0, 1e3] {
            let c = cusp.part(from, to).unwrap().mapped(|p| p * size + DVec2::new(3.0, -1.0) * size).unwrap();
            for tolerance in [1e-12, 1e-10, 1e-9, 1e-7, 1e-5] {
                let all = self_intersections(&c, tolerance * size).unwrap();
                let none = all.crossings.is_empty() && all.overlaps.is_empty();
                assert!(none, "{from} to {to}, size {size}, tolerance {tolerance}: {all:?}");
            }
        }
    }
}

/// The offset of y = x² by d beyond its least radius 1/2 crosses itself where 1 + 4x² = 4d², with a
/// cusp on either side: two control segments hold all of it.
#[test]
fn the_loop_of_an_offset_parabola_is_one_crossing() {
    let poles = [[-1.0, 1.0], [0.0, -1.0], [1.0, 1.0]].map(DVec2::from).to_vec();
    let parabola = NurbsCurve::new(KnotVector::clamped(2, &[-1.0, 1.0]).unwrap(), poles, None).unwrap();
    for (d, fit) in [(0.501, 1e-9), (0.51, 1e-9), (0.6, 1e-9)] {
        let raw = Offset::new(d, fit).raw(&parabola).unwrap();
        assert_eq!(raw.len(), 1, "{d}");
        let half = 0.5 * (4.0 * d * d - 1.0f64).sqrt();
        for tolerance in [1e-11, 1e-10, 1e-9, 1e-8] {
            let all = self_intersections(&raw[0].curve, tolerance).unwrap();
            let what = format!("{d}, {fit}, {tolerance}: {all:?}");
            assert!(all.crossings.len() == 1 && all.overlaps.is_empty(), "{what}");
            let off = all.crossings[0].at.map(f64::abs).map(|x| (x - half).abs());
            assert!(off.iter().all(|x| *x < 1e-4), "{what}");
        }
    }
}

#[test]
fn a_span_that_turns_back_on_itself_overlaps_up_to_its_turn() {
    // x = t (2 − t), y = x / 2: all beyond the turn at 1 lies on what was before.
    for end in [2.0, 1.5] {
        let c = bezier(&[[0.0, 0.0], [end, 0.5 * end], [end * (2.0 - end), 0.5 * end * (2.0 - end)]]);
        let all = self_intersections(&c, 1e-9).unwrap();
        assert!(all.overlaps.len() == 1 && all.crossings.is_empty(), "{end}: {all:?}");
        let Overlap { first, second } = all.overlaps[0];
        let expected = [(2.0 - end) / end, 1.0 / end, 1.0, 1.0 / end];
        for (is, t) in [first, second].as_flattened().iter().zip(expected) {
            assert!((is - t).abs() < 1e-4, "{end}: {all:?}, expected {expected:?}");
        }
    }
}

#[test]
fn a_curve_that_runs_back_on_itself_overlaps() {
    let c = NurbsCurve::new(
        KnotVector::clamped(1, &[0.0, 1.0, 2.0]).unwrap(),
        [[0.0, 0.0], [2.0, 2.0], [1.0, 1.0]].map(DVec2::from).to_vec(),
        None,
    )
    .unwrap();
    let all = self_intersections(&c, 1e-9).unwrap();
    assert_eq!(all.overlaps.len(), 1, "{all:?}");
    let o = all.overlaps[0];
    let gap = [o.first[0] - 0.5, o.first[1] - 1.0, o.second[0] - 2.0, o.second[1] - 1.0];
    assert!(gap.iter().all(|g| g.abs() < 1e-9) && all.crossings.is_empty(), "{all:?}");
}
