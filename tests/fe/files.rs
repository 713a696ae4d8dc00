//! Files that are damaged, empty, or something else.

use crate::p5::original;
use crate::{assert_says, file, packed, refused};
use bladesmith::Error;
use bladesmith::fe::{ReadOptions, read};
use std::path::Path;

#[test]
fn damaged_archives_are_refused() {
    let whole = packed(original("base.frd"));
    for (name, size) in
        [("cut.frd.gz", whole.len() / 2), ("cut_end.frd.gz", whole.len() - 4), ("cut_head.frd.gz", 5)]
    {
        assert_says(&refused(name, &whole[..size]), &["ends early", "truncated"]);
    }
    let mut spoiled = whole.clone();
    let middle = spoiled.len() / 2;
    spoiled[middle..middle + 8].fill(0xff);
    assert_says(&refused("spoiled.frd.gz", spoiled), &["damaged"]);
    assert_says(&refused("results.zip", b"PK\x03\x04 and more"), &["zip"]);
}

#[test]
fn tiny_and_foreign_files_are_refused() {
    for (name, content, word) in [
        ("two_bytes.frd", &b"\x1f\x8b"[..], "ends early"),
        ("one_letter.frd", b"x", "neither"),
        ("blank.frd", b"\n \n\r\n", "empty"),
        ("mesh.stl", b"solid part made by hand\nfacet normal 0 0 1\n", "found solid, part"),
        ("model.step", b"ISO-10303-21;\nHEADER;\n", "neither"),
        ("data.vtu", b"<?xml version=\"1.0\"?>\n<VTKFile>\n", "neither"),
        ("deck.inp", b"*HEADING\n*NODE\n1,0,0,0\n", "a deck (.inp) has a mesh but no displacements"),
        ("wide.csv", b"\xff\xfei\0d\0,\0", "UTF-16"),
    ] {
        assert_says(&refused(name, content), &[word]);
    }
}

#[test]
fn headers_alone_are_refused() {
    assert_says(
        &refused("header.frd", "    1C\n    1UDATE 1.1.2026\n 9999\n"),
        &["no nodes", "no block at all"],
    );
    let nodes = original("base.frd").lines().take(13).map(|line| format!("{line}\n")).collect::<String>();
    assert_says(&refused("open_block.frd", &nodes), &["truncated", "0 of 2425"]);
    assert_says(&refused("no_rows.frd", nodes + " -3\n 9999\n"), &["no nodes"]);
}

#[test]
fn garbage_is_refused() {
    let noise: Vec<u8> = (0..100_000u64).map(|k| crate::p5::mix(k) as u8).collect();
    refused("noise.frd", &noise);
    let tail = [b"    1C\n".as_slice(), &noise].concat();
    refused("noise_behind_header.frd", &tail);
    assert_says(&refused("one_line.frd", "7".repeat(100_000)), &["not a text file"]);
}

#[test]
fn files_that_cannot_be_read_say_why() {
    for path in [Path::new("/no/such/file.frd"), Path::new(env!("CARGO_MANIFEST_DIR"))] {
        match read(path, &ReadOptions::default()) {
            Err(Error::Io { path: named, .. }) => assert_eq!(named, path.display().to_string()),
            other => panic!("{}: {other:?}", path.display()),
        }
    }
    let results = file("good.frd", original("base.frd"));
    let options = ReadOptions { mesh: Some("/no/such/deck.inp".into()), step: None };
    assert_eq!(read(&results, &options).map(|field| field.name).map_err(|error| error.code()), Err(100));
}
