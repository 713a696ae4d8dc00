//! Faces that the user or the field holds.

use crate::fields::bend;
use crate::judge::judge;
use crate::solids::{field, hot, inside, nodes, solid};
use crate::{assert_says, refusal, run};
use bladesmith::brep::Brep;
use bladesmith::fe::Field;
use bladesmith::morph::Options;
use glam::DVec3;

/// What a held quadric may differ from its spline, mm; planes and splines do not at all.
const REPRESENTED_MM: f64 = 4e-7;

/// Largest distance that a face (from 1) moved.
fn moved(before: &Brep, after: &Brep, face: usize) -> f64 {
    let old = hot(before);
    let (a, b) = (
        &before.surfaces[old.topology.faces[face - 1].surface],
        &after.surfaces[hot(after).topology.faces[face - 1].surface],
    );
    let apart = |uv: glam::DVec2| (a.point(uv.x, uv.y) - b.point(uv.x, uv.y)).length();
    inside(&old, face - 1, 20).into_iter().map(apart).fold(0.0, f64::max)
}

fn displaced(brep: &Brep) -> Field {
    field(nodes(brep, 0.8, |_| true), |x| bend(x, 0.004) + DVec3::new(0.02, 0.01, 0.03))
}

#[test]
fn fixed_faces_do_not_move_and_the_solid_stays_closed() {
    for (name, fixed) in
        [("cylinder", vec![2]), ("filleted", vec![1, 24]), ("bar", vec![5]), ("drop", vec![1])]
    {
        let brep = solid(name);
        let options = Options { fixed_faces: fixed.clone(), ..Options::default() };
        let done = run(&brep, &displaced(&brep), &options);
        let verdict = judge(&brep, &done.brep, |_| DVec3::ZERO);
        assert!(verdict.gap < Options::default().tolerance_mm, "{name}: {verdict:?}");
        for face in &fixed {
            let by = moved(&brep, &done.brep, *face);
            assert!(by <= REPRESENTED_MM, "{name}: face {face} moved by {by}");
        }
        assert!(verdict.beyond_tolerance <= 0.0, "{name}: {verdict:?}");
    }
}

#[test]
fn only_moving_faces_move() {
    let brep = solid("plate");
    let options = Options { moving_faces: vec![11, 12], ..Options::default() };
    let done = run(&brep, &displaced(&brep), &options);
    let verdict = judge(&brep, &done.brep, |_| DVec3::ZERO);
    assert!(verdict.gap < 5e-3, "{verdict:?}");
    for face in 1..=10 {
        let by = moved(&brep, &done.brep, face);
        assert!(by <= REPRESENTED_MM, "face {face} moved by {by}");
    }
    assert!(moved(&brep, &done.brep, 11) > 0.01 && moved(&brep, &done.brep, 12) > 0.01);
    assert!(verdict.beyond_tolerance <= 0.0, "{verdict:?}");
}

#[test]
fn all_faces_held_is_the_input() {
    let brep = solid("filleted");
    let options = Options { fixed_faces: (1..=26).collect(), ..Options::default() };
    let done = run(&brep, &displaced(&brep), &options);
    let verdict = judge(&brep, &done.brep, |_| DVec3::ZERO);
    assert!(verdict.error <= 2e-6 && verdict.gap <= 2e-6, "{verdict:?}");
}

#[test]
fn numbers_of_no_face_are_refused() {
    let brep = solid("cylinder");
    let field = displaced(&brep);
    for wrong in [0, 4, usize::MAX] {
        for options in [
            Options { fixed_faces: vec![1, wrong], ..Options::default() },
            Options { moving_faces: vec![wrong], ..Options::default() },
        ] {
            let error = refusal(&brep, &field, &options);
            assert_eq!(error.code(), 1);
            assert_says(&error.to_string(), &[&format!("no face {wrong}"), "3"]);
        }
    }
}

#[test]
fn a_face_cannot_both_move_and_stay() {
    let brep = solid("cylinder");
    let options = Options { moving_faces: vec![1, 2], fixed_faces: vec![2], ..Options::default() };
    let error = refusal(&brep, &displaced(&brep), &options);
    assert_eq!(error.code(), 1);
    assert_says(&error.to_string(), &["face 2", "move", "stay"]);
}

#[test]
fn a_face_on_the_surface_of_a_held_one_cannot_move() {
    let brep = solid("plate");
    let hot = hot(&brep);
    let shared = hot.patches.iter().find(|p| p.faces.len() > 1).expect("two faces on one surface");
    let options = Options { fixed_faces: vec![shared.faces[0] + 1], ..Options::default() };
    let error = refusal(&brep, &displaced(&brep), &options);
    assert_says(&error.to_string(), &[&format!("face {}", shared.faces[1] + 1), "same surface", "both"]);
}

/// A field that is zero on one face and grows smoothly from there.
#[test]
fn a_face_that_the_field_holds_stays_and_is_named() {
    let brep = solid("bar");
    let field = field(nodes(&brep, 0.8, |_| true), |x| DVec3::new(0.0, 2e-4 * x.z * x.z, 1e-3 * x.z));
    let done = run(&brep, &field, &Options::default());
    let foot = (0..6).find(|&f| hot(&brep).topology.faces[f].surface == bottom(&brep)).expect("a bottom");
    assert!(done.report.faces[foot].held);
    assert!(moved(&brep, &done.brep, foot + 1) < 1e-12);
    crate::assert_warns(&done, &["holds", &format!("Face{}", foot + 1)]);
}

/// The surface on which the bar stands.
fn bottom(brep: &Brep) -> usize {
    let hot = hot(brep);
    let low = |f: &usize| {
        inside(&hot, *f, 3)
            .iter()
            .all(|uv| brep.surfaces[hot.topology.faces[*f].surface].point(uv.x, uv.y).z.abs() < 1e-9)
    };
    hot.topology.faces[(0..6).find(low).expect("a bottom")].surface
}
