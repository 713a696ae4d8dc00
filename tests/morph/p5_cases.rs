//! The twisted bar and the half ball: every row of the list of awkward inputs.

use crate::judge::judge;
use crate::p5::{VARIANTS, folder, original, variant};
use crate::solids::{hot, part};
use crate::{assert_says, assert_warns, refusal, run};
use bladesmith::brep::Brep;
use bladesmith::fe::{self, Field, ReadOptions};
use bladesmith::morph::hot::Hot;
use bladesmith::morph::{Morphed, Options, morph};
use bladesmith::ops::closest::foot;
use glam::{DVec2, DVec3};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A field with the full-precision coordinates of its deck.
fn precise(name: &str) -> Field {
    let mesh = Some(folder().join(format!("{name}.inp.gz")));
    let path = folder().join(format!("{name}.frd.gz"));
    fe::read(&path, &ReadOptions { mesh, step: None }).unwrap_or_else(|error| panic!("{error}"))
}

/// A variant of the base's results, read from a file.
fn try_read(name: &str, step: Option<usize>) -> bladesmith::Result<Field> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("morph");
    std::fs::create_dir_all(&folder).expect("a folder for test files");
    static WRITTEN: AtomicUsize = AtomicUsize::new(0);
    let path = folder.join(format!("{name}-{}.frd", WRITTEN.fetch_add(1, Ordering::Relaxed)));
    std::fs::write(&path, variant(name)).expect("room for the file");
    fe::read(&path, &ReadOptions { mesh: None, step })
}

fn read_step(name: &str, step: Option<usize>) -> Field {
    try_read(name, step).unwrap_or_else(|error| panic!("{error}"))
}

fn read(name: &str) -> Field {
    read_step(name, None)
}

/// Points between the nodes, with their displacements.
fn probes(name: &str) -> Vec<[DVec3; 2]> {
    let parse = |line: &str| {
        let n: Vec<f64> = line.split(',').map(|n| n.trim().parse().expect("a number")).collect();
        [DVec3::new(n[0], n[1], n[2]), DVec3::new(n[3], n[4], n[5])]
    };
    original(&format!("truth/{name}.csv")).lines().skip(1).map(parse).collect()
}

/// Distance of probes between the nodes from curved faces, mm: the sag of a straight element side.
const SAG_MM: f64 = 5e-3;

/// The face nearest to `p` and the parameters of the foot.
fn nearest(hot: &Hot, p: DVec3) -> (usize, DVec2) {
    let on_face = |face: usize| {
        let (f, surface) = (&hot.faces[face], &hot.patches[hot.faces[face].patch].hot);
        let (low, size) = (f.trim.low(), f.trim.high() - f.trim.low());
        let starts =
            (0..900).map(|k| low + size * (DVec2::new(f64::from(k / 30), f64::from(k % 30)) + 0.5) / 30.0);
        let far = |uv: &DVec2| (surface.point(uv.x, uv.y) - p).length();
        let start = starts.min_by(|a, b| far(a).total_cmp(&far(b))).expect("starts");
        (face, foot(surface, p, start))
    };
    let feet = (0..hot.faces.len()).map(on_face);
    let (face, foot) = feet.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance)).expect("faces");
    assert!(foot.distance < SAG_MM, "a probe lies {} off the part", foot.distance);
    (face, foot.uv)
}

/// Mean and largest distance of the probes' images from where the truth has them, mm.
fn missed(name: &str, before: &Brep, after: &Brep, factor: f64) -> (f64, f64) {
    let (old, new) = (hot(before), hot(after));
    let probes = probes(name);
    let miss = |[point, displacement]: &[DVec3; 2]| {
        let (face, uv) = nearest(&old, *point);
        let start = old.patches[old.faces[face].patch].hot.point(uv.x, uv.y);
        let moved = after.surfaces[new.topology.faces[face].surface].point(uv.x, uv.y);
        (moved - start - factor * *displacement).length()
    };
    let all: Vec<f64> = probes.iter().map(miss).collect();
    (all.iter().sum::<f64>() / all.len() as f64, all.iter().copied().fold(0.0, f64::max))
}

fn base() -> (Brep, Morphed) {
    let brep = solid("base");
    let done = run(&brep, &precise("base"), &Options::default());
    (brep, done)
}

fn solid(name: &str) -> Brep {
    crate::solids::solid(name)
}

/// Largest distance between two outputs of one input, on faces and vertices.
fn apart(a: &Brep, b: &Brep) -> f64 {
    let (x, y) = (hot(a), hot(b));
    let mut worst = 0.0f64;
    for face in 0..x.faces.len() {
        let (s, t) = (x.topology.faces[face].surface, y.topology.faces[face].surface);
        for uv in crate::solids::inside(&x, face, 15) {
            worst = worst.max((a.surfaces[s].point(uv.x, uv.y) - b.surfaces[t].point(uv.x, uv.y)).length());
        }
    }
    let ends = x.topology.vertices.iter().zip(&y.topology.vertices);
    ends.map(|(v, w)| (v.point - w.point).length()).fold(worst, f64::max)
}

/// Displacements go up to 0.25 mm, and are singular around the clamped foot: the largest error is there.
#[test]
fn probes_of_base_sphere_and_coarse_are_reproduced() {
    for (name, mean_mm, max_mm) in [("base", 3e-5, 1e-3), ("sphere", 3e-5, 5e-4), ("coarse", 2e-4, 3e-3)] {
        let brep = solid(if name == "coarse" { "base" } else { name });
        let done = run(&brep, &precise(name), &Options { factor: -1.0, ..Options::default() });
        let (mean, max) = missed(name, &brep, &done.brep, -1.0);
        assert!(
            mean <= mean_mm && max <= max_mm,
            "{name}: probes missed by {mean} in the mean, {max} at most"
        );
        let verdict = judge(&brep, &done.brep, |_| DVec3::ZERO);
        let widest = done.report.edges.iter().map(|e| e.gap_mm.after).fold(verdict.gap, f64::max);
        assert!(widest < verdict.gap_before + 5e-5, "{name}: an edge gapes by {widest}");
        assert_eq!(done.report.solid.folded, 0, "{name}");
        assert!(verdict.beyond_tolerance <= 0.0, "{name}: {verdict:?}");
        assert_warns(&done, &["first-order estimate"]);
    }
}

/// What becomes of each variant without any option.
#[test]
fn every_variant_is_used_or_refused_as_listed() {
    let brep = solid("base");
    for name in VARIANTS {
        let outcome = match try_read(name, None) {
            Err(_) => "unreadable",
            Ok(field) => match morph(&brep, &field, &Options::default(), &|_, _| true) {
                Err(_) => "refused",
                Ok(_) => "morphed",
            },
        };
        let expected = match name {
            "empty" | "nan" | "no_disp" | "not_frd" | "truncated" => "unreadable",
            "huge_disp" | "metres" | "mirrored" | "other_frame" | "partial_disp" | "partial_face" => {
                "refused"
            }
            _ => "morphed",
        };
        assert_eq!(outcome, expected, "{name}");
    }
}

/// Rounding of six digits at 40 mm, through the fit.
const SIX_DIGITS_MM: f64 = 1e-4;

#[test]
fn variants_with_the_same_field_give_the_same_solid() {
    let (brep, base) = base();
    for name in ["crlf", "gaps_shuffled", "two_steps", "no_elements"] {
        let done = run(&brep, &read(name), &Options::default());
        let apart = apart(&base.brep, &done.brep);
        assert!(apart < SIX_DIGITS_MM, "{name}: {apart} from the base");
    }
    let crlf = run(&brep, &read("crlf"), &Options::default());
    let shuffled = run(&brep, &read("gaps_shuffled"), &Options::default());
    assert!(apart(&crlf.brep, &shuffled.brep) < 1e-9, "the order of the nodes counts");
    assert_warns(&shuffled, &["no elements"]);
    let metres = Options { field_unit_mm: Some(1000.0), ..Options::default() };
    assert!(apart(&base.brep, &run(&brep, &read("metres"), &metres).brep) < SIX_DIGITS_MM);
    let alone = Options { displacement_scale: 1000.0, ..Options::default() };
    assert!(apart(&base.brep, &run(&brep, &read("disp_metres_only"), &alone).brep) < SIX_DIGITS_MM);
}

#[test]
fn a_step_can_be_chosen() {
    let (brep, _) = base();
    let half = run(&brep, &read_step("two_steps", Some(1)), &Options::default());
    let twice = Options { displacement_scale: 0.5, ..Options::default() };
    let full = run(&brep, &read_step("two_steps", Some(2)), &twice);
    assert!(apart(&half.brep, &full.brep) < SIX_DIGITS_MM);
    assert_eq!((half.report.input.step, full.report.input.step), (1, 2));
    assert_warns(&run(&brep, &read("two_steps"), &Options::default()), &["2 steps", "the last"]);
}

#[test]
fn models_elsewhere_or_in_another_unit_are_refused() {
    let brep = solid("base");
    for name in ["mirrored", "other_frame"] {
        let error = refusal(&brep, &read(name), &Options::default());
        assert_eq!(error.code(), 160, "{name}: {error}");
        assert_says(&error.to_string(), &[name, "does not lie on", "mirrored"]);
    }
    assert_says(&refusal(&brep, &read("metres"), &Options::default()).to_string(), &["--field-unit m"]);
    assert_says(
        &refusal(&brep, &read("huge_disp"), &Options::default()).to_string(),
        &["largest displacement", "folded"],
    );
}

#[test]
fn fields_of_odd_size_are_used_with_a_warning() {
    let brep = solid("base");
    let zero = run(&brep, &read("zero_disp"), &Options::default());
    assert_warns(&zero, &["displacements are zero"]);
    assert!(judge(&brep, &zero.brep, |_| DVec3::ZERO).error < 1e-6);
    let metres = run(&brep, &read("disp_metres_only"), &Options::default());
    assert_warns(&metres, &["--displacement-scale 1000"]);
    assert_warns(&run(&brep, &read("duplicate_nodes"), &Options::default()), &["3", "50", "300"]);
}

#[test]
fn parts_of_the_field_are_extended_only_on_demand() {
    let brep = solid("base");
    for name in ["partial_face", "partial_disp"] {
        let field = read(name);
        let error = refusal(&brep, &field, &Options::default());
        assert_eq!(error.code(), 160, "{name}: {error}");
        assert_says(&error.to_string(), &["without nodes", "mm²", "--extrapolate"]);
        let done = run(&brep, &field, &Options { extrapolate: true, ..Options::default() });
        assert_warns(&done, &["extrapolated"]);
        assert_eq!(done.report.solid.folded, 0, "{name}");
        let (mean, _) = missed("base", &brep, &done.brep, 1.0);
        // Nothing in place of what is missing would be off by half the displacement, 0.1 mm.
        assert!(mean < 0.02, "{name}: probes are off by {mean} in the mean");
    }
}

#[test]
fn of_two_solids_the_covered_one_is_morphed() {
    let (_, base) = base();
    let part = part("two_solids");
    let done = run(&part, &precise("base"), &Options::default());
    assert_warns(&done, &["2 solids", "only solid"]);
    assert_eq!((done.report.solid.faces, done.report.faces.len()), (6, 6));
    let apart = apart(&base.brep, &done.brep);
    assert!(apart < 1e-7, "{apart}");
    let chosen = run(&part, &precise("base"), &Options { solid: Some(1), ..Options::default() });
    assert_warns(&chosen, &["2 solids", "as asked"]);
    let error = refusal(&part, &precise("base"), &Options { solid: Some(2), ..Options::default() });
    assert_says(&error.to_string(), &["does not lie on"]);
    let error = refusal(&part, &precise("base"), &Options { solid: Some(3), ..Options::default() });
    assert_says(&error.to_string(), &["no solid 3", "has 2"]);
}

#[test]
fn a_coarse_mesh_is_told_with_its_empty_spans() {
    let brep = solid("base");
    let done = run(&brep, &precise("coarse"), &Options::default());
    assert_warns(&done, &["empty knot spans"]);
    let filled: usize = done.report.faces.iter().map(|f| f.spans_filled).sum();
    assert!(filled > 500, "{filled}");
}
