//! Decks: coordinates in full precision and elements.

use crate::p5::{original, variant};
use crate::{assert_says, data, file, read, read_with, the_warning};
use bladesmith::fe::Field;

fn base_with(name: &str, deck: &str) -> bladesmith::Result<Field> {
    read_with(&data("p5/base.frd.gz"), &file(name, deck))
}

fn refused(name: &str, deck: &str) -> String {
    crate::refusal(name, base_with(name, deck))
}

/// Node lines of the bar's deck.
fn node_lines(deck: &str) -> Vec<&str> {
    deck.lines()
        .skip_while(|line| !line.starts_with("*NODE"))
        .skip(1)
        .take_while(|line| !line.starts_with('*'))
        .collect()
}

#[test]
fn a_deck_replaces_rounded_coordinates() {
    let rounded = read(&data("p5/base.frd.gz"));
    let deck = original("base.inp");
    let exact = base_with("exact.inp", &deck).expect("results and deck");
    assert_eq!((exact.warnings.len(), &exact.displacements), (0, &rounded.displacements));
    assert_eq!(exact.surface_faces, rounded.surface_faces);
    assert!(exact.source.mesh.as_ref().is_some_and(|mesh| mesh.ends_with("exact.inp")));
    for (k, line) in node_lines(&deck).iter().enumerate() {
        let numbers: Vec<f64> = line.split(',').map(|word| word.trim().parse().expect("a number")).collect();
        assert_eq!((exact.ids[k] as f64, exact.points[k].to_array().as_slice()), (numbers[0], &numbers[1..]));
    }
    let off = rounded.points.iter().zip(&exact.points).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(off > 1e-6 && off < 1e-4, "rounding {off}");
}

#[test]
fn a_foreign_deck_is_refused_with_figures() {
    let turned = file("turned.frd", variant("other_frame"));
    let own = file("own.inp", original("base.inp"));
    let message = crate::refusal("own.inp", read_with(&turned, &own));
    assert_says(
        &message,
        &["do not belong together", "of 2425 common nodes differ", "turned.frd", "at node"],
    );
    assert_says(
        &refused("coarse.inp", &original("coarse.inp")),
        &["do not belong together", "of 358 common nodes"],
    );
    let other = original("base.inp").replacen("1, -1.000000000e+01", "1, -1.000010000e+01", 1);
    assert_says(&refused("moved.inp", &other), &["1 of 2425", "by up to 0.000100 at node 1"]);
    let shuffled = file("numbers.frd", variant("gaps_shuffled"));
    assert_says(&crate::refusal("own.inp", read_with(&shuffled, &own)), &["no node number in common"]);
}

#[test]
fn nodes_that_the_deck_lacks_keep_their_rounding_and_are_counted() {
    let deck = original("base.inp");
    let lines = node_lines(&deck);
    let part = deck.replacen(&format!("{}\n{}\n", lines[9], lines[10]), "", 1);
    let rounded = read(&data("p5/base.frd.gz"));
    let field = base_with("part.inp", &part).expect("most nodes");
    assert_says(the_warning(&field), &["2 of 2425 nodes missing in the deck", "10, 11"]);
    assert_eq!(field.points[9..11], rounded.points[9..11]);
    assert_ne!(field.points[11], rounded.points[11]);
}

#[test]
fn a_deck_may_be_written_in_many_ways() {
    let plain = base_with("plain.inp", &original("base.inp")).expect("the plain deck");
    let deck = original("base.inp");
    let lines = node_lines(&deck);
    let middle = lines[1000];
    let wrapped = |line: &str| {
        let words: Vec<&str> = line.split(',').collect();
        if words.len() > 10 {
            format!("{},\n{}\n", words[..6].join(","), words[6..].join(","))
        } else {
            format!("{line}\n")
        }
    };
    for (name, text) in [
        ("blocks.inp", deck.replacen(middle, &format!("{middle}\n** a comment\n\n*NODE\n"), 1)),
        ("lower.inp", deck.replacen("*NODE, NSET=NALL", "*node,\n nset=NALL", 1)),
        ("crlf.inp", deck.replace('\n', "\r\n")),
        ("fortran.inp", deck.replace("e+", "D+").replace("e-", "d-")),
        ("wrapped.inp", deck.lines().map(wrapped).collect()),
        ("again.inp", format!("*NODE\n{}, 1., 2., 3.\n{deck}", 5)),
        ("system.inp", deck.replacen("*NODE,", "*NODE, SYSTEM=R,", 1)),
    ] {
        let field = base_with(name, &text).unwrap_or_else(|error| panic!("{error}"));
        assert!(field.points == plain.points && field.warnings.is_empty(), "{name}: {:?}", field.warnings);
        let table = read_with(&file("surface.frd", variant("no_elements")), &file(name, &text));
        assert_eq!(table.expect("without elements").surface_faces, plain.surface_faces, "{name}");
    }
}

#[test]
fn included_files_are_followed() {
    let deck = original("base.inp");
    let lines = node_lines(&deck).join("\n");
    file("nodes.txt", &lines);
    let outer = deck.replacen(&lines, "*INCLUDE, INPUT=nodes.txt", 1);
    let plain = base_with("whole.inp", &deck).expect("the whole deck");
    assert_eq!(base_with("outer.inp", &outer).expect("with an include").points, plain.points);
    let input =
        outer.replacen("*NODE, NSET=NALL\n*INCLUDE, INPUT=nodes.txt", "*NODE, INPUT=\"nodes.txt\"", 1);
    assert_eq!(base_with("input.inp", &input).expect("with an input").points, plain.points);
    assert_says(
        &refused("absent.inp", "*INCLUDE, INPUT=absent.txt\n"),
        &["line 1", "absent.txt", "not there"],
    );
    let circle = "*INCLUDE, INPUT=circle.inp\n";
    assert_says(&refused("circle.inp", circle), &["include each other"]);
}

#[test]
fn decks_that_cannot_be_used_say_why() {
    for (name, text, words) in [
        ("cylindrical.inp", "*NODE, SYSTEM=C\n1,1,90,0\n", &["line 1", "SYSTEM=C", "Cartesian"][..]),
        ("frame.inp", "*SYSTEM\n0,0,0\n*NODE\n1,1,2,3\n", &["line 1", "*SYSTEM"]),
        ("word.inp", "*NODE\n1,0,0,0\n2,zero,0,0\n", &["line 3", "a node", "2,zero"]),
        ("nan.inp", "*NODE\n1,nan,0,0\n", &["line 2", "a node"]),
        ("short.inp", "*NODE\n1,0,0,0\n*ELEMENT,TYPE=C3D4\n1,1,1,1\n*STEP\n", &["line 5", "lacks 1 node"]),
        ("long.inp", "*NODE\n1,0,0,0\n*ELEMENT,TYPE=C3D4\n1,1,1,1,1,1\n", &["line 4", "C3D4", "4 nodes"]),
        ("cut.inp", "*NODE\n1,0,0,0\n*ELEMENT,TYPE=C3D4\n1,1,1,\n", &["truncated", "lacks 2 nodes"]),
        ("typeless.inp", "*NODE\n1,0,0,0\n*ELEMENT\n1,1,1,1,1\n", &["line 3", "TYPE"]),
        ("empty.inp", "", &["no *NODE"]),
        ("results.inp", "    1C\n    2C\n", &["no *NODE"]),
    ] {
        assert_says(&refused(name, text), words);
    }
    let generated = format!("{}*NGEN\n1,5,1\n", original("base.inp"));
    assert_says(the_warning(&base_with("ngen.inp", &generated).expect("with *NGEN")), &["*NGEN"]);
}

#[test]
fn elements_without_a_surface_are_counted() {
    let deck =
        original("base.inp").replacen("*MATERIAL", "*ELEMENT, TYPE=B31\n9001,1,2\n9002,2,3\n*MATERIAL", 1);
    let field = read_with(&file("beams.frd", variant("no_elements")), &file("beams.inp", &deck));
    let field = field.expect("with beams");
    assert_says(the_warning(&field), &["not understood: 2 of B31"]);
    let kinds: Vec<String> =
        field.source.elements.iter().map(|e| format!("{} {}", e.count, e.kind)).collect();
    assert_eq!(kinds, ["1250 C3D10", "2 B31"]);
}

#[test]
fn a_selection_of_nodes_gets_the_part_of_the_surface_it_covers() {
    let selection = file("selection.frd", variant("partial_face"));
    let field = read_with(&selection, &file("selection.inp", original("base.inp"))).expect("a selection");
    let whole = read(&data("p5/base.frd.gz"));
    let nodes = field.surface_nodes.expect("the deck's elements");
    let low =
        whole.surface_nodes.expect("elements").into_iter().filter(|&k| whole.points[k as usize].z < 26.0);
    assert_eq!(
        nodes.iter().map(|&k| field.ids[k as usize]).collect::<Vec<_>>(),
        low.map(|k| whole.ids[k as usize]).collect::<Vec<_>>()
    );
    assert!(field.surface_faces.len() > 300 && field.surface_faces.len() < whole.surface_faces.len());
    assert!(field.surface_faces.iter().flatten().all(|&k| (k as usize) < field.ids.len()));
}
