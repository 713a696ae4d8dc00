//! Curves that touch.

use crate::sample::{Random, curve};
use bladesmith::nurbs::{KnotVector, NurbsCurve, Point};
use bladesmith::ops::intersect::{Kind, curves};
use glam::{DMat2, DMat3, DVec2, DVec3};
use std::f64::consts::TAU;

fn circle(centre: DVec2, radius: f64) -> NurbsCurve<DVec2> {
    NurbsCurve::arc(centre, DVec2::X * radius, DVec2::Y * radius, 0.3, 0.3 + TAU).unwrap()
}

#[test]
fn circles_that_touch_do_so_once() {
    for (distance, what) in [(3.0, "outside"), (1.0, "inside")] {
        for off in [-5e-8, 0.0, 5e-8] {
            let (a, b) = (circle(DVec2::ZERO, 2.0), circle(DVec2::new(distance + off, 0.0), 1.0));
            let all = curves(&a, &b, 1e-7).unwrap();
            assert_eq!(all.crossings.len(), 1, "{what}, {off}: {all:?}");
            let c = all.crossings[0];
            assert_eq!(c.kind, Kind::Tangential, "{what}, {off}: {all:?}");
            assert!(c.point.distance(DVec2::new(2.0, 0.0)) < 1e-6, "{what}, {off}: {all:?}");
            assert!(all.overlaps.is_empty(), "{what}, {off}: {all:?}");
        }
    }
}

#[test]
fn circles_that_miss_or_cut_by_more_than_the_tolerance_do_not_touch() {
    for (off, expected) in
        [(1e-5, 0), (1.1e-7, 0), (1.9e-7, 0), (-1.5e-7, 2), (-1e-5, 2), (-1e-6, 2), (-1e-3, 2)]
    {
        let (a, b) = (circle(DVec2::ZERO, 2.0), circle(DVec2::new(3.0 + off, 0.0), 1.0));
        let all = curves(&a, &b, 1e-7).unwrap();
        assert_eq!(all.crossings.len(), expected, "{off}: {all:?}");
        assert!(all.crossings.iter().all(|c| c.kind == Kind::Transversal), "{off}: {all:?}");
        // Where the common chord stands.
        let d = 3.0 + off;
        let x = (d * d + 3.0) / (2.0 * d);
        for c in &all.crossings {
            let expected = DVec2::new(x, (4.0 - x * x).sqrt().copysign(c.point.y));
            assert!(c.point.distance(expected) < 1e-8, "{off}: {c:?}, {expected}");
        }
    }
}

fn bezier<P: Point>(poles: Vec<P>) -> NurbsCurve<P> {
    NurbsCurve::new(KnotVector::clamped(poles.len() - 1, &[0.0, 1.0]).unwrap(), poles, None).unwrap()
}

#[test]
fn a_cubic_through_its_tangent_touches_it() {
    // y = (x − 1)³ and y = 0: a crossing with parallel tangents.
    let cubic =
        bezier([[0.0, -1.0], [2.0 / 3.0, 1.0], [4.0 / 3.0, -1.0], [2.0, 1.0]].map(DVec2::from).to_vec());
    let axis = bezier([[-1.0, 0.0], [3.0, 0.0]].map(DVec2::from).to_vec());
    let all = curves(&cubic, &axis, 1e-9).unwrap();
    assert_eq!(all.crossings.len(), 1, "{all:?}");
    assert_eq!(all.crossings[0].kind, Kind::Tangential, "{all:?}");
    assert!((all.crossings[0].at[0] - 0.5).abs() < 1e-3, "{all:?}");
}

#[test]
fn tangents_of_different_speed_are_parallel_all_the_same() {
    let parabola = bezier([[-1.0, 1.0], [0.0, -1.0], [1.0, 1.0]].map(DVec2::from).to_vec());
    let axis = bezier([[-2.0, 0.0], [2.0, 0.0]].map(DVec2::from).to_vec());
    let all = curves(&parabola, &axis, 1e-9).unwrap();
    assert_eq!(all.crossings.len(), 1, "{all:?}");
    assert_eq!(all.crossings[0].kind, Kind::Tangential, "{all:?}");
    assert!((all.crossings[0].at[0] - 0.5).abs() < 1e-9, "{all:?}");
}

#[test]
fn curves_that_go_on_smoothly_touch_at_their_ends() {
    let whole = bezier([[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 1.0]].map(DVec2::from).to_vec());
    let [a, b] = whole.split(0.4).unwrap();
    for (a, b, what) in [(&a, &b, "on"), (&b, &a, "back"), (&a, &b.reversed(), "reversed")] {
        let all = curves(a, b, 1e-9).unwrap();
        assert_eq!(all.crossings.len(), 1, "{what}: {all:?}");
        assert!(all.overlaps.is_empty(), "{what}: {all:?}");
        assert!(all.crossings[0].point.distance(whole.point(0.4)) < 1e-9, "{what}: {all:?}");
    }
}

#[test]
fn curves_in_space_meet_within_the_tolerance_only() {
    let a = bezier(
        [[0.0, 0.0, 0.0], [1.0, 2.0, 0.3], [2.0, -1.0, 0.0], [3.0, 1.0, 1.0]].map(DVec3::from).to_vec(),
    );
    let at = a.point(0.37);
    for (off, expected) in [(0.0, 1), (0.9e-6, 1), (1.1e-6, 0), (0.1, 0)] {
        let along = DVec3::new(0.2, -1.0, 0.5);
        let across = a.derivatives(0.37)[1].cross(along).normalize() * off;
        let b = bezier(vec![at + across - along, at + across + along * 2.0]);
        let all = curves(&a, &b, 1e-6).unwrap();
        assert_eq!(all.crossings.len(), expected, "{off}: {all:?}");
        for c in &all.crossings {
            assert!((c.distance - off).abs() < 1e-12 && (c.at[0] - 0.37).abs() < 1e-6, "{off}: {c:?}");
        }
    }
    // A tangent in space.
    let d = a.derivatives(0.37)[1];
    let all = curves(&a, &bezier(vec![at - d, at + d * 0.7]), 1e-9).unwrap();
    assert_eq!(all.crossings.len(), 1, "{all:?}");
    assert_eq!(all.crossings[0].kind, Kind::Tangential, "{all:?}");
}

#[test]
fn random_curves_laid_on_each_other_touch_there() {
    let mut random = Random(21);
    for case in 0..400 {
        let a = curve(&mut random, 1 + case % 7, case % 3 == 0);
        let b = curve(&mut random, 2 + case / 7 % 6, case % 4 == 0);
        let place = |random: &mut Random, c: &NurbsCurve<DVec2>| {
            let (from, to) = c.knots().domain();
            random.within(from, to)
        };
        let (s, t) = (place(&mut random, &a), place(&mut random, &b));
        let ([p, d, _], [q, e, _]) = (a.derivatives(s), b.derivatives(t));
        let turn = DMat2::from_angle(d.to_angle() - e.to_angle());
        let b = b.mapped(|x| p + turn * (x - q)).unwrap();
        let all = curves(&a, &b, 1e-9).unwrap();
        let touch = all.crossings.iter().find(|c| c.kind == Kind::Tangential && c.point.distance(p) < 1e-3);
        assert!(touch.is_some(), "{case}: {p} at {s}, {t} is not among {all:?}");
    }
}

#[test]
fn curves_turned_into_space_meet_as_in_the_plane() {
    let mut random = Random(22);
    let mut total = 0;
    for case in 0..400 {
        let a = curve(&mut random, 1 + case % 7, case % 3 == 0);
        let b = curve(&mut random, 1 + case / 7 % 7, case % 4 == 0);
        let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.0 + case as f64);
        let lifted = |c: &NurbsCurve<DVec2>| {
            c.mapped(|p| turn * p.extend(0.0) + DVec3::new(10.0, -20.0, 5.0)).unwrap()
        };
        let (plane, space) = (curves(&a, &b, 1e-9).unwrap(), curves(&lifted(&a), &lifted(&b), 1e-9).unwrap());
        assert_eq!(plane.crossings.len(), space.crossings.len(), "{case}: {plane:?}, {space:?}");
        for (c, d) in plane.crossings.iter().zip(&space.crossings) {
            let apart = (c.at[0] - d.at[0]).abs().max((c.at[1] - d.at[1]).abs());
            assert!(apart < 1e-6 && c.kind == d.kind, "{case}: {c:?}, {d:?}");
        }
        total += plane.crossings.len();
    }
    assert!(total > 1000, "{total} crossings say little");
}
