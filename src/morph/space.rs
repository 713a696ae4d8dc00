//! The spline space of one patch's displacement, and its share of the normal equations.
//!
//! The unknown displacement `D(u, v)` has the knots of the patch it moves, so that adding its
//! coefficients to the poles adds the fields exactly.

use crate::error::Result;
use crate::nurbs::{KnotVector, NurbsSurface, SurfaceDerivatives};
use crate::ops::approximate::Breaks;
use crate::ops::interpolate::Collocation;
use glam::{DVec2, DVec3};

/// Highest degree of a displacement space.
pub const MAX_SPACE_DEGREE: usize = 5;
const W: usize = MAX_SPACE_DEGREE + 1;

/// One linear functional of the displacement (a value or a derivative): the coefficients of the
/// `rows × columns` poles from (`i0`, `j0`) on.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// First pole index along u.
    pub i0: usize,
    /// First pole index along v.
    pub j0: usize,
    /// Coefficients, [along u][along v].
    pub c: [[f64; W]; W],
}

/// Basis functions and derivatives of one direction at one parameter.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// First pole that the parameter sees.
    pub first: usize,
    /// Values, first and second derivatives.
    pub n: [[f64; W]; 3],
}

impl Line {
    /// At parameter `t` of `knots`.
    pub fn at(knots: &KnotVector, t: f64) -> Self {
        let (p, span) = (knots.degree(), knots.span(t));
        let mut flat = [0.0; 3 * W];
        knots.basis_derivatives(span, t, 2, &mut flat);
        let mut n = [[0.0; W]; 3];
        for d in 0..3 {
            n[d][..=p].copy_from_slice(&flat[d * (p + 1)..(d + 1) * (p + 1)]);
        }
        Self { first: span - p, n }
    }
}

/// A tensor-product spline space of degree at most 5.
#[derive(Debug, Clone, PartialEq)]
pub struct Space {
    /// Knots along u.
    pub ku: KnotVector,
    /// Knots along v.
    pub kv: KnotVector,
}

impl Space {
    /// Number of poles.
    pub fn poles(&self) -> usize {
        self.ku.len() * self.kv.len()
    }

    /// Degrees along u and v.
    pub fn degrees(&self) -> [usize; 2] {
        [self.ku.degree(), self.kv.degree()]
    }

    /// Number of poles that a point sees.
    pub fn order(&self) -> usize {
        (self.ku.degree() + 1) * (self.kv.degree() + 1)
    }

    /// Number of cells (non-empty knot spans).
    pub fn cells(&self) -> usize {
        (self.ku.breaks().len() - 1) * (self.kv.breaks().len() - 1)
    }

    /// The smallest space that contains this one and the one over `ku × kv`, of the same degrees.
    ///
    /// # Errors
    /// As [`KnotVector::new`].
    pub fn union(&self, ku: &KnotVector, kv: &KnotVector) -> Result<Space> {
        Ok(Space { ku: union(&self.ku, ku)?, kv: union(&self.kv, kv)? })
    }

    /// The space whose functions may also have a kink at the given parameters.
    ///
    /// # Errors
    /// As [`KnotVector::new`].
    pub fn with_kinks(&self, kinks: &[Vec<f64>; 2]) -> Result<Space> {
        let add = |k: &KnotVector, at: &[f64]| -> Result<KnotVector> {
            let (a, b) = k.domain();
            let mut breaks = Breaks { degree: k.degree(), at: vec![(a, 1)] };
            breaks.at.extend(at.iter().map(|&t| (t, k.degree())));
            breaks.at.push((b, 1));
            union(k, &breaks.knots()?)
        };
        Ok(Space { ku: add(&self.ku, &kinks[0])?, kv: add(&self.kv, &kinks[1])? })
    }

    /// The coefficients over a space that contains this one.
    ///
    /// # Errors
    /// As [`Collocation::new`].
    pub fn lift(&self, x: &[DVec3], finer: &Space) -> Result<Vec<DVec3>> {
        if self == finer {
            return Ok(x.to_vec());
        }
        let (cu, cv) = (Collocation::new(&finer.ku)?, Collocation::new(&finer.kv)?);
        let lines = |k: &KnotVector, at: &[f64]| at.iter().map(|&t| Line::at(k, t)).collect::<Vec<_>>();
        let (lu, lv) = (lines(&self.ku, cu.points()), lines(&self.kv, cv.points()));
        let value = |a: &Line, b: &Line| self.apply(&combine(a, b, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]), x);
        let mut out: Vec<DVec3> =
            lu.iter().flat_map(|a| lv.iter().map(move |b| (a, b))).map(|(a, b)| value(a, b)).collect();
        Collocation::poles_tensor(&cu, &cv, &mut out);
        Ok(out)
    }

    /// The value at (u, v) as a functional.
    pub fn value(&self, uv: DVec2) -> Row {
        let (su, sv) = (self.ku.span(uv.x), self.kv.span(uv.y));
        let (mut nu, mut nv) = ([0.0; W], [0.0; W]);
        self.ku.basis(su, uv.x, &mut nu);
        self.kv.basis(sv, uv.y, &mut nv);
        let c = nu.map(|a| nv.map(|b| a * b));
        Row { i0: su - self.ku.degree(), j0: sv - self.kv.degree(), c }
    }

    /// `w0 D + w1 D_u + w2 D_v + w3 D_uu + w4 D_uv + w5 D_vv` at (u, v) as a functional.
    pub fn combine(&self, uv: DVec2, w: [f64; 6]) -> Row {
        combine(&Line::at(&self.ku, uv.x), &Line::at(&self.kv, uv.y), w)
    }

    /// Applies a functional to coefficients (`v` fastest).
    pub fn apply(&self, row: &Row, x: &[DVec3]) -> DVec3 {
        let columns = self.kv.len();
        let mut sum = DVec3::ZERO;
        for a in 0..=self.ku.degree() {
            let base = (row.i0 + a) * columns + row.j0;
            for b in 0..=self.kv.degree() {
                sum += x[base + b] * row.c[a][b];
            }
        }
        sum
    }
}

/// Knots with the larger multiplicity of both.
fn union(a: &KnotVector, b: &KnotVector) -> Result<KnotVector> {
    let mut at = a.breaks_and_multiplicities();
    for (t, m) in b.breaks_and_multiplicities() {
        match at.iter_mut().find(|k| k.0 == t) {
            Some(k) => k.1 = k.1.max(m),
            None => at.push((t, m)),
        }
    }
    at.sort_by(|a, b| a.0.total_cmp(&b.0));
    Breaks { degree: a.degree(), at }.knots()
}

/// The same functional from prepared basis values.
pub fn combine(lu: &Line, lv: &Line, w: [f64; 6]) -> Row {
    let mut c = [[0.0; W]; W];
    for a in 0..W {
        let (n0, n1, n2) = (lu.n[0][a], lu.n[1][a], lu.n[2][a]);
        let (f0, f1, f2) = (w[0] * n0 + w[1] * n1 + w[3] * n2, w[2] * n0 + w[4] * n1, w[5] * n0);
        for b in 0..W {
            c[a][b] = f0 * lv.n[0][b] + f1 * lv.n[1][b] + f2 * lv.n[2][b];
        }
    }
    Row { i0: lu.first, j0: lv.first, c }
}

/// The three functionals whose squares add up to the thin-plate density `|∇²D|²` on the surface:
/// covariant second derivatives in an orthonormal frame of the tangent plane. Also returns the
/// area element. `None` where the surface is degenerate.
///
/// Free of the parametrisation: with `D_{;αβ} = D_αβ − Γ^γ_αβ D_γ` and `S_u, S_v` resolved in the
/// frame, the physical Hessian is `J⁻ᵀ D_{;} J⁻¹`.
pub fn bending(d: &SurfaceDerivatives) -> Option<([[f64; 6]; 3], f64)> {
    let normal = d.normal();
    let area = normal.length();
    let (lu, lv) = (d.u.length(), d.v.length());
    if area < 1e-9 * lu * lv || area < 1e-14 {
        return None;
    }
    let (guu, guv, gvv) = (d.u.dot(d.u), d.u.dot(d.v), d.v.dot(d.v));
    let det = guu * gvv - guv * guv;
    // Γ^u and Γ^v of the second derivative `s`.
    let christoffel = |s: DVec3| {
        let (a, b) = (s.dot(d.u), s.dot(d.v));
        ((gvv * a - guv * b) / det, (guu * b - guv * a) / det)
    };
    let e1 = d.u / lu;
    let e2 = normal.cross(d.u).normalize();
    // Columns of J⁻¹: parameter directions of the unit frame vectors.
    let (p1, p2) = (DVec2::new(1.0 / lu, 0.0), {
        let t = 1.0 / d.v.dot(e2);
        DVec2::new(-d.v.dot(e1) * t / lu, t)
    });
    let second = [christoffel(d.uu), christoffel(d.uv), christoffel(d.vv)];
    let hessian = |a: DVec2, b: DVec2, scale: f64| {
        let (cuu, cuv, cvv) = (a.x * b.x * scale, (a.x * b.y + a.y * b.x) * scale, a.y * b.y * scale);
        let along = |k: usize| {
            let g = |e: (f64, f64)| if k == 0 { e.0 } else { e.1 };
            -(cuu * g(second[0]) + cuv * g(second[1]) + cvv * g(second[2]))
        };
        [0.0, along(0), along(1), cuu, cuv, cvv]
    };
    Some(([hessian(p1, p1, 1.0), hessian(p1, p2, std::f64::consts::SQRT_2), hessian(p2, p2, 1.0)], area))
}

/// Normal equations of one patch: a stencil of `(p+1) × (2q+1)` entries for each pole, and three
/// right-hand sides.
#[derive(Debug, Clone)]
pub struct NormalEquations {
    rows: usize,
    columns: usize,
    p: usize,
    q: usize,
    stencil: Vec<f64>,
    /// Right-hand sides.
    pub rhs: Vec<DVec3>,
}

impl NormalEquations {
    /// Empty equations of `space`.
    pub fn new(space: &Space) -> Self {
        let (p, q) = (space.ku.degree(), space.kv.degree());
        let n = space.poles();
        Self {
            rows: space.ku.len(),
            columns: space.kv.len(),
            p,
            q,
            stencil: vec![0.0; n * (p + 1) * (2 * q + 1)],
            rhs: vec![DVec3::ZERO; n],
        }
    }

    /// Adds the square of `row · x − target`, times `weight`.
    pub fn add(&mut self, row: &Row, weight: f64, target: DVec3) {
        self.add_square(row, weight);
        self.add_target(row, target * weight);
    }

    /// Adds `weight · row ⊗ row` to the matrix.
    pub fn add_square(&mut self, row: &Row, weight: f64) {
        // Known sizes let the compiler unroll: most spaces are bicubic.
        match (self.p, self.q) {
            (3, 3) => self.add_square_of(3, 3, row, weight),
            (5, 5) => self.add_square_of(5, 5, row, weight),
            (p, q) => self.add_square_of(p, q, row, weight),
        }
    }

    #[inline(always)]
    fn add_square_of(&mut self, p: usize, q: usize, row: &Row, weight: f64) {
        let width = 2 * q + 1;
        let size = (p + 1) * width;
        for a in 0..=p {
            let at = ((row.i0 + a) * self.columns + row.j0) * size;
            let poles = self.stencil[at..at + (q + 1) * size].chunks_exact_mut(size);
            for (b, stencil) in poles.enumerate() {
                let ca = weight * row.c[a][b];
                for a2 in a..=p {
                    let line = (a2 - a) * width + q - b;
                    for (s, c) in stencil[line..=line + q].iter_mut().zip(&row.c[a2][..=q]) {
                        *s += ca * c;
                    }
                }
            }
        }
    }

    /// Adds `row · value` to the right-hand side.
    pub fn add_target(&mut self, row: &Row, value: DVec3) {
        for a in 0..=self.p {
            let base = (row.i0 + a) * self.columns + row.j0;
            for b in 0..=self.q {
                self.rhs[base + b] += value * row.c[a][b];
            }
        }
    }

    /// Adds `weight · |D|²`, which keeps unseen coefficients at zero.
    pub fn add_ridge(&mut self, weight: f64) {
        let size = (self.p + 1) * (2 * self.q + 1);
        for k in 0..self.rows * self.columns {
            self.stencil[k * size + self.q] += weight;
        }
    }

    /// Visits each pair of unknowns once with its matrix entry.
    pub fn for_each_entry(&self, mut visit: impl FnMut(usize, usize, f64)) {
        let (p, q) = (self.p, self.q);
        let width = 2 * q + 1;
        for i in 0..self.rows {
            for j in 0..self.columns {
                let k = i * self.columns + j;
                let stencil = &self.stencil[k * (p + 1) * width..(k + 1) * (p + 1) * width];
                for di in 0..=p.min(self.rows - 1 - i) {
                    for dj in 0..width {
                        let column = j + dj;
                        if column < q || column - q >= self.columns || (di == 0 && dj < q) {
                            continue;
                        }
                        visit(k, k + di * self.columns + dj - q, stencil[di * width + dj]);
                    }
                }
            }
        }
    }

    /// Solves these equations on their own (banded Cholesky, the shorter direction innermost).
    ///
    /// # Errors
    /// [`crate::Error::Numerics`] where they do not determine the unknowns.
    pub fn solve(&self) -> Result<Vec<DVec3>> {
        let by_rows = self.columns <= self.rows;
        let order = |k: usize| {
            if by_rows { k } else { (k % self.columns) * self.rows + k / self.columns }
        };
        let half = if by_rows { self.p * self.columns + self.q } else { self.q * self.rows + self.p };
        let mut matrix = crate::linalg::BandedCholesky::zeros(self.rhs.len(), half);
        self.for_each_entry(|a, b, value| {
            let (a, b) = (order(a), order(b));
            matrix.add(a.max(b), a.min(b), value);
        });
        matrix.factor()?;
        let mut x = vec![DVec3::ZERO; self.rhs.len()];
        for (k, r) in self.rhs.iter().enumerate() {
            x[order(k)] = *r;
        }
        matrix.solve(&mut x);
        Ok((0..x.len()).map(|k| x[order(k)]).collect())
    }
}

/// The surface of `poles + coefficients` over a space that contains both.
///
/// # Errors
/// As [`NurbsSurface::new`].
pub fn displaced(space: &Space, poles: &[DVec3], coefficients: &[DVec3]) -> Result<NurbsSurface> {
    let sum = poles.iter().zip(coefficients).map(|(p, d)| *p + *d).collect();
    NurbsSurface::new(space.ku.clone(), space.kv.clone(), sum, None)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn space(p: usize, q: usize) -> Space {
        Space {
            ku: KnotVector::clamped(p, &[0.0, 0.2, 0.5, 1.0]).unwrap(),
            kv: KnotVector::clamped(q, &[0.0, 0.6, 1.0]).unwrap(),
        }
    }

    #[test]
    fn free_fit_reproduces_a_field_of_the_space() {
        for (p, q) in [(3, 3), (5, 3), (3, 5)] {
            let s = space(p, q);
            let x: Vec<DVec3> = (0..s.poles()).map(|k| DVec3::new((k as f64).sin(), 1.0, k as f64)).collect();
            let mut equations = NormalEquations::new(&s);
            for i in 0..40 {
                for j in 0..40 {
                    let row = s.value(DVec2::new(i as f64 / 39.0, j as f64 / 39.0));
                    equations.add(&row, 1.0, s.apply(&row, &x));
                }
            }
            for (a, b) in equations.solve().unwrap().iter().zip(&x) {
                assert!((*a - *b).length() < 1e-9, "degrees {p}, {q}: {a} {b}");
            }
        }
    }

    #[test]
    fn bending_of_a_linear_field_vanishes_on_a_skewed_plane() {
        // A plane in awkward parameters; the field is linear in space.
        let point = |u: f64, v: f64| DVec3::new(2.0 * u + 0.3 * u * u, v + 0.5 * u * v, 0.0);
        let s = space(3, 3);
        let (cu, cv) = (Collocation::new(&s.ku).unwrap(), Collocation::new(&s.kv).unwrap());
        let mut poles: Vec<DVec3> =
            cu.points().iter().flat_map(|&u| cv.points().iter().map(move |&v| point(u, v))).collect();
        Collocation::poles_tensor(&cu, &cv, &mut poles);
        let surface = displaced(&s, &poles, &vec![DVec3::ZERO; s.poles()]).unwrap();
        let field: Vec<DVec3> = poles.iter().map(|x| DVec3::new(x.x - 2.0 * x.y, 3.0 * x.y, x.x)).collect();
        let square: Vec<DVec3> = {
            let mut f: Vec<DVec3> = cu
                .points()
                .iter()
                .flat_map(|&u| cv.points().iter().map(move |&v| DVec3::new(0.0, 0.0, point(u, v).y.powi(2))))
                .collect();
            Collocation::poles_tensor(&cu, &cv, &mut f);
            f
        };
        for uv in [DVec2::new(0.1, 0.3), DVec2::new(0.7, 0.9), DVec2::new(0.4, 0.2)] {
            let (rows, area) = bending(&surface.derivatives(uv.x, uv.y)).unwrap();
            assert!(area > 0.0);
            let energy = |x: &[DVec3]| {
                rows.iter().map(|&w| s.apply(&s.combine(uv, w), x).length_squared()).sum::<f64>()
            };
            assert!(energy(&field) < 1e-18, "linear field bends by {} at {uv}", energy(&field));
            // z = y² has the Hessian 2 in one direction and nothing else.
            assert!((energy(&square) - 4.0).abs() < 1e-8, "{} at {uv}", energy(&square));
        }
    }
}
