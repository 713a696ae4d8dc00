//! Which solid of the input is meant.

use super::associate::{Association, associate, typical_distance};
use super::hot::Hot;
use super::nodes::Nodes;
use super::options::Options;
use super::warnings::{Severity, Warnings};
use crate::brep::{Brep, Topology};
use crate::error::{Error, Result, counted};
use crate::fe::Field;
use glam::DVec3;

/// Fraction of the surface nodes that must lie on the part.
const ENOUGH: f64 = 0.5;
/// Nodes on a part at least, where no elements say which lie on the surface.
const FEWEST: usize = 4;

/// The solid to morph with the nodes on it.
pub struct Selected {
    /// A B-rep of this solid alone, without locations and triangulations.
    pub brep: Brep,
    /// The solid as the morph sees it.
    pub hot: Hot,
    /// The field in mm.
    pub nodes: Nodes,
    /// Which node lies where.
    pub association: Association,
    /// Seconds spent on nodes and faces.
    pub seconds: f64,
}

/// Finds the solid that is asked for, or the only one that the field covers.
///
/// # Errors
/// [`Error::Solid`] without a solid or with several to choose from; [`Error::Mismatch`] where the
/// field does not lie on it.
pub fn select(brep: &Brep, field: &Field, options: &Options, warnings: &mut Warnings) -> Result<Selected> {
    let mut brep = brep.clone();
    brep.normalise()?;
    let count = Topology::new(&brep)?.solids.len();
    if count == 0 {
        return Err(Error::Solid {
            why: format!(
                "{} holds no solid, only faces or shells: a watertight solid is needed; sew and close the faces first",
                name(options)
            ),
        });
    }
    if let Some(n) = options.solid.filter(|&n| n == 0 || n > count) {
        return Err(Error::Solid { why: format!("there is no solid {n}: the part has {count}") });
    }
    let mut fitting = Vec::new();
    let mut failures = Vec::new();
    for n in 1..=count {
        if options.solid.is_some_and(|wanted| wanted != n) {
            continue;
        }
        let mut said = Warnings::default();
        let attempt = attempt(brep.solid(n)?, field, options, &mut said);
        match attempt {
            Ok(selected) => fitting.push((n, selected, said)),
            Err(e) => failures.push((n, e)),
        }
    }
    choose(fitting, failures, count, warnings)
}

fn choose(
    mut fitting: Vec<(usize, Selected, Warnings)>,
    failures: Vec<(usize, Error)>,
    count: usize,
    warnings: &mut Warnings,
) -> Result<Selected> {
    if fitting.len() > 1 {
        let list: Vec<String> = fitting
            .iter()
            .map(|(n, s, _)| format!("solid {n} ({})", counted(s.hot.faces.len(), "face")))
            .collect();
        return Err(Error::Solid {
            why: format!("the field covers several solids: {}; choose one with --solid N", list.join(", ")),
        });
    }
    let Some((n, selected, said)) = fitting.pop() else {
        let (_, error) = failures.into_iter().next().unwrap_or((0, Error::Solid { why: "no solid".into() }));
        return Err(error);
    };
    if count > 1 {
        let left: Vec<String> = failures.iter().map(|(n, _)| n.to_string()).collect();
        let why = if left.is_empty() {
            "as asked".to_string()
        } else {
            format!("no nodes on solid {}", left.join(", "))
        };
        let text = format!("the part has {count} solids; only solid {n} is morphed and written ({why})");
        warnings.push(Severity::Known, text);
    }
    warnings.append(said);
    Ok(selected)
}

fn name(options: &Options) -> &str {
    if options.solid_name.is_empty() { "the part" } else { &options.solid_name }
}

fn attempt(brep: Brep, field: &Field, options: &Options, warnings: &mut Warnings) -> Result<Selected> {
    let hot = Hot::new(&brep)?;
    let nodes = Nodes::new(field, options, size_mm(&hot), warnings)?;
    let clock = std::time::Instant::now();
    let association =
        associate(&hot, &nodes.points, &nodes.usable, &field.mid_sides, nodes.match_tolerance_mm);
    check(&hot, field, &nodes, &association, options, warnings)?;
    Ok(Selected { brep, hot, nodes, association, seconds: clock.elapsed().as_secs_f64() })
}

/// Diagonal of the box around the part's edges and faces, mm.
fn size_mm(hot: &Hot) -> f64 {
    let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
    for face in 0..hot.faces.len() {
        let patch = &hot.patches[hot.faces[face].patch].hot;
        for (uv, _) in super::coverage::samples(hot, face) {
            let p = patch.point(uv.x, uv.y);
            (low, high) = (low.min(p), high.max(p));
        }
    }
    (high - low).length()
}

fn check(
    hot: &Hot,
    field: &Field,
    nodes: &Nodes,
    association: &Association,
    options: &Options,
    warnings: &mut Warnings,
) -> Result<()> {
    let usable = nodes.usable.len();
    let lost = association.unmatched.len();
    let on = usable - lost;
    let enough = if field.surface_nodes.is_some() { ENOUGH * usable as f64 } else { FEWEST as f64 };
    if on < FEWEST || (on as f64) < enough {
        let distance = typical_distance(hot, &nodes.points, &nodes.usable);
        return Err(Error::Mismatch {
            why: format!(
                "{}: the FE model does not lie on the geometry of {}: {on} of {usable} nodes are within {:.3e} mm, the median \
                 distance is {distance:.4} mm; check that both are in the same place, orientation (not mirrored) and unit, or give \
                 --match-tolerance",
                field.name,
                name(options),
                nodes.match_tolerance_mm
            ),
        });
    }
    if field.surface_nodes.is_none() {
        let text = format!(
            "the field has no elements: {on} of {usable} nodes lie on the faces, the others are taken as inside"
        );
        warnings.push(Severity::Known, text);
    } else if lost > 0 {
        let ids: Vec<String> =
            association.unmatched.iter().take(10).map(|&n| nodes.ids[n as usize].to_string()).collect();
        let text = format!(
            "{lost} of {usable} surface nodes lie on no face within {:.3e} mm and are not used (ids {}{})",
            nodes.match_tolerance_mm,
            ids.join(", "),
            if lost > ids.len() { ", …" } else { "" }
        );
        warnings.push(Severity::Doubtful, text);
    }
    Ok(())
}
