//! The twisted bar and what was done to its results: every row of the list of awkward inputs.

use crate::p5::{self, original, variant};
use crate::{assert_same, assert_says, data, file, read, read_step, read_text, refused, the_warning};
use bladesmith::fe::{Field, NO_NODE};
use glam::DVec3;

fn base() -> Field {
    read(&data("p5/base.frd.gz"))
}

#[test]
fn variants_made_here_are_the_shared_files() {
    let Some(folder) = std::env::var_os("BLADESMITH_DATA") else {
        return println!("skipped: BLADESMITH_DATA names no folder with P5");
    };
    for name in p5::VARIANTS {
        let path = std::path::Path::new(&folder).join(format!("P5/{name}.frd"));
        let shared =
            std::fs::read_to_string(&path).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()));
        let (made, shared) = match (name, variant(name)) {
            // Rows in an order of their own.
            ("gaps_shuffled", made) => (sorted_lines(&made), sorted_lines(&shared)),
            (_, made) => (made, shared),
        };
        let first = made.lines().zip(shared.lines()).position(|(a, b)| a != b);
        assert!(made == shared, "{name}: differs, first at line index {first:?}");
    }
}

fn sorted_lines(text: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    lines.sort();
    lines.join("\n")
}

#[test]
fn the_good_case_is_read_whole_and_without_warnings() {
    let field = base();
    assert_eq!((field.ids.len(), field.points.len(), field.displacements.len()), (2425, 2425, 2425));
    assert_eq!(field.ids, (1..=2425).collect::<Vec<i64>>());
    assert_eq!(field.points[0], DVec3::new(-10.0, -4.0, 0.0));
    assert_eq!(field.points[3], DVec3::new(10.7536, 0.600951, 40.0));
    assert_eq!(field.displacements[1], DVec3::new(-5.75863e-2, -7.02622e-2, 2.17398e-1));
    assert_eq!((field.step, field.steps), (1, 1));
    assert_eq!(field.warnings, [""; 0]);
    let largest = field.largest_displacement();
    assert!((largest.value - 0.248510).abs() < 1e-6, "{largest:?}");
    for (name, nodes) in [("coarse", 358), ("sphere", 3218)] {
        assert_eq!(read(&data(&format!("p5/{name}.frd.gz"))).ids.len(), nodes, "{name}");
    }
}

#[test]
fn the_surface_is_closed_and_encloses_the_bar() {
    for (name, surface_nodes, volume) in
        [("base", Some(1434), Some(6400.0)), ("coarse", None, Some(6400.0)), ("sphere", None, None)]
    {
        let field = read(&data(&format!("p5/{name}.frd.gz")));
        let nodes = field.surface_nodes.as_ref().expect("elements");
        assert!(nodes.is_sorted() && field.mid_sides.is_sorted());
        assert!(
            surface_nodes.is_none_or(|count| nodes.len() == count),
            "{name}: {} surface nodes",
            nodes.len()
        );
        // Euler: each triangle has 3/2 edges, and each edge one mid-side node.
        let (faces, edges) = (field.surface_faces.len(), field.mid_sides.len());
        assert_eq!((2 * edges, nodes.len() - edges + faces), (3 * faces, edges + 2), "{name}");
        let corner = |face: &[u32; 6], k: usize| field.points[face[k] as usize];
        let part = |face: &[u32; 6]| corner(face, 0).dot(corner(face, 1).cross(corner(face, 2))) / 6.0;
        let found: f64 = field.surface_faces.iter().map(part).sum();
        assert!(found > 0.0, "{name}: the surface looks inward");
        assert!(
            volume.is_none_or(|volume: f64| (found / volume - 1.0).abs() < 0.02),
            "{name}: volume {found}"
        );
    }
}

#[test]
fn mid_side_nodes_lie_between_their_corners() {
    let field = base();
    let at = |node: u32| field.points[node as usize];
    for &[mid, a, b] in &field.mid_sides {
        let (length, off) = (at(a).distance(at(b)), at(mid).distance((at(a) + at(b)) / 2.0));
        assert!(off < 0.1 * length, "mid-side {mid} is {off} off the middle of {a} and {b}");
    }
    for face in &field.surface_faces {
        for (side, (a, b)) in [(0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
            let (mid, a, b) = (face[3 + side], face[a], face[b]);
            assert!(mid != NO_NODE && field.mid_sides.contains(&[mid, a.min(b), a.max(b)]), "{face:?}");
        }
    }
}

#[test]
fn line_ends_order_and_gaps_in_the_numbers_change_nothing() {
    let base = base();
    let crlf = read_text("crlf.frd", variant("crlf"));
    assert_same(&base, &crlf);
    assert_eq!(base.surface_faces, crlf.surface_faces);
    let shuffled = read_text("gaps_shuffled.frd", variant("gaps_shuffled"));
    assert!(shuffled.ids.is_sorted() && shuffled.ids.len() == base.ids.len());
    assert_eq!((shuffled.surface_nodes, shuffled.warnings), (None, vec![]));
    for (k, id) in base.ids.iter().enumerate() {
        let place = shuffled.ids.binary_search(&(7 * id + 1_000_000 + 500_000 * (id % 3))).expect("the node");
        assert_eq!(shuffled.points[place], base.points[k]);
        assert_eq!(shuffled.displacements[place], base.displacements[k]);
    }
}

#[test]
fn nodes_without_displacement_are_counted_and_marked() {
    let base = base();
    let field = read_text("partial_disp.frd", variant("partial_disp"));
    assert_eq!(field.ids, base.ids);
    let missing = field.nodes_without_result();
    assert!(missing.len() > 500, "{}", missing.len());
    assert_says(the_warning(&field), &[&format!("{} of 2425 nodes without displacement", missing.len())]);
    for (k, id) in field.ids.iter().enumerate() {
        assert_eq!(missing.contains(id), field.points[k].z >= 26.0, "node {id}");
        assert!(missing.contains(id) || field.displacements[k] == base.displacements[k], "node {id}");
    }
}

#[test]
fn a_selection_of_nodes_is_read_and_its_header_doubted() {
    let field = read_text("partial_face.frd", variant("partial_face"));
    assert!(field.points.iter().all(|point| point.z < 26.0) && field.nodes_without_result().is_empty());
    assert_says(the_warning(&field), &["announces 2425 nodes", &format!("holds {}", field.ids.len())]);
    assert_eq!(field.surface_nodes, None);
}

#[test]
fn missing_displacements_are_refused_with_what_is_there() {
    let message = refused("no_disp.frd", variant("no_disp"));
    assert_says(
        &message,
        &["no displacements (DISP)", "nodes (2425 rows)", "elements (1250 rows)", "NODE FILE"],
    );
    let other = refused("stress_only.frd", original("base.frd").replace(" -4  DISP  ", " -4  STRESS"));
    assert_says(&other, &["no displacements (DISP)", "STRESS (2425 rows)"]);
}

#[test]
fn values_that_are_no_numbers_are_refused_with_their_nodes() {
    let message = refused("nan.frd", variant("nan"));
    assert_says(&message, &["6 nodes", "NaN", "7, 418, 829, 1240, 1651, 2062"]);
    let place = original("base.frd").replacen("-1.00000E+01-4.00000E+00", "    Infinity-4.00000E+00", 1);
    assert_says(&refused("infinite.frd", place), &["node 1 with coordinates"]);
}

#[test]
fn truncated_results_are_refused_with_how_far_they_go() {
    let message = refused("truncated.frd", variant("truncated"));
    assert_says(&message, &["truncated", "displacements (DISP) of step 1", "1614 of 2425 nodes"]);
    let base = original("base.frd");
    let cut = |line: usize| -> String { base.split_inclusive('\n').take(line).collect() };
    assert_says(
        &refused("cut_nodes.frd", cut(1013)),
        &["truncated", "inside the nodes", "1000 of 2425 nodes"],
    );
    assert_says(
        &refused("cut_elements.frd", cut(2442)),
        &["truncated", "inside the elements", "of 1250 elements"],
    );
}

#[test]
fn the_last_of_several_steps_is_used_unless_another_is_chosen() {
    let path = file("two_steps.frd", variant("two_steps"));
    let last = read(&path);
    assert_eq!((last.step, last.steps), (2, 2));
    assert_says(the_warning(&last), &["2 steps", "the last", "step 1 (time 1), step 2 (time 1)"]);
    assert_same(&last, &base());
    let first = read_step(&path, 1).expect("step 1");
    assert_eq!((first.step, first.steps, first.warnings.len()), (1, 2, 0));
    for (half, full) in first.displacements.iter().zip(&last.displacements) {
        assert!(
            (*half * 2.0 - *full).abs().max_element() <= 1e-5 * full.abs().max_element().max(1e-9),
            "{half} {full}"
        );
    }
    let message = crate::refusal("two_steps.frd", read_step(&path, 3));
    assert_says(&message, &["step 3 is not in it", "step 1 (time 1), step 2 (time 1)"]);
    assert_says(&crate::refusal("two_steps.frd", read_step(&path, 0)), &["numbered from 1"]);
}

#[test]
fn of_two_displacements_of_a_node_the_last_is_used_and_said() {
    let field = read_text("duplicate_nodes.frd", variant("duplicate_nodes"));
    assert_says(the_warning(&field), &["3 nodes", "the last is used", "3, 50, 300"]);
    let base = base();
    for (k, id) in base.ids.iter().enumerate() {
        let shift = if [3, 50, 300].contains(id) { 0.25 } else { 0.0 };
        let off = field.displacements[k] - base.displacements[k] - DVec3::splat(shift);
        assert!(off.abs().max_element() < 1e-6, "node {id}: {off}");
    }
}

#[test]
fn suspicious_sizes_are_said() {
    assert_eq!(base().magnitude_warnings(1.0), [""; 0]);
    for (name, words) in [
        ("zero_disp", &["all displacements are zero"][..]),
        ("disp_metres_only", &["very small", "2.485e-4"]),
        ("huge_disp", &["larger than the model", "2.485e2"]),
    ] {
        let warnings = read_text(&format!("{name}.frd"), variant(name)).summary().warnings;
        assert_says(&warnings.join("; "), words);
    }
    let metres = read_text("disp_metres.frd", variant("disp_metres_only"));
    assert_eq!(metres.magnitude_warnings(1000.0), [""; 0]);
}

#[test]
fn metres_and_other_frames_are_read_as_they_are() {
    let (base, metres) = (base(), read_text("metres.frd", variant("metres")));
    assert_eq!((base.summary().unit_guess, metres.summary().unit_guess), (Some("mm"), Some("m")));
    for (a, b) in base.points.iter().zip(&metres.points) {
        assert!((*a - *b * 1e3).abs().max_element() <= 1e-12 * a.length().max(1.0), "{a} {b}");
    }
    let place = read_text("place.csv", "1,5,5,5,0.1,0,0\n").summary();
    assert_eq!((place.unit_guess, place.warnings.len()), (None, 1), "{:?}", place.warnings);
    assert!(place.warnings[0].starts_with("only 1 node with"), "{:?}", place.warnings);
    let mirrored = read_text("mirrored.frd", variant("mirrored"));
    assert_eq!(mirrored.points[3], DVec3::new(10.7536, -0.600951, 40.0));
    let turned = read_text("other_frame.frd", variant("other_frame"));
    assert!(turned.bounds()[0].z > 39.9 && turned.surface_faces == base.surface_faces);
}

#[test]
fn files_of_other_kinds_are_refused() {
    assert_says(&refused("empty.frd", variant("empty")), &["empty"]);
    assert_says(&refused("not_frd.frd", variant("not_frd")), &["neither CalculiX results", "solid ascii"]);
}
