//! The C interface called from within: its symbols and so-name, texts, points, and damaged parts.
//! C and C++ programs are in `package.rs`.

use bladesmith::brep;
use bladesmith::ffi::{Part, field, library, part};
use proptest::prelude::*;
use serde_json::Value;
use std::collections::BTreeSet;
use std::ffi::{CStr, c_char};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::null_mut;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A file of the test data.
fn data(name: &str) -> PathBuf {
    root().join("tests/consumer/data").join(name)
}

/// What a tool says of the shared library, which cargo puts beside the running test.
fn said_of_the_library(tool: &str, options: &[&str]) -> String {
    let test = std::env::current_exe().expect("a test knows its path");
    let library = test.with_file_name("libbladesmith.so");
    let output = Command::new(tool).args(options).arg(library).output();
    let output = output.unwrap_or_else(|error| panic!("{tool} is needed for this test: {error}"));
    assert!(output.status.success(), "{tool}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn the_shared_library_exports_the_functions_of_the_header() {
    let header = fs::read_to_string(root().join("include/bladesmith/bladesmith.h")).expect("it is committed");
    let declared: BTreeSet<String> = header
        .lines()
        .filter(|line| !line.trim_start().starts_with(['*', '/', '#']) && !line.starts_with("typedef"))
        .filter_map(|line| line.split_once('(')?.0.rsplit([' ', '*']).next())
        .filter(|name| name.starts_with("bladesmith_"))
        .map(str::to_owned)
        .collect();
    let exported: BTreeSet<String> = said_of_the_library("nm", &["-D", "--defined-only"])
        .lines()
        .filter_map(|line| line.split_whitespace().last())
        .filter(|name| name.starts_with("bladesmith_"))
        .map(str::to_owned)
        .collect();
    assert_eq!(declared, exported);
    assert!(declared.len() > 15, "{declared:?}");
}

#[test]
fn the_so_name_carries_the_abi_number() {
    let expected = format!("[libbladesmith.so.{}]", library::BLADESMITH_ABI_VERSION);
    let said = said_of_the_library("readelf", &["-d"]);
    assert!(said.lines().any(|line| line.contains("SONAME") && line.contains(&expected)), "{said}");
}

/// The text that a call gives, asked for first and then fetched.
fn text_of(call: impl Fn(*mut c_char, usize, *mut usize) -> i32) -> String {
    let mut length = 0;
    assert_eq!(call(null_mut(), 0, &mut length), 0, "{}", last_error());
    let mut buffer = vec![0u8; length + 1];
    assert_eq!(call(buffer.as_mut_ptr().cast(), buffer.len(), &mut length), 0, "{}", last_error());
    assert_eq!(buffer.pop(), Some(0));
    String::from_utf8(buffer).expect("texts are UTF-8")
}

fn last_error() -> String {
    // SAFETY: the text is copied before this thread makes another call.
    unsafe { CStr::from_ptr(library::bladesmith_last_error()) }.to_string_lossy().into_owned()
}

/// The bar as a handle.
struct Bar(*mut Part);

impl Bar {
    fn read() -> Self {
        let text = fs::read(data("bar.brep")).expect("it is committed");
        Self::parse(&text).unwrap_or_else(|status| panic!("status {status}: {}", last_error()))
    }

    /// The part of a text, or the status.
    fn parse(text: &[u8]) -> Result<Self, i32> {
        let mut handle = null_mut();
        // SAFETY: the text is as long as announced, and there is room for the handle.
        let status = unsafe {
            part::bladesmith_part_read(text.as_ptr().cast(), text.len(), c"bar".as_ptr(), &mut handle)
        };
        if status == 0 { Ok(Self(handle)) } else { Err(status) }
    }

    fn evaluate(&self, face: u32, uv: &[f64], order: u32) -> Vec<f64> {
        let mut out = vec![f64::NAN; uv.len() / 2 * [3, 9, 18][order as usize]];
        // SAFETY: the arrays have the lengths that the header asks for.
        let status = unsafe {
            part::bladesmith_part_evaluate(self.0, face, uv.as_ptr(), uv.len() / 2, order, out.as_mut_ptr())
        };
        assert_eq!(status, 0, "{}", last_error());
        out
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        // SAFETY: the handle is this one's and not used any more.
        unsafe { part::bladesmith_part_free(self.0) };
    }
}

#[test]
fn part_info_tells_solids_faces_and_size() {
    let bar = Bar::read();
    // SAFETY: `text_of` gives room as announced.
    let json = text_of(|text, capacity, length| unsafe {
        part::bladesmith_part_info(bar.0, text, capacity, length)
    });
    let info: Value = serde_json::from_str(&json).expect("it is JSON");
    assert_eq!(info["solids"].as_array().map(Vec::len), Some(1));
    assert_eq!(info["solids"][0]["closed"], true);
    assert_eq!(info["solids"][0]["faces"], serde_json::json!([1, 2, 3, 4, 5, 6, 7]));
    let count = |kind: &str| {
        let faces = info["faces"].as_array().expect("a list of faces");
        faces.iter().filter(|face| face["surface"] == kind && face["poles"].is_null()).count()
    };
    assert_eq!((count("plane"), count("cylinder")), (6, 1), "{info:#}");
    assert_eq!((info["edges"].as_u64(), info["vertices"].as_u64()), (Some(15), Some(10)));
    for (corner, expected) in [(0, [-10.0, -4.0, 0.0]), (1, [10.0, 4.0, 40.0])] {
        for axis in 0..3 {
            let value = info["bounding_box_mm"][corner][axis].as_f64().expect("a number");
            assert!((value - expected[axis]).abs() < 1e-9, "corner {corner}, axis {axis}: {value}");
        }
    }
}

#[test]
fn a_part_writes_what_reads_as_the_same_part() {
    let bar = Bar::read();
    // SAFETY: `text_of` gives room as announced.
    let text = text_of(|text, capacity, length| unsafe {
        part::bladesmith_part_write(bar.0, text, capacity, length)
    });
    let original = fs::read_to_string(data("bar.brep")).expect("it is committed");
    assert_eq!(brep::parse("written", &text), brep::parse("bar.brep", &original));
}

#[test]
fn derivatives_of_the_hole_are_those_of_a_cylinder() {
    let bar = Bar::read();
    let (u, v) = (0.7, 1.5);
    let is_hole = |face: &u32| {
        let d = bar.evaluate(*face, &[u, v], 2);
        (9..12).any(|k| d[k] != 0.0)
    };
    let hole = (1..=7).find(is_hole).expect("one face is curved");
    let d = bar.evaluate(hole, &[0.0, 0.0, u, v], 2).split_off(18);
    let vector = |k: usize| [d[3 * k], d[3 * k + 1], d[3 * k + 2]];
    let (s, su, sv, suu) = (vector(0), vector(1), vector(2), vector(3));
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}: {d:?}");
    close((s[0] - 2.0).hypot(s[2] - 22.0), 3.0);
    close(su[0].hypot(su[2]), 3.0);
    close(sv[1].abs(), 1.0);
    for axis in 0..3 {
        close(suu[axis], [2.0, s[1], 22.0][axis] - s[axis]);
        close(vector(4)[axis], 0.0);
        close(vector(5)[axis], 0.0);
    }
    assert_eq!(bar.evaluate(hole, &[u, v], 0), d[..3]);
    assert_eq!(bar.evaluate(hole, &[u, v], 1), d[..9]);
}

#[test]
fn field_info_tells_nodes_and_largest_displacement() {
    let path = std::ffi::CString::new(data("bar.frd.gz").to_str().expect("a plain path")).expect("no NUL");
    let mut handle = null_mut();
    // SAFETY: texts end with NUL, and there is room for the handle.
    let status = unsafe { field::bladesmith_field_read(path.as_ptr(), std::ptr::null(), 0, &mut handle) };
    assert_eq!(status, 0, "{}", last_error());
    // SAFETY: `text_of` gives room as announced.
    let json = text_of(|text, capacity, length| unsafe {
        field::bladesmith_field_info(handle, text, capacity, length)
    });
    let info: Value = serde_json::from_str(&json).expect("it is JSON");
    assert_eq!(info["nodes"], 669, "{info:#}");
    // SAFETY: the handle is not used any more.
    unsafe { field::bladesmith_field_free(handle) };
}

/// One damage to a text: a number or word replaced, a line lost, or the end cut off.
fn damaged(text: &str, kind: usize, at: usize, with: &str) -> String {
    if kind == 0 {
        return text.chars().take(at % text.len()).collect();
    }
    let lines: Vec<&str> = text.lines().collect();
    let hit = at % lines.len();
    let changed = lines.iter().enumerate().filter(|(i, _)| kind != 1 || *i != hit).map(|(i, line)| {
        let mut words: Vec<&str> = line.split(' ').collect();
        if kind == 2 && i == hit {
            let word = at / lines.len() % words.len();
            words[word] = with;
        }
        words.join(" ")
    });
    changed.collect::<Vec<_>>().join("\n")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_parts_are_refused_or_described_but_never_a_fault_of_ours(
        kind in 0usize..3,
        at in any::<usize>(),
        with in prop::sample::select(vec!["0", "-1", "3", "99", "1e300", "nan", "-0", "x", "4294967296", ""]),
    ) {
        let original = fs::read_to_string(data("bar.brep")).expect("it is committed");
        let text = damaged(&original, kind, at, with);
        let mut length = 0;
        let status = match Bar::parse(text.as_bytes()) {
            Err(status) => status,
            // SAFETY: only the length is asked for.
            Ok(bar) => unsafe { part::bladesmith_part_info(bar.0, null_mut(), 0, &mut length) },
        };
        prop_assert!(status == 0 || (100..300).contains(&status), "status {}: {}", status, last_error());
    }
}
