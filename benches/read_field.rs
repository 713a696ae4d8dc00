//! Time to read a field with its deck, against a plain reader that goes line by line through
//! `str::parse`. Give the two files; without them, or `BLADESMITH_DATA`, it says what it needs.

use bladesmith::fe::{self, ReadOptions};
use flate2::read::MultiGzDecoder;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::time::Instant;

const ROUNDS: usize = 15;

fn main() {
    let given: Vec<PathBuf> =
        std::env::args().skip(1).filter(|word| word != "--bench").map(Into::into).collect();
    let (results, deck) = match (given.as_slice(), std::env::var("BLADESMITH_DATA")) {
        ([results, deck], _) => (results.clone(), deck.clone()),
        (_, Ok(data)) => (Path::new(&data).join("P1/P1.frd.gz"), Path::new(&data).join("P1/P1.inp.gz")),
        _ => return println!("read_field: give RESULTS.frd.gz DECK.inp.gz, or set BLADESMITH_DATA"),
    };
    let options = ReadOptions { mesh: Some(deck.clone()), step: None };
    let both = best(|| fe::read(&results, &options).expect("results and deck").ids.len());
    let alone = best(|| fe::read(&results, &ReadOptions::default()).expect("results").ids.len());
    let plain = best(|| plain_results(&results) + plain_deck(&deck));
    println!(
        "results and deck   {:7.1} ms   {:5.1} times as fast as the plain reader",
        both * 1e3,
        plain / both
    );
    println!("results alone      {:7.1} ms", alone * 1e3);
    println!("plain line reader  {:7.1} ms", plain * 1e3);
}

/// The shortest of some rounds, in seconds.
fn best(work: impl Fn() -> usize) -> f64 {
    let round = |_| {
        let start = Instant::now();
        std::hint::black_box(work());
        start.elapsed().as_secs_f64()
    };
    (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min)
}

fn lines(path: &Path) -> impl Iterator<Item = String> {
    BufReader::new(MultiGzDecoder::new(File::open(path).expect("a file"))).lines().map_while(Result::ok)
}

fn plain_results(path: &Path) -> usize {
    let mut values: Vec<[f64; 3]> = Vec::new();
    let mut nodes: Vec<usize> = Vec::new();
    for line in lines(path) {
        if line.starts_with(" -1") && line.len() == 49 {
            values.push([13, 25, 37].map(|first| line[first..first + 12].trim().parse().unwrap_or(f64::NAN)));
        } else if let Some(row) = line.strip_prefix(" -2") {
            nodes.extend(row.split_whitespace().filter_map(|word| word.parse::<usize>().ok()));
        }
    }
    values.len() + nodes.len()
}

fn plain_deck(path: &Path) -> usize {
    let numbers = |line: String| line.split(',').filter_map(|word| word.trim().parse::<f64>().ok()).count();
    lines(path).filter(|line| !line.starts_with('*')).map(numbers).sum()
}
