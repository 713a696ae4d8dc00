//! Inputs that are refused, or used with a warning.

use crate::fields::{Affine, bend};
use crate::judge::judge;
use crate::solids::{field, nodes, part, solid};
use crate::{assert_says, assert_warns, refusal, run};
use bladesmith::brep::Brep;
use bladesmith::fe::Field;
use bladesmith::morph::Options;
use glam::DVec3;

fn good() -> (Brep, Field) {
    let brep = solid("cylinder");
    let field = field(nodes(&brep, 0.8, |_| true), |x| bend(x, 0.004));
    (brep, field)
}

fn mapped(field: &Field, place: impl Fn(DVec3) -> DVec3) -> Field {
    Field { points: field.points.iter().map(|p| place(*p)).collect(), ..field.clone() }
}

fn scaled(field: &Field, factor: f64) -> Field {
    Field { displacements: field.displacements.iter().map(|u| *u * factor).collect(), ..field.clone() }
}

#[test]
fn a_part_without_a_solid_is_refused() {
    let (_, field) = good();
    let error = refusal(&part("faces_only"), &field, &Options::default());
    assert_eq!(error.code(), 120);
    assert_says(&error.to_string(), &["no solid", "sew"]);
}

/// The base with one face taken out of its shell.
#[test]
fn an_open_shell_is_refused() {
    let mut brep = solid("bar");
    let shell = brep.shapes.iter_mut().find(|s| matches!(s.kind, bladesmith::brep::ShapeKind::Shell));
    shell.expect("a shell").children.pop();
    let error = refusal(&brep, &good().1, &Options::default());
    assert_eq!(error.code(), 120);
    assert_says(&error.to_string(), &["not closed", "4 of 12 edges", "sew"]);
}

#[test]
fn a_solid_that_does_not_exist_is_refused() {
    let (brep, field) = good();
    for n in [0, 2, usize::MAX] {
        let error = refusal(&brep, &field, &Options { solid: Some(n), ..Options::default() });
        assert_says(&error.to_string(), &[&format!("no solid {n}"), "has 1"]);
    }
}

#[test]
fn a_field_elsewhere_is_refused() {
    let (brep, field) = good();
    type Place = fn(DVec3) -> DVec3;
    let places: [(&str, Place); 3] = [
        ("mirrored", |p| DVec3::new(p.x, p.y, -p.z)),
        ("turned", |p| DVec3::new(p.z, p.x, p.y + 2.0)),
        ("far", |p| p + DVec3::splat(1e5)),
    ];
    for (what, place) in places {
        let error = refusal(&brep, &mapped(&field, place), &Options::default());
        assert_eq!(error.code(), 160, "{what}: {error}");
        assert_says(&error.to_string(), &["sampled.csv", "does not lie on", "median distance"]);
    }
}

#[test]
fn another_unit_is_named_and_then_used() {
    let (brep, field) = good();
    let metres = scaled(&mapped(&field, |p| p * 1e-3), 1e-3);
    let error = refusal(&brep, &metres, &Options::default());
    assert_says(&error.to_string(), &["sampled.csv", "a ratio of 99", "--field-unit m"]);
    let options = Options { field_unit_mm: Some(1000.0), ..Options::default() };
    let verdict = judge(&brep, &run(&brep, &metres, &options).brep, |x| bend(x, 0.004));
    let direct = judge(&brep, &run(&brep, &field, &Options::default()).brep, |x| bend(x, 0.004));
    assert!((verdict.error - direct.error).abs() < 1e-9, "{verdict:?} {direct:?}");
    let inches = scaled(&mapped(&field, |p| p / 25.4), 1.0 / 25.4);
    assert_says(&refusal(&brep, &inches, &Options::default()).to_string(), &["--field-unit in"]);
}

#[test]
fn a_unit_that_was_stated_wrongly_is_named() {
    let (brep, field) = good();
    for (stated, scale) in [(1000.0, 1.0), (25.4, 1.0), (25.4, 1e-3)] {
        let options = Options { field_unit_mm: Some(stated), ..Options::default() };
        let error = refusal(&brep, &scaled(&mapped(&field, |p| p * scale), scale), &options);
        assert_eq!(error.code(), 160, "{error}");
        let right = if scale == 1.0 { "--field-unit mm instead" } else { "--field-unit m instead" };
        assert_says(&error.to_string(), &["sampled.csv", right]);
    }
}

#[test]
fn too_few_nodes_are_refused_for_what_they_are() {
    let (brep, whole) = good();
    let points = |count: usize| whole.points.iter().copied().take(count).collect::<Vec<_>>();
    let line = |step: DVec3| (0..30).map(|k| whole.points[0] + step * k as f64).collect::<Vec<_>>();
    let cases = [
        (points(1), "only 1 node with a displacement"),
        (points(3), "only 3 nodes with a displacement"),
        (line(DVec3::new(0.01, 0.02, 0.1)), "30 nodes with a displacement lie in one line"),
        (line(DVec3::ZERO), "lie in one line"),
    ];
    for (points, what) in cases {
        let error = refusal(&brep, &field(points, |x| bend(x, 0.004)), &Options::default());
        assert_eq!(error.code(), 150, "{error}");
        assert_says(&error.to_string(), &["sampled.csv", what, "at least 4 that do not lie in one line"]);
    }
}

/// Nodes in a plane say nothing of what lies beside it, however well an affine motion meets them.
#[test]
fn nodes_in_a_plane_do_not_move_the_rest_unasked() {
    let brep = solid("bar");
    let all = nodes(&brep, 1.0, |_| true);
    let lowest = all.iter().map(|p| p.z).fold(f64::MAX, f64::min);
    let plane = all.into_iter().filter(|p| p.z < lowest + 1e-9).collect();
    let field = field(plane, |x| Affine::turned_and_sheared().at(x));
    let error = refusal(&brep, &field, &Options::default());
    assert_says(&error.to_string(), &["without nodes on", "--extrapolate"]);
}

#[test]
fn odd_sizes_of_displacement_are_told() {
    let (brep, field) = good();
    let error = refusal(&brep, &scaled(&field, 1e3), &Options::default());
    assert_says(&error.to_string(), &["largest displacement", "folded", "factor"]);
    let tiny = run(&brep, &scaled(&field, 1e-4), &Options::default());
    assert_warns(&tiny, &["largest displacement", "--displacement-scale"]);
    let zero = run(&brep, &scaled(&field, 0.0), &Options::default());
    assert_warns(&zero, &["displacements are zero"]);
    let verdict = judge(&brep, &zero.brep, |_| DVec3::ZERO);
    assert!(verdict.error < 1e-6 && verdict.gap < 1e-6, "{verdict:?}");
}

#[test]
fn areas_without_nodes_are_refused_unless_extrapolated() {
    let (brep, whole) = good();
    let part = |limit: f64| {
        let keep = |p: &DVec3| p.z < limit;
        field(whole.points.iter().copied().filter(keep).collect(), |x| bend(x, 0.004))
    };
    let error = refusal(&brep, &part(5.0), &Options::default());
    assert_eq!(error.code(), 160);
    assert_says(&error.to_string(), &["without nodes", "Face1", "mm²", "--extrapolate"]);
    let done = run(&brep, &part(5.0), &Options { extrapolate: true, ..Options::default() });
    assert_warns(&done, &["without nodes", "extrapolated"]);
    let verdict = judge(&brep, &done.brep, |x| bend(x, 0.004));
    assert_eq!(verdict.folded, 0);
}

#[test]
fn nodes_without_result_are_left_out() {
    let (brep, mut field) = good();
    for u in field.displacements.iter_mut().step_by(7) {
        *u = DVec3::NAN;
    }
    let done = run(&brep, &field, &Options::default());
    assert!(done.nodes.iter().all(|n| n.displacement.is_finite() && n.deviation.is_finite()));
    let verdict = judge(&brep, &done.brep, |x| bend(x, 0.004));
    assert!(verdict.error < 1e-4, "{verdict:?}");
    field.displacements.fill(DVec3::NAN);
    let error = refusal(&brep, &field, &Options::default());
    assert_says(&error.to_string(), &["sampled.csv", "no node has a displacement"]);
}

#[test]
fn the_match_tolerance_decides_which_nodes_count() {
    let (brep, mut field) = good();
    for p in field.points.iter_mut().step_by(9) {
        *p *= 1.02;
    }
    let off = field.points.len().div_ceil(9);
    let done = run(&brep, &field, &Options::default());
    assert!(done.report.unmatched_nodes.abs_diff(off) < 8, "{} {off}", done.report.unmatched_nodes);
    assert_warns(&done, &["lie on no face", "not used"]);
    let wide = Options { match_tolerance_mm: Some(0.5), ..Options::default() };
    let done = run(&brep, &field, &wide);
    assert_eq!(done.report.unmatched_nodes, 0);
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let (brep, field) = good();
    let cases: [(&str, Options); 10] = [
        ("factor", Options { factor: f64::NAN, ..Options::default() }),
        ("factor", Options { factor: f64::INFINITY, ..Options::default() }),
        ("displacement_scale", Options { displacement_scale: f64::NAN, ..Options::default() }),
        ("tolerance", Options { tolerance_mm: f64::NAN, ..Options::default() }),
        ("tolerance", Options { tolerance_mm: -1.0, ..Options::default() }),
        ("match_tolerance", Options { match_tolerance_mm: Some(-1.0), ..Options::default() }),
        ("match_tolerance", Options { match_tolerance_mm: Some(f64::NAN), ..Options::default() }),
        ("field_unit", Options { field_unit_mm: Some(0.0), ..Options::default() }),
        ("field_unit", Options { field_unit_mm: Some(f64::NAN), ..Options::default() }),
        ("field_unit", Options { field_unit_mm: Some(-1000.0), ..Options::default() }),
    ];
    for (name, options) in cases {
        let error = refusal(&brep, &field, &options);
        assert_eq!(error.code(), 1, "{name}: {error}");
        assert_says(&error.to_string(), &[name]);
    }
}

#[test]
fn an_affine_field_of_four_nodes_needs_no_more() {
    let brep = solid("bar");
    let motion = Affine::turned_and_sheared();
    let corners = nodes(&brep, 1.0, |_| true).into_iter().take(5).collect();
    let done = run(&brep, &field(corners, |x| motion.at(x)), &Options::default());
    let verdict = judge(&brep, &done.brep, |x| motion.at(x));
    assert!(verdict.error < 2e-6, "{verdict:?}");
}
