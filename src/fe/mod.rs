//! Finite-element meshes and displacement fields.
//!
//! [`read`] takes CalculiX results (`.frd`) or a table of nodes (CSV), gzipped or not, told by
//! their content; a deck (`.inp`) adds the node coordinates in full precision. Files in other
//! formats come in as arrays, through [`Field::from_arrays`], and go through the same checks.

mod assemble;
mod csv;
mod deck;
mod elements;
mod frd;
mod input;
mod nodes;
mod scan;
mod source;
mod summary;
mod surface;

pub use source::{Block, ElementCount, Format, Source, Step};
pub(crate) use summary::shortage;
pub use summary::{FieldSummary, LargestDisplacement};
pub use surface::NO_NODE;

use crate::error::{Error, Result};
use assemble::{Parts, assemble};
use glam::DVec3;
use input::Input;
use nodes::Rows;
use std::path::{Path, PathBuf};

/// A displacement field on the nodes of an FE mesh, as read (no unit applied).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Field {
    /// Where it came from, for messages.
    pub name: String,
    /// Node numbers, ascending.
    pub ids: Vec<i64>,
    /// Node coordinates in the file's unit, as many as `ids`.
    pub points: Vec<DVec3>,
    /// Displacements in the file's unit, as many as `ids`; NaN where a node has no result.
    pub displacements: Vec<DVec3>,
    /// Nodes on the mesh's surface as indices into `ids`, ascending; `None` without elements.
    pub surface_nodes: Option<Vec<u32>>,
    /// Each mid-side node on the surface with its two corners, as indices: (mid-side, corner,
    /// corner), ascending.
    pub mid_sides: Vec<[u32; 3]>,
    /// Triangles of the mesh's surface as indices: three corners, anticlockwise seen from outside,
    /// then the mid-side nodes between the first and second, second and third, third and first
    /// corner, or [`NO_NODE`] for all three.
    ///
    /// A linear quadrilateral is two of them. A second-order one is six linear triangles over its
    /// eight nodes. Empty without elements.
    pub surface_faces: Vec<[u32; 6]>,
    /// Result step used, from 1, among those with displacements.
    pub step: usize,
    /// Number of steps with displacements.
    pub steps: usize,
    /// Format of the file, its blocks, steps and elements.
    pub source: Source,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// What to read, and with what.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The deck that was solved, for coordinates in full precision, and for the elements where the
    /// results have none.
    pub mesh: Option<PathBuf>,
    /// Step with displacements to use, from 1; `None`: the last.
    pub step: Option<usize>,
}

/// Reads a field from a results file or a table; results and deck are read at the same time.
///
/// Values that are no numbers, nodes at two places and files that end inside a block are refused.
/// Warned of are nodes without displacement, nodes with several different displacements (the last
/// is used), nodes that the deck lacks, and steps not chosen between (the last is used).
///
/// # Errors
/// [`Error::Io`] for files that cannot be read, [`Error::Field`] for those that cannot be used.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Field> {
    let Some(mesh) = &options.mesh else { return read_results(path, options.step) };
    let (field, deck) = rayon::join(|| read_results(path, options.step), || deck::read(mesh));
    let mut field = field?;
    deck?.refine(&mut field)?;
    Ok(field)
}

fn read_results(path: &Path, step: Option<usize>) -> Result<Field> {
    let mut input = Input::open(path)?;
    if step == Some(0) {
        return Err(input.error("step 0 was asked for; steps are numbered from 1"));
    }
    let parts = read_parts(&mut input, step);
    assemble(parts.map_err(|error| input.deeper_cause(error))?)
}

fn read_parts(input: &mut Input, step: Option<usize>) -> Result<Parts> {
    let name = input.path().to_string();
    let first = loop {
        match input.next_line()? {
            None => return Err(Error::Field { path: name, line: 0, why: "the file is empty".into() }),
            Some(line) if scan::trim(line).is_empty() => (),
            Some(line) => break line.to_vec(),
        }
    };
    if first.starts_with(b"\xff\xfe") || first.starts_with(b"\xfe\xff") {
        return Err(input.error("the text is in UTF-16; save it as UTF-8"));
    }
    if first.starts_with(b"*") {
        let why = "a deck (.inp) has a mesh but no displacements: give the results of its run (.frd) here, and the \
                   deck as their mesh"
            .into();
        return Err(Error::Field { path: name, line: 0, why });
    }
    input.put_back();
    if frd::begins_with(&first) {
        let frd::Results { nodes, displacements, elements, source, step, warnings } = frd::read(input, step)?;
        return Ok(Parts { name, nodes, displacements, elements, source, step, warnings });
    }
    let parts = csv::read(input)?;
    match step {
        None | Some(1) => Ok(parts),
        Some(step) => {
            let why = format!("step {step} is not in it: a table has a single step");
            Err(Error::Field { path: name, line: 0, why })
        }
    }
}

impl Field {
    /// A field from arrays of equal length, checked like one from a file.
    ///
    /// # Errors
    /// [`Error::Argument`] for arrays of different lengths, [`Error::Field`] as in [`read`].
    pub fn from_arrays(name: &str, ids: &[i64], points: &[DVec3], displacements: &[DVec3]) -> Result<Self> {
        for (array, length) in [("points", points.len()), ("displacements", displacements.len())] {
            if length != ids.len() {
                let why = format!("{length} values for {} nodes", ids.len());
                return Err(Error::Argument { name: array, why });
            }
        }
        let rows = |values: &[DVec3]| Rows { ids: ids.to_vec(), values: values.to_vec() };
        assemble(Parts::of_table(name.to_string(), rows(points), rows(displacements)))
    }

    /// Numbers of the nodes without a displacement, ascending.
    pub fn nodes_without_result(&self) -> Vec<i64> {
        let missing = |(id, u): (&i64, &DVec3)| u.is_nan().then_some(*id);
        self.ids.iter().zip(&self.displacements).filter_map(missing).collect()
    }
}
