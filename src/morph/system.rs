//! The coupled system: every patch's normal equations, tied together along the edges.
//!
//! Links ask for equal values (or equal cross-edge derivatives) on both sides of an edge. They are
//! soft: along a trimmed edge the two spline spaces share next to no functions, and links forced
//! to zero would lock the patches and pull them off their nodes.

use super::space::{NormalEquations, Row, Space};
use crate::error::Result;
use crate::linalg::{SparseCholesky, SymmetricEntries, SymmetricMatrix};
use glam::DVec3;
use std::collections::HashMap;

/// Marks a coefficient that is prescribed.
pub const PRESCRIBED: u32 = u32::MAX;

/// One patch in the system.
#[derive(Debug, Clone)]
pub struct Block {
    /// Its space.
    pub space: Space,
    /// Its own normal equations.
    pub equations: NormalEquations,
    /// For each coefficient the unknown it is: several may be one (a closed side, a degenerate
    /// side), or none ([`PRESCRIBED`]).
    pub unknowns: Vec<u32>,
    /// Values of prescribed coefficients (zero elsewhere).
    pub prescribed: Vec<DVec3>,
}

/// Asks `a · D_a − b · D_b = target`.
#[derive(Debug, Clone)]
pub struct Link {
    /// Patch and functional on one side.
    pub a: (usize, Row),
    /// Patch and functional on the other side.
    pub b: (usize, Row),
    /// Difference wanted.
    pub target: DVec3,
    /// Weight of the square.
    pub weight: f64,
}

/// Solves for the coefficients of every block; `assembled` is called before the factorisation.
///
/// # Errors
/// [`crate::Error::Numerics`] where the system is singular; what `assembled` returns.
pub fn solve(
    blocks: &[Block],
    links: &[Link],
    unknowns: usize,
    assembled: &dyn Fn() -> Result<()>,
) -> Result<Vec<Vec<DVec3>>> {
    let matrix = SymmetricMatrix::new(unknowns, &Assembly::new(blocks, links));
    assembled()?;
    let factor = SparseCholesky::new(&matrix)?;
    let mut x = vec![DVec3::ZERO; unknowns];
    for block in blocks {
        scatter(block, &block.equations.rhs, &mut x);
    }
    for link in links {
        add_link_target(blocks, link, &mut x);
    }
    factor.solve(&mut x)?;
    Ok(blocks.iter().map(|b| gather(b, &x)).collect())
}

/// What a link misses.
pub fn jump(blocks: &[Block], link: &Link, solution: &[Vec<DVec3>]) -> DVec3 {
    let side = |s: &(usize, Row)| blocks[s.0].space.apply(&s.1, &solution[s.0]);
    side(&link.a) - side(&link.b) - link.target
}

fn scatter(block: &Block, values: &[DVec3], out: &mut [DVec3]) {
    for (&u, v) in block.unknowns.iter().zip(values) {
        if u != PRESCRIBED {
            out[u as usize] += *v;
        }
    }
}

fn gather(block: &Block, x: &[DVec3]) -> Vec<DVec3> {
    let known = block.unknowns.iter().zip(&block.prescribed);
    known.map(|(&u, p)| if u == PRESCRIBED { *p } else { x[u as usize] }).collect()
}

/// Right-hand side of one link: what is wanted and what is prescribed.
fn add_link_target(blocks: &[Block], link: &Link, rhs: &mut [DVec3]) {
    let known = |s: &(usize, Row)| blocks[s.0].space.apply(&s.1, &blocks[s.0].prescribed);
    let target = (link.target + known(&link.b) - known(&link.a)) * link.weight;
    for (side, sign) in [(&link.a, 1.0), (&link.b, -1.0)] {
        for_each_pole(&blocks[side.0], &side.1, |unknown, c| rhs[unknown] += target * (sign * c));
    }
}

fn for_each_pole(block: &Block, row: &Row, mut visit: impl FnMut(usize, f64)) {
    let columns = block.space.kv.len();
    for a in 0..=block.space.ku.degree() {
        for b in 0..=block.space.kv.degree() {
            let unknown = block.unknowns[(row.i0 + a) * columns + row.j0 + b];
            if unknown != PRESCRIBED && row.c[a][b] != 0.0 {
                visit(unknown as usize, row.c[a][b]);
            }
        }
    }
}

/// What the links between two cells put off the blocks of their patches.
struct CellPair {
    sides: [(usize, usize, usize); 2],
    dense: Vec<f64>,
}

impl CellPair {
    fn sides(link: &Link) -> [(usize, usize, usize); 2] {
        [&link.a, &link.b].map(|(block, row)| (*block, row.i0, row.j0))
    }

    fn new(blocks: &[Block], sides: [(usize, usize, usize); 2]) -> Self {
        let [rows, columns] = sides.map(|s| blocks[s.0].space.order());
        Self { sides, dense: vec![0.0; rows * columns] }
    }

    fn add(&mut self, blocks: &[Block], link: &Link) {
        let ([p, q], other) = (blocks[link.a.0].space.degrees(), blocks[link.b.0].space.degrees());
        let mut at = 0;
        for a in link.a.1.c[..=p].iter().flat_map(|line| &line[..=q]) {
            let a = -a * link.weight;
            for line in &link.b.1.c[..=other[0]] {
                let line = &line[..=other[1]];
                self.dense[at..at + line.len()].iter_mut().zip(line).for_each(|(d, b)| *d += a * b);
                at += line.len();
            }
        }
    }

    fn for_each(&self, blocks: &[Block], mut visit: impl FnMut(u32, u32, f64)) {
        let poles = |side: usize| {
            let (block, i0, j0) = self.sides[side];
            let Block { space, unknowns, .. } = &blocks[block];
            let [p, q] = space.degrees();
            (i0..=i0 + p).flat_map(move |i| (j0..=j0 + q).map(move |j| unknowns[i * space.kv.len() + j]))
        };
        let mut values = self.dense.iter();
        for i in poles(0) {
            for (j, value) in poles(1).zip(&mut values) {
                visit(i, j, *value);
            }
        }
    }
}

/// All that goes into the matrix: the blocks with their own parts of the links, and what is
/// between blocks.
struct Assembly<'a> {
    blocks: &'a [Block],
    equations: Vec<NormalEquations>,
    pairs: Vec<CellPair>,
}

impl<'a> Assembly<'a> {
    fn new(blocks: &'a [Block], links: &[Link]) -> Self {
        let mut equations: Vec<NormalEquations> = blocks.iter().map(|b| b.equations.clone()).collect();
        let (mut pairs, mut known) = (Vec::new(), HashMap::new());
        for link in links {
            for (block, row) in [&link.a, &link.b] {
                equations[*block].add_square(row, link.weight);
            }
            let sides = CellPair::sides(link);
            let at = *known.entry(sides).or_insert_with(|| {
                pairs.push(CellPair::new(blocks, sides));
                pairs.len() - 1
            });
            pairs[at].add(blocks, link);
        }
        Self { blocks, equations, pairs }
    }
}

impl SymmetricEntries for Assembly<'_> {
    fn for_each(&self, mut visit: impl FnMut(usize, usize, f64)) {
        // An entry off the local diagonal stands for two; where both coefficients are one unknown,
        // both fall on its diagonal.
        let mut entry = |i: u32, j: u32, diagonal: bool, value: f64| {
            if i != PRESCRIBED && j != PRESCRIBED && value != 0.0 {
                visit(i as usize, j as usize, if i == j && !diagonal { 2.0 * value } else { value });
            }
        };
        for (block, equations) in self.blocks.iter().zip(&self.equations) {
            equations.for_each_entry(|a, b, value| {
                entry(block.unknowns[a], block.unknowns[b], a == b, value);
            });
        }
        for pair in &self.pairs {
            pair.for_each(self.blocks, |i, j, value| entry(i, j, false, value));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;
    use glam::DVec2;

    fn block(first: u32, fixed: bool) -> Block {
        let knots = |b: &[f64]| KnotVector::clamped(3, b).unwrap();
        let space = Space { ku: knots(&[0.0, 0.5, 1.0]), kv: knots(&[0.0, 1.0]) };
        let mut equations = NormalEquations::new(&space);
        equations.add_ridge(1e-9);
        let n = space.poles() as u32;
        let unknowns = (0..n).map(|k| if fixed { PRESCRIBED } else { first + k }).collect();
        let prescribed = vec![if fixed { DVec3::X } else { DVec3::ZERO }; n as usize];
        Block { space, equations, unknowns, prescribed }
    }

    fn links(a: &Block, b: &Block) -> Vec<Link> {
        let at = |t: f64| {
            let (ra, rb) = (a.space.value(DVec2::new(1.0, t)), b.space.value(DVec2::new(0.0, t)));
            Link { a: (0, ra), b: (1, rb), target: DVec3::ZERO, weight: 1e4 }
        };
        (0..12).map(|k| at(k as f64 / 11.0)).collect()
    }

    #[test]
    fn linked_edges_agree_although_their_data_do_not() {
        let (mut a, mut b) = (block(0, false), block(20, false));
        for i in 0..30 {
            for j in 0..30 {
                let uv = DVec2::new(i as f64 / 29.0, j as f64 / 29.0);
                a.equations.add(&a.space.value(uv), 1.0, DVec3::new(uv.x, 0.0, 0.0));
                b.equations.add(&b.space.value(uv), 1.0, DVec3::new(1.01 + uv.x, 0.0, 0.0));
            }
        }
        let links = links(&a, &b);
        let blocks = [a, b];
        let x = solve(&blocks, &links, 40, &|| Ok(())).unwrap();
        let worst = links.iter().map(|l| jump(&blocks, l, &x).length()).fold(0.0, f64::max);
        assert!(worst < 1e-3, "the links leave {worst} of 0.01");
    }

    #[test]
    fn a_prescribed_neighbour_pulls_the_edge() {
        let (a, b) = (block(0, false), block(0, true));
        let links = links(&a, &b);
        let blocks = [a, b];
        let x = solve(&blocks, &links, 20, &|| Ok(())).unwrap();
        let edge = blocks[0].space.apply(&links[3].a.1, &x[0]);
        assert!((edge - DVec3::X).length() < 1e-4, "edge went to {edge}");
        assert!(x[1].iter().all(|p| *p == DVec3::X), "a prescribed coefficient moved");
    }
}
