//! CalculiX results (`.frd`): nodes, elements and displacements, in one pass over the stream.
//!
//! Text files with short or long node numbers, and the binary ones that `*NODE OUTPUT` asks for.
//! Each `DISP` block counts as one step. Everything else is skipped, but remembered by name.

mod header;
mod rows;

use crate::error::Result;
use crate::fe::elements::Elements;
use crate::fe::input::Input;
use crate::fe::nodes::Rows;
use crate::fe::source::{Block, Format, Source, Step};
use header::{Coding, Component, Record};
use rows::Extent;

/// Name of the displacements among the results.
const DISPLACEMENTS: &str = "DISP";

/// What messages call the block of elements.
const ELEMENTS: &str = "the elements";

/// What a results file holds, as far as it concerns a field.
#[derive(Debug, Default)]
pub(super) struct Results {
    /// Nodes with coordinates, in the file's order.
    pub nodes: Rows,
    /// Nodes with displacements in the step used.
    pub displacements: Rows,
    /// Elements of all blocks.
    pub elements: Elements,
    /// Format, blocks and steps.
    pub source: Source,
    /// Step used, from 1.
    pub step: usize,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Whether a file that begins with this line looks like CalculiX results.
pub(super) fn begins_with(line: &[u8]) -> bool {
    !matches!(Record::of(line), Record::Blank | Record::Unknown | Record::Attribute(_) | Record::End)
}

/// Reads the nodes, the elements and the displacements of one step (from 1; `None`: the last).
///
/// # Errors
/// [`crate::Error::Field`] for malformed lines, a file that ends inside a block, no displacements,
/// or a step that is not there.
pub(super) fn read(input: &mut Input, wanted: Option<usize>) -> Result<Results> {
    let mut reader = Reader {
        input,
        wanted,
        results: Results::default(),
        header: None,
        numbers: None,
        complete_steps: 0,
        ended: false,
        strays: (0, 0),
    };
    reader.records()?;
    reader.finish()
}

struct Reader<'a> {
    input: &'a mut Input,
    wanted: Option<usize>,
    results: Results,
    /// Header of the results to come.
    header: Option<header::Results>,
    /// Step and increment of the results to come.
    numbers: Option<(i64, i64)>,
    /// Steps whose displacements came whole.
    complete_steps: usize,
    ended: bool,
    /// Lines not understood: how many, and the first.
    strays: (usize, usize),
}

impl Reader<'_> {
    fn records(&mut self) -> Result<()> {
        while let Some(line) = self.input.next_line()? {
            let (what, announced, extent) = match Record::of(line) {
                Record::Nodes(block) => ("the nodes".to_string(), block.count, self.nodes(block)?),
                Record::Elements(block) => (ELEMENTS.to_string(), block.count, self.elements(block)?),
                Record::Attribute(name) => self.values(name)?,
                other => {
                    self.note(other);
                    continue;
                }
            };
            if !extent.closed {
                return self.cut_off(&what, announced, extent.rows);
            }
        }
        Ok(())
    }

    fn note(&mut self, record: Record) {
        match record {
            Record::Step { increment, step } => self.numbers = Some((step, increment)),
            Record::Results(header) => self.header = Some(header),
            Record::End => self.ended = true,
            Record::Unknown => {
                let first = if self.strays.0 == 0 { self.input.line() } else { self.strays.1 };
                self.strays = (self.strays.0 + 1, first);
            }
            _ => (),
        }
    }

    fn warn(&mut self, text: String) {
        self.results.warnings.push(text);
    }

    fn add_block(&mut self, name: &str, rows: usize) {
        self.results.source.blocks.push(Block { name: name.to_string(), rows });
    }

    fn nodes(&mut self, block: header::Block) -> Result<Extent> {
        let rows = Some(&mut self.results.nodes);
        let extent = vectors(self.input, block, 3, rows)?;
        self.add_block("nodes", extent.rows);
        self.check_count("nodes", block.count, extent);
        Ok(extent)
    }

    fn elements(&mut self, block: header::Block) -> Result<Extent> {
        let elements = &mut self.results.elements;
        let extent = match (block.coding, block.count) {
            (Coding::Single | Coding::Double, Some(count)) => {
                rows::binary_elements(self.input, count, elements)?
            }
            _ => rows::text_elements(self.input, block.coding, elements)?,
        };
        self.add_block("elements", extent.rows);
        self.check_count("elements", block.count, extent);
        Ok(extent)
    }

    fn check_count(&mut self, what: &str, announced: Option<usize>, extent: Extent) {
        let rows = extent.rows;
        if let Some(count) = announced.filter(|&count| extent.closed && count != rows) {
            self.warn(format!("the header announces {count} {what}, the block holds {rows}"));
        }
    }

    /// Reads the results of that name; returns what they are, how many were announced and read.
    fn values(&mut self, name: String) -> Result<(String, Option<usize>, Extent)> {
        let components = self.components()?;
        let header = self.header.take();
        let block =
            header.map_or(header::Block { count: None, coding: Coding::Unstated }, |header| header.block);
        let mut what = format!("the results {name}");
        let mut rows = None;
        if name == DISPLACEMENTS {
            let number = self.add_step(header);
            what = format!("the displacements (DISP) of step {number}");
            if self.wanted.is_none_or(|wanted| wanted == number) {
                self.check_components(&components)?;
                self.results.step = number;
                self.results.displacements.clear();
                rows = Some(&mut self.results.displacements);
            }
        }
        let extent = vectors(self.input, block, components.len(), rows)?;
        if let Some(step) = self.results.source.steps.last_mut().filter(|_| name == DISPLACEMENTS) {
            step.rows = extent.rows;
            self.complete_steps += usize::from(extent.closed);
        }
        self.add_block(&name, extent.rows);
        Ok((what, block.count, extent))
    }

    /// The stored components that the lines after a result's name declare.
    fn components(&mut self) -> Result<Vec<Component>> {
        let mut components = Vec::new();
        while let Some(line) = self.input.next_line()? {
            match Component::of(line) {
                Some(component) if component.stored => components.push(component),
                Some(_) => (),
                None => {
                    self.input.put_back();
                    break;
                }
            }
        }
        Ok(components)
    }

    fn check_components(&self, components: &[Component]) -> Result<()> {
        let names: Vec<&str> = components.iter().map(|component| component.name.as_str()).collect();
        if names.get(..3) == Some(&["D1", "D2", "D3"]) {
            return Ok(());
        }
        let found = if names.is_empty() { "none".to_string() } else { names.join(", ") };
        Err(self.input.error(format!("the displacements must have components D1, D2, D3; found {found}")))
    }

    fn add_step(&mut self, header: Option<header::Results>) -> usize {
        let (step, increment) = self.numbers.take().unzip();
        let steps = &mut self.results.source.steps;
        steps.push(Step {
            number: steps.len() + 1,
            step,
            increment,
            time: header.and_then(|header| header.value),
            frequency: header.is_some_and(|header| header.analysis == 2),
            rows: 0,
        });
        steps.len()
    }

    /// The file ends inside a block: an error, unless the step asked for by number came whole.
    fn cut_off(&mut self, what: &str, announced: Option<usize>, read: usize) -> Result<()> {
        let of = announced.map_or(String::new(), |count| format!(" of {count}"));
        let unit = if what == ELEMENTS { "elements" } else { "nodes" };
        let ends = format!("the file is truncated: it ends inside {what}, {read}{of} {unit} read");
        if self.wanted.is_some_and(|wanted| wanted <= self.complete_steps) {
            self.ended = true;
            self.warn(format!("{ends}; step {} before it is complete", self.results.step));
            return Ok(());
        }
        let advice = match self.complete_steps {
            0 => "solve again or copy the file again".to_string(),
            step => format!("solve again, or choose step {step}, the last complete one"),
        };
        Err(self.input.error(format!("{ends}; {advice}")))
    }

    fn finish(mut self) -> Result<Results> {
        let source = &mut self.results.source;
        source.format = Format::Results;
        source.compressed = self.input.compressed();
        source.elements = self.results.elements.counts();
        self.check_found()?;
        let (strays, first) = self.strays;
        if strays > 0 {
            self.warn(format!(
                "lines that are not understood and skipped: {strays}, the first is line {first}"
            ));
        }
        if !self.ended {
            self.warn("the file lacks its last line (9999): perhaps it is not complete".into());
        }
        Ok(self.results)
    }

    fn check_found(&mut self) -> Result<()> {
        let source = &self.results.source;
        let steps = source.steps.len();
        if self.results.nodes.len() == 0 {
            return Err(self.no_line(format!("no nodes in it; found: {}", source.found())));
        }
        if steps == 0 {
            let found = source.found();
            return Err(self.no_line(format!(
                "no displacements (DISP) in it; found: {found}. Ask for U under *NODE FILE and solve again"
            )));
        }
        if self.results.step == 0 {
            let wanted = self.wanted.unwrap_or(0);
            return Err(self.no_line(format!("step {wanted} is not in it; it has {}", source.list_steps())));
        }
        let used = &source.steps[self.results.step - 1];
        let mut warnings = Vec::new();
        if steps > 1 && self.wanted.is_none() {
            let all = source.list_steps();
            warnings.push(format!("{steps} steps with displacements; the last is used of {all}"));
        }
        if used.frequency {
            warnings.push(format!("{} is a mode shape: its size means nothing", used.label()));
        }
        self.results.warnings.extend(warnings);
        Ok(())
    }

    fn no_line(&self, why: String) -> crate::Error {
        crate::Error::Field { path: self.input.path().to_string(), line: 0, why }
    }
}

/// Reads a block of vectors with that many components, or only counts its rows.
fn vectors(
    input: &mut Input,
    block: header::Block,
    components: usize,
    rows: Option<&mut Rows>,
) -> Result<Extent> {
    match (block.coding, block.count) {
        (Coding::Single | Coding::Double, Some(count)) => {
            rows::binary_vectors(input, block.coding == Coding::Double, count, components, rows)
        }
        _ => rows::text_vectors(input, block.coding, components, rows),
    }
}
