//! The many ways in which programs write CalculiX results.

use crate::p5::original;
use crate::{assert_same, assert_says, data, file, packed, read, read_step, read_text, refused, the_warning};

/// The rows of nodes and displacements of `base.frd` rewritten, other lines as they are.
fn rewritten(row: impl Fn(&str) -> String) -> String {
    let mut in_elements = false;
    let mut line = |line: &str| {
        in_elements = (in_elements || line.starts_with("    3C")) && !line.starts_with(" -3");
        if line.starts_with(" -1") && !in_elements { row(line) } else { line.to_string() }
    };
    original("base.frd").lines().map(|text| line(text) + "\n").collect()
}

/// Node numbers in five columns and elements to match.
fn short() -> String {
    let narrow = |line: &str| -> String {
        let fields = (3..line.len()).step_by(10).map(|first| line[first..first + 10].trim());
        format!("{}{}", &line[..3], fields.map(|field| format!("{field:>5}")).collect::<String>())
    };
    let mut text = String::new();
    for line in original("base.frd").lines() {
        let header = line.starts_with("    2C") || line.starts_with("    3C") || line.starts_with("  100C");
        text += &match line {
            _ if header => format!("{}0", &line[..line.len() - 1]),
            _ if line.starts_with(" -2") => narrow(line),
            _ if line.starts_with(" -1") => format!(" -1{:>5}{}", line[3..13].trim(), &line[13..]),
            _ => line.to_string(),
        };
        text.push('\n');
    }
    text
}

#[test]
fn short_and_long_numbers_give_the_same() {
    let base = read(&data("p5/base.frd.gz"));
    let narrow = read_text("short.frd", short());
    assert_same(&base, &narrow);
    assert_eq!(base.surface_faces, narrow.surface_faces);
    // Headers that do not say how wide the numbers are.
    let bare = |text: &str, name: &str| {
        let strip = |line: &str| {
            let header = ["    2C", "    3C", "  100C"].iter().any(|start| line.starts_with(start));
            if header { line[..36.min(line.len())].to_string() + "\n" } else { line.to_string() + "\n" }
        };
        read_text(name, text.lines().map(strip).collect::<String>())
    };
    assert_same(&base, &bare(&short(), "bare_short.frd"));
    assert_same(&base, &bare(&original("base.frd"), "bare_long.frd"));
}

#[test]
fn three_digit_exponents_that_shift_the_columns_give_the_same() {
    let base = read(&data("p5/base.frd.gz"));
    // As some C libraries write twelve columns: thirteen for negative values.
    let value = |field: &str| format!("{:>12}", field.trim().replace("E-", "E-0").replace("E+", "E+0"));
    let row = |row: &str| {
        format!("{}{}{}{}", &row[..13], value(&row[13..25]), value(&row[25..37]), value(&row[37..]))
    };
    let wide = rewritten(row);
    assert!(wide.contains(" -1         1-1.00000E+001-4.00000E+0000.00000E+000\n"));
    assert_same(&base, &read_text("exponents.frd", wide));
}

#[test]
fn a_comma_may_be_the_decimal_mark() {
    let base = read(&data("p5/base.frd.gz"));
    assert_same(&base, &read_text("comma.frd", rewritten(|row| row.replace('.', ","))));
}

#[test]
fn fortran_exponents_and_blank_separated_values_are_read() {
    let base = read(&data("p5/base.frd.gz"));
    let spaced =
        rewritten(|row| format!("{}   {} {} {}", &row[..13], &row[13..25], &row[25..37], &row[37..]));
    assert_same(&base, &read_text("spaced.frd", spaced.replace("E-0", "D-0")));
}

#[test]
fn blocks_may_be_split_and_the_last_line_may_lack_its_end() {
    let base = read(&data("p5/base.frd.gz"));
    let split = |text: &str, header: &str, line: &str| {
        let start = text.find(header).expect("a header");
        let header: String = text[start..].lines().take(1).collect();
        let cut = text[start..].find(line).expect("a row") + start + 1;
        format!("{} -3\n{header}\n{}", &text[..cut], &text[cut..])
    };
    let text = split(&original("base.frd"), "    2C", "\n -1      1200");
    let text = split(&text, "    3C", "\n -1       600");
    let field = read_text("split.frd", text.trim_end());
    assert_same(&base, &field);
    assert_eq!(base.surface_faces, field.surface_faces);
    assert_eq!(field.source.blocks.iter().filter(|block| block.name == "nodes").count(), 2);
    assert_says(&field.warnings.join("; "), &["announces 2425 nodes, the block holds 1199"]);
}

#[test]
fn nodes_may_be_defined_twice_in_one_place_only() {
    let base = original("base.frd");
    let row = base.lines().find(|line| line.starts_with(" -1         5")).expect("node 5");
    let again = base.replacen(row, &format!("{row}\n{row}"), 1);
    assert_same(&read(&data("p5/base.frd.gz")), &read_text("same_twice.frd", &again));
    let moved = base.replacen(row, &format!("{row}\n{}", row.replace("E+0", "E+1")), 1);
    assert_says(&refused("two_places.frd", moved), &["node 5 with several different positions"]);
}

#[test]
fn huge_numbers_of_nodes_are_kept() {
    let huge = |row: &str| {
        let id: i64 = row[3..13].trim().parse().expect("a number");
        format!(" -1{:10}{}", 9_999_997_574 + id, &row[13..])
    };
    let field = read_text("huge.frd", rewritten(huge));
    assert_eq!((field.ids[0], field.ids[2424]), (9_999_997_575, 9_999_999_999));
    assert_says(
        &field.warnings.join("; "),
        &["2425 nodes (1, 2, 3, 4, 5, 6, 7, 8, …) of the elements without coordinates", "not used"],
    );
    assert_eq!(field.surface_nodes, None);
}

#[test]
fn a_number_that_runs_over_its_columns_is_refused() {
    let text = short().replacen(" -1    7", " -1123457", 1);
    assert_says(&refused("overrun.frd", text), &["line 20", "number in 5 columns", "-1123457"]);
}

#[test]
fn broken_rows_are_refused_with_their_line() {
    let base = original("base.frd");
    for (name, from, to, line) in [
        ("broken_value.frd", " -1         4 1.07536E+01", " -1         4 1.0x536E+01", "line 17"),
        ("broken_number.frd", " -1         4 1.07536E+01", " -1       4.5 1.07536E+01", "line 17"),
        ("two_values.frd", " -1         4 1.07536E+01", " -1         4", "line 17"),
        ("foreign_line.frd", " -1         4 1.07536E+01", "what is this", "line 17"),
        ("broken_element.frd", " -2       210", " -2       2x0", "line 2442"),
        ("short_element.frd", " -2       210", " -2          ", "line 2443"),
    ] {
        assert_says(&refused(name, base.replacen(from, to, 1)), &[line, "expected"]);
    }
    let names = base.replacen(" -5  D2 ", " -5  T2 ", 1);
    assert_says(&refused("components.frd", names), &["D1, D2, D3", "found D1, T2, D3"]);
}

#[test]
fn binary_results_are_those_of_the_text() {
    let text = read(&data("fe/brick_and_wedge.frd.gz"));
    let binary = read(&data("fe/brick_and_wedge_binary.frd.gz"));
    assert_eq!((binary.ids.len(), binary.step, binary.steps), (35, 2, 2));
    assert_eq!(
        (&text.ids, &text.points, &text.surface_faces),
        (&binary.ids, &binary.points, &binary.surface_faces)
    );
    for (a, b) in text.displacements.iter().zip(&binary.displacements) {
        assert!((*a - *b).abs().max_element() <= 5.1e-6 * b.abs().max_element(), "{a} {b}");
    }
    assert_eq!(text.summary().elements, binary.summary().elements);
}

#[test]
fn bricks_and_wedges_get_the_nodes_between_their_corners() {
    let field = read(&data("fe/brick_and_wedge.frd.gz"));
    let kinds: Vec<(&str, usize)> =
        field.source.elements.iter().map(|count| (count.kind.as_str(), count.count)).collect();
    assert_eq!(kinds, [("C3D15", 1), ("C3D20", 1)]);
    assert_eq!((field.surface_nodes.as_ref().map(Vec::len), field.mid_sides.len()), (Some(35), 21));
    for &[mid, a, b] in &field.mid_sides {
        let [mid, a, b] = [mid, a, b].map(|node| field.points[node as usize]);
        assert_eq!(mid, (a + b) / 2.0);
    }
}

#[test]
fn steps_are_listed_with_their_times_and_modes_are_named() {
    let base = original("base.frd");
    let start = base.find("    1PSTEP").expect("a step");
    let step = base[start..].trim_end().trim_end_matches(" 9999").to_string();
    let frequency = |text: &str, time: &str| {
        text.replace(" 1.000000000", &format!("{time:>12}"))
            .replace("                     0    1 ", "                     2    1 ")
    };
    let text = format!("{}{step}{} 9999\n", &base[..start], frequency(&step, "1234.5"));
    let path = file("modes.frd", text);
    let field = read(&path);
    assert_says(&field.warnings.join("; "), &["step 1 (time 1), step 2 (frequency 1234.5)", "mode shape"]);
    assert_eq!(read_step(&path, 1).expect("step 1").warnings, [""; 0]);
    let steps = field.summary().steps;
    assert_eq!(
        (steps[1].number, steps[1].time, steps[1].step, steps[1].rows),
        (2, Some(1234.5), Some(1), 2425)
    );
}

#[test]
fn a_chosen_step_before_the_cut_is_used() {
    let text = crate::p5::variant("two_steps");
    let path = file("cut_second.frd", &text[..text.len() - 40_000]);
    assert_says(
        &crate::refusal("cut_second.frd", crate::fe::read(&path, &Default::default())),
        &["choose step 1"],
    );
    assert_says(&crate::refusal("cut_second.frd", read_step(&path, 2)), &["truncated", "of step 2"]);
    let field = read_step(&path, 1).expect("the complete step");
    assert_says(the_warning(&field), &["truncated", "step 1 before it is complete"]);
}

#[test]
fn an_end_at_a_block_border_is_doubted() {
    let text = original("base.frd").replace(" 9999\n", "");
    assert_says(the_warning(&read_text("no_end.frd", text)), &["9999"]);
}

#[test]
fn shells_and_unknown_elements_are_told() {
    let text =
        original("base.frd").replacen(" -1         1    6    0    1", " -1         1   13    0    1", 1);
    let field = read_text("unknown_element.frd", text);
    assert_says(&field.warnings.join("; "), &["not understood: 1 of type 13"]);
}

#[test]
fn gzipped_results_are_told_by_content() {
    let plain = read(&data("p5/base.frd.gz"));
    let odd_name = read_text("packed_without_its_ending.frd", packed(original("base.frd")));
    assert_same(&plain, &odd_name);
    assert!(
        odd_name.source.compressed && !read_text("not_packed.frd.gz", original("base.frd")).source.compressed
    );
}

#[test]
fn the_summary_tells_what_is_in_a_file() {
    let field = read(&data("p5/base.frd.gz"));
    let summary = serde_json::to_value(field.summary()).expect("plain values");
    let count = |name: &str| summary[name].as_u64();
    assert_eq!(
        (count("nodes"), count("nodes_with_result"), count("surface_nodes")),
        (Some(2425), Some(2425), Some(1434))
    );
    assert_eq!(summary["format"], "CalculiX results (.frd)");
    assert_eq!(summary["compressed"], true);
    assert_eq!(summary["unit_guess"], "mm");
    assert_eq!(summary["elements"], serde_json::json!([{ "kind": "C3D10", "count": 1250 }]));
    let blocks: Vec<&str> = summary["blocks"]
        .as_array()
        .expect("blocks")
        .iter()
        .filter_map(|block| block["name"].as_str())
        .collect();
    assert_eq!(blocks, ["nodes", "elements", "DISP"]);
    assert_eq!(summary["steps"][0]["time"], 1.0);
    assert_eq!(summary["bounds"][0][2], 0.0);
    assert_eq!(summary["bounds"][1][2], 40.0);
    let largest = &summary["largest_displacement"];
    let node = largest["node"].as_i64().expect("a node") as usize - 1;
    assert_eq!(largest["at"], serde_json::json!(field.points[node].to_array()));
    assert_eq!(largest["value"].as_f64(), Some(field.displacements[node].length()));
}
