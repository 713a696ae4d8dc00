//! The course of a morph.

use super::Morphed;
use super::affine::{self, AffineField};
use super::associate::Match;
use super::coverage::{self, Uncovered};
use super::data;
use super::fit::{self, Fit, Problem};
use super::hot::{Hot, Joint, Patch};
use super::links::{self, Tie};
use super::measure;
use super::options::Options;
use super::progress::{Progress, tell};
use super::rebuild;
use super::report::Seconds;
use super::represent::reknot;
use super::select::{Selected, select};
use super::space::displaced;
use super::summary::{self, Outcome};
use super::warnings::{Severity, Warnings};
use crate::brep::{Brep, Surface};
use crate::error::{Error, Result, counted};
use crate::fe::Field;
use crate::nurbs::NurbsSurface;
use glam::DVec3;
use rayon::prelude::*;
use std::time::Instant;

/// Nodes whose number this divides are kept out of the second fit.
pub const HOLDOUT: i64 = 10;
/// What an affine motion may leave at the nodes to be the whole answer, mm: the rounding of a
/// six-digit results file.
const AFFINE_MM: f64 = 3e-6;
/// Nodes that an affine motion of one patch needs.
const LOCAL_NODES: usize = 20;
/// Kinks this close, as a fraction of the domain, are one, or lie on its border.
const KINK_SLACK: f64 = 1e-3;
/// A face whose displacements stay below this fraction of the largest is held.
const HELD: f64 = 1e-6;

/// Morphs one solid of `brep` by `field`.
///
/// # Errors
/// See [`Error`]; nothing is returned that does not hold together.
pub fn morph(brep: &Brep, field: &Field, options: &Options, progress: Progress<'_>) -> Result<Morphed> {
    let start = Instant::now();
    let mut seconds = Seconds::default();
    let mut warnings = Warnings::of_field(&field.warnings);
    let (selected, fixed) = place(brep, field, options, &mut warnings, progress)?;
    seconds.associate = start.elapsed().as_secs_f64();

    tell(progress, "preparing the fit", 0.25)?;
    let clock = Instant::now();
    let task = Task::new(&selected, fixed, options, &mut warnings)?;
    let fit = task.fit(&|_| true, &|stage, s| progress(stage, 0.3 + 0.4 * s))?;
    let cold = task.surfaces(&fit)?;
    let holdout = if options.holdout { Some(task.holdout(progress)?) } else { None };
    seconds.fit = clock.elapsed().as_secs_f64();

    tell(progress, "rebuilding the solid", 0.75)?;
    let clock = Instant::now();
    let edges = rebuild::new_edges(&selected.hot, &cold)?;
    let out = rebuild::rebuild(&selected.brep, &selected.hot, &cold, &edges);
    tell(progress, "measuring the result", 0.85)?;
    let outcome =
        Outcome { selected: &selected, task: &task, fit: &fit, cold: &cold, edges: &edges, out: &out };
    let (mut report, nodes) = summary::summarise(&outcome, field, options, holdout.as_deref(), warnings)?;
    seconds.rebuild = clock.elapsed().as_secs_f64();
    seconds.total = start.elapsed().as_secs_f64();
    report.seconds = seconds;
    tell(progress, "done", 1.0)?;
    Ok(Morphed { brep: out, report, nodes })
}

/// Brings the nodes to the faces; returns which faces the user holds, too.
///
/// # Errors
/// See [`select`] and [`Error::Argument`].
pub fn place(
    brep: &Brep,
    field: &Field,
    options: &Options,
    warnings: &mut Warnings,
    progress: Progress<'_>,
) -> Result<(Selected, Vec<bool>)> {
    options.check()?;
    tell(progress, "placing nodes on faces", 0.05)?;
    let mut selected = select(brep, field, options, warnings)?;
    let fixed = fixed_faces(&selected.hot, options)?;
    hold_nodes(&mut selected, &fixed);
    Ok((selected, fixed))
}

/// What is to be fitted, ready to go.
pub struct Task<'a> {
    brep: &'a Brep,
    hot: &'a Hot,
    /// Nodes on faces.
    pub matches: &'a [Match],
    ids: &'a [i64],
    displacements: &'a [DVec3],
    /// The affine part of the displacement.
    pub affine: AffineField,
    /// What an affine motion of each patch adds to it. Fillets come in uneven parameters, in which
    /// even a linear field is rough: what moves with the poles need not be fitted.
    local: Vec<AffineField>,
    /// Whether the affine part is the whole answer.
    pub affine_suffices: bool,
    spacings: Vec<f64>,
    prescribed: Vec<Option<Vec<DVec3>>>,
    ties: Vec<Tie>,
    kinks: Vec<[Vec<f64>; 2]>,
    /// Angles along the joints of the input, degrees.
    pub hot_angles_deg: Vec<f64>,
    tolerance_mm: f64,
    /// Faces that the field holds still.
    pub held: Vec<bool>,
    /// Faces that the user holds still.
    pub fixed: Vec<bool>,
}

impl<'a> Task<'a> {
    /// Gets ready to fit.
    ///
    /// # Errors
    /// [`Error::Mismatch`] for areas without nodes that the field is not to be extended over.
    pub fn new(
        selected: &'a Selected,
        fixed: Vec<bool>,
        options: &Options,
        warnings: &mut Warnings,
    ) -> Result<Self> {
        let hot = &selected.hot;
        let matches = &selected.association.matches[..];
        let displacements = &selected.nodes.displacements[..];
        let used: Vec<&Match> = matches.iter().filter(|m| !fixed[m.face as usize]).collect();
        let points: Vec<DVec3> = used.iter().map(|m| m.foot.point).collect();
        let moved: Vec<DVec3> = used.iter().map(|m| displacements[m.node as usize]).collect();
        let affine = AffineField::fit(&points, &moved);
        let left = points.iter().zip(&moved).map(|(x, d)| (*d - affine.at(*x)).length()).fold(0.0, f64::max);
        let spacings = data::spacings(hot, matches);
        let bare = coverage::uncovered(hot, matches, &spacings);
        let bare: Vec<Uncovered> = bare.into_iter().filter(|b| !fixed[b.face]).collect();
        check_coverage(&bare, left, affine::spans_space(&points), options, warnings)?;
        let hot_angles_deg = measure::hot_angles_deg(hot, &selected.brep);
        let affine_suffices = left <= AFFINE_MM && !fixed.contains(&true);
        let local = if affine_suffices {
            vec![AffineField::NONE; hot.patches.len()]
        } else {
            local_affine(hot, &used, displacements, &affine)
        };
        let held = held_faces(hot, matches, displacements, selected.nodes.largest_mm);
        let stays = |(p, local): (&Patch, &AffineField)| {
            p.faces.iter().all(|f| fixed[*f] || held[*f]).then(|| stay(p, &affine, local))
        };
        let prescribed = hot.patches.iter().zip(&local).map(stays).collect();
        let ties = hot.joints.iter().zip(&hot_angles_deg).map(|(j, a)| links::tie(j, *a, &held)).collect();
        Ok(Self {
            brep: &selected.brep,
            hot,
            matches,
            ids: &selected.nodes.ids,
            displacements,
            affine,
            local,
            affine_suffices,
            spacings,
            prescribed,
            ties,
            kinks: kinks(hot, &held),
            hot_angles_deg,
            tolerance_mm: options.tolerance_mm,
            held,
            fixed,
        })
    }

    /// The displacement left at a match by the affine part.
    fn remainder(&self, m: &Match) -> DVec3 {
        let patch = self.hot.faces[m.face as usize].patch;
        let x = m.foot.point;
        self.displacements[m.node as usize] - self.affine.at(x) - self.local[patch].at(x)
    }

    fn fit(&self, uses: &dyn Fn(i64) -> bool, progress: Progress<'_>) -> Result<Fit> {
        if self.affine_suffices {
            return Ok(Fit::nothing(self.hot));
        }
        let target = |m: &Match| {
            let wanted = uses(self.ids[m.node as usize]) && !self.fixed[m.face as usize];
            wanted.then(|| self.remainder(m))
        };
        let data = data::collect(self.hot, self.matches, &self.spacings, target);
        let problem = Problem {
            hot: self.hot,
            data: &data,
            tolerance_mm: self.tolerance_mm,
            affine: &self.local,
            ties: &self.ties,
            prescribed: &self.prescribed,
            kinks: &self.kinks,
        };
        fit::fit(&problem, progress)
    }

    /// The input's own spline where an affine motion is all: it needs no other representation.
    fn exact(&self, patch: usize) -> Result<Option<NurbsSurface>> {
        if self.affine_suffices {
            input_spline(&self.brep.surfaces[self.hot.patches[patch].surface])
        } else {
            Ok(None)
        }
    }

    /// The surfaces before they moved.
    ///
    /// # Errors
    /// As [`NurbsSurface::clamped`].
    pub fn before(&self) -> Result<Vec<NurbsSurface>> {
        let one = |p: usize| Ok(self.exact(p)?.unwrap_or_else(|| self.hot.patches[p].hot.clone()));
        (0..self.hot.patches.len()).map(one).collect()
    }

    /// The surfaces moved by the affine part and the fit.
    fn surfaces(&self, fit: &Fit) -> Result<Vec<NurbsSurface>> {
        let one = |p: usize| {
            let (patch, space) = (&self.hot.patches[p], &fit.spaces[p]);
            if let Some(exact) = self.exact(p)? {
                return moved(exact, &self.affine);
            }
            let both = space.union(patch.hot.knots_u(), patch.hot.knots_v())?;
            let hot = reknot(&patch.hot, &both)?;
            let moved: Vec<DVec3> =
                hot.poles().iter().map(|x| *x + self.affine.at(*x) + self.local[p].at(*x)).collect();
            displaced(&both, &moved, &space.lift(&fit.coefficients[p], &both)?)
        };
        (0..self.hot.patches.len()).into_par_iter().map(one).collect()
    }

    /// What a fit without every tenth node misses there, by match; NaN at the others.
    fn holdout(&self, progress: Progress<'_>) -> Result<Vec<f64>> {
        let out = |id: i64| id % HOLDOUT == 0;
        let fit =
            self.fit(&|id| !out(id), &|_, s| progress("fitting without every tenth node", 0.7 + 0.05 * s))?;
        let missed = |m: &Match| {
            if !out(self.ids[m.node as usize]) {
                return f64::NAN;
            }
            let p = self.hot.faces[m.face as usize].patch;
            let row = fit.spaces[p].value(m.foot.uv);
            (fit.spaces[p].apply(&row, &fit.coefficients[p]) - self.remainder(m)).length()
        };
        Ok(self.matches.par_iter().map(missed).collect())
    }
}

/// The best affine motion of each patch beyond `affine`; none where few nodes tell.
fn local_affine(
    hot: &Hot,
    used: &[&Match],
    displacements: &[DVec3],
    affine: &AffineField,
) -> Vec<AffineField> {
    let mut points = vec![Vec::new(); hot.patches.len()];
    let mut left = points.clone();
    for m in used {
        let patch = hot.faces[m.face as usize].patch;
        points[patch].push(m.foot.point);
        left[patch].push(displacements[m.node as usize] - affine.at(m.foot.point));
    }
    let fit = |p: usize| {
        let few = points[p].len() < LOCAL_NODES || hot.patches[p].own_poles;
        if few { AffineField::NONE } else { AffineField::fit(&points[p], &left[p]) }
    };
    (0..hot.patches.len()).map(fit).collect()
}

/// The input's own spline, if the surface is one.
fn input_spline(surface: &Surface) -> Result<Option<NurbsSurface>> {
    match surface {
        Surface::BSpline(s) => Ok(Some(s.to_nurbs()?)),
        Surface::Bezier(s) => Ok(Some(s.nurbs().clone())),
        Surface::Trimmed { basis, .. } => input_spline(basis),
        _ => Ok(None),
    }
}

/// The surface moved by an affine displacement: exact, weights stay.
fn moved(mut surface: NurbsSurface, affine: &AffineField) -> Result<NurbsSurface> {
    surface.poles_mut().iter_mut().for_each(|p| *p += affine.at(*p));
    Ok(surface)
}

/// Coefficients, over the knots of the patch itself, that undo the affine motion.
fn stay(patch: &Patch, affine: &AffineField, local: &AffineField) -> Vec<DVec3> {
    patch.hot.poles().iter().map(|x| -affine.at(*x) - local.at(*x)).collect()
}

/// Which faces the user holds.
fn fixed_faces(hot: &Hot, options: &Options) -> Result<Vec<bool>> {
    let count = hot.faces.len();
    for &f in options.moving_faces.iter().chain(&options.fixed_faces) {
        if f == 0 || f > count {
            return Err(Error::Argument {
                name: "faces",
                why: format!("there is no face {f}: the solid has {count}"),
            });
        }
    }
    if let Some(f) = options.moving_faces.iter().find(|f| options.fixed_faces.contains(f)) {
        let why = format!("face {f} is asked both to move and to stay; leave it out of one list");
        return Err(Error::Argument { name: "faces", why });
    }
    let moves = |f: usize| options.moving_faces.is_empty() || options.moving_faces.contains(&f);
    let fixed: Vec<bool> = (1..=count).map(|f| !moves(f) || options.fixed_faces.contains(&f)).collect();
    for patch in &hot.patches {
        let some = patch.faces.iter().any(|&f| fixed[f]);
        if let Some(free) = patch.faces.iter().find(|f| some && !fixed[**f]) {
            return Err(Error::Face {
                face: free + 1,
                why: "lies on the same surface as a face that is held; hold both or neither".into(),
            });
        }
    }
    Ok(fixed)
}

/// Takes the displacement from the nodes on fixed faces, those on their edges included: a
/// neighbour that followed them would part from the fixed face.
fn hold_nodes(selected: &mut Selected, fixed: &[bool]) {
    for m in selected.association.matches.iter().filter(|m| fixed[m.face as usize]) {
        selected.nodes.displacements[m.node as usize] = DVec3::ZERO;
    }
}

/// Which faces the field holds.
fn held_faces(hot: &Hot, matches: &[Match], displacements: &[DVec3], largest: f64) -> Vec<bool> {
    let mut most = vec![f64::NAN; hot.faces.len()];
    for m in matches {
        let (most, u) = (&mut most[m.face as usize], displacements[m.node as usize].length());
        *most = most.max(u);
    }
    most.iter().map(|m| *m <= HELD * largest && largest > 0.0).collect()
}

/// Parameters at which the displacement of each patch may have a kink: where the edge of a held
/// face ends on it, the gradient jumps along the patch's own edges.
fn kinks(hot: &Hot, held: &[bool]) -> Vec<[Vec<f64>; 2]> {
    let clamped = |j: &Joint| j.sides.len() == 2 && held[j.sides[0].face] != held[j.sides[1].face];
    let corners: Vec<usize> =
        hot.joints.iter().filter(|j| clamped(j)).flat_map(|j| j.vertices).flatten().collect();
    let mut out = vec![[Vec::new(), Vec::new()]; hot.patches.len()];
    for joint in &hot.joints {
        for (end, vertex) in joint.vertices.iter().enumerate() {
            if !vertex.is_some_and(|v| corners.contains(&v)) {
                continue;
            }
            for side in joint.sides.iter().filter(|s| !held[s.face]) {
                let (uv, space) = (side.pcurve.point(joint.range[end]), &hot.patches[side.patch].space);
                for (d, knots) in [&space.ku, &space.kv].into_iter().enumerate() {
                    let (a, b) = knots.domain();
                    let slack = KINK_SLACK * (b - a);
                    let known = out[side.patch][d].iter().any(|t: &f64| (t - uv[d]).abs() < slack);
                    if uv[d] > a + slack && uv[d] < b - slack && !known {
                        out[side.patch][d].push(uv[d]);
                    }
                }
            }
        }
    }
    out.iter_mut().flatten().for_each(|k| k.sort_by(f64::total_cmp));
    out
}

/// Refuses areas without nodes, unless an affine motion leaves `left` mm at nodes that `fix` it, or
/// the user asked to extrapolate.
fn check_coverage(
    bare: &[Uncovered],
    left: f64,
    fix: bool,
    options: &Options,
    warnings: &mut Warnings,
) -> Result<()> {
    if bare.is_empty() {
        return Ok(());
    }
    let name = |f: usize| summary::face_name(options, f);
    let list: Vec<String> = bare
        .iter()
        .take(10)
        .map(|b| format!("{} {:.0} % ({:.2} mm²)", name(b.face), 100.0 * b.fraction, b.area_mm2))
        .collect();
    let area: f64 = bare.iter().map(|b| b.area_mm2).sum();
    let what = format!(
        "areas without nodes on {}, {area:.2} mm² in all: {}{}",
        counted(bare.len(), "face"),
        list.join(", "),
        if bare.len() > list.len() { ", …" } else { "" }
    );
    if left < options.tolerance_mm && fix {
        let text = format!("{what}; the field is affine to {left:.1e} mm and is extended as such");
        warnings.push(Severity::Known, text);
        return Ok(());
    }
    if options.extrapolate {
        warnings.push(Severity::Doubtful, format!("{what}; the field is extrapolated there"));
        return Ok(());
    }
    Err(Error::Mismatch { why: format!("{what}; give --extrapolate to extend the field over them") })
}
