//! Header lines of `.frd` files. Columns as the CalculiX GraphiX manual ("Result Format") gives
//! them, counted from 0 here.

use crate::fe::scan;

/// How the rows of a block are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coding {
    /// Text, numbers of nodes in five columns.
    Short,
    /// Text, numbers of nodes in ten columns.
    Long,
    /// Binary with single-precision values.
    Single,
    /// Binary with double-precision values.
    Double,
    /// The header does not say: text, to be told from the first row.
    Unstated,
}

/// What a block's header announces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Block {
    /// Number of nodes or elements to come.
    pub count: Option<usize>,
    /// How they are written.
    pub coding: Coding,
}

/// Header of a block of results.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Results {
    /// Size and coding.
    pub block: Block,
    /// Time, load factor or frequency.
    pub value: Option<f64>,
    /// Kind of analysis; 2 is a frequency step.
    pub analysis: i64,
}

/// A component of a result: `-5` line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Component {
    /// Its name.
    pub name: String,
    /// Whether the rows hold it, or a reader is to compute it.
    pub stored: bool,
}

/// A line outside the rows of a block.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Record {
    /// Nothing in it.
    Blank,
    /// Text for people, and parameters of no interest here.
    Note,
    /// Numbers of the step and of the increment in it.
    Step { increment: i64, step: i64 },
    /// Nodes follow.
    Nodes(Block),
    /// Elements follow.
    Elements(Block),
    /// Results follow, of the kind the next line names.
    Results(Results),
    /// Name of the results.
    Attribute(String),
    /// The end of the data.
    End,
    /// None of these.
    Unknown,
}

impl Record {
    /// Tells what a line is.
    pub fn of(line: &[u8]) -> Self {
        let text = scan::trim(line);
        if text.is_empty() {
            return Record::Blank;
        }
        let Some((key, rest)) = scan::integer(text) else { return Record::Unknown };
        match (key, rest.first()) {
            (-4, _) => Record::Attribute(word(rest)),
            (9999, None) => Record::End,
            (1, Some(b'P')) if rest.starts_with(b"PSTEP") => step(&rest[5..]),
            (1, Some(b'C' | b'U' | b'P')) => Record::Note,
            (2, Some(b'C')) => Record::Nodes(Block::of(line)),
            (3, Some(b'C')) => Record::Elements(Block::of(line)),
            (100, Some(b'C')) => Record::Results(Results::of(line)),
            _ => Record::Unknown,
        }
    }
}

impl Block {
    fn of(line: &[u8]) -> Self {
        let coding = match column(line, 73, 75) {
            Some(0) => Coding::Short,
            Some(1) => Coding::Long,
            Some(2) => Coding::Single,
            Some(3) => Coding::Double,
            _ => Coding::Unstated,
        };
        Self { count: column(line, 24, 36).and_then(|count| usize::try_from(count).ok()), coding }
    }
}

impl Results {
    fn of(line: &[u8]) -> Self {
        let value = line.get(12..24).and_then(|text| scan::whole_number(text, true));
        Self { block: Block::of(line), value, analysis: column(line, 56, 58).unwrap_or(0) }
    }
}

impl Component {
    /// Reads a `-5` line; `None` for any other.
    pub fn of(line: &[u8]) -> Option<Self> {
        let rest = scan::trim(line).strip_prefix(b"-5")?;
        Some(Self { name: word(rest), stored: column(line, 33, 38) != Some(1) })
    }
}

fn step(text: &[u8]) -> Record {
    let read = || {
        let (_, rest) = scan::integer(text)?;
        let (increment, rest) = scan::integer(rest)?;
        let (step, _) = scan::integer(rest)?;
        Some(Record::Step { increment, step })
    };
    read().unwrap_or(Record::Note)
}

fn word(text: &[u8]) -> String {
    let text = scan::skip_blanks(text);
    let length = text.iter().take_while(|byte| byte.is_ascii_graphic()).count();
    String::from_utf8_lossy(&text[..length]).into_owned()
}

/// The integer in columns `first..end`, of which the line may lack the last.
fn column(line: &[u8], first: usize, end: usize) -> Option<i64> {
    scan::whole_integer(line.get(first..end.min(line.len()))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_of_calculix_are_understood() {
        let nodes = format!("    2C{:18}{:12}{:37}1", "", 51294, "");
        assert_eq!(
            Record::of(nodes.as_bytes()),
            Record::Nodes(Block { count: Some(51294), coding: Coding::Long })
        );
        let results =
            format!("  100CL  101{:>12}{:12}{:20}{:2}{:5}{:10}{:2}", "1.250000000", 35, "", 2, 1, "", 0);
        let block = Block { count: Some(35), coding: Coding::Short };
        let expected = Results { block, value: Some(1.25), analysis: 2 };
        assert_eq!(Record::of(results.as_bytes()), Record::Results(expected));
        let step = b"    1PSTEP                         2           4           1          ";
        assert_eq!(Record::of(step), Record::Step { increment: 4, step: 1 });
        assert_eq!(Record::of(b" -4  DISP        4    1"), Record::Attribute("DISP".into()));
        assert_eq!(Record::of(b" 9999"), Record::End);
        assert_eq!(Record::of(b"    1UDATE              22.november.2026"), Record::Note);
    }

    #[test]
    fn computed_components_are_told_from_stored_ones() {
        let stored = Component::of(b" -5  D1          1    2    1    0").unwrap();
        assert_eq!(stored, Component { name: "D1".into(), stored: true });
        assert!(!Component::of(b" -5  ALL         1    2    0    0    1ALL").unwrap().stored);
        assert_eq!(Component::of(b" -1         1 1.00000E+00"), None);
    }

    #[test]
    fn bare_headers_say_nothing_and_garbage_is_unknown() {
        assert_eq!(Record::of(b"    2C"), Record::Nodes(Block { count: None, coding: Coding::Unstated }));
        for text in ["solid ascii", "1,2,3,4", "-1 5", "99999", "id,x,y,z"] {
            assert_eq!(Record::of(text.as_bytes()), Record::Unknown, "{text}");
        }
    }
}
