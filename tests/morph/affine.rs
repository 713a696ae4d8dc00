//! Affine fields come out exactly, wherever the nodes are.

use crate::fields::Affine;
use crate::judge::judge;
use crate::solids::{SOLIDS, field, nodes, solid};
use crate::{assert_warns, run};
use bladesmith::brep::Brep;
use bladesmith::fe::Field;
use bladesmith::morph::Options;
use std::f64::consts::PI;

/// What a solid of a few millimetres may be off, mm.
const EXACT_MM: f64 = 2e-6;

fn check(what: &str, brep: &Brep, field: &Field, motion: &Affine) {
    let done = run(brep, field, &Options::default());
    let verdict = judge(brep, &done.brep, |x| motion.at(x));
    assert!(verdict.error <= EXACT_MM, "{what}: {verdict:?}");
    assert!(verdict.gap <= 2.0 * EXACT_MM && verdict.beyond_tolerance <= 0.0, "{what}: {verdict:?}");
    assert_eq!((verdict.folded, done.report.solid.folded), (0, 0), "{what}");
    assert!(verdict.opened_deg <= 0.1, "{what}: {verdict:?}");
    let volume = done.report.solid.volume_mm3;
    let ratio = volume.after / volume.before / motion.volume_ratio();
    assert!((ratio - 1.0).abs() <= 1e-7, "{what}: volume ratio {ratio} times the field's");
}

#[test]
fn affine_fields_are_exact_on_every_kind_of_face() {
    for name in SOLIDS {
        let brep = solid(name);
        let points = nodes(&brep, 1.0, |_| true);
        for motion in [Affine::scaling(), Affine::turned_and_sheared(), Affine::translation()] {
            check(name, &brep, &field(points.clone(), |x| motion.at(x)), &motion);
        }
    }
}

#[test]
fn faces_without_nodes_follow_an_affine_field() {
    for (name, meshed) in [("plate", vec![0, 1, 4, 10]), ("filleted", vec![2, 9, 13]), ("bar", vec![0, 4])] {
        let brep = solid(name);
        let motion = Affine::turned_and_sheared();
        let field = field(nodes(&brep, 1.0, |f| meshed.contains(&f)), |x| motion.at(x));
        check(name, &brep, &field, &motion);
        let done = run(&brep, &field, &Options::default());
        assert_warns(&done, &["without nodes", "affine"]);
    }
}

#[test]
fn the_factor_and_the_scale_multiply_the_field() {
    let brep = solid("filleted");
    let whole = Affine::scaling();
    let points = nodes(&brep, 1.0, |_| true);
    let options = Options { factor: -0.5, displacement_scale: 10.0, ..Options::default() };
    let done = run(&brep, &field(points, |x| whole.at(x) / 5.0), &options);
    let verdict = judge(&brep, &done.brep, |x| -whole.at(x));
    assert!(verdict.error <= EXACT_MM, "{verdict:?}");
    assert_warns(&done, &["first-order estimate"]);
}

/// Volume, area and centroid of simple solids in closed form.
#[test]
fn volume_area_and_centroid_are_those_of_the_solid() {
    let fillet = 12.0 * 8.0 * 5.0 - (4.0 - PI) * (10.0 + 6.0 + 3.0) - (8.0 - PI * 4.0 / 3.0);
    let cases = [
        ("cylinder", PI * 72.0, PI * (18.0 + 48.0), [0.0, 0.0, 4.0]),
        ("torus", 2.0 * PI * PI * 24.0, 4.0 * PI * PI * 12.0, [0.0; 3]),
        ("filleted", fillet, 2.0 * (60.0 + 30.0 + 18.0) + 2.0 * PI * 19.0 + 4.0 * PI, [6.0, 4.0, 2.5]),
    ];
    for (name, volume, area, centroid) in cases {
        let brep = solid(name);
        let still = Affine { gradient: glam::DMat3::ZERO, shift: glam::DVec3::ZERO };
        let report =
            run(&brep, &field(nodes(&brep, 1.0, |_| true), |x| still.at(x)), &Options::default()).report;
        let found = report.solid;
        for (what, is, expected) in
            [("volume", found.volume_mm3.before, volume), ("area", found.area_mm2.before, area)]
        {
            assert!((is / expected - 1.0).abs() < 1e-7, "{name}: {what} {is} instead of {expected}");
        }
        for (is, expected) in found.centroid_mm.before.iter().zip(centroid) {
            assert!((is - expected).abs() < 1e-6, "{name}: centroid {:?}", found.centroid_mm.before);
        }
    }
}
