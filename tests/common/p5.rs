//! The small field files of `tests/data/p5`, and broken or awkward ones made from them.

use flate2::read::GzDecoder;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Where the packed originals lie.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/p5")
}

/// The text of a packed original, such as `base.frd` or `truth/base.csv`.
pub fn original(name: &str) -> String {
    let path = folder().join(format!("{name}.gz"));
    let packed = std::fs::read(&path).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()));
    let mut text = String::new();
    GzDecoder::new(&packed[..]).read_to_string(&mut text).expect("packed text");
    text
}

/// The variants that are also shared as files; [`variant`] makes one more, `no_elements`.
pub const VARIANTS: [&str; 17] = [
    "crlf",
    "disp_metres_only",
    "duplicate_nodes",
    "empty",
    "gaps_shuffled",
    "huge_disp",
    "metres",
    "mirrored",
    "nan",
    "no_disp",
    "not_frd",
    "other_frame",
    "partial_disp",
    "partial_face",
    "truncated",
    "two_steps",
    "zero_disp",
];

/// A variant of `base.frd`, by name.
pub fn variant(name: &str) -> String {
    let base = Frd::base();
    match name {
        "crlf" => original("base.frd").replace('\n', "\r\n"),
        "disp_metres_only" => base.with_displacements(|_, u| u.map(|c| c * 1e-3)),
        "duplicate_nodes" => base.with_duplicates(&[3, 50, 300], 0.25),
        "empty" => String::new(),
        "gaps_shuffled" => base.renumbered_and_shuffled(),
        "huge_disp" => base.with_displacements(|_, u| u.map(|c| c * 1e3)),
        "metres" => base.mapped(|p| p.map(|c| c * 1e-3), |u| u.map(|c| c * 1e-3)),
        "mirrored" => base.mapped(|[x, y, z]| [x, -y, z], |[x, y, z]| [x, -y, z]),
        "nan" => base.with_not_a_number(|id| id % 411 == 7),
        "no_elements" => base.without_elements(),
        "no_disp" => text(&[&base.lines[..base.step], &[" 9999".into()]]),
        "not_frd" => "solid ascii\nfacet normal 0 0 1\n".into(),
        "other_frame" => base.mapped(|[x, y, z]| [-y + 12.5, x - 3.0, z + 40.0], |[x, y, z]| [-y, x, z]),
        "partial_disp" => base.partial(false),
        "partial_face" => base.partial(true),
        "truncated" => base.truncated(),
        "two_steps" => base.with_half_load_first(),
        "zero_disp" => base.with_displacements(|_, _| [0.0; 3]),
        _ => panic!("no variant '{name}'"),
    }
}

/// The lines of `base.frd` and where its blocks stand.
struct Frd {
    lines: Vec<String>,
    /// Header and end of the nodes.
    nodes: [usize; 2],
    /// First line of the step.
    step: usize,
    /// Name and end of the displacements.
    displacements: [usize; 2],
}

type Vector = [f64; 3];

/// A number in twelve columns with five decimals.
fn column(value: f64) -> String {
    let text = format!("{value:.5E}");
    let (mantissa, exponent) = text.split_once('E').expect("an exponent");
    let exponent: i32 = exponent.parse().expect("an exponent");
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{:>12}", format!("{mantissa}E{sign}{:02}", exponent.abs()))
}

fn row(id: i64, vector: Vector) -> String {
    format!(" -1{id:10}{}", vector.map(column).concat())
}

/// Number and vector of a row; `None` for other lines.
fn parsed(line: &str) -> Option<(i64, Vector)> {
    let rest = line.strip_prefix(" -1")?;
    let value = |k: usize| rest[10 + 12 * k..22 + 12 * k].trim().parse().expect("a number");
    Some((rest[..10].trim().parse().expect("a node number"), [0, 1, 2].map(value)))
}

fn text(parts: &[&[String]]) -> String {
    parts.iter().flat_map(|lines| lines.iter()).map(|line| format!("{line}\n")).collect()
}

impl Frd {
    fn base() -> Self {
        let lines: Vec<String> = original("base.frd").lines().map(String::from).collect();
        let find = |from: usize, start: &str| {
            from + lines[from..].iter().position(|line| line.starts_with(start)).expect("a block")
        };
        let nodes = find(0, "    2C");
        let displacements = find(0, " -4  DISP");
        Self {
            nodes: [nodes, find(nodes, " -3")],
            step: find(0, "    1PSTEP"),
            displacements: [displacements, find(displacements, " -3")],
            lines,
        }
    }

    fn rows(&self, [start, end]: [usize; 2]) -> impl Iterator<Item = (i64, Vector)> {
        self.lines[start..end].iter().filter_map(|line| parsed(line))
    }

    fn replaced(
        &self,
        [start, end]: [usize; 2],
        new: impl Fn(&str, i64, Vector) -> Vec<String>,
    ) -> Vec<String> {
        let rewrite = |(k, line): (usize, &String)| {
            let inside = start < k && k < end;
            match inside.then(|| parsed(line)).flatten() {
                Some((id, vector)) => new(line, id, vector),
                None => vec![line.clone()],
            }
        };
        self.lines.iter().enumerate().flat_map(rewrite).collect()
    }

    fn with_displacements(&self, map: impl Fn(i64, Vector) -> Vector) -> String {
        text(&[&self.replaced(self.displacements, |_, id, u| vec![row(id, map(id, u))])])
    }

    fn mapped(&self, place: impl Fn(Vector) -> Vector, turn: impl Fn(Vector) -> Vector) -> String {
        let moved = Frd { lines: self.replaced(self.nodes, |_, id, p| vec![row(id, place(p))]), ..*self };
        moved.with_displacements(|_, u| turn(u))
    }

    fn with_not_a_number(&self, broken: impl Fn(i64) -> bool) -> String {
        let spoil = |line: &str, id: i64, _| {
            vec![if broken(id) {
                format!(" -1{id:10}{}", "         NaN".repeat(3))
            } else {
                line.to_string()
            }]
        };
        text(&[&self.replaced(self.displacements, spoil)])
    }

    fn with_duplicates(&self, ids: &[i64], shift: f64) -> String {
        let double = |line: &str, id: i64, u: Vector| {
            let second = ids.contains(&id).then(|| row(id, u.map(|c| c + shift)));
            std::iter::once(line.to_string()).chain(second).collect()
        };
        text(&[&self.replaced(self.displacements, double)])
    }

    /// Header lines of the displacements, from the step to the first row.
    fn step_header(&self) -> &[String] {
        let first = self.lines[self.displacements[0]..].iter().position(|line| line.starts_with(" -1"));
        &self.lines[self.step..self.displacements[0] + first.expect("rows")]
    }

    /// Displacements below z = 26 only, and with `nodes_too` the nodes alike and no elements.
    fn partial(&self, nodes_too: bool) -> String {
        let low: Vec<i64> =
            self.rows(self.nodes).filter(|(_, [_, _, z])| *z < 26.0).map(|(id, _)| id).collect();
        let selected = |block| -> Vec<String> {
            self.rows(block)
                .filter(|(id, _)| low.binary_search(id).is_ok())
                .map(|(id, v)| row(id, v))
                .collect()
        };
        let (end, last) = (vec![" -3".to_string()], vec![" 9999".to_string()]);
        let results = selected(self.displacements);
        if !nodes_too {
            return text(&[&self.lines[..self.step], self.step_header(), &results, &end, &last]);
        }
        let nodes = selected(self.nodes);
        text(&[&self.lines[..=self.nodes[0]], &nodes, &end, self.step_header(), &results, &end, &last])
    }

    fn without_elements(&self) -> String {
        text(&[&self.lines[..=self.nodes[1]], &self.lines[self.step..]])
    }

    fn truncated(&self) -> String {
        let [start, end] = self.displacements;
        let mut cut = text(&[&self.lines[..start + (end - start) * 2 / 3]]);
        cut.truncate(cut.len() - 18);
        cut
    }

    fn with_half_load_first(&self) -> String {
        let [start, end] = self.displacements;
        let half = self.lines[start..=end].iter().map(|line| match parsed(line) {
            Some((id, u)) => row(id, u.map(|c| 0.5 * c)),
            None => line.clone(),
        });
        let second = self.lines[self.step..start].iter().map(|line| {
            line.replace("         1           1           1", "         2           1           2")
        });
        let between: Vec<String> = half.chain(second).collect();
        text(&[&self.lines[..start], &between, &self.lines[start..]])
    }

    /// Node numbers up to 1.5 million with gaps, and rows in another order in each block.
    fn renumbered_and_shuffled(&self) -> String {
        let number = |id: i64| 7 * id + 1_000_000 + 500_000 * (id % 3);
        let mixed = |block, seed: u64| -> Vec<String> {
            let mut rows: Vec<(u64, String)> =
                self.rows(block).map(|(id, v)| (mix(id as u64 ^ seed), row(number(id), v))).collect();
            rows.sort();
            rows.into_iter().map(|(_, row)| row).collect()
        };
        let end = vec![" -3".to_string()];
        text(&[
            &self.lines[..=self.nodes[0]],
            &mixed(self.nodes, 1 << 40),
            &end,
            self.step_header(),
            &mixed(self.displacements, 1 << 50),
            &end,
            &[" 9999".to_string()],
        ])
    }
}

/// A number that looks random but is always the same (the finaliser of SplitMix64).
pub fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
