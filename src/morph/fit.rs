//! The fit of the whole solid: each patch on its own to find its knots, then all together.

use super::affine::AffineField;
use super::data::PatchData;
use super::hot::Hot;
use super::links::{self, Context, JointLinks, Tie};
use super::progress::{Progress, Shared, tell};
use super::refine::{Limit, Marks};
use super::space::Space;
use super::surface_fit::{self, Cells, SHORTEST, SHORTEST_AT_EDGE, SINGULAR_MM};
use super::system::{self, Block, PRESCRIBED};
use crate::error::Result;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Rounds of the coupled solve as a rule, and where something is still far off.
const ROUNDS: [usize; 2] = [3, 4];
/// Part of the work that goes into each patch on its own.
const ALONE: f64 = 0.4;
/// What is far off, as a fraction of the tolerance asked.
const FAR: f64 = 0.8;
/// The weight that a datum may come to; links between faces weigh far more.
const HEAVIEST: f64 = 10.0;
/// A jump along an edge that asks for finer knots, mm.
const JUMP_MM: f64 = 1e-5;

/// The fitted displacement.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Space of each patch.
    pub spaces: Vec<Space>,
    /// Its coefficients.
    pub coefficients: Vec<Vec<DVec3>>,
}

impl Fit {
    /// No displacement, on the hot knots.
    pub fn nothing(hot: &Hot) -> Self {
        let spaces: Vec<Space> = hot.patches.iter().map(|p| p.space.clone()).collect();
        let coefficients = spaces.iter().map(|s| vec![DVec3::ZERO; s.poles()]).collect();
        Self { spaces, coefficients }
    }
}

/// What the fit is asked for.
pub struct Problem<'a> {
    /// The solid.
    pub hot: &'a Hot,
    /// Data of each patch.
    pub data: &'a [PatchData],
    /// Deviation that still counts as success, mm.
    pub tolerance_mm: f64,
    /// Affine fields of the patches, to which the fitted displacements are added.
    pub affine: &'a [AffineField],
    /// How each joint is tied.
    pub ties: &'a [Tie],
    /// Prescribed displacement coefficients of patches that must not move freely, over the knots
    /// of the patches themselves.
    pub prescribed: &'a [Option<Vec<DVec3>>],
    /// Parameters of each patch, along u and v, where its displacement may have a kink.
    pub kinks: &'a [[Vec<f64>; 2]],
}

/// Fits the displacement.
///
/// # Errors
/// [`crate::Error::Numerics`] where the equations cannot be solved, [`crate::Error::Cancelled`].
pub fn fit(problem: &Problem<'_>, progress: Progress<'_>) -> Result<Fit> {
    let mut spaces = spaces_of_each(problem, &|stage, s| progress(stage, ALONE * s))?;
    let mut data = problem.data.to_vec();
    let mut coefficients = Vec::new();
    for round in 0..ROUNDS[1] {
        let round_done = |part: f64| {
            let done = (round as f64 + part) / ROUNDS[1] as f64;
            tell(progress, "fitting all faces together", ALONE + (1.0 - ALONE) * done)
        };
        round_done(0.0)?;
        let coupled = Coupled::solve(problem, &data, &spaces, &round_done)?;
        let more = round + 1 < ROUNDS[0]
            || (round + 1 < ROUNDS[1] && coupled.worst_mm() > FAR * problem.tolerance_mm);
        let finer = if more { coupled.refine(problem, &spaces)? } else { None };
        if finer.is_some() {
            coupled.weigh(&mut data);
        }
        coefficients = coupled.coefficients;
        match finer {
            Some(finer) => spaces = finer,
            None => break,
        }
    }
    Ok(Fit { spaces, coefficients })
}

/// The space that each patch needs on its own.
fn spaces_of_each(problem: &Problem<'_>, progress: Progress<'_>) -> Result<Vec<Space>> {
    let patches = &problem.hot.patches;
    let stage = Shared::new(progress, "fitting each face", patches.len());
    let space = |p: usize| {
        let patch = &patches[p];
        let space = match problem.prescribed[p] {
            Some(_) => Space { ku: patch.hot.knots_u().clone(), kv: patch.hot.knots_v().clone() },
            None => {
                let start = patch.space.with_kinks(&problem.kinks[p])?;
                surface_fit::fit_alone(start, &patch.hot, &problem.data[p], &limit(problem, p), &stage)?
            }
        };
        stage.piece_done()?;
        Ok(space)
    };
    (0..patches.len()).into_par_iter().map(space).collect()
}

/// How far a patch may be refined.
fn limit(problem: &Problem<'_>, patch: usize) -> Limit {
    Limit::new(&problem.hot.patches[patch], problem.data[patch].data.len())
}

struct Coupled {
    coefficients: Vec<Vec<DVec3>>,
    blocks: Vec<Block>,
    cells: Vec<Cells>,
    /// Cell and size of what each datum is missed by.
    residuals: Vec<Vec<(usize, f64)>>,
    links: Vec<JointLinks>,
}

impl Coupled {
    /// Sets up the equations and solves them; `part_done` hears fractions in between.
    fn solve(
        problem: &Problem<'_>,
        data: &[PatchData],
        spaces: &[Space],
        part_done: &dyn Fn(f64) -> Result<()>,
    ) -> Result<Self> {
        let hot = problem.hot;
        let (unknowns, count) = number(hot, spaces, problem.prescribed);
        let (blocks, cells): (Vec<Block>, Vec<Cells>) = spaces
            .par_iter()
            .zip(unknowns)
            .enumerate()
            .map(|(p, (space, unknowns))| {
                let cells = Cells::new(space, &data[p]);
                let equations = surface_fit::equations(space, &hot.patches[p].hot, &data[p], &cells);
                let prescribed =
                    problem.prescribed[p].clone().unwrap_or_else(|| vec![DVec3::ZERO; space.poles()]);
                (Block { space: space.clone(), equations, unknowns, prescribed }, cells)
            })
            .unzip();
        let links: Vec<JointLinks> = hot
            .joints
            .par_iter()
            .zip(problem.ties)
            .map(|(joint, &tie)| {
                let spacing = joint_spacing(problem, joint);
                links::links(hot, joint, &Context { spaces, affine: problem.affine, tie, spacing })
            })
            .collect();
        let all: Vec<_> = links.iter().flat_map(|l| l.position.iter().chain(&l.tangent)).cloned().collect();
        part_done(0.3)?;
        let coefficients = system::solve(&blocks, &all, count, &|| part_done(0.5))?;
        part_done(0.8)?;
        let missed = |p: usize| surface_fit::residuals(&spaces[p], &data[p], &cells[p], &coefficients[p]);
        let residuals = (0..spaces.len()).into_par_iter().map(missed).collect();
        Ok(Self { coefficients, blocks, cells, residuals, links })
    }

    /// The largest residual, mm.
    fn worst_mm(&self) -> f64 {
        self.residuals.iter().flatten().map(|r| r.1).fold(0.0, f64::max)
    }

    /// Gives data that are missed by far more weight: the field is singular there, and the smooth
    /// surface that the others ask for cuts the corner.
    fn weigh(&self, data: &mut [PatchData]) {
        for (patch, residuals) in data.iter_mut().zip(&self.residuals) {
            for (datum, (_, missed)) in patch.data.iter_mut().zip(residuals) {
                datum.weight = (datum.weight * missed / SINGULAR_MM).clamp(1.0, HEAVIEST);
            }
        }
    }

    /// Spaces with finer knots where edges gape or nodes are missed; none if nothing is asked.
    fn refine(&self, problem: &Problem<'_>, spaces: &[Space]) -> Result<Option<Vec<Space>>> {
        let hot = problem.hot;
        let mut marks: Vec<Marks> =
            (0..spaces.len()).into_par_iter().map(|p| self.mark_missed(problem, p)).collect();
        for (joint, links) in hot.joints.iter().zip(&self.links) {
            self.mark_gaping(problem, joint, links, &mut marks);
        }
        let mut asked = false;
        let mut finer = Vec::with_capacity(spaces.len());
        for (p, (space, marks)) in spaces.iter().zip(&marks).enumerate() {
            let refined = match problem.prescribed[p] {
                Some(_) => None,
                None => marks.refine(space, &hot.patches[p].hot, &limit(problem, p))?,
            };
            asked |= refined.is_some();
            finer.push(refined.unwrap_or_else(|| space.clone()));
        }
        Ok(asked.then_some(finer))
    }

    /// Asks for finer knots where a patch misses its data, finer at edges than inside.
    fn mark_missed(&self, problem: &Problem<'_>, p: usize) -> Marks {
        let cells = &self.cells[p];
        let mut at_edge = vec![false; cells.count.len()];
        for (joint, links) in problem.hot.joints.iter().zip(&self.links) {
            for side in joint.sides.iter().filter(|s| s.patch == p) {
                links.parameters.iter().for_each(|&t| at_edge[cells.index(side.pcurve.point(t))] = true);
            }
        }
        let shortest = |k: usize| if at_edge[k] { SHORTEST_AT_EDGE } else { SHORTEST };
        surface_fit::mark(cells, &problem.hot.patches[p].hot, &self.residuals[p], shortest)
    }

    /// Asks for finer knots on the coarser side of every sample at which a joint gapes.
    fn mark_gaping(
        &self,
        problem: &Problem<'_>,
        joint: &super::hot::Joint,
        links: &JointLinks,
        marks: &mut [Marks],
    ) {
        for (link, &t) in links.position.iter().zip(&links.parameters) {
            let jump = system::jump(&self.blocks, link, &self.coefficients).length();
            if jump < JUMP_MM {
                continue;
            }
            let side = |s: usize| {
                let side = &joint.sides[s];
                let (p, hot) = (side.patch, &problem.hot.patches[side.patch].hot);
                let k = self.cells[p].index(side.pcurve.point(t));
                let [a, b] = self.cells[p].sides(k, hot);
                (p, k, a.max(b))
            };
            let (a, b) = (side(0), side(1));
            for (p, k, size) in [a, b] {
                if size > 0.7 * a.2.max(b.2) {
                    let shortest = SHORTEST_AT_EDGE * self.cells[p].spacing[k];
                    marks[p].halve_longer(&self.cells[p], &problem.hot.patches[p].hot, k, shortest, jump);
                }
            }
        }
    }
}

/// Node spacing along a joint: the finer of its sides, mm.
fn joint_spacing(problem: &Problem<'_>, joint: &super::hot::Joint) -> f64 {
    joint.sides.iter().map(|s| problem.data[s.patch].spacing).fold(f64::INFINITY, f64::min)
}

/// Numbers the unknowns. Coefficients along a closed or degenerate side of a patch are one
/// unknown, so that what was one point stays one.
fn number(hot: &Hot, spaces: &[Space], prescribed: &[Option<Vec<DVec3>>]) -> (Vec<Vec<u32>>, usize) {
    let mut next = 0u32;
    let mut all = Vec::with_capacity(spaces.len());
    for (p, space) in spaces.iter().enumerate() {
        if prescribed[p].is_some() {
            all.push(vec![PRESCRIBED; space.poles()]);
            continue;
        }
        let ties = PatchTies::new(hot, p);
        let mut unknowns = vec![PRESCRIBED; space.poles()];
        for k in 0..space.poles() {
            let first = ties.first_of(k, space);
            unknowns[k] = if first == k { next } else { unknowns[first] };
            next += u32::from(first == k);
        }
        all.push(unknowns);
    }
    (all, next as usize)
}

/// Which sides of a patch coincide in space.
struct PatchTies {
    /// The first and last row (u), or column (v), are the same curve.
    closed: [bool; 2],
    /// The side at the first / last u, first / last v, is a single point.
    point: [bool; 4],
}

impl PatchTies {
    fn new(hot: &Hot, patch: usize) -> Self {
        let surface = &hot.patches[patch].hot;
        let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
        let fractions = (0..=8).map(|k| k as f64 / 8.0);
        let us: Vec<f64> = fractions.clone().map(|s| u0 + s * (u1 - u0)).collect();
        let vs: Vec<f64> = fractions.map(|s| v0 + s * (v1 - v0)).collect();
        let same = |a: DVec2, b: DVec2| (surface.point(a.x, a.y) - surface.point(b.x, b.y)).length() < 1e-5;
        let seams: Vec<_> = hot
            .joints
            .iter()
            .filter(|j| j.sides.len() == 2 && j.sides.iter().all(|s| s.patch == patch))
            .collect();
        let closed_u = !seams.is_empty() && vs.iter().all(|&v| same(DVec2::new(u0, v), DVec2::new(u1, v)));
        let closed_v = !seams.is_empty() && us.iter().all(|&u| same(DVec2::new(u, v0), DVec2::new(u, v1)));
        let point_u = |u: f64| vs.iter().all(|&v| same(DVec2::new(u, v), DVec2::new(u, v0)));
        let point_v = |v: f64| us.iter().all(|&u| same(DVec2::new(u, v), DVec2::new(u0, v)));
        Self { closed: [closed_u, closed_v], point: [point_u(u0), point_u(u1), point_v(v0), point_v(v1)] }
    }

    /// The coefficient that stands for coefficient `k`.
    fn first_of(&self, k: usize, space: &Space) -> usize {
        let (rows, columns) = (space.ku.len(), space.kv.len());
        let (mut i, mut j) = (k / columns, k % columns);
        if self.closed[0] && i == rows - 1 {
            i = 0;
        }
        if self.closed[1] && j == columns - 1 {
            j = 0;
        }
        if (self.point[0] && i == 0) || (self.point[1] && i == rows - 1) {
            j = 0;
        }
        if (self.point[2] && j == 0) || (self.point[3] && j == columns - 1) {
            i = 0;
        }
        i * columns + j
    }
}
