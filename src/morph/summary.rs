//! Puts the report together.

use super::fit::Fit;
use super::mass::{Mass, mass};
use super::measure::{self, NodeFigures, spread};
use super::options::Options;
use super::rebuild::{NewEdge, largest_tolerance_mm};
use super::report::{Change, EdgeReport, FaceReport, Input, Report, Seconds, SolidReport, Tool};
use super::run::Task;
use super::select::Selected;
use super::surface_fit::Cells;
use super::warnings::{Severity, Warnings};
use super::{NodeResult, data::PatchData};
use crate::brep::Brep;
use crate::error::{Result, counted};
use crate::fe::Field;
use crate::nurbs::NurbsSurface;

/// A tangent joint that opens by more than this is named, degrees.
const OPENED_DEG: f64 = 0.1;

/// Everything that a report speaks of.
pub struct Outcome<'a> {
    /// Input.
    pub selected: &'a Selected,
    /// What was asked.
    pub task: &'a Task<'a>,
    /// The fit.
    pub fit: &'a Fit,
    /// New surfaces, by patch.
    pub cold: &'a [NurbsSurface],
    /// New edges.
    pub edges: &'a [NewEdge],
    /// The output.
    pub out: &'a Brep,
}

/// The name of a face (from 0) for a user.
pub fn face_name(options: &Options, face: usize) -> String {
    match options.face_names.get(face) {
        Some(name) if !name.is_empty() => name.clone(),
        _ => format!("Face{}", face + 1),
    }
}

/// Measures the outcome. `holdout` gives, by match, what the second fit missed (NaN where the
/// node was used).
///
/// # Errors
/// As [`Task::before`].
pub fn summarise(
    outcome: &Outcome<'_>,
    field: &Field,
    options: &Options,
    holdout: Option<&[f64]>,
    mut warnings: Warnings,
) -> Result<(Report, Vec<NodeResult>)> {
    let Selected { brep, hot, nodes, association, .. } = outcome.selected;
    let matches = &association.matches[..];
    let figures = measure::at_nodes(hot, brep, outcome.cold, matches, &nodes.displacements);
    let faces = faces(outcome, options, &figures, holdout);
    let edges = measure::edges(
        hot,
        brep,
        outcome.cold,
        outcome.edges,
        &outcome.task.hot_angles_deg,
        &outcome.task.held,
    );
    let before = mass(hot, &outcome.task.before()?);
    let after = mass(hot, outcome.cold);
    let folded = figures.iter().filter(|f| f.folded).count() + measure::folded_samples(hot, outcome.cold);
    warn(outcome, options, &figures, folded, &mut warnings);
    warn_of_joints(&edges, options.tolerance_mm, &mut warnings);
    empty_spans(&faces).into_iter().for_each(|text| warnings.push(Severity::Known, text));
    let results = matches.iter().zip(&figures).map(|(m, f)| NodeResult {
        id: nodes.ids[m.node as usize],
        face: m.face + 1,
        foot: m.foot.point,
        displacement: nodes.displacements[m.node as usize],
        deviation: f.deviation,
    });
    let report = Report {
        tool: Tool { name: "bladesmith".into(), version: env!("CARGO_PKG_VERSION").into() },
        input: Input {
            solid: options.solid_name.clone(),
            field: field.name.clone(),
            step: field.step,
            factor: options.factor,
            nodes: field.ids.len(),
        },
        deviation_mm: spread(figures.iter().map(|f| f.deviation.length())),
        holdout_mm: holdout.map(|h| spread(h.iter().copied().filter(|e| !e.is_nan()))),
        unmatched_nodes: if field.surface_nodes.is_some() { association.unmatched.len() } else { 0 },
        solid: solid(outcome, &before, &after, folded),
        faces,
        edges,
        warnings: warnings.into_texts(),
        seconds: Seconds::default(),
    };
    Ok((report, results.collect()))
}

fn solid(outcome: &Outcome<'_>, before: &Mass, after: &Mass, folded: usize) -> SolidReport {
    SolidReport {
        valid: None,
        closed: outcome.selected.hot.joints.iter().all(|j| j.degenerated || j.sides.len() == 2),
        faces: outcome.selected.hot.faces.len(),
        folded,
        volume_mm3: Change { before: before.volume, after: after.volume },
        area_mm2: Change { before: before.area, after: after.area },
        centroid_mm: Change { before: before.centroid.to_array(), after: after.centroid.to_array() },
        tolerance_mm: Change {
            before: largest_tolerance_mm(&outcome.selected.brep),
            after: largest_tolerance_mm(outcome.out),
        },
    }
}

fn faces(
    outcome: &Outcome<'_>,
    options: &Options,
    figures: &[NodeFigures],
    holdout: Option<&[f64]>,
) -> Vec<FaceReport> {
    let hot = &outcome.selected.hot;
    let matches = &outcome.selected.association.matches[..];
    let one = |index: usize| {
        let patch = hot.faces[index].patch;
        let range = matches.partition_point(|m| (m.face as usize) < index)
            ..matches.partition_point(|m| m.face as usize <= index);
        let (own, figures) = (&matches[range.clone()], &figures[range.clone()]);
        let surface = &outcome.cold[patch];
        let (spans, filled) = spans(outcome, index, own);
        FaceReport {
            index: index + 1,
            name: face_name(options, index),
            degree: [surface.knots_u().degree(), surface.knots_v().degree()],
            poles: [surface.knots_u().len(), surface.knots_v().len()],
            rational: surface.weights().is_some(),
            nodes: own.len(),
            foot_mm: spread(own.iter().map(|m| m.foot.distance)),
            deviation_mm: spread(figures.iter().map(|f| f.deviation.length())),
            distance_mm: spread(figures.iter().map(|f| f.distance)),
            holdout_mm: holdout.map(|h| spread(h[range].iter().copied().filter(|e| !e.is_nan()))),
            spans,
            spans_filled: filled,
            rank_cut: 0,
            knots_inserted: inserted(&hot.patches[patch].hot, surface),
            held: outcome.task.held[index],
        }
    };
    (0..hot.faces.len()).map(one).collect()
}

/// Knots that a surface has more than another, both directions.
fn inserted(before: &NurbsSurface, after: &NurbsSurface) -> usize {
    let knots = |s: &NurbsSurface| s.knots_u().flat().len() + s.knots_v().flat().len();
    knots(after).saturating_sub(knots(before))
}

/// Says where most spans hold no node: there the mesh is coarser than the net of poles.
fn empty_spans(faces: &[FaceReport]) -> Option<String> {
    let sparse = || faces.iter().filter(|f| 2 * f.spans_filled > f.spans);
    let (empty, all) = sparse().fold((0, 0), |(e, a), f| (e + f.spans_filled, a + f.spans));
    let names: Vec<&str> = sparse().take(10).map(|f| f.name.as_str()).collect();
    let more = if sparse().count() > names.len() { ", …" } else { "" };
    (empty > 0).then(|| {
        let names = names.join(", ");
        format!(
            "empty knot spans: {empty} of {all} on {names}{more}: their poles follow the regularisation alone"
        )
    })
}

/// Spans whose middle lies on the face or that hold a node of it, and how many of them hold none.
fn spans(outcome: &Outcome<'_>, face: usize, own: &[super::associate::Match]) -> (usize, usize) {
    let f = &outcome.selected.hot.faces[face];
    let mut cells = Cells::new(&outcome.fit.spaces[f.patch], &PatchData::default());
    for m in own {
        let k = cells.index(m.foot.uv);
        cells.count[k] += 1;
    }
    let (mut all, mut empty) = (0, 0);
    for k in 0..cells.count.len() {
        let (i, j) = cells.place(k);
        let middle =
            glam::DVec2::new(0.5 * (cells.us[i] + cells.us[i + 1]), 0.5 * (cells.vs[j] + cells.vs[j + 1]));
        if cells.count[k] > 0 || f.trim.contains(middle) {
            all += 1;
            empty += usize::from(cells.count[k] == 0);
        }
    }
    (all, empty)
}

fn warn(
    outcome: &Outcome<'_>,
    options: &Options,
    figures: &[NodeFigures],
    folded: usize,
    warnings: &mut Warnings,
) {
    if folded > 0 {
        let normals = counted(folded, "sampled normal");
        let text = format!("the result is folded and not to be used: {normals} turned against the input's");
        warnings.push(Severity::Broken, text);
    }
    if options.factor < 0.0 {
        let second = figures.iter().map(|f| f.second_order).fold(0.0, f64::max);
        let text = format!(
            "the displacement was computed on the given shape and taken away from it: the result is a first-order estimate of \
             the unloaded shape; the second-order term |∇u|·|u| reaches about {second:.1e} mm"
        );
        warnings.push(Severity::Known, text);
    }
    let faces = &outcome.selected.hot.faces;
    let held: Vec<String> = (0..faces.len())
        .filter(|f| outcome.task.held[*f] && !outcome.task.fixed[*f])
        .map(|f| face_name(options, f))
        .collect();
    if !held.is_empty() {
        let text =
            format!("the field holds {} still; its gradient jumps at the edges there", held.join(", "));
        warnings.push(Severity::Known, text);
    }
}

/// Names joints that open or gape.
fn warn_of_joints(edges: &[EdgeReport], tolerance_mm: f64, warnings: &mut Warnings) {
    let opened = |e: &EdgeReport| e.angle_deg.after - e.angle_deg.before;
    let list = |chosen: &[&EdgeReport]| {
        let named: Vec<String> = chosen
            .iter()
            .take(10)
            .map(|e| format!("{} (faces {} and {})", e.index, e.faces[0], e.faces[1]))
            .collect();
        format!("{}{}", named.join(", "), if chosen.len() > named.len() { ", …" } else { "" })
    };
    let joints = [(false, "elsewhere", Severity::Doubtful), (true, "beside held faces", Severity::Known)];
    for (held, what, severity) in joints {
        let chosen: Vec<&EdgeReport> =
            edges.iter().filter(|e| e.tangent && e.held == held && opened(e) > OPENED_DEG).collect();
        if !chosen.is_empty() {
            let most = chosen.iter().map(|e| opened(e)).fold(0.0, f64::max);
            let text = format!("tangent joints open by up to {most:.2}° {what}: edges {}", list(&chosen));
            warnings.push(severity, text);
        }
    }
    let gaping: Vec<&EdgeReport> =
        edges.iter().filter(|e| e.gap_mm.after > tolerance_mm.max(2.0 * e.gap_mm.before)).collect();
    if !gaping.is_empty() {
        let most = gaping.iter().map(|e| e.gap_mm.after).fold(0.0, f64::max);
        warnings.push(Severity::Doubtful, format!("edges gape by up to {most:.1e} mm: {}", list(&gaping)));
    }
}
