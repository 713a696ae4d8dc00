//! Texts that are no B-rep: each gets one error with its line, never a panic or a huge allocation.

use bladesmith::Error;
use bladesmith::brep::{Topology, parse};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

const CATALOGUE: &str = include_str!("data/brep/catalogue.brep");
const THREE_SOLIDS: &str = include_str!("data/brep/three_solids.brep");

thread_local! {
    /// The largest single allocation of this thread so far.
    static LARGEST: Cell<usize> = const { Cell::new(0) };
}

struct Watch;

unsafe impl GlobalAlloc for Watch {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        LARGEST.with(|largest| largest.set(largest.get().max(layout.size())));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static WATCH: Watch = Watch;

/// More than a text of 6 kB can need.
const SANE_BYTES: usize = 1 << 18;

/// Byte ranges of all tokens.
fn tokens(text: &str) -> Vec<(usize, usize)> {
    let start = text.as_ptr() as usize;
    text.split_ascii_whitespace().map(|t| (t.as_ptr() as usize - start, t.len())).collect()
}

/// Parses; where that works, does all else that a text can lead to.
fn use_text(text: &str) -> Result<(), Error> {
    let mut brep = parse("bad.brep", text)?;
    assert_eq!(parse("again.brep", &brep.write()).as_ref(), Ok(&brep));
    brep.normalise()?;
    Topology::new(&brep)?;
    for surface in &brep.surfaces {
        let [[u, _], [v, _]] = surface.domain();
        surface.derivatives(u.max(-1.0), v.max(-1.0));
    }
    brep.curves.iter().for_each(|c| {
        c.derivatives(c.domain()[0].max(-1.0));
    });
    Ok(())
}

fn assert_sane_allocations() {
    let largest = LARGEST.get();
    assert!(largest < SANE_BYTES, "one allocation of {largest} bytes");
}

fn assert_refused(text: &str, what: &str) {
    let lines = text.lines().count().max(1) + 1;
    match parse("bad.brep", text) {
        Err(Error::Brep { name, line, why }) => {
            assert_eq!(name, "bad.brep");
            assert!((1..=lines).contains(&line), "{what}: line {line} of {lines}");
            assert!(!why.is_empty());
        }
        other => panic!("{what}: {other:?}"),
    }
}

#[test]
fn a_text_cut_before_any_token_is_refused() {
    for text in [CATALOGUE, THREE_SOLIDS] {
        for (start, _) in tokens(text) {
            assert_refused(&text[..start], &format!("cut at byte {start}"));
        }
    }
    assert_sane_allocations();
}

#[test]
fn a_wrong_token_anywhere_is_no_disaster() {
    let wrong = ["-1", "0", "7", "2147483647", "99999999999999999999", "nan", "1e400", "x", "*"];
    for (start, length) in tokens(CATALOGUE).into_iter().filter(|t| t.0 > 45) {
        for word in wrong {
            let text = format!("{}{word}{}", &CATALOGUE[..start], &CATALOGUE[start + length..]);
            if let Err(error) = use_text(&text) {
                let known = matches!(error, Error::Brep { .. } | Error::Solid { .. } | Error::Face { .. });
                assert!(known, "'{word}' at byte {start}: {error}");
            }
        }
    }
    assert_sane_allocations();
}

#[test]
fn what_is_no_text_of_a_brep_is_refused() {
    for text in ["", "\n\n", "ISO-10303-21;\nHEADER;", "CASCADE Topology V9, (c) Someone\n", "\0\0\0"] {
        assert_refused(text, text);
    }
}

/// Replaces the first occurrence, which must be there.
fn edited(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from:?} does not occur");
    text.replacen(from, to, 1)
}

#[test]
fn errors_name_the_line_and_the_reason() {
    let line_of = |text: &str, part: &str| text[..text.find(part).unwrap()].matches('\n').count() + 1;
    let cases = [
        ("Curve2ds 13", "Curve2ds 14", "Curves 15", "a kind of curve"),
        ("Curve2ds 13", "Curve2ds 99999999", "Curve2ds", "possible number of Curve2ds"),
        ("Curves 15", "Curves -3", "Curves", "-3 is no possible number"),
        ("Surfaces 24", "Surfaces many", "Surfaces", "expected an integer for Surfaces, found 'many'"),
        ("1 1 2 3 0.36", "1 nan 2 3 0.36", "1 nan 2", "finite number for a coordinate, found 'nan'"),
        ("1 1 2 3 0.36 0.48 0.8", "1 1 2 3 0 0 0", "1 1 2 3 0 0 0", "null vector"),
        ("2 1 2 3 0 0.6 0.8 1 0 0", "2 1 2 3 0 0.6 0.8 0 0.6 0.8", "2 1 2 3 0 0.6", "null or parallel"),
        ("-0.6 2.5", "-0.6 -2.5", "-0.6 -2.5", "a radius is -2.5"),
        (" 0 4 0.5 1 0.75 1 2 4", " 0 4 0.75 1 0.5 1 2 4", " 0 4 0.75 1 0.5", "knots do not increase"),
        (" 0 4 0.5 1 0.75 1 2 4", " 0 4 0.5 1 0.75 9 2 4", " 0 4 0.5 1 0.75 9", "multiplicity 9"),
        ("0.70710678118654757", "-0.5", "7 1 0  2 3 2", "weight 2 is -0.5"),
        ("Ve\n1e-07", "Ve\n-1e-07", "-1e-07", "a tolerance is -0.0000001"),
        ("Ve\n1e-07", "Vertex\n1e-07", "Vertex", "found 'Vertex'"),
        ("0101101", "010110", "010110\n", "seven flags"),
        ("1  2 2 0 1", "1  77 2 0 1", "1  77", "curve 77 does not exist: there are 15"),
        ("1  2 2 0 1", "1  2 6 0 1", "1  2 6 0 1", "a location is 6"),
        ("4 C1 1 0", "4 C9 1 0", "4 C9", "expected a continuity"),
        ("2  1 2 0", "2  9 2 0", "2  9 2 0", "a location is 9"),
    ];
    for (from, to, at, reason) in cases {
        let text = edited(CATALOGUE, from, to);
        match parse("bad.brep", &text) {
            Err(Error::Brep { line, why, .. }) => {
                assert!(why.contains(reason), "{to}: {why}");
                assert_eq!(line, line_of(&text, at), "{to}: {why}");
            }
            other => panic!("{to}: {other:?}"),
        }
    }
}

/// A text of compounds, each of which uses the one before in the given way.
fn nested(locations: &str, depth: usize, uses: &str) -> String {
    let mut text = format!(
        "CASCADE Topology V1, (c) Matra-Datavision\n{locations}\nCurve2ds 0\nCurves 0\nPolygon3D 0\n\
         PolygonOnTriangulations 0\nSurfaces 0\nTriangulations 0\n\nTShapes {depth}\nVe\n1e-07\n0 0 0\n0 0\n\
         \n0101101\n*\n"
    );
    for shape in (1..depth).rev() {
        text += &format!("Co\n\n1100000\n{}*\n", uses.replace('#', &(shape + 1).to_string()));
    }
    text + "\n+1 0 \n"
}

#[test]
fn endless_nesting_is_refused() {
    assert!(use_text(&nested("Locations 0", 400, "+# 0 ")).is_ok());
    assert_refused(&nested("Locations 0", 100_000, "+# 0 "), "nested compounds");
    let trimmed = edited(CATALOGUE, "8 0.25 1.5\n", &"8 0 1\n".repeat(100_000));
    assert_refused(&trimmed, "nested curves");
}

#[test]
fn shapes_used_twice_at_each_level_are_visited_once() {
    use_text(&nested("Locations 0", 100, "+# 0 +# 0 ")).unwrap();
}

#[test]
fn products_of_locations_that_explode_are_refused() {
    let matrix = "1\n1 0 0 1\n0 1 0 0\n0 0 1 0\n";
    let mut locations = format!("Locations 60\n{matrix}{matrix}2 1 1 2 1 0\n");
    for i in 4..=60 {
        locations += &format!("2 {} 2 0\n", i - 1);
    }
    let error = use_text(&nested(&locations, 2, "+# 60 ")).unwrap_err();
    assert!(matches!(&error, Error::Solid { why } if why.contains("location")), "{error}");
}

#[test]
fn powers_of_a_location_are_cheap() {
    let locations = "Locations 2\n1\n1 0 0 1\n0 1 0 0\n0 0 1 0\n2 1 2147483647 0\n";
    use_text(&nested(locations, 3, "+# 2 ")).unwrap();
}
