//! Where a surface meets a plane: signs of the Bernstein coefficients of the distance.
//!
//! A patch on which the distance is monotonic along one parameter, and each of whose sides it
//! changes sign at most once, holds one branch at most, and that if its corners lie on both sides.
//! Patches are quartered until this decides; what it cannot decide is where the surface touches.

use super::pair::{At, Pair};
use super::seeds::{Place, Seeds};
use super::sheet::Sheet;
use super::touch::{Contact, common_normal, on_plane};
use crate::error::Result;
use crate::nurbs::NurbsSurface;
use crate::ops::invert::bezier::{halve, surface_pieces};
use glam::{DVec2, DVec3, Vec2Swizzles};

/// Quarterings before touching is looked for.
const TOUCHING_FROM: usize = 3;
/// Quarterings before a patch around a touching point is left.
const NEAR_TOUCHING: usize = 9;
/// Quarterings at most.
const DEEPEST: usize = 26;

/// Bernstein coefficients, `v` fastest, of the distance times the weight.
#[derive(Debug, Clone)]
struct Net {
    low: DVec2,
    high: DVec2,
    columns: usize,
    values: Vec<f64>,
    depth: usize,
}

/// What signs say.
enum Verdict {
    Nothing,
    /// One branch at most; points on it.
    Branch(Vec<DVec2>),
    Undecided,
}

impl Net {
    /// Both halves along v.
    fn halves(mut self) -> [Self; 2] {
        let middle = 0.5 * (self.low.y + self.high.y);
        let values: Vec<f64> = self.values.chunks_exact_mut(self.columns).flat_map(halve).collect();
        let second = Self { low: DVec2::new(self.low.x, middle), values, ..self };
        self.high.y = middle;
        [self, second]
    }

    fn transposed(self) -> Self {
        let (rows, columns) = (self.values.len() / self.columns, self.columns);
        let values = (0..self.values.len()).map(|k| self.values[(k % rows) * columns + k / rows]).collect();
        Self { low: self.low.yx(), high: self.high.yx(), columns: rows, values, depth: self.depth }
    }

    fn quarters(self) -> impl Iterator<Item = Self> {
        let halves = self.halves().map(|half| half.transposed().halves());
        halves.into_iter().flatten().map(|quarter| {
            let mut quarter = quarter.transposed();
            quarter.depth += 1;
            quarter
        })
    }

    /// The coefficients along the four sides with their ends in the parameters.
    fn sides(&self) -> [(Vec<f64>, DVec2, DVec2); 4] {
        let (n, c) = (self.values.len(), self.columns);
        let pick = |from: usize, step: usize, count: usize| {
            (0..count).map(|k| self.values[from + k * step]).collect::<Vec<f64>>()
        };
        let (low, high) = (self.low, self.high);
        let (right, top) = (DVec2::new(high.x, low.y), DVec2::new(low.x, high.y));
        [
            (pick(0, 1, c), low, top),
            (pick(n - c, 1, c), right, high),
            (pick(0, c, n / c), low, right),
            (pick(c - 1, c, n / c), top, high),
        ]
    }

    fn is_monotonic(&self, nothing: f64) -> bool {
        // A side on which the distance vanishes is a factor that changes no sign within.
        let counts = |line: &&[f64]| line.iter().any(|c| c.abs() > nothing);
        let one_sign = |lines: &[f64], width: usize| {
            let lines = lines.chunks(width).filter(counts);
            let range = bounds(lines.flat_map(|line| line.windows(2).map(|w| w[1] - w[0])));
            range.0 <= range.1 && (range.0 > nothing || range.1 < -nothing)
        };
        let rows = self.values.len() / self.columns;
        one_sign(&self.values, self.columns) || one_sign(&self.clone().transposed().values, rows)
    }

    fn verdict(&self, nothing: f64) -> Verdict {
        let (least, most) = bounds(self.values.iter().copied());
        if least > nothing || most < -nothing {
            return Verdict::Nothing;
        }
        let sides = self.sides();
        if !self.is_monotonic(nothing) || sides.iter().any(|(side, ..)| changes(side, nothing) > 1) {
            return Verdict::Undecided;
        }
        let mut places = Vec::new();
        for (side, from, to) in &sides {
            let (first, last) = (side[0], side[side.len() - 1]);
            if first.abs() <= nothing {
                places.push(*from);
            }
            if last.abs() <= nothing {
                places.push(*to);
            }
            if first.abs().min(last.abs()) > nothing && first * last < 0.0 {
                places.push(from.lerp(*to, root(side)));
            }
        }
        if places.is_empty() { Verdict::Nothing } else { Verdict::Branch(places) }
    }
}

fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
}

/// Changes of sign among coefficients that are not nothing.
fn changes(side: &[f64], nothing: f64) -> usize {
    let signs = side.iter().filter(|c| c.abs() > nothing).map(|c| *c > 0.0);
    signs.clone().zip(signs.skip(1)).filter(|(a, b)| a != b).count()
}

/// The only root in [0, 1] of Bernstein coefficients with different signs at the ends.
fn root(side: &[f64]) -> f64 {
    let value = |t: f64| {
        let mut c = side.to_vec();
        for level in (1..c.len()).rev() {
            for i in 0..level {
                c[i] += (c[i + 1] - c[i]) * t;
            }
        }
        c[0]
    };
    let (mut a, mut b) = (0.0, 1.0);
    for _ in 0..30 {
        let middle = 0.5 * (a + b);
        if (value(middle) > 0.0) == (side[0] > 0.0) { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}

/// Points on all branches of a surface in a plane, and where it touches.
pub fn seeds(pair: &Pair, surface: &NurbsSurface, origin: DVec3, normal: DVec3) -> Result<Seeds> {
    let mut seeds = Seeds::default();
    for piece in surface_pieces(surface)? {
        let distance = |(p, w): (&DVec3, &f64)| (*p - origin * *w).dot(normal);
        let values: Vec<f64> = piece.poles.iter().zip(&piece.weights).map(distance).collect();
        let heaviest = piece.weights.iter().copied().fold(0.0, f64::max);
        let lightest = piece.weights.iter().copied().fold(f64::INFINITY, f64::min);
        let [[u0, u1], [v0, v1]] = piece.range;
        let (low, high) = (DVec2::new(u0, v0), DVec2::new(u1, v1));
        let (least, most) = bounds(values.iter().copied());
        if least.abs().max(most.abs()) <= pair.tolerance * lightest {
            seeds.overlaps.push([low, high]);
            continue;
        }
        let nothing = 8.0 * f64::EPSILON * pair.reach * heaviest;
        search(pair, Net { low, high, columns: piece.columns, values, depth: 0 }, nothing, &mut seeds)?;
    }
    Ok(seeds)
}

fn search(pair: &Pair, net: Net, nothing: f64, seeds: &mut Seeds) -> Result<()> {
    let mut rest = vec![net];
    while let Some(net) = rest.pop() {
        pair.spend()?;
        match net.verdict(nothing) {
            Verdict::Nothing => {}
            Verdict::Branch(places) => {
                let middle = 0.5 * (net.low + net.high);
                seeds.crossing.extend(places.into_iter().map(|uv| {
                    // Within the patch, the side on which it has the derivatives is known.
                    Place { at: pierced(pair, uv), inside: pierced(pair, middle) }
                }));
            }
            Verdict::Undecided if net.depth < DEEPEST => {
                if net.depth < TOUCHING_FROM || !touches(pair, &net, seeds) {
                    rest.extend(net.quarters());
                }
            }
            Verdict::Undecided => seeds.uncertain.push(0.5 * (net.low + net.high)),
        }
    }
    Ok(())
}

fn pierced(pair: &Pair, uv: DVec2) -> At {
    let [Sheet::Surface(parts), Sheet::Plane { origin, x, y }] = &pair.sheets else {
        unreachable!("a surface and a plane")
    };
    [uv, on_plane(*origin, *x, *y, parts.surface.point(uv.x, uv.y))]
}

/// Notes the touching point of a patch if there is one; whether the patch is done with.
fn touches(pair: &Pair, net: &Net, seeds: &mut Seeds) -> bool {
    let (middle, half) = (0.5 * (net.low + net.high), 0.5 * (net.high - net.low));
    let guess = pierced(pair, middle);
    let Some(cells) = pair.cells(guess, [DVec2::ZERO; 2]) else { return false };
    let Some(found) = common_normal(pair, &cells, guess) else { return false };
    let off = (found.at[0] - middle).abs() / half;
    if off.max_element() > 1.5 || found.gap > pair.tolerance {
        return false;
    }
    match found.contact {
        Contact::Area => net.depth >= NEAR_TOUCHING,
        contact => {
            seeds.touch(pair, found);
            contact == Contact::Curve || net.depth >= NEAR_TOUCHING
        }
    }
}
