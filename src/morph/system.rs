//! The coupled system: every patch's normal equations, tied together along the edges.
//!
//! Links ask for equal values (or equal cross-edge derivatives) on both sides of an edge. They are
//! soft: along a trimmed edge the two spline spaces share next to no functions, and links forced
//! to zero would lock the patches and pull them off their nodes.

use super::space::{NormalEquations, Row, Space};
use crate::error::Result;
use crate::linalg::{SparseCholesky, SymmetricBuilder};
use glam::DVec3;

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

/// Asks `a · D_a = b · D_b`.
#[derive(Debug, Clone)]
pub struct Link {
    /// Patch and functional on one side.
    pub a: (usize, Row),
    /// Patch and functional on the other side.
    pub b: (usize, Row),
    /// Weight of the square.
    pub weight: f64,
}

/// Solves for the coefficients of every block.
///
/// # Errors
/// [`crate::Error::Numerics`] where the system is singular.
pub fn solve(blocks: &[Block], links: &[Link], unknowns: usize) -> Result<Vec<Vec<DVec3>>> {
    let factor = SparseCholesky::new(&assemble(blocks, links, unknowns))?;
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
    side(&link.a) - side(&link.b)
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

/// Right-hand side of one link: its prescribed parts.
fn add_link_target(blocks: &[Block], link: &Link, rhs: &mut [DVec3]) {
    let known = |s: &(usize, Row)| blocks[s.0].space.apply(&s.1, &blocks[s.0].prescribed);
    let target = (known(&link.b) - known(&link.a)) * link.weight;
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

/// Links between the same two cells, summed before they go into the matrix.
struct CellPair {
    key: [usize; 6],
    unknowns: Vec<usize>,
    dense: Vec<f64>,
}

impl CellPair {
    fn key(link: &Link) -> [usize; 6] {
        [link.a.0, link.a.1.i0, link.a.1.j0, link.b.0, link.b.1.i0, link.b.1.j0]
    }

    fn new(blocks: &[Block], link: &Link) -> Self {
        let mut unknowns = Vec::new();
        for side in [&link.a, &link.b] {
            let space = &blocks[side.0].space;
            for a in 0..=space.ku.degree() {
                for b in 0..=space.kv.degree() {
                    let u = blocks[side.0].unknowns[(side.1.i0 + a) * space.kv.len() + side.1.j0 + b];
                    unknowns.push(if u == PRESCRIBED { usize::MAX } else { u as usize });
                }
            }
        }
        let n = unknowns.len();
        Self { key: Self::key(link), unknowns, dense: vec![0.0; n * n] }
    }

    fn add(&mut self, blocks: &[Block], link: &Link) {
        let n = self.unknowns.len();
        let mut c = Vec::with_capacity(n);
        for (side, sign) in [(&link.a, 1.0), (&link.b, -1.0)] {
            let space = &blocks[side.0].space;
            for line in &side.1.c[..=space.ku.degree()] {
                c.extend(line[..=space.kv.degree()].iter().map(|v| sign * v));
            }
        }
        for i in 0..n {
            let ci = c[i] * link.weight;
            if ci != 0.0 {
                for (d, cj) in self.dense[i * n..i * n + i + 1].iter_mut().zip(&c) {
                    *d += ci * cj;
                }
            }
        }
    }

    fn flush(self, builder: &mut SymmetricBuilder) {
        let n = self.unknowns.len();
        for i in 0..n {
            for j in 0..=i {
                add_entry(builder, self.unknowns[i], self.unknowns[j], i == j, self.dense[i * n + j]);
            }
        }
    }
}

/// An entry off the local diagonal stands for two; where both coefficients are one unknown, both
/// fall on its diagonal.
fn add_entry(builder: &mut SymmetricBuilder, i: usize, j: usize, diagonal: bool, value: f64) {
    if i == usize::MAX || j == usize::MAX || value == 0.0 {
        return;
    }
    builder.add(i, j, if i == j && !diagonal { 2.0 * value } else { value });
}

fn assemble(blocks: &[Block], links: &[Link], unknowns: usize) -> crate::linalg::sparse::SymmetricMatrix {
    let mut builder = SymmetricBuilder::new(unknowns);
    let global = |u: u32| if u == PRESCRIBED { usize::MAX } else { u as usize };
    for block in blocks {
        block.equations.for_each_entry(|a, b, value| {
            add_entry(&mut builder, global(block.unknowns[a]), global(block.unknowns[b]), a == b, value);
        });
    }
    let mut pair: Option<CellPair> = None;
    for link in links {
        if pair.as_ref().is_none_or(|p| p.key != CellPair::key(link)) {
            if let Some(full) = pair.replace(CellPair::new(blocks, link)) {
                full.flush(&mut builder);
            }
        }
        if let Some(p) = &mut pair {
            p.add(blocks, link);
        }
    }
    if let Some(full) = pair {
        full.flush(&mut builder);
    }
    builder.build()
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
        let n = space.len() as u32;
        let unknowns = (0..n).map(|k| if fixed { PRESCRIBED } else { first + k }).collect();
        let prescribed = vec![if fixed { DVec3::X } else { DVec3::ZERO }; n as usize];
        Block { space, equations, unknowns, prescribed }
    }

    fn links(a: &Block, b: &Block) -> Vec<Link> {
        let at = |t: f64| {
            let (ra, rb) = (a.space.value(DVec2::new(1.0, t)), b.space.value(DVec2::new(0.0, t)));
            Link { a: (0, ra), b: (1, rb), weight: 1e4 }
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
        let x = solve(&blocks, &links, 40).unwrap();
        let worst = links.iter().map(|l| jump(&blocks, l, &x).length()).fold(0.0, f64::max);
        assert!(worst < 1e-3, "the links leave {worst} of 0.01");
    }

    #[test]
    fn a_prescribed_neighbour_pulls_the_edge() {
        let (a, b) = (block(0, false), block(0, true));
        let links = links(&a, &b);
        let blocks = [a, b];
        let x = solve(&blocks, &links, 20).unwrap();
        let edge = blocks[0].space.apply(&links[3].a.1, &x[0]);
        assert!((edge - DVec3::X).length() < 1e-4, "edge went to {edge}");
        assert!(x[1].iter().all(|p| *p == DVec3::X), "a prescribed coefficient moved");
    }
}
