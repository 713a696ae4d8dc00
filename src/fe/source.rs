//! What was found in the files of a field: format, blocks, steps, elements.

use serde::Serialize;

/// What kind of file a field came from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub enum Format {
    /// Arrays, handed over by a program.
    #[default]
    #[serde(rename = "arrays")]
    Arrays,
    /// CalculiX results.
    #[serde(rename = "CalculiX results (.frd)")]
    Results,
    /// A table of nodes.
    #[serde(rename = "table of nodes (CSV)")]
    Table,
}

/// A block of a results file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Block {
    /// `nodes`, `elements`, or the name of the results (`DISP`, `STRESS`, …).
    pub name: String,
    /// Number of rows.
    pub rows: usize,
}

/// A set of displacements in a results file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Step {
    /// Number among the sets of displacements, from 1: what a user chooses by.
    pub number: usize,
    /// The solver's number of the step, if it is given.
    pub step: Option<i64>,
    /// The solver's number of the increment in the step, if it is given.
    pub increment: Option<i64>,
    /// Time, load factor, or frequency, if it is given.
    pub time: Option<f64>,
    /// Whether the displacements are a mode shape, and `time` its frequency.
    pub frequency: bool,
    /// Number of rows.
    pub rows: usize,
}

impl Step {
    /// Number and time, for messages.
    pub fn label(&self) -> String {
        match self.time {
            Some(time) if self.frequency => format!("step {} (frequency {time})", self.number),
            Some(time) => format!("step {} (time {time})", self.number),
            None => format!("step {}", self.number),
        }
    }
}

/// Number of elements of one kind.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ElementCount {
    /// Name of the kind in an Abaqus or CalculiX deck.
    pub kind: String,
    /// How many there are.
    pub count: usize,
}

/// Where a field came from.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Source {
    /// Kind of file.
    pub format: Format,
    /// Whether it is gzipped.
    pub compressed: bool,
    /// The deck that gave the coordinates.
    pub mesh: Option<String>,
    /// Blocks in the file's order.
    pub blocks: Vec<Block>,
    /// Sets of displacements, in the file's order.
    pub steps: Vec<Step>,
    /// Elements by kind, from the results or else from the deck.
    pub elements: Vec<ElementCount>,
}

impl Source {
    /// Names of the blocks with their sizes, for messages.
    pub(super) fn found(&self) -> String {
        if self.blocks.is_empty() {
            return "no block at all".into();
        }
        let names: Vec<String> =
            self.blocks.iter().map(|block| format!("{} ({} rows)", block.name, block.rows)).collect();
        names.join(", ")
    }

    /// The steps with their times, for messages: all of them, or the first and last few.
    pub(super) fn list_steps(&self) -> String {
        const SHOWN: usize = 6;
        let labels: Vec<String> = self.steps.iter().map(Step::label).collect();
        if labels.len() <= 2 * SHOWN {
            return labels.join(", ");
        }
        format!("{}, …, {}", labels[..SHOWN].join(", "), labels[labels.len() - SHOWN..].join(", "))
    }
}
