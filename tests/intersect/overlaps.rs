//! Curves that run along each other.

use super::sample::{Random, curve};
use bladesmith::nurbs::{KnotVector, NurbsCurve};
use bladesmith::ops::intersect::{Intersections, Kind, curves, self_intersections};
use glam::DVec2;

fn one_overlap(what: &str, all: &Intersections<DVec2>, first: [f64; 2], second: [f64; 2]) {
    assert_eq!(all.overlaps.len(), 1, "{what}: {:?}", all.overlaps);
    let o = all.overlaps[0];
    for (is, expected) in o.first.iter().chain(&o.second).zip(first.iter().chain(&second)) {
        assert!((is - expected).abs() < 1e-7, "{what}: {o:?}, expected {first:?} and {second:?}");
    }
}

#[test]
fn a_curve_and_itself_in_another_form_are_one() {
    let mut random = Random(3);
    for case in 0..70 {
        let a = curve(&mut random, 1 + case % 7, case % 3 == 0);
        let (from, to) = a.knots().domain();
        let at = |share: f64| from + (to - from) * share;
        let own = self_intersections(&a, 1e-9).unwrap().crossings.len();
        let refined = a.refined(&[at(0.31), at(0.77)]).unwrap();
        let forms = [
            ("as it is", a.clone(), [from, to], [from, to]),
            ("refined", refined, [from, to], [from, to]),
            ("elevated", a.elevated(1).unwrap(), [from, to], [from, to]),
            ("reversed", a.reversed(), [from, to], [to, from]),
            ("a part", a.part(at(0.2), at(0.6)).unwrap(), [at(0.2), at(0.6)], [at(0.2), at(0.6)]),
        ];
        for (what, b, first, second) in forms {
            let what = format!("{case}, degree {}, {what}", 1 + case % 7);
            let all = curves(&a, &b, 1e-9).unwrap();
            one_overlap(&what, &all, first, second);
            if b.knots().domain() == (from, to) {
                assert_eq!(all.crossings.len(), 2 * own, "{what}: {:?}", all.crossings);
            }
        }
    }
}

fn line(a: [f64; 2], b: [f64; 2]) -> NurbsCurve<DVec2> {
    let knots = KnotVector::clamped(1, &[0.0, 1.0]).unwrap();
    NurbsCurve::new(knots, vec![a.into(), b.into()], None).unwrap()
}

#[test]
fn collinear_lines_share_what_they_share() {
    let a = line([0.0, 0.0], [4.0, 2.0]);
    let all = curves(&a, &line([2.0, 1.0], [6.0, 3.0]), 1e-9).unwrap();
    one_overlap("shifted", &all, [0.5, 1.0], [0.0, 0.5]);
    assert!(all.crossings.is_empty(), "{all:?}");
    let all = curves(&a, &line([3.0, 1.5], [1.0, 0.5]), 1e-9).unwrap();
    one_overlap("within, against it", &all, [0.25, 0.75], [1.0, 0.0]);
    let all = curves(&a, &line([4.0, 2.0], [6.0, 3.0]), 1e-9).unwrap();
    assert!(all.overlaps.is_empty() && all.crossings.len() == 1, "end to end: {all:?}");
    assert_eq!(all.crossings[0].kind, Kind::Tangential);
    let all = curves(&a, &line([5.0, 2.5], [6.0, 3.0]), 1e-9).unwrap();
    assert!(all.overlaps.is_empty() && all.crossings.is_empty(), "apart: {all:?}");
    let all = curves(&a, &line([0.0, 0.1], [4.0, 2.1]), 1e-9).unwrap();
    assert!(all.overlaps.is_empty() && all.crossings.is_empty(), "beside it: {all:?}");
}

#[test]
fn arcs_of_one_circle_overlap() {
    let arc =
        |from: f64, to: f64| NurbsCurve::arc(DVec2::new(1.0, 2.0), DVec2::X, DVec2::Y, from, to).unwrap();
    let (a, b) = (arc(0.0, 2.0), arc(1.0, 3.0));
    let all = curves(&a, &b, 1e-9).unwrap();
    assert_eq!(all.overlaps.len(), 1, "{all:?}");
    let o = all.overlaps[0];
    let start = b.point(o.second[0]).distance(b.point(b.knots().domain().0));
    let end = a.point(o.first[1]).distance(a.point(a.knots().domain().1));
    assert!(start < 1e-8 && end < 1e-8 && all.crossings.is_empty(), "{all:?}");
}

#[test]
fn a_curve_that_leaves_another_at_a_corner_overlaps_up_to_it() {
    let whole = NurbsCurve::new(
        KnotVector::clamped(3, &[0.0, 1.0]).unwrap(),
        [[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 1.0]].map(DVec2::from).to_vec(),
        None,
    )
    .unwrap();
    let [a, _] = whole.split(0.5).unwrap();
    let end = whole.point(0.5);
    let away = a.joined(&line(end.into(), [end.x, end.y + 2.0]), 1e-9).unwrap();
    let all = curves(&whole, &away, 1e-9).unwrap();
    one_overlap("a corner", &all, [0.0, 0.5], [0.0, 0.5]);
    assert!(all.crossings.is_empty(), "{all:?}");
}

#[test]
fn curves_beside_each_other_overlap_up_to_the_tolerance() {
    let mut random = Random(9);
    for case in 0..20 {
        let a = curve(&mut random, 1 + case % 5, false).part(0.0, 0.1).unwrap();
        for (off, expected) in [(0.5e-6, 1), (0.99e-6, 1), (1.02e-6, 0), (1.9e-6, 0), (2.1e-6, 0), (1e-5, 0)]
        {
            let [_, d, _] = a.derivatives(0.05);
            let line = line((a.point(0.0) - d).into(), (a.point(0.0) + d).into());
            let beside = line.mapped(|p| p + d.perp().normalize() * off).unwrap();
            let all = curves(&line, &beside, 1e-6).unwrap();
            assert_eq!(all.overlaps.len(), expected, "{case}, {off}: {all:?}");
            assert!(all.crossings.is_empty(), "{case}, {off}: {all:?}");
        }
    }
}

#[test]
fn a_closed_curve_and_itself_have_the_seam_in_their_overlap() {
    let circle = |radius: f64| {
        NurbsCurve::arc(DVec2::ZERO, DVec2::X * radius, DVec2::Y * radius, 0.0, std::f64::consts::TAU)
            .unwrap()
    };
    let all = curves(&circle(2.0), &circle(2.0), 1e-9).unwrap();
    one_overlap("a circle", &all, [0.0, 1.0], [0.0, 1.0]);
    assert!(all.crossings.is_empty(), "{all:?}");
    for off in [3e-9, 1e-8, 1e-3] {
        let all = curves(&circle(2.0), &circle(2.0 + off), 1e-9).unwrap();
        assert!(all.overlaps.is_empty() && all.crossings.is_empty(), "{off}: {all:?}");
    }
}
