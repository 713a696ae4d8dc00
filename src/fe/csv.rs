//! Tables of nodes: `id,x,y,z,dx,dy,dz` with a header or without, also without the id.
//!
//! Columns are separated by semicolons, tabs, commas or blanks, told from the first line; unless
//! they are commas, a comma may be the decimal mark. A byte-order mark, lines that begin with `#`,
//! quotation marks, and with a header columns of other names are passed over.

mod header;

use super::assemble::Parts;
use super::input::Input;
use super::nodes::Rows;
use super::scan;
use super::source::Format;
use crate::error::{Error, Result};
use glam::DVec3;
use header::Columns;

/// What stands between the columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    Byte(u8),
    Blanks,
}

impl Separator {
    fn of(line: &[u8]) -> Self {
        let used = [b';', b'\t', b','].into_iter().find(|byte| line.contains(byte));
        used.map_or(Separator::Blanks, Separator::Byte)
    }

    /// Whether a comma may be a decimal mark.
    fn leaves_comma(self) -> bool {
        self != Separator::Byte(b',')
    }

    fn cells(self, line: &[u8]) -> Vec<&[u8]> {
        match self {
            Separator::Byte(byte) => line.split(|&other| other == byte).map(cell).collect(),
            Separator::Blanks => line
                .split(|byte| matches!(byte, b' ' | b'\t'))
                .filter(|cell| !cell.is_empty())
                .map(cell)
                .collect(),
        }
    }
}

fn cell(text: &[u8]) -> &[u8] {
    let text = scan::trim(text);
    match text {
        [b'"', inner @ .., b'"'] => scan::trim(inner),
        _ => text,
    }
}

/// How a table is laid out.
struct Layout {
    separator: Separator,
    columns: Columns,
}

/// The row of a node: number, if there is one, position, and displacement, if there is one.
type NodeRow = (Option<i64>, DVec3, Option<DVec3>);

/// Reads a table; without ids the nodes are numbered from 1 as they come.
///
/// # Errors
/// [`Error::Field`] with the line, for anything but such a table.
pub(super) fn read(input: &mut Input) -> Result<Parts> {
    let name = input.path().to_string();
    let (layout, mut after_header) = layout(input)?;
    let (mut nodes, mut displacements) = (Rows::default(), Rows::default());
    while let Some(line) = next_row(input)? {
        let cells = layout.separator.cells(line);
        let is_units =
            std::mem::take(&mut after_header) && !cells.iter().any(|cell| layout.number(cell).is_some());
        if is_units {
            continue;
        }
        let (id, position, displacement) = match layout.row(&cells) {
            Ok(row) => row,
            Err(why) => return Err(input.error(why)),
        };
        let id = id.unwrap_or(nodes.len() as i64 + 1);
        nodes.push(id, position);
        if let Some(displacement) = displacement {
            displacements.push(id, displacement);
        }
    }
    if nodes.len() == 0 {
        return Err(Error::Field { path: name, line: 0, why: "the table has no rows".into() });
    }
    let mut parts = Parts::of_table(name, nodes, displacements);
    parts.source.format = Format::Table;
    parts.source.compressed = input.compressed();
    Ok(parts)
}

/// The next line that is no comment and not blank, without a byte-order mark.
fn next_row(input: &mut Input) -> Result<Option<&[u8]>> {
    loop {
        match input.next_line()? {
            None => return Ok(None),
            Some(line) => {
                let text = scan::trim(scan::without_mark(line));
                if !text.is_empty() && text[0] != b'#' {
                    input.put_back();
                    break;
                }
            }
        }
    }
    Ok(input.next_line()?.map(scan::without_mark))
}

/// The layout, and whether a header told it; a first row of numbers comes again.
fn layout(input: &mut Input) -> Result<(Layout, bool)> {
    let Some(line) = next_row(input)? else {
        return Err(Error::Field {
            path: input.path().to_string(),
            line: 0,
            why: "only comments in it".into(),
        });
    };
    let separator = Separator::of(line);
    let cells = separator.cells(line);
    let is_number =
        |cell: &&[u8]| cell.is_empty() || scan::whole_number(cell, separator.leaves_comma()).is_some();
    let numbers = cells.iter().all(is_number);
    let excerpt = scan::excerpt(line);
    if cells.len() < 3 {
        return Err(input.error(format!(
            "neither CalculiX results (.frd) nor a table id,x,y,z,dx,dy,dz: it begins with '{excerpt}'"
        )));
    }
    let columns = if numbers { Columns::by_place(&cells) } else { Columns::by_name(&cells) };
    let columns = columns.map_err(|why| input.error(why))?;
    if numbers {
        input.put_back();
    }
    Ok((Layout { separator, columns }, !numbers))
}

impl Layout {
    fn number(&self, cell: &[u8]) -> Option<f64> {
        scan::whole_number(cell, self.separator.leaves_comma())
    }

    fn row(&self, cells: &[&[u8]]) -> std::result::Result<NodeRow, String> {
        let width = self.columns.width;
        let trailing = cells.len() == width + 1 && cells[width].is_empty();
        if cells.len() != width && !trailing {
            let hint = if self.separator.leaves_comma() {
                ""
            } else {
                "; where a comma is the decimal mark, separate the columns by semicolons"
            };
            return Err(format!("expected {width} columns, found {}{hint}", cells.len()));
        }
        let id = self.columns.id.map(|column| self.id(cells[column])).transpose()?;
        let position = self.vector(cells, self.columns.position)?;
        let empty = self.columns.displacement.iter().all(|&column| cells[column].is_empty());
        let displacement = if empty { None } else { Some(self.vector(cells, self.columns.displacement)?) };
        Ok((id, position, displacement))
    }

    fn id(&self, cell: &[u8]) -> std::result::Result<i64, String> {
        const LARGEST: f64 = (1i64 << 53) as f64;
        let whole = |value: f64| (value.fract() == 0.0 && value.abs() < LARGEST).then_some(value as i64);
        scan::whole_integer(cell)
            .or_else(|| self.number(cell).and_then(whole))
            .ok_or_else(|| format!("expected a node number, found '{}'", scan::excerpt(cell)))
    }

    fn vector(&self, cells: &[&[u8]], columns: [usize; 3]) -> std::result::Result<DVec3, String> {
        let mut vector = [0.0; 3];
        for (value, column) in vector.iter_mut().zip(columns) {
            *value = self.number(cells[column]).ok_or_else(|| {
                format!(
                    "expected a number in column {}, found '{}'",
                    column + 1,
                    scan::excerpt(cells[column])
                )
            })?;
        }
        Ok(vector.into())
    }
}
