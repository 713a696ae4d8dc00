//! Parts of unusual shape, size and place, and meshes of unusual density.

use crate::fields::{bend, heat};
use crate::judge::judge;
use crate::run;
use crate::solids::{field, nodes, solid};
use bladesmith::fe::Field;
use bladesmith::morph::Options;
use glam::DVec3;

#[test]
fn tiny_and_sliver_faces_follow() {
    let brep = solid("slivers");
    let u = |x: DVec3| bend(x, 0.004) + heat(x, 2e-5);
    let spacing = 0.7;
    let done = run(&brep, &field(nodes(&brep, spacing, |_| true), u), &Options::default());
    let verdict = judge(&brep, &done.brep, u);
    assert_eq!(verdict.folded, 0);
    assert!(
        verdict.error < MESH * spacing * spacing + AIM_MM && verdict.beyond_tolerance <= 0.0,
        "{verdict:?}"
    );
}

/// Errors that the fit leaves alone, mm.
const AIM_MM: f64 = 2.5e-5;
/// Error of a part of a few units with nodes one unit apart, in units: three times what straight
/// lines between the nodes would leave of the field.
const MESH: f64 = 2e-3;

/// The same part, mesh and field at other scales: errors scale down to a floor of rounding.
#[test]
fn parts_of_every_size_follow() {
    for (name, size) in [("filleted_small", 0.01), ("filleted", 1.0), ("filleted_large", 100.0)] {
        let brep = solid(name);
        let u = |x: DVec3| size * (bend(x / size, 0.004) + heat(x / size, 2e-5));
        let done = run(&brep, &field(nodes(&brep, size, |_| true), u), &Options::default());
        let verdict = judge(&brep, &done.brep, u);
        assert_eq!(verdict.folded, 0, "{name}");
        let opened = done.report.edges.iter().filter(|e| e.tangent).map(|e| e.angle_deg);
        let opened = opened.map(|a| a.after - a.before).fold(verdict.opened_deg, f64::max);
        assert!(opened < 0.1, "{name}: a tangent edge opens by {opened} degrees");
        assert!(
            verdict.error < MESH * size + AIM_MM && verdict.beyond_tolerance <= 0.0,
            "{name}: {verdict:?}"
        );
    }
}

#[test]
fn a_part_far_from_the_origin_follows_like_one_at_it() {
    let place = DVec3::new(1e4, -2e3, 500.0);
    let u = |x: DVec3| bend(x, 0.004) + heat(x, 2e-5);
    let near = solid("drop");
    let here = judge(&near, &run(&near, &field(nodes(&near, 0.8, |_| true), u), &Options::default()).brep, u);
    let far = solid("far");
    let there = |x: DVec3| u(x - place);
    let done = run(&far, &field(nodes(&far, 0.8, |_| true), there), &Options::default());
    let verdict = judge(&far, &done.brep, there);
    assert!((verdict.error - here.error).abs() < 0.1 * here.error + 1e-7, "{here:?} {verdict:?}");
    assert!(verdict.gap < here.gap + 1e-6 && verdict.beyond_tolerance <= 0.0, "{here:?} {verdict:?}");
}

fn repeated(field: &Field, by: usize) -> Field {
    let indices = || (0..field.points.len() * by).map(|k| k / by);
    Field {
        ids: (1..=(field.ids.len() * by) as i64).collect(),
        points: indices().map(|k| field.points[k]).collect(),
        displacements: indices().map(|k| field.displacements[k]).collect(),
        surface_nodes: Some((0..(field.ids.len() * by) as u32).collect()),
        ..field.clone()
    }
}

#[test]
fn nodes_at_the_same_place_do_no_harm() {
    let brep = solid("drop");
    let u = |x: DVec3| bend(x, 0.004);
    let once = field(nodes(&brep, 0.8, |_| true), u);
    let single = judge(&brep, &run(&brep, &once, &Options::default()).brep, u);
    for by in [2, 5] {
        let done = run(&brep, &repeated(&once, by), &Options::default());
        let verdict = judge(&brep, &done.brep, u);
        assert!(verdict.error < 1.5 * single.error && verdict.folded == 0, "{by} times: {verdict:?}");
    }
}

/// So few nodes cannot carry the field, but the result is a whole solid near it.
#[test]
fn very_few_nodes_give_a_closed_solid() {
    let options = Options { extrapolate: true, ..Options::default() };
    for name in ["drop", "plate", "torus"] {
        let brep = solid(name);
        let all = nodes(&brep, 0.8, |_| true);
        for count in [4, 5, 7, 10, 20] {
            let some = (0..count).map(|k| all[(k * 7919 + 13) % all.len()]).collect();
            let u = |x: DVec3| bend(x, 0.004);
            let done = run(&brep, &field(some, u), &options);
            let verdict = judge(&brep, &done.brep, u);
            assert_eq!(done.report.solid.folded, 0, "{name}, {count} nodes");
            assert!(
                verdict.beyond_tolerance <= 0.0 && verdict.gap < 0.05,
                "{name}, {count} nodes: {verdict:?}"
            );
        }
    }
}

#[test]
fn nodes_on_one_face_carry_the_others_along() {
    let options = Options { extrapolate: true, ..Options::default() };
    for (name, face) in [("plate", 1), ("filleted", 8), ("drop", 0), ("bar", 0)] {
        let brep = solid(name);
        let u = |x: DVec3| bend(x, 0.004) + DVec3::new(0.1, 0.0, 0.0);
        let done = run(&brep, &field(nodes(&brep, 0.5, |f| f == face), u), &options);
        let verdict = judge(&brep, &done.brep, u);
        assert_eq!((verdict.folded, done.report.solid.folded), (0, 0), "{name}: {verdict:?}");
        assert!(verdict.error < 1.0 && verdict.beyond_tolerance <= 0.0, "{name}: {verdict:?}");
    }
}
