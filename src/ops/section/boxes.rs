//! Where two surfaces meet: pairs of patches, halved until their boxes are apart or their normals
//! nowhere agree.
//!
//! Patches whose cones of normals (Sederberg and Meyers 1988) do not meet share no closed branch
//! and do not touch: from their middles Newton's method finds the branch. What stays undecided is
//! where the surfaces touch or coincide.

use super::pair::{At, Cells, Cut, Kind, Pair};
use super::seeds::{Place, Seeds};
use super::sheet::Sheet;
use super::touch::{Contact, Normal, common_normal};
use crate::error::Result;
use crate::nurbs::{Direction, NurbsSurface};
use crate::ops::closest;
use crate::ops::invert::bezier::{SurfacePiece, surface_pieces};
use glam::{DVec2, DVec3};

/// Half angle in rad of a cone of normals below which a patch is flat enough for a start.
const FLAT: f64 = 0.4;
/// Halvings of patches that ought to meet but show no common point.
const PATIENCE: usize = 6;
/// Fractions of the size: patches below are searched for touching, left as touching, given up.
const TOUCHING: f64 = 0.1;
const NEAR_TOUCHING: f64 = 5e-3;
const SMALLEST: f64 = 1e-6;

/// A patch with its bounds.
struct Patch {
    piece: SurfacePiece,
    points: Vec<DVec3>,
    low: DVec3,
    high: DVec3,
    radius: f64,
    /// The middle of the normals and the largest angle from it, in rad.
    axis: DVec3,
    spread: f64,
    /// Middles of the derivatives.
    along: [DVec3; 2],
    halves: Option<[usize; 2]>,
}

/// The middle of some directions and the largest angle from it.
fn cone(directions: impl Iterator<Item = DVec3> + Clone) -> (DVec3, f64) {
    let units = directions.filter_map(DVec3::try_normalize);
    let axis = units.clone().sum::<DVec3>().normalize_or_zero();
    (axis, units.map(|d| axis.dot(d).clamp(-1.0, 1.0).acos()).fold(0.0, f64::max))
}

impl Patch {
    fn new(piece: SurfacePiece) -> Self {
        let points: Vec<DVec3> = piece.points().collect();
        let bounds = points.iter().fold((DVec3::MAX, DVec3::MIN), |(a, b), p| (a.min(*p), b.max(*p)));
        let columns = piece.columns;
        let (u, alpha) = cone(points.iter().zip(&points[columns..]).map(|(a, b)| *b - *a));
        let (v, beta) = cone(points.chunks(columns).flat_map(|row| row.windows(2).map(|w| w[1] - w[0])));
        let cross = u.cross(v);
        let (sine, cosine) = (cross.length(), u.dot(v).abs());
        let (a, b) = (alpha.sin(), beta.sin());
        let bound = (a * a + 2.0 * a * b * cosine + b * b).sqrt() / sine;
        let known = sine > 0.0 && alpha < 1.5 && beta < 1.5 && bound < 1.0;
        Self {
            piece,
            points,
            low: bounds.0,
            high: bounds.1,
            radius: 0.5 * (bounds.1 - bounds.0).length(),
            axis: cross.normalize_or_zero(),
            spread: if known { bound.asin() } else { 4.0 },
            along: [u, v],
            halves: None,
        }
    }

    fn range(&self) -> [DVec2; 2] {
        let [[u0, u1], [v0, v1]] = self.piece.range;
        [DVec2::new(u0, v0), DVec2::new(u1, v1)]
    }

    fn middle(&self) -> DVec2 {
        let [low, high] = self.range();
        0.5 * (low + high)
    }

    /// Whether parameters lie in the patch or not far beyond.
    fn is_near(&self, at: DVec2, factor: f64) -> bool {
        let [low, high] = self.range();
        ((at - self.middle()).abs()).cmple(0.5 * factor * (high - low)).all()
    }

    /// Lowest and highest along a direction.
    fn extent(&self, direction: DVec3) -> (f64, f64) {
        let along = self.points.iter().map(|p| p.dot(direction));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
    }

    fn is_apart(&self, other: &Self, gap: f64) -> bool {
        if self.low.cmpgt(other.high + gap).any() || other.low.cmpgt(self.high + gap).any() {
            return true;
        }
        let axes = |p: &Self| [p.axis, p.axis.cross(p.along[0]), p.axis.cross(p.along[1])];
        axes(self).into_iter().chain(axes(other)).filter(|axis| *axis != DVec3::ZERO).any(|axis| {
            let ((a, b), (c, d)) = (self.extent(axis), other.extent(axis));
            a > d + gap || c > b + gap
        })
    }

    /// Whether no normal of one is a normal of the other.
    fn is_transversal(&self, other: &Self) -> bool {
        let angle = self.axis.dot(other.axis).abs().clamp(0.0, 1.0).acos();
        angle > self.spread + other.spread
    }

    fn halved(&self) -> [Self; 2] {
        let (n, c) = (self.points.len(), self.piece.columns);
        let along_v =
            self.points[0].distance(self.points[c - 1]).max(self.points[n - c].distance(self.points[n - 1]));
        let along_u =
            self.points[0].distance(self.points[n - c]).max(self.points[c - 1].distance(self.points[n - 1]));
        let direction = if along_u > along_v { Direction::U } else { Direction::V };
        self.piece.clone().halves(direction).map(Self::new)
    }
}

/// Patches of one surface, halved when first asked for.
struct Tree {
    patches: Vec<Patch>,
    roots: usize,
}

impl Tree {
    fn new(surface: &NurbsSurface) -> Result<Self> {
        let patches: Vec<Patch> = surface_pieces(surface)?.into_iter().map(Patch::new).collect();
        Ok(Self { roots: patches.len(), patches })
    }

    fn halves(&mut self, i: usize) -> [usize; 2] {
        if let Some(halves) = self.patches[i].halves {
            return halves;
        }
        let n = self.patches.len();
        let halves = self.patches[i].halved();
        self.patches.extend(halves);
        self.patches[i].halves = Some([n, n + 1]);
        [n, n + 1]
    }
}

/// What to do with a pair of patches.
enum Verdict {
    Done,
    /// Halve it; whether it was tried in vain.
    Halve(bool),
}

/// Points on the branches of two surfaces, and where they touch.
pub fn seeds(pair: &Pair, a: &NurbsSurface, b: &NurbsSurface) -> Result<Seeds> {
    let mut trees = [Tree::new(a)?, Tree::new(b)?];
    let mut seeds = Seeds::default();
    let mut rest: Vec<[usize; 3]> = Vec::new();
    for i in 0..trees[0].roots {
        rest.extend((0..trees[1].roots).map(|j| [i, j, 0]));
        while let Some([i, j, tries]) = rest.pop() {
            let (p, q) = (&trees[0].patches[i], &trees[1].patches[j]);
            if p.is_apart(q, pair.tolerance) {
                continue;
            }
            pair.spend()?;
            let Verdict::Halve(tried) = examine(pair, [p, q], &mut seeds) else { continue };
            let tries = tries + usize::from(tried);
            if tries > PATIENCE || p.radius.max(q.radius) < SMALLEST * pair.size {
                if !tried {
                    seeds.uncertain.push(p.middle());
                }
                continue;
            }
            let bent = |patch: &Patch| patch.radius * patch.spread.max(0.1);
            if bent(p) >= bent(q) {
                rest.extend(trees[0].halves(i).map(|i| [i, j, tries]));
            } else {
                rest.extend(trees[1].halves(j).map(|j| [i, j, tries]));
            }
        }
    }
    Ok(seeds)
}

fn examine(pair: &Pair, patches: [&Patch; 2], seeds: &mut Seeds) -> Verdict {
    let [p, q] = patches;
    let guess = [p.middle(), q.middle()];
    let Some(cells) = pair.cells(guess, [DVec2::ZERO; 2]) else { return Verdict::Done };
    if p.is_transversal(q) {
        if p.spread.max(q.spread) > FLAT {
            return Verdict::Halve(false);
        }
        return if start(pair, patches, &cells, guess, seeds) { Verdict::Done } else { Verdict::Halve(true) };
    }
    let radius = p.radius.max(q.radius) / pair.size;
    let found = if radius < TOUCHING { common_normal(pair, &cells, guess) } else { None };
    match found.filter(|f| f.gap <= pair.tolerance) {
        Some(found) => touch(pair, patches, found, radius, seeds),
        None => Verdict::Halve(false),
    }
}

/// What a common normal of no length says about two patches of a size.
fn touch(pair: &Pair, patches: [&Patch; 2], found: Normal, radius: f64, seeds: &mut Seeds) -> Verdict {
    let [p, q] = patches;
    let small = radius < NEAR_TOUCHING;
    let here = p.is_near(found.at[0], 1.5) && q.is_near(found.at[1], 1.5);
    let done = match found.contact {
        Contact::Area => {
            let common = coinciding(pair, patches);
            let overlap = common == 9 || (small && common > 3);
            if overlap {
                seeds.overlap(p.range());
            }
            overlap || small
        }
        // What touches elsewhere is met by the patches there.
        _ if !here => small,
        contact => {
            seeds.touch(pair, found);
            contact == Contact::Curve || small
        }
    };
    if done { Verdict::Done } else { Verdict::Halve(false) }
}

/// Notes points of the branch through two patches; whether there are any.
fn start(pair: &Pair, [p, q]: [&Patch; 2], cells: &Cells, guess: At, seeds: &mut Seeds) -> bool {
    let domains = pair.sheets.each_ref().map(|sheet| match sheet {
        Sheet::Surface(parts) => parts.domain(),
        Sheet::Plane { .. } => [DVec2::NEG_INFINITY, DVec2::INFINITY],
    });
    let direction = p.axis.cross(q.axis).normalize_or(DVec3::Z);
    let point = pair.jets(cells, guess)[0].s;
    let mut cuts = vec![Cut::Across { point, direction }];
    for (k, patch) in [p, q].into_iter().enumerate() {
        let [low, high] = patch.range();
        for d in 0..2 {
            for (end, border) in [(low[d], domains[k][0][d]), (high[d], domains[k][1][d])] {
                if end == border {
                    cuts.push(Cut::Parameter { index: 2 * k + d, value: end });
                }
            }
        }
    }
    let mut found = false;
    for cut in cuts {
        let Some((at, _)) = pair.point(Kind::Crossing, cells, guess, cut) else { continue };
        if p.is_near(at[0], 1.2) && q.is_near(at[1], 1.2) && (0..2).all(|k| cells[k].part_holds(at[k])) {
            seeds.crossing.push(Place { at, inside: guess });
            found = true;
        }
    }
    found
}

/// How many of nine places of the first patch lie on the second surface.
fn coinciding(pair: &Pair, [p, q]: [&Patch; 2]) -> usize {
    let [Sheet::Surface(a), Sheet::Surface(b)] = &pair.sheets else { return 0 };
    let [low, high] = p.range();
    let place = |k: usize| low + (high - low) * DVec2::new((k / 3) as f64, (k % 3) as f64) * 0.5;
    let on = |k: &usize| {
        let uv = place(*k);
        closest::foot(&b.surface, a.surface.point(uv.x, uv.y), q.middle()).distance <= pair.tolerance
    };
    (0..9).filter(on).count()
}
