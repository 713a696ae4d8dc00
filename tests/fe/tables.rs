//! Tables of nodes.

use crate::p5::original;
use crate::{
    assert_same, assert_says, data, file, packed, read, read_step, read_text, read_with, refused, the_warning,
};
use bladesmith::Error;
use bladesmith::fe::{Field, Format};
use glam::DVec3;

fn base() -> Field {
    read(&data("p5/base.frd.gz"))
}

/// The bar as a table with that separator, each number with as many digits as it needs.
fn table(header: &str, separator: &str, with_ids: bool) -> String {
    let field = base();
    let mut text = header.to_string();
    for (k, id) in field.ids.iter().enumerate() {
        let values = [field.points[k].to_array(), field.displacements[k].to_array()].concat();
        let cells = values.iter().map(|value| format!("{value:e}"));
        let row: Vec<String> = with_ids.then(|| id.to_string()).into_iter().chain(cells).collect();
        text += &(row.join(separator) + "\n");
    }
    text
}

#[test]
fn every_kind_of_table_gives_the_same_field() {
    let base = base();
    let german = "\u{feff}# Knoten; Koordinaten mm\nNode;X;Y;Z;UX;UY;UZ\n";
    let units = "Node Number\tX [mm]\tY [mm]\tZ [mm]\tU1\tU2\tU3\n-\tmm\tmm\tmm\tmm\tmm\tmm\n";
    for (name, content) in [
        ("plain.csv", table("id,x,y,z,dx,dy,dz\n", ",", true)),
        ("bare.csv", table("", ",", true)),
        ("without_ids.csv", table("x,y,z,dx,dy,dz\n", ",", false)),
        ("bare_without_ids.csv", table("# nodes of the bar\n\n", ",", false)),
        ("german.csv", table(german, ";", true).replace('.', ",")),
        ("tabs.csv", table(units, "\t", true)),
        ("blanks.txt", table("", "   ", true)),
        (
            "quoted.csv",
            table("\"id\",\"x\",\"y\",\"z\",\"dx\",\"dy\",\"dz\"\n", "\" , \"", true).replace("\" , \"", ","),
        ),
        ("crlf.csv", table("id,x,y,z,dx,dy,dz\n", ",", true).replace('\n', "\r\n")),
        ("trailing.csv", table("id,x,y,z,dx,dy,dz\n", ",", true).replace('\n', ",\n")),
        ("no_end.csv", table("", ",", true).trim_end().to_string()),
    ] {
        let field = read_text(name, content);
        assert_same(&base, &field);
        assert_eq!((field.warnings, field.step, field.steps), (vec![], 1, 1), "{name}");
        assert_eq!((field.source.format, field.surface_nodes), (Format::Table, None), "{name}");
    }
    assert_same(&base, &read_text("packed.csv.gz", packed(table("", ",", true))));
}

#[test]
fn columns_are_found_by_name() {
    let text = "T,uz,uy,ux,z,y,x,|U|,Node Label\n20,3,2,1,30,20,10,9,7\n21,6,5,4,60,50,40,9,5.0\n";
    let field = read_text("names.csv", text);
    assert_eq!(field.ids, [5, 7]);
    assert_eq!(field.points, [DVec3::new(40.0, 50.0, 60.0), DVec3::new(10.0, 20.0, 30.0)]);
    assert_eq!(field.displacements, [DVec3::new(4.0, 5.0, 6.0), DVec3::new(1.0, 2.0, 3.0)]);
}

#[test]
fn empty_displacements_are_missing_ones() {
    let field = read_text("missing.csv", "id;x;y;z;dx;dy;dz\n1;0;0;0;;;\n2;1;0;0;0,5;0;0\n");
    assert!(field.displacements[0].is_nan() && field.displacements[1] == DVec3::new(0.5, 0.0, 0.0));
    assert_says(the_warning(&field), &["1 of 2 nodes without displacement: 1"]);
    assert_says(&refused("half_missing.csv", "1;0;0;0;;1;\n"), &["line 1", "column 5"]);
    assert_says(
        &refused("all_missing.csv", "id;x;y;z;dx;dy;dz\n1;0;0;0;;;\n"),
        &["no node has a displacement"],
    );
}

#[test]
fn faults_are_named_with_their_line() {
    for (name, text, words) in [
        (
            "columns.csv",
            "id,x,y,z,dx,dy,dz\n1,0,0,0,0,0,0\n2,0,0,0,0,0\n",
            &["line 3", "7 columns", "found 6"][..],
        ),
        (
            "commas.csv",
            "id,x,y,z,dx,dy,dz\n1,0,5,0,5,0,5,0,5,0,5,0,5\n",
            &["line 2", "found 13", "semicolons"],
        ),
        (
            "word.csv",
            "id,x,y,z,dx,dy,dz\n1,0,0,0,0,0,0\n2,0,zero,0,0,0,0\n",
            &["line 3", "column 3", "'zero'"],
        ),
        ("number.csv", "id,x,y,z,dx,dy,dz\n1.5,0,0,0,0,0,0\n", &["line 2", "node number", "1.5"]),
        ("four.csv", "1,2,3,4\n", &["line 1", "4 columns", "id,x,y,z,dx,dy,dz"]),
        ("header.csv", "id,x,y,z,T\n1,2,3,4,5\n", &["line 1", "displacements", "found id, x, y, z, T"]),
        ("rows.csv", "id,x,y,z,dx,dy,dz\n# nothing\n", &["no rows"]),
        ("comments.csv", "# nothing\n", &["only comments"]),
        ("nan.csv", "4,0,0,0,nan,0,0\n9,1,0,0,0,0,0\n", &["node 4 with displacements", "NaN"]),
        ("places.csv", "4,0,0,0,0,0,0\n4,1,0,0,0,0,0\n", &["node 4 with several different positions"]),
        ("thousands.csv", "id;x;y;z;dx;dy;dz\n1;1.000,5;0;0;0;0;0\n", &["line 2", "column 2", "1.000,5"]),
    ] {
        assert_says(&refused(name, text), words);
    }
}

#[test]
fn a_table_has_one_step() {
    let path = file("steps.csv", "1,0,0,0,1,0,0\n");
    assert_eq!(read_step(&path, 1).expect("the only step").steps, 1);
    assert_says(&crate::refusal("steps.csv", read_step(&path, 2)), &["step 2", "single step"]);
}

#[test]
fn a_deck_gives_a_table_its_surface() {
    let deck = file("table_deck.inp", original("base.inp"));
    let rounded = file("rounded.csv", table("", ",", true));
    let field = read_with(&rounded, &deck).expect("table and deck");
    let from_results = read_with(&data("p5/base.frd.gz"), &deck).expect("results and deck");
    assert_same(&field, &from_results);
    assert_eq!(field.surface_faces, from_results.surface_faces);
    assert_eq!(field.mid_sides, from_results.mid_sides);
}

#[test]
fn arrays_are_checked_like_files() {
    let base = base();
    let reversed = |values: &[DVec3]| values.iter().rev().copied().collect::<Vec<_>>();
    let ids: Vec<i64> = base.ids.iter().rev().copied().collect();
    let field = Field::from_arrays("here", &ids, &reversed(&base.points), &reversed(&base.displacements));
    assert_same(&base, &field.expect("good arrays"));
    let one = [DVec3::ZERO];
    let short = Field::from_arrays("here", &[1, 2], &one, &one);
    assert!(matches!(short, Err(Error::Argument { name: "points", .. })), "{short:?}");
    for (points, values) in [(one, [DVec3::NAN]), ([DVec3::INFINITY], one)] {
        assert_says(
            &crate::refusal("here", Field::from_arrays("here", &[1], &points, &values)),
            &["node 1 with ", "no numbers"],
        );
    }
    assert_says(&crate::refusal("here", Field::from_arrays("here", &[], &[], &[])), &["no nodes"]);
}

#[test]
fn the_shared_tables_are_the_shared_results() {
    let Some(folder) = std::env::var_os("BLADESMITH_DATA") else {
        return println!("skipped: BLADESMITH_DATA names no folder with P1");
    };
    let folder = std::path::Path::new(&folder).join("P1");
    let results = read_with(&folder.join("P1.frd.gz"), &folder.join("P1.inp.gz")).expect("P1");
    assert_eq!((results.ids.len(), results.surface_nodes.as_ref().map(Vec::len)), (51294, Some(24766)));
    for (name, nodes) in [("P1_nodes.csv.gz", 51294), ("P1_surface_semicolon.csv.gz", 24766)] {
        let table = read(&folder.join("formats").join(name));
        assert_eq!((table.ids.len(), table.warnings.len()), (nodes, 0), "{name}");
        for (k, id) in table.ids.iter().enumerate() {
            let place = results.ids.binary_search(id).expect("the node");
            let off = (table.points[k] - results.points[place]).abs().max_element();
            assert!(
                off <= 5.1e-7 && table.displacements[k] == results.displacements[place],
                "{name}: node {id}"
            );
        }
    }
}
