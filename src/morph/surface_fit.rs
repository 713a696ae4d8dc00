//! The displacement of one patch: data, thin-plate regularisation, and knots where they are asked.

use super::data::PatchData;
use super::progress::Shared;
use super::refine::{Limit, Marks};
use super::space::{Line, NormalEquations, Space, bending, combine};
use crate::error::Result;
use crate::nurbs::{KnotVector, NurbsSurface};
use glam::DVec2;
use glam::DVec3;

/// Cut-off of the regularisation in node spacings: λ = c⁴h². From measurements on real blades:
/// below it the error between nodes explodes while the residual still falls.
const CUT_OFF: f64 = 0.2;
/// Weight that keeps coefficients without any evidence at zero.
const RIDGE: f64 = 1e-10;
/// Residual at which a cell is left alone, mm.
pub const TARGET_MM: f64 = 2.5e-5;
/// Shortest side of a cell in node spacings, as long as only nodes ask for more.
pub const SHORTEST: f64 = 2.0;
/// A residual that asks for knots as dense as edges do, mm: the field is singular there.
pub const SINGULAR_MM: f64 = 1e-4;
/// Shortest side of a cell in node spacings where an edge or a singularity asks for more.
pub const SHORTEST_AT_EDGE: f64 = 0.5;
/// The same where the field is singular.
const SHORTEST_AT_SINGULARITY: f64 = 0.12;
/// Gauss points and weights on (0, 1), two and three.
const GAUSS: [&[(f64, f64)]; 2] = [
    &[(0.211_324_865_405_187_13, 0.5), (0.788_675_134_594_812_9, 0.5)],
    &[(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)],
];

/// The cells of a space (its non-empty knot spans) with what is known of each.
#[derive(Debug, Clone)]
pub struct Cells {
    /// Breaks along u and v.
    pub us: Vec<f64>,
    /// Breaks along v.
    pub vs: Vec<f64>,
    /// Node spacing in each cell (`v` fastest), mm.
    pub spacing: Vec<f64>,
    /// Number of data in each cell.
    pub count: Vec<u32>,
}

impl Cells {
    /// Counts the data in the cells of `space`.
    pub fn new(space: &Space, data: &PatchData) -> Self {
        let (us, vs) = (space.ku.breaks(), space.kv.breaks());
        let n = (us.len() - 1) * (vs.len() - 1);
        let mut cells = Self { us, vs, spacing: vec![0.0; n], count: vec![0; n] };
        for d in &data.data {
            let k = cells.index(d.uv);
            cells.spacing[k] += d.spacing;
            cells.count[k] += 1;
        }
        for (s, &c) in cells.spacing.iter_mut().zip(&cells.count) {
            *s = if c > 0 { *s / c as f64 } else { 0.0 };
        }
        cells.spread_spacing(data.spacing);
        cells
    }

    /// Gives empty cells the spacing of the nearest cells that have one, ring by ring.
    fn spread_spacing(&mut self, fallback: f64) {
        let (rows, columns) = (self.us.len() - 1, self.vs.len() - 1);
        loop {
            let old = self.spacing.clone();
            for k in (0..old.len()).filter(|&k| old[k] == 0.0) {
                let (i, j) = (k / columns, k % columns);
                let around = [
                    (i > 0).then(|| k - columns),
                    (i + 1 < rows).then(|| k + columns),
                    (j > 0).then(|| k - 1),
                    (j + 1 < columns).then(|| k + 1),
                ];
                let known: Vec<f64> =
                    around.into_iter().flatten().map(|n| old[n]).filter(|s| *s > 0.0).collect();
                if !known.is_empty() {
                    self.spacing[k] = known.iter().sum::<f64>() / known.len() as f64;
                }
            }
            if self.spacing == old {
                self.spacing.iter_mut().filter(|s| **s == 0.0).for_each(|s| *s = fallback);
                return;
            }
        }
    }

    /// The cell of a parameter pair.
    pub fn index(&self, uv: DVec2) -> usize {
        let at = |breaks: &[f64], t: f64| breaks.partition_point(|&b| b <= t).clamp(1, breaks.len() - 1) - 1;
        at(&self.us, uv.x) * (self.vs.len() - 1) + at(&self.vs, uv.y)
    }

    /// Row and column of a cell.
    pub fn place(&self, k: usize) -> (usize, usize) {
        (k / (self.vs.len() - 1), k % (self.vs.len() - 1))
    }

    /// Its sides in mm on `surface`.
    pub fn sides(&self, k: usize, surface: &NurbsSurface) -> [f64; 2] {
        let (i, j) = self.place(k);
        let (du, dv) = (self.us[i + 1] - self.us[i], self.vs[j + 1] - self.vs[j]);
        let d = surface.derivatives(self.us[i] + 0.5 * du, self.vs[j] + 0.5 * dv);
        [d.u.length() * du, d.v.length() * dv]
    }
}

/// The normal equations of a patch alone.
pub fn equations(space: &Space, hot: &NurbsSurface, data: &PatchData, cells: &Cells) -> NormalEquations {
    let mut equations = NormalEquations::new(space);
    for d in &data.data {
        equations.add(&space.value(d.uv), d.weight, d.target);
    }
    add_bending(space, hot, cells, &mut equations);
    equations.add_ridge(RIDGE);
    equations
}

fn add_bending(space: &Space, hot: &NurbsSurface, cells: &Cells, equations: &mut NormalEquations) {
    let gauss = |k: &KnotVector, breaks: &[f64]| -> Vec<(f64, f64, Line)> {
        let points = GAUSS[usize::from(k.degree() > 3)];
        let span = |w: &[f64]| {
            let (a, length) = (w[0], w[1] - w[0]);
            points.iter().map(move |&(x, weight)| (a + x * length, weight * length))
        };
        breaks.windows(2).flat_map(span).map(|(t, w)| (t, w, Line::at(k, t))).collect()
    };
    let (gu, gv) = (gauss(&space.ku, &cells.us), gauss(&space.kv, &cells.vs));
    let parameters = |gauss: &[(f64, f64, Line)]| gauss.iter().map(|g| g.0).collect::<Vec<_>>();
    let on_hot = hot.derivatives_on_grid(&parameters(&gu), &parameters(&gv));
    let (per_u, per_v) = (gu.len() / (cells.us.len() - 1), gv.len() / (cells.vs.len() - 1));
    for (i, (_, wu, lu)) in gu.iter().enumerate() {
        for (j, (_, wv, lv)) in gv.iter().enumerate() {
            let h = cells.spacing[(i / per_u) * (cells.vs.len() - 1) + j / per_v].max(1e-6);
            let Some((rows, area)) = bending(&on_hot[i * gv.len() + j]) else { continue };
            let weight = CUT_OFF.powi(4) * h * h * area * wu * wv;
            for w in rows {
                equations.add_square(&combine(lu, lv, w), weight);
            }
        }
    }
}

/// Cells whose data are missed by more than the target, as knots to insert: the longer side is
/// halved, never below twice the node spacing.
pub fn mark(
    cells: &Cells,
    hot: &NurbsSurface,
    residuals: &[(usize, f64)],
    shortest: impl Fn(usize) -> f64,
) -> Marks {
    let mut marks = Marks::new(cells);
    let mut worst = vec![0.0f64; cells.count.len()];
    for &(k, r) in residuals {
        worst[k] = worst[k].max(r);
    }
    for (k, &r) in worst.iter().enumerate() {
        if r > TARGET_MM {
            let shortest = if r > SINGULAR_MM { SHORTEST_AT_SINGULARITY } else { shortest(k) };
            marks.halve_longer(cells, hot, k, shortest * cells.spacing[k], r);
        }
    }
    marks
}

/// Cell and size of what each datum is missed by.
pub fn residuals(space: &Space, data: &PatchData, cells: &Cells, x: &[DVec3]) -> Vec<(usize, f64)> {
    let one = |d: &super::data::Datum| {
        (cells.index(d.uv), (space.apply(&space.value(d.uv), x) - d.target).length())
    };
    data.data.iter().map(one).collect()
}

/// Fits one patch on its own, inserting knots until its data are met, the mesh carries no more,
/// or the limit is reached; `stage` hears of every round.
///
/// # Errors
/// [`crate::Error::Numerics`] where the equations cannot be solved; [`crate::Error::Cancelled`].
pub fn fit_alone(
    mut space: Space,
    hot: &NurbsSurface,
    data: &PatchData,
    limit: &Limit,
    stage: &Shared<'_>,
) -> Result<Space> {
    if data.data.is_empty() {
        return Ok(space);
    }
    loop {
        stage.goes_on()?;
        let cells = Cells::new(&space, data);
        let x = equations(&space, hot, data, &cells).solve()?;
        let marks = mark(&cells, hot, &residuals(&space, data, &cells, &x), |_| SHORTEST);
        match marks.refine(&space, hot, limit)? {
            Some(finer) => space = finer,
            None => return Ok(space),
        }
    }
}
