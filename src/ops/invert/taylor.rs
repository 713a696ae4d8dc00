//! A surface piece as powers of two parameters about its middle: a point with its derivatives costs
//! three sums over the coefficients, without basis functions.

use super::bezier::SurfacePiece;
use crate::nurbs::SurfaceDerivatives;
use crate::nurbs::surface::divide;
use crate::nurbs::wide::{self, Four, Work};
use crate::ops::closest::{Jet, Local, descend};
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use std::marker::PhantomData;

/// What turns Bernstein polynomials over −1..1 into powers: entry `[k][i]` is the coefficient of
/// the `k`-th power in the `i`-th polynomial.
#[derive(Debug, Clone)]
pub struct Powers(Vec<Vec<f64>>);

impl Powers {
    /// For one degree.
    pub fn new(degree: usize) -> Self {
        let mut rows = vec![vec![0.0; degree + 1]; degree + 1];
        let mut binomial = 1.0;
        for i in 0..=degree {
            let mut polynomial = vec![binomial];
            for factor in 0..degree {
                let slope = if factor < i { 0.5 } else { -0.5 };
                polynomial.push(0.0);
                for k in (0..polynomial.len()).rev() {
                    let below = if k > 0 { polynomial[k - 1] } else { 0.0 };
                    polynomial[k] = 0.5 * polynomial[k] + slope * below;
                }
            }
            for (row, c) in rows.iter_mut().zip(polynomial) {
                row[i] = c;
            }
            binomial = binomial * (degree - i) as f64 / (i + 1) as f64;
        }
        Self(rows)
    }
}

/// Homogeneous coefficients of the powers of `s` and `t`, both within −1..1, about a centre.
#[derive(Debug, Clone)]
pub struct Taylor {
    /// The point in the middle, from which coordinates count.
    pub centre: DVec3,
    rational: bool,
    columns: usize,
    /// Those of `t` fastest.
    coefficients: Vec<[f64; 4]>,
}

impl Taylor {
    /// Of a piece, with the powers of its degrees along u and v.
    pub fn new(piece: &SurfacePiece, [along_u, along_v]: [&Powers; 2], rational: bool) -> Self {
        let columns = piece.columns;
        // Over differences, so that higher coefficients lose no digits to the position.
        let first = piece.poles[0] / piece.weights[0];
        let net: Vec<DVec4> =
            piece.poles.iter().zip(&piece.weights).map(|(&x, &w)| (x - first * w).extend(w)).collect();
        let across: Vec<DVec4> = net
            .chunks_exact(columns)
            .flat_map(|row| along_v.0.iter().map(|m| row.iter().zip(m).map(|(&x, &m)| x * m).sum()))
            .collect();
        let mut out = Self { centre: first, rational, columns, coefficients: vec![[0.0; 4]; net.len()] };
        for (i, m) in along_u.0.iter().enumerate() {
            for j in 0..columns {
                let sum: DVec4 = m.iter().enumerate().map(|(k, &m)| across[k * columns + j] * m).sum();
                out.coefficients[i * columns + j] = sum.to_array();
            }
        }
        let middle = out.get(0, 0).xyz() / out.get(0, 0).w;
        out.centre += middle;
        for c in &mut out.coefficients {
            *c = (DVec4::from(*c) - (middle * c[3]).extend(0.0)).to_array();
        }
        out
    }

    /// The coefficient of a power; 0 beyond the degrees.
    pub fn get(&self, i: usize, j: usize) -> DVec4 {
        if j >= self.columns {
            return DVec4::ZERO;
        }
        self.coefficients.get(i * self.columns + j).map_or(DVec4::ZERO, |&c| c.into())
    }

    /// All powers.
    pub fn each(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let columns = self.columns;
        (0..self.coefficients.len()).map(move |k| (k / columns, k % columns))
    }

    /// Point, relative to the centre, and derivatives in the middle.
    #[inline]
    pub fn middle(&self) -> SurfaceDerivatives {
        let at = |i: usize, j: usize| self.get(i, j);
        let rest = DVec4::ZERO;
        let jet =
            [[at(0, 0), at(0, 1), 2.0 * at(0, 2)], [at(1, 0), at(1, 1), rest], [2.0 * at(2, 0), rest, rest]];
        self.divided(jet)
    }

    #[inline(always)]
    fn divided(&self, jet: [[DVec4; 3]; 3]) -> SurfaceDerivatives {
        let (mut points, mut weights) = ([[DVec3::ZERO; 3]; 3], [[0.0; 3]; 3]);
        for k in 0..3 {
            for l in 0..3 - k {
                (points[k][l], weights[k][l]) = (jet[k][l].xyz(), jet[k][l].w);
            }
        }
        if self.rational {
            divide(&mut points, &weights);
        }
        points.into()
    }

    /// A local minimum of the distance to `p`, relative to the centre.
    pub fn foot(&self, p: DVec3) -> Local {
        let mut out = None;
        wide::run(Foot { taylor: self, p: p - self.centre, out: &mut out });
        out.expect("the work is done")
    }
}

/// A piece whose sums run over fours.
struct InFours<'a, F>(&'a Taylor, PhantomData<F>);

impl<F: Four> Jet for InFours<'_, F> {
    #[inline(always)]
    fn jet(&self, at: DVec2) -> SurfaceDerivatives {
        let taylor = self.0;
        if at == DVec2::ZERO {
            return taylor.middle();
        }
        taylor.divided(match taylor.columns {
            4 => horner::<F, [[f64; 4]; 4]>(taylor.coefficients.as_chunks().0.iter(), at),
            columns => horner::<F, [[f64; 4]]>(taylor.coefficients.chunks_exact(columns), at),
        })
    }
}

struct Foot<'a> {
    taylor: &'a Taylor,
    p: DVec3,
    out: &'a mut Option<Local>,
}

impl Work for Foot<'_> {
    #[inline(always)]
    fn run<F: Four>(self) {
        let piece = InFours::<F>(self.taylor, PhantomData);
        *self.out = Some(descend(&piece, self.p, DVec2::ZERO, [DVec2::NEG_ONE, DVec2::ONE]));
    }
}

/// Horner's scheme with derivatives, in both directions.
#[inline(always)]
fn horner<'r, F: Four, R: AsRef<[[f64; 4]]> + ?Sized + 'r>(
    rows: impl DoubleEndedIterator<Item = &'r R>,
    at: DVec2,
) -> [[DVec4; 3]; 3] {
    let (s, t, zero) = (F::splat(at.x), F::splat(at.y), F::splat(0.0));
    let mut jet = [[zero; 3]; 3];
    for row in rows.rev() {
        let mut line = [zero; 3];
        for c in row.as_ref().iter().rev() {
            line[2] = line[2] * t + line[1];
            line[1] = line[1] * t + line[0];
            line[0] = line[0] * t + F::load(c);
        }
        for l in 0..3 {
            for k in (1..3 - l).rev() {
                jet[k][l] = jet[k][l] * s + jet[k - 1][l];
            }
            jet[0][l] = jet[0][l] * s + line[l];
        }
    }
    let two = F::splat(2.0);
    (jet[2][0], jet[0][2]) = (jet[2][0] * two, jet[0][2] * two);
    let mut out = [[DVec4::ZERO; 3]; 3];
    for k in 0..3 {
        for l in 0..3 - k {
            out[k][l] = jet[k][l].to_array().into();
        }
    }
    out
}
