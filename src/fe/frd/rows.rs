//! Rows of `.frd` blocks: text in short or long columns, and binary records.

use super::header::Coding;
use crate::error::Result;
use crate::fe::elements::{ElementKind, Elements};
use crate::fe::input::Input;
use crate::fe::nodes::Rows;
use crate::fe::scan;
use glam::DVec3;

/// How far a block was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Extent {
    /// Complete rows.
    pub rows: usize,
    /// Whether the block's end came; if not, the file ends inside it.
    pub closed: bool,
}

/// What the first columns of a text line say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mark {
    Row,
    More,
    End,
    Blank,
    Other,
}

impl Mark {
    fn of(line: &[u8]) -> Self {
        match line.get(..3) {
            Some(b" -1") => Mark::Row,
            Some(b" -2") => Mark::More,
            Some(b" -3") => Mark::End,
            _ if scan::trim(line).is_empty() => Mark::Blank,
            _ => Mark::Other,
        }
    }
}

/// Columns of a node number, told from the first row where the header does not say.
fn id_width(coding: Coding, line: &[u8]) -> usize {
    match coding {
        Coding::Short => 5,
        Coding::Unstated if line.get(3..13).is_none_or(|text| scan::whole_integer(text).is_none()) => 5,
        _ => 10,
    }
}

/// Reads text rows of a number and `components` values, of which the first three go into `rows`, or
/// only counts the rows.
pub(super) fn text_vectors(
    input: &mut Input,
    coding: Coding,
    components: usize,
    mut rows: Option<&mut Rows>,
) -> Result<Extent> {
    let mut extent = Extent { rows: 0, closed: false };
    loop {
        let Some(line) = input.next_line()? else { return Ok(extent) };
        let (mark, width) = (Mark::of(line), id_width(coding, line));
        let row =
            if mark == Mark::Row && rows.is_some() { vector_row(line, width, components) } else { None };
        match mark {
            Mark::End => return Ok(Extent { closed: true, ..extent }),
            Mark::Blank | Mark::More => continue,
            Mark::Row | Mark::Other if input.unterminated() => return Ok(extent),
            Mark::Other => return Err(unexpected(input, "a row (-1) or the end of the block (-3)")),
            Mark::Row => extent.rows += 1,
        }
        match (&mut rows, row) {
            (Some(rows), Some((id, vector))) => rows.push(id, vector),
            (Some(_), None) => {
                return Err(unexpected(input, &format!("-1, a number in {width} columns and three values")));
            }
            (None, _) => (),
        }
    }
}

/// An error that quotes the line last read.
fn unexpected(input: &mut Input, expected: &str) -> crate::Error {
    input.put_back();
    let found = match input.next_line() {
        Ok(Some(line)) => scan::excerpt(line),
        _ => String::new(),
    };
    input.error(format!("expected {expected}, found '{found}'"))
}

fn vector_row(line: &[u8], width: usize, components: usize) -> Option<(i64, DVec3)> {
    let id = scan::whole_integer(line.get(3..3 + width)?)?;
    let values = &line[3 + width..];
    // One digit stands before the decimal mark: more of them means that the number ran over.
    let overrun = values.iter().take(2).all(u8::is_ascii_digit) && !values.len().is_multiple_of(12);
    let (x, rest) = scan::number(values, true)?;
    let (y, rest) = scan::number(rest, true)?;
    let (z, rest) = scan::number(rest, true)?;
    let complete = components > 3 || scan::trim(rest).is_empty();
    (complete && !overrun).then_some((id, DVec3::new(x, y, z)))
}

/// Reads `count` binary records of a number and `components` values, keeping the first three.
pub(super) fn binary_vectors(
    input: &mut Input,
    double: bool,
    count: usize,
    components: usize,
    mut rows: Option<&mut Rows>,
) -> Result<Extent> {
    let size = if double { 8 } else { 4 };
    for row in 0..count {
        let Some(record) = input.take(4 + size * components)? else {
            return Ok(Extent { rows: row, closed: false });
        };
        if let Some(rows) = &mut rows {
            let value = |k: usize| float(&record[4 + size * k..4 + size * (k + 1)]);
            rows.push(int(&record[..4]), DVec3::new(value(0), value(1), value(2)));
        }
    }
    Ok(Extent { rows: count, closed: true })
}

fn int(bytes: &[u8]) -> i64 {
    bytes.try_into().map_or(0, |bytes| i64::from(i32::from_le_bytes(bytes)))
}

fn float(bytes: &[u8]) -> f64 {
    match bytes.try_into() {
        Ok(bytes) => f64::from_le_bytes(bytes),
        Err(_) => bytes.try_into().map_or(f64::NAN, |bytes| f64::from(f32::from_le_bytes(bytes))),
    }
}

/// Reads text rows of elements.
pub(super) fn text_elements(input: &mut Input, coding: Coding, elements: &mut Elements) -> Result<Extent> {
    let mut extent = Extent { rows: 0, closed: false };
    let mut open: Option<(i64, usize)> = None;
    let mut width = id_width(coding, b"");
    loop {
        let Some(line) = input.next_line()? else { return Ok(extent) };
        let mark = Mark::of(line);
        let understood = match mark {
            Mark::Row => {
                width = id_width(coding, line);
                let kind = line.get(3 + width..8 + width).and_then(scan::whole_integer);
                let complete = close(elements, open.take());
                open = kind.map(|kind| (kind, elements.nodes.len()));
                complete && open.is_some()
            }
            Mark::More => open.is_some() && connectivity(&line[3..], width, &mut elements.nodes),
            Mark::End => close(elements, open),
            Mark::Blank => true,
            Mark::Other => false,
        };
        match mark {
            Mark::End if understood => return Ok(Extent { closed: true, ..extent }),
            Mark::Row if understood => extent.rows += 1,
            _ if understood => (),
            _ if input.unterminated() => return Ok(extent),
            _ => {
                return Err(unexpected(
                    input,
                    "an element (-1), its nodes (-2) or the end of the block (-3)",
                ));
            }
        }
    }
}

/// Appends the node numbers in equal columns; `false` if one is unreadable.
fn connectivity(text: &[u8], width: usize, nodes: &mut Vec<i64>) -> bool {
    for column in text.chunks(width) {
        match scan::whole_integer(column) {
            Some(node) => nodes.push(node),
            None if scan::trim(column).is_empty() => (),
            None => return false,
        }
    }
    true
}

/// Ends the element of that kind number whose nodes begin at the given place; `false` if it has
/// not as many nodes as its kind.
fn close(elements: &mut Elements, open: Option<(i64, usize)>) -> bool {
    let Some((number, first)) = open else { return true };
    let Some(kind) = ElementKind::from_frd(number) else {
        elements.nodes.truncate(first);
        elements.skip(&format!("type {number}"));
        return true;
    };
    if elements.nodes.len() - first != kind.nodes() {
        return false;
    }
    kind.reorder_from_frd(&mut elements.nodes[first..]);
    elements.kinds.push(kind);
    true
}

/// Reads `count` binary elements. An unknown kind is an error: its length is unknown too.
pub(super) fn binary_elements(input: &mut Input, count: usize, elements: &mut Elements) -> Result<Extent> {
    for row in 0..count {
        let cut_off = Ok(Extent { rows: row, closed: false });
        let Some(number) = input.take(16)?.map(|record| int(&record[4..8])) else { return cut_off };
        let Some(kind) = ElementKind::from_frd(number) else {
            return Err(
                input.error(format!("element {} of the binary block has the unknown type {number}", row + 1))
            );
        };
        let Some(record) = input.take(4 * kind.nodes())? else { return cut_off };
        let first = elements.nodes.len();
        elements.nodes.extend(record.chunks(4).map(int));
        close(elements, Some((number, first)));
    }
    Ok(Extent { rows: count, closed: true })
}
