//! The two sides of an intersection: surfaces cut into parts of continuous curvature, and planes.

use crate::error::Result;
use crate::nurbs::{Direction, KnotVector, NurbsSurface, SurfaceDerivatives};
use glam::{DVec2, DVec3};

/// Parameters nearer to a break than this fraction of the domain lie on it.
pub const SLACK: f64 = 1e-10;
/// A curve that changes a parameter by less than this fraction of the domain over the whole size
/// runs along a break.
const ALONG: f64 = 1e-6;

/// A surface or a plane.
#[derive(Debug, Clone)]
pub enum Sheet {
    /// A plane with orthonormal axes, without borders.
    Plane { origin: DVec3, x: DVec3, y: DVec3 },
    /// A surface.
    Surface(Parts),
}

/// A surface in parts of continuous second derivatives.
#[derive(Debug, Clone)]
pub struct Parts {
    pub surface: NurbsSurface,
    /// All breaks along u and along v.
    breaks: [Vec<f64>; 2],
    /// Those between the parts, and the ends.
    cuts: [Vec<f64>; 2],
    parts: Vec<NurbsSurface>,
}

/// A rectangle between neighbouring breaks, and the part that it belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    pub low: DVec2,
    pub high: DVec2,
    part: usize,
    part_low: DVec2,
    part_high: DVec2,
    /// What counts as nothing along u and v.
    pub slack: DVec2,
}

impl Cell {
    /// Whether the part of the surface that the cell belongs to has these parameters.
    pub fn part_holds(&self, at: DVec2) -> bool {
        at.cmpge(self.part_low - 10.0 * self.slack).all()
            && at.cmple(self.part_high + 10.0 * self.slack).all()
    }
}

fn cuts(knots: &KnotVector) -> Vec<f64> {
    let (a, b) = knots.domain();
    let rough = |&(t, m): &(f64, usize)| t == a || t == b || m + 2 > knots.degree();
    let all = knots.breaks_and_multiplicities();
    all.into_iter().filter(rough).map(|(t, _)| t).collect()
}

impl Parts {
    fn new(surface: &NurbsSurface) -> Result<Self> {
        let surface = surface.clamped()?;
        let cuts = [cuts(surface.knots_u()), cuts(surface.knots_v())];
        let mut parts = Vec::new();
        for u in cuts[0].windows(2) {
            let row = surface.part(Direction::U, u[0], u[1])?;
            for v in cuts[1].windows(2) {
                parts.push(row.part(Direction::V, v[0], v[1])?);
            }
        }
        Ok(Self { breaks: [surface.knots_u().breaks(), surface.knots_v().breaks()], cuts, parts, surface })
    }

    /// Ends of the domain.
    pub fn domain(&self) -> [DVec2; 2] {
        let ((u0, u1), (v0, v1)) = (self.surface.knots_u().domain(), self.surface.knots_v().domain());
        [DVec2::new(u0, v0), DVec2::new(u1, v1)]
    }

    fn cell(&self, at: DVec2, towards: DVec2) -> Option<Cell> {
        let [low, high] = self.domain();
        let slack = SLACK * (high - low);
        let interval = |k: usize| {
            let along = towards[k].abs() < ALONG * (high[k] - low[k]);
            let towards = if along { 0.0 } else { towards[k] };
            interval(&self.breaks[k], at[k], towards, 2.0 * slack[k])
        };
        let (i, j) = (interval(0)?, interval(1)?);
        let of = |breaks: &[f64], i: usize| (breaks[i], breaks[i + 1]);
        let ((u0, u1), (v0, v1)) = (of(&self.breaks[0], i), of(&self.breaks[1], j));
        let part = |cuts: &[f64], t: f64| cuts.partition_point(|&c| c < t) - 1;
        let (a, b) = (part(&self.cuts[0], 0.5 * (u0 + u1)), part(&self.cuts[1], 0.5 * (v0 + v1)));
        let ((pu0, pu1), (pv0, pv1)) = (of(&self.cuts[0], a), of(&self.cuts[1], b));
        Some(Cell {
            low: DVec2::new(u0, v0),
            high: DVec2::new(u1, v1),
            part: a * (self.cuts[1].len() - 1) + b,
            part_low: DVec2::new(pu0, pv0),
            part_high: DVec2::new(pu1, pv1),
            slack,
        })
    }
}

/// The interval that holds `t`, or begins there in the direction of `towards`; none where that
/// leads out.
fn interval(breaks: &[f64], t: f64, towards: f64, slack: f64) -> Option<usize> {
    let last = breaks.len() - 2;
    let inside = |i: usize| breaks[i.min(last)] - slack <= t && t <= breaks[i.min(last) + 1] + slack;
    let i = (breaks.partition_point(|&b| b <= t).max(1) - 1).min(last);
    if t - breaks[i] <= slack && towards < 0.0 {
        return i.checked_sub(1);
    }
    if breaks[i + 1] - t <= slack && towards > 0.0 {
        return (i < last).then_some(i + 1);
    }
    inside(i).then_some(i)
}

impl Sheet {
    pub fn surface(surface: &NurbsSurface) -> Result<Self> {
        Ok(Self::Surface(Parts::new(surface)?))
    }

    /// The plane through a point, across a unit normal.
    pub fn plane(origin: DVec3, normal: DVec3) -> Self {
        let x = normal.any_orthonormal_vector();
        Self::Plane { origin, x, y: normal.cross(x) }
    }

    /// Point and derivatives; the part of the cell is continued beyond it.
    pub fn jet(&self, cell: &Cell, at: DVec2) -> SurfaceDerivatives {
        match self {
            Self::Plane { origin, x, y } => {
                SurfaceDerivatives { s: *origin + *x * at.x + *y * at.y, u: *x, v: *y, ..Default::default() }
            }
            Self::Surface(parts) => parts.parts[cell.part].derivatives(at.x, at.y),
        }
    }

    /// The cell into which `towards` leads from `at`; none where that is outside. `towards` is the
    /// change of the parameters over a way as long as the sheets are large.
    pub fn cell(&self, at: DVec2, towards: DVec2) -> Option<Cell> {
        let all = DVec2::INFINITY;
        match self {
            Self::Plane { .. } => Some(Cell {
                low: -all,
                high: all,
                part: 0,
                part_low: -all,
                part_high: all,
                slack: DVec2::ZERO,
            }),
            Self::Surface(parts) => parts.cell(at, towards),
        }
    }
}
