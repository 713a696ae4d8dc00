//! Sections of a wavy sheet of 60 × 40 poles by planes and by a second sheet, one thread.

use bladesmith::nurbs::{KnotVector, NurbsSurface};
use bladesmith::ops::section::{self, Section};
use glam::DVec3;
use std::time::Instant;

const ROUNDS: usize = 7;

fn main() {
    let sheet = surface(60, 40, 0.0);
    println!("{:<28} {:>10} {:>9} {:>9} {:>11}", "", "ms", "branches", "length", "deviation");
    for tolerance in [1e-3, 1e-6] {
        for (name, origin, normal) in [
            ("plane across", DVec3::new(52.3, 0.0, 0.0), DVec3::new(1.0, 0.1, 0.0)),
            ("plane through the waves", DVec3::new(50.0, 30.0, 0.3), DVec3::new(0.01, 0.02, 1.0)),
        ] {
            row(name, tolerance, || {
                section::with_plane(&sheet, origin, normal, tolerance).expect("a section")
            });
        }
        let other = surface(20, 20, 1.3);
        row("sheet of 20 × 20 poles", tolerance, || {
            section::with_surface(&sheet, &other, tolerance).expect("a section")
        });
    }
}

fn row(name: &str, tolerance: f64, work: impl Fn() -> Section) {
    let mut shortest = f64::MAX;
    let mut found = None;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        found = Some(work());
        shortest = shortest.min(start.elapsed().as_secs_f64() * 1e3);
    }
    let found = found.expect("at least one round");
    let length: f64 = found.branches.iter().map(|b| b.curve.length(1e-6).expect("a length")).sum();
    let deviation = found.branches.iter().map(|b| b.deviation_mm).fold(0.0, f64::max);
    let name = format!("{name}, {tolerance:e}");
    println!("{name:<28} {shortest:>10.3} {:>9} {length:>9.3} {deviation:>11.2e}", found.branches.len());
    assert!(found.uncertain.is_empty(), "undecided at {:?}", found.uncertain);
}

/// A sheet of 100 mm × 60 mm with waves of 3 mm.
fn surface(n: usize, m: usize, phase: f64) -> NurbsSurface {
    let knots = |poles: usize| {
        let spans = poles - 3;
        KnotVector::clamped(3, &(0..=spans).map(|i| i as f64 / spans as f64).collect::<Vec<_>>())
            .expect("knots")
    };
    let (ku, kv) = (knots(n), knots(m));
    let pole = |u: f64, v: f64| {
        let wave = (9.0 * u + phase).sin() * (6.0 * v + 0.5 - phase).cos();
        DVec3::new(100.0 * u, 60.0 * v, 3.0 * wave + phase * u)
    };
    let (gu, gv) = (ku.greville(), kv.greville());
    let poles = gu.iter().flat_map(|&u| gv.iter().map(move |&v| pole(u, v))).collect();
    NurbsSurface::new(ku, kv, poles, None).expect("a surface")
}
