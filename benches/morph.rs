//! Time of the core on the compressor blade, by stage, against peers measured in the same run: the
//! field against a plain line reader, the morph against one dense factorisation of a single face's
//! normal equations. Give PART.brep RESULTS.frd.gz DECK.inp.gz, or set BLADESMITH_DATA to a folder
//! with `P1/hot.brep`, `P1/P1.frd.gz` and `P1/P1.inp.gz`; a part is B-rep text, as
//! `Shape.exportBrepToString()` gives it.

use bladesmith::brep::{self, Brep};
use bladesmith::fe::{self, Field, ReadOptions};
use bladesmith::morph::space::{NormalEquations, Space};
use bladesmith::morph::{self, Options};
use bladesmith::nurbs::KnotVector;
use flate2::read::MultiGzDecoder;
use glam::{DVec2, DVec3};
use std::fs::File;
use std::hint::black_box;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::time::Instant;

const ROUNDS: usize = 7;
/// Cells of the peer's face along both directions: about as many poles as the blade's sides get.
const CELLS: usize = 40;

fn main() {
    let given: Vec<PathBuf> =
        std::env::args().skip(1).filter(|word| word != "--bench").map(Into::into).collect();
    let [part, results, deck] = match (given.as_slice(), std::env::var("BLADESMITH_DATA")) {
        ([part, results, deck], _) => [part.clone(), results.clone(), deck.clone()],
        (_, Ok(data)) => ["hot.brep", "P1.frd.gz", "P1.inp.gz"].map(|f| Path::new(&data).join("P1").join(f)),
        _ => return println!("morph: give PART.brep RESULTS.frd.gz DECK.inp.gz, or set BLADESMITH_DATA"),
    };
    let text = std::fs::read_to_string(&part).expect("B-rep text");
    let options = ReadOptions { mesh: Some(deck.clone()), step: None };
    let solid = brep::parse("part", &text).expect("a B-rep");
    let field = fe::read(&results, &options).expect("results and deck");

    let plain = best(|| lines(&results) + lines(&deck));
    let dense = best(dense_face);
    row("parse the part", best(|| brep::parse("part", &text).expect("a B-rep").shapes.len()), None);
    let read = best(|| fe::read(&results, &options).expect("results and deck").ids.len());
    row("read the field", read, Some(("plain line reader", plain)));
    let stages = stages(&solid, &field);
    for (name, seconds) in stages.iter().take(3) {
        row(name, *seconds, None);
    }
    row("whole morph", stages[3].1, Some(("one face, dense", dense)));
}

fn row(name: &str, seconds: f64, peer: Option<(&str, f64)>) {
    let ratio = peer.map_or(String::new(), |(peer, other)| {
        format!("   {:6.2} times as fast as {peer} ({:.1} ms)", other / seconds, other * 1e3)
    });
    println!("{name:<18} {:8.1} ms{ratio}", seconds * 1e3);
}

/// The shortest of some rounds, in seconds.
fn best(work: impl Fn() -> usize) -> f64 {
    let round = |_| {
        let start = Instant::now();
        black_box(work());
        start.elapsed().as_secs_f64()
    };
    (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min)
}

/// Shortest times of the stages of a morph and of all of it.
fn stages(solid: &Brep, field: &Field) -> [(&'static str, f64); 4] {
    let options = Options { factor: -1.0, ..Options::default() };
    let mut out =
        [("associate", f64::MAX), ("fit", f64::MAX), ("rebuild, measure", f64::MAX), ("", f64::MAX)];
    for _ in 0..ROUNDS {
        let start = Instant::now();
        let morphed = morph::morph(solid, field, &options, &|_, _| true).expect("a morphed solid");
        let total = start.elapsed().as_secs_f64();
        let s = &morphed.report.seconds;
        for (best, seconds) in out.iter_mut().zip([s.associate, s.fit, s.rebuild, total]) {
            best.1 = best.1.min(seconds);
        }
    }
    out
}

/// Reads every number of a file, line by line.
fn lines(path: &Path) -> usize {
    let reader = BufReader::new(MultiGzDecoder::new(File::open(path).expect("a file")));
    let words = |line: String| {
        line.split([' ', ',']).filter(|word| word.parse::<f64>().is_ok_and(f64::is_finite)).count()
    };
    reader.lines().map_while(Result::ok).map(words).sum()
}

/// Normal equations of one bicubic face, assembled as the morph does, solved by a dense Cholesky
/// factorisation.
fn dense_face() -> usize {
    let breaks: Vec<f64> = (0..=CELLS).map(|i| i as f64 / CELLS as f64).collect();
    let knots = KnotVector::clamped(3, &breaks).expect("knots");
    let space = Space { ku: knots.clone(), kv: knots };
    let mut equations = NormalEquations::new(&space);
    for k in 0..8 * CELLS * CELLS {
        let uv = DVec2::new((k as f64 * 0.754_877_666).fract(), (k as f64 * 0.569_840_291).fract());
        equations.add(&space.value(uv), 1.0, DVec3::splat(uv.x));
    }
    equations.add_ridge(1e-3);
    let mut matrix = nalgebra::DMatrix::zeros(space.poles(), space.poles());
    equations.for_each_entry(|a, b, value| matrix[(a.max(b), a.min(b))] = value);
    matrix.cholesky().expect("a positive definite matrix").l().nrows()
}
