//! The twisted bar and the half ball: every row of the list of awkward inputs.

use crate::p5::{folder, original, variant};
use crate::solids::{hot, part};
use crate::{assert_says, assert_warns, refusal, run};
use bladesmith::brep::Brep;
use bladesmith::fe::{self, Field, ReadOptions};
use bladesmith::morph::hot::Hot;
use bladesmith::morph::{Morphed, Options};
use bladesmith::ops::closest::foot;
use glam::{DVec2, DVec3};
use std::path::Path;

/// A field with the full-precision coordinates of its deck.
fn precise(name: &str) -> Field {
    let mesh = Some(folder().join(format!("{name}.inp.gz")));
    let path = folder().join(format!("{name}.frd.gz"));
    fe::read(&path, &ReadOptions { mesh, step: None }).unwrap_or_else(|error| panic!("{error}"))
}

/// A variant of the base's results, read from a file.
fn read_step(name: &str, step: Option<usize>) -> Field {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("morph");
    std::fs::create_dir_all(&folder).expect("a folder for test files");
    let path = folder.join(format!("{name}-{}.frd", step.unwrap_or(0)));
    std::fs::write(&path, variant(name)).expect("room for the file");
    fe::read(&path, &ReadOptions { mesh: None, step }).unwrap_or_else(|error| panic!("{error}"))
}

fn read(name: &str) -> Field {
    read_step(name, None)
}

/// A point between the nodes with its displacement and its face (from 0).
struct Probe {
    point: DVec3,
    displacement: DVec3,
    face: usize,
}

fn probes(name: &str) -> Vec<Probe> {
    let parse = |line: &str| {
        let n: Vec<f64> = line.split(',').map(|n| n.trim().parse().expect("a number")).collect();
        Probe {
            point: DVec3::new(n[0], n[1], n[2]),
            displacement: DVec3::new(n[3], n[4], n[5]),
            face: n[6] as usize - 1,
        }
    };
    original(&format!("truth/{name}.csv")).lines().skip(1).map(parse).collect()
}

/// Parameters of the point of a face nearest to `p`.
fn nearest(hot: &Hot, face: usize, p: DVec3) -> DVec2 {
    let (f, surface) = (&hot.faces[face], &hot.patches[hot.faces[face].patch].hot);
    let (low, size) = (f.trim.low(), f.trim.high() - f.trim.low());
    let starts = (0..900).map(|k| low + size * DVec2::new(f64::from(k / 30), f64::from(k % 30)) / 29.0);
    let far = |uv: &DVec2| (surface.point(uv.x, uv.y) - p).length();
    let start = starts.min_by(|a, b| far(a).total_cmp(&far(b))).expect("starts");
    let found = foot(surface, p, start);
    assert!(found.distance < 2e-5, "a probe lies {} off face {}", found.distance, face + 1);
    found.uv
}

/// Mean and largest distance of the probes' images from where the truth has them, mm.
fn missed(name: &str, before: &Brep, after: &Brep, factor: f64) -> (f64, f64) {
    let (old, new) = (hot(before), hot(after));
    let probes = probes(name);
    let miss = |p: &Probe| {
        let uv = nearest(&old, p.face, p.point);
        let start = old.patches[old.faces[p.face].patch].hot.point(uv.x, uv.y);
        let moved = after.surfaces[new.topology.faces[p.face].surface].point(uv.x, uv.y);
        (moved - start - factor * p.displacement).length()
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

#[test]
fn probes_of_base_sphere_and_coarse_are_reproduced() {
    for name in ["base", "sphere", "coarse"] {
        let brep = solid(if name == "coarse" { "base" } else { name });
        let done = run(&brep, &precise(name), &Options { factor: -1.0, holdout: true, ..Options::default() });
        let (mean, max) = missed(name, &brep, &done.brep, -1.0);
        println!(
            "{name}: probes {mean:e} {max:e} dev {:?} hold {:?} folded {} {:#?}",
            done.report.deviation_mm, done.report.holdout_mm, done.report.solid.folded, done.report.warnings
        );
        println!("{:?}", done.report.edges.iter().map(|e| (e.gap_mm.after, e.held)).collect::<Vec<_>>());
    }
}

#[test]
fn variants_with_the_same_field_give_the_same_solid() {
    let (_, base) = base();
    for name in ["crlf", "gaps_shuffled", "two_steps", "no_elements"] {
        let brep = solid("base");
        let done = run(&brep, &read(name), &Options::default());
        println!("{name} {:e} {:?}", apart(&base.brep, &done.brep), done.report.warnings);
    }
}
