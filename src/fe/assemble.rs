//! From rows as read to a [`Field`]: order, duplicates, missing and unusable values, surface.

use super::Field;
use super::elements::Elements;
use super::nodes::{NodeIndex, Rows, first_few, named};
use super::source::{Source, Step};
use super::surface::{self, Surface};
use crate::error::{Error, Result};
use glam::DVec3;

/// Rows of nodes and of displacements, each in its own order, and what else a file says.
#[derive(Debug, Default)]
pub(super) struct Parts {
    /// Where they came from, for messages.
    pub name: String,
    /// Coordinates.
    pub nodes: Rows,
    /// Displacements.
    pub displacements: Rows,
    /// Elements; may be empty.
    pub elements: Elements,
    /// Format, blocks and steps.
    pub source: Source,
    /// Step used, from 1.
    pub step: usize,
    /// What the user should know.
    pub warnings: Vec<String>,
}

impl Parts {
    /// A table with the same nodes in both, which counts as a single step.
    pub fn of_table(name: String, nodes: Rows, displacements: Rows) -> Self {
        let rows = nodes.len();
        let step = Step { number: 1, step: None, increment: None, time: None, frequency: false, rows };
        let source = Source { steps: vec![step], ..Source::default() };
        Self { name, nodes, displacements, source, step: 1, ..Self::default() }
    }
}

/// Puts a field together.
///
/// Where a node has several displacements the last one is used, with a warning if they differ;
/// where it has several different positions the file is refused.
///
/// # Errors
/// [`Error::Field`] without nodes, for values that are no numbers, for nodes at two places, or
/// where no node has a displacement.
pub(super) fn assemble(mut parts: Parts) -> Result<Field> {
    let name = parts.name;
    let refuse = |why: String| Err(Error::Field { path: name.clone(), line: 0, why });
    if parts.nodes.len() == 0 {
        return refuse("no nodes in it".into());
    }
    let moved = parts.nodes.sort();
    if !moved.is_empty() {
        let which = named(&moved);
        return refuse(format!("{which} with several different positions; each node must have one"));
    }
    if let Some(why) = unusable(&parts.nodes, "coordinates") {
        return refuse(why);
    }
    let mut warnings = parts.warnings;
    let conflicts = parts.displacements.sort();
    if let Some(why) = unusable(&parts.displacements, "displacements") {
        return refuse(format!("{why}; the solution has diverged, or these nodes must be left out"));
    }
    if !conflicts.is_empty() {
        let which = named(&conflicts);
        warnings.push(format!("{which} with several different displacements, of which the last is used"));
    }
    let Rows { ids, values: points } = parts.nodes;
    let (displacements, strangers) = match_up(&ids, &parts.displacements);
    if strangers > 0 {
        warnings.push(format!("displacements of nodes without coordinates, which are not used: {strangers}"));
    }
    let mut field = Field {
        name: name.clone(),
        ids,
        points,
        displacements,
        step: parts.step,
        steps: parts.source.steps.len(),
        source: parts.source,
        warnings,
        ..Field::default()
    };
    let missing = field.nodes_without_result();
    if missing.len() == field.ids.len() {
        return refuse("no node has a displacement".into());
    }
    if !missing.is_empty() {
        let (count, of, first) = (missing.len(), field.ids.len(), first_few(&missing));
        field.warnings.push(format!("{count} of {of} nodes without displacement: {first}"));
    }
    field.set_surface(&parts.elements);
    Ok(field)
}

/// What is wrong with rows that hold NaN or infinite values.
fn unusable(rows: &Rows, what: &str) -> Option<String> {
    let bad = |(id, value): (&i64, &DVec3)| (!value.is_finite()).then_some(*id);
    let ids: Vec<i64> = rows.ids.iter().zip(&rows.values).filter_map(bad).collect();
    (!ids.is_empty()).then(|| format!("{} with {what} that are no numbers (NaN or infinite)", named(&ids)))
}

/// Displacements in the order of `ids`, NaN where there is none, and the number of rows left over;
/// both lists of numbers ascend.
fn match_up(ids: &[i64], rows: &Rows) -> (Vec<DVec3>, usize) {
    if ids == rows.ids {
        return (rows.values.clone(), 0);
    }
    let mut left = rows.ids.iter().zip(&rows.values).peekable();
    let mut strangers = 0;
    let mut value_of = |id: i64| {
        while left.next_if(|(other, _)| **other < id).is_some() {
            strangers += 1;
        }
        left.next_if(|(other, _)| **other == id).map_or(DVec3::NAN, |(_, value)| *value)
    };
    let values = ids.iter().map(|&id| value_of(id)).collect();
    (values, strangers + left.count())
}

impl Field {
    /// Takes the surface of the elements over, as far as its nodes are in the field.
    pub(super) fn set_surface(&mut self, elements: &Elements) {
        for (kind, count) in &elements.unknown {
            self.warnings.push(format!("elements that are not understood: {count} of {kind}"));
        }
        if !elements.kinds.iter().any(|kind| kind.shape.is_volume() || kind.shape.is_shell()) {
            return;
        }
        let index = NodeIndex::new(&self.ids);
        let mut lost = Vec::new();
        let found = |&id: &i64| {
            index.find(id).unwrap_or_else(|| {
                lost.push(id);
                0
            })
        };
        let nodes: Vec<u32> = elements.nodes.iter().map(found).collect();
        if !lost.is_empty() {
            lost.sort_unstable();
            lost.dedup();
            let which = named(&lost);
            self.warnings
                .push(format!("{which} of the elements without coordinates; the mesh's surface is not used"));
            return;
        }
        self.take_surface(surface::extract(&elements.kinds, &nodes, self.ids.len()));
    }

    fn take_surface(&mut self, surface: Surface) {
        if surface.crowded > 0 {
            let count = surface.crowded;
            self.warnings
                .push(format!("the mesh overlaps itself: element faces of more than two elements: {count}"));
        }
        self.surface_nodes = Some(surface.nodes);
        self.mid_sides = surface.mid_sides;
        self.surface_faces = surface.faces;
    }
}
