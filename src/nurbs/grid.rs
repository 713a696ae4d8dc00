//! Many points of one surface: basis functions once for each parameter line, poles collapsed once
//! for each line of constant `v`.

use super::basis::{KnotVector, MAX_DEGREE};
use super::surface::{NurbsSurface, SurfaceDerivatives, divide};
use glam::DVec3;

/// Basis functions at many parameters, with derivatives below the `K`-th.
#[derive(Debug, Clone)]
pub struct BasisTable<const K: usize> {
    width: usize,
    spans: Vec<usize>,
    n: Vec<f64>,
}

impl<const K: usize> BasisTable<K> {
    /// At `parameters` of `knots`.
    pub fn new(knots: &KnotVector, parameters: &[f64]) -> Self {
        let width = knots.degree() + 1;
        let mut n = vec![0.0; parameters.len() * K * width];
        let mut spans = Vec::with_capacity(parameters.len());
        for (&t, out) in parameters.iter().zip(n.chunks_exact_mut(K * width)) {
            let span = knots.span(t);
            knots.basis_derivatives(span, t, K - 1, out);
            spans.push(span);
        }
        Self { width, spans, n }
    }

    /// Number of parameters.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// Whether there are no parameters.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    fn at(&self, index: usize) -> (usize, &[f64]) {
        let size = K * self.width;
        (self.spans[index], &self.n[index * size..(index + 1) * size])
    }
}

/// A surface along one line of constant `v`: for each row of poles its derivatives in `v` below
/// the `K`-th there, homogeneous.
#[derive(Debug, Clone)]
pub struct IsoLine<'a, const K: usize> {
    surface: &'a NurbsSurface,
    rows: Vec<[DVec3; K]>,
    weights: Vec<[f64; K]>,
}

impl<'a, const K: usize> IsoLine<'a, K> {
    /// At the parameter `v`.
    pub fn new(surface: &'a NurbsSurface, v: f64) -> Self {
        let mut line = Self { surface, rows: Vec::new(), weights: Vec::new() };
        line.move_to(v);
        line
    }

    /// Moves the line to another `v`.
    pub fn move_to(&mut self, v: f64) {
        let table = BasisTable::<K>::new(self.surface.knots_v(), &[v]);
        self.collapse(table.at(0));
    }

    fn collapse(&mut self, (span, n): (usize, &[f64])) {
        let (columns, width) = (self.surface.knots_v().len(), n.len() / K);
        let first = span + 1 - width;
        let poles = self.surface.poles().chunks_exact(columns);
        self.rows.clear();
        let Some(weights) = self.surface.weights() else {
            self.rows.extend(poles.map(|row| {
                let mut c = combined(&row[first..=span], row[span], n);
                c[0] += row[span];
                c
            }));
            return;
        };
        self.weights.clear();
        for (row, weights) in poles.zip(weights.chunks_exact(columns)) {
            let (mut c, mut w) = ([DVec3::ZERO; K], [0.0; K]);
            for (j, (pole, weight)) in row[first..=span].iter().zip(&weights[first..=span]).enumerate() {
                for l in 0..K {
                    c[l] += *pole * (weight * n[l * width + j]);
                    w[l] += weight * n[l * width + j];
                }
            }
            self.rows.push(c);
            self.weights.push(w);
        }
    }

    /// Derivatives `[k][l]`, `k`-th in `u` and `l`-th in `v`, at a parameter of a table over the
    /// surface's knots in `u`.
    pub fn jet(&self, table: &BasisTable<K>, index: usize) -> [[DVec3; K]; K] {
        let (span, n) = table.at(index);
        self.jet_of(span, n)
    }

    /// The same at any `u`.
    pub fn jet_at(&self, u: f64) -> [[DVec3; K]; K] {
        let knots = self.surface.knots_u();
        let span = knots.span(u);
        // As many rows as `K` can be: arrays of K · (MAX_DEGREE + 1) cannot be written yet.
        let mut n = [0.0; 3 * (MAX_DEGREE + 1)];
        let n = &mut n[..K * (knots.degree() + 1)];
        knots.basis_derivatives(span, u, K - 1, n);
        self.jet_of(span, n)
    }

    fn jet_of(&self, span: usize, n: &[f64]) -> [[DVec3; K]; K] {
        let width = n.len() / K;
        let rows = &self.rows[span + 1 - width..=span];
        let mut jet = [[DVec3::ZERO; K]; K];
        let Some(weights) = self.weights.get(span + 1 - width..=span) else {
            // As in the other direction, derivatives lose no digits over differences.
            let origin = rows[width - 1];
            for (i, row) in rows.iter().enumerate() {
                for l in 0..K {
                    let c = row[l] - origin[l];
                    for k in 0..K - l {
                        jet[k][l] += c * n[k * width + i];
                    }
                }
            }
            for l in 0..K {
                jet[0][l] += origin[l];
            }
            return jet;
        };
        let mut total = [[0.0; K]; K];
        for (i, (row, weight)) in rows.iter().zip(weights).enumerate() {
            for k in 0..K {
                for l in 0..K - k {
                    jet[k][l] += row[l] * n[k * width + i];
                    total[k][l] += weight[l] * n[k * width + i];
                }
            }
        }
        divide(&mut jet, &total);
        jet
    }
}

/// Sums over differences from `origin`, for each derivative in `n`.
fn combined<const K: usize>(poles: &[DVec3], origin: DVec3, n: &[f64]) -> [DVec3; K] {
    let mut c = [DVec3::ZERO; K];
    for (j, pole) in poles.iter().enumerate() {
        let d = *pole - origin;
        for l in 0..K {
            c[l] += d * n[l * poles.len() + j];
        }
    }
    c
}

impl NurbsSurface {
    /// Points on the grid `us × vs`, `v` fastest.
    pub fn points_on_grid(&self, us: &[f64], vs: &[f64]) -> Vec<DVec3> {
        self.on_grid::<1, _>(us, vs, |jet| jet[0][0])
    }

    /// Points and derivatives up to the second on the grid `us × vs`, `v` fastest.
    pub fn derivatives_on_grid(&self, us: &[f64], vs: &[f64]) -> Vec<SurfaceDerivatives> {
        self.on_grid::<3, _>(us, vs, SurfaceDerivatives::from)
    }

    fn on_grid<const K: usize, T: Default + Clone>(
        &self,
        us: &[f64],
        vs: &[f64],
        value: impl Fn([[DVec3; K]; K]) -> T,
    ) -> Vec<T> {
        let (tu, tv) = (BasisTable::<K>::new(self.knots_u(), us), BasisTable::<K>::new(self.knots_v(), vs));
        let mut out = vec![T::default(); us.len() * vs.len()];
        let mut line = IsoLine::<K> { surface: self, rows: Vec::new(), weights: Vec::new() };
        for j in 0..vs.len() {
            line.collapse(tv.at(j));
            for i in 0..us.len() {
                out[i * vs.len() + j] = value(line.jet(&tu, i));
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(rational: bool) -> NurbsSurface {
        let ku = KnotVector::clamped(3, &[0.0, 0.3, 0.35, 1.0]).unwrap();
        let kv = KnotVector::clamped(5, &[-1.0, 0.2, 2.0]).unwrap();
        let n = ku.len() * kv.len();
        let poles = (0..n).map(|k| DVec3::new(k as f64, (k as f64).sin(), 100.0 + (k % 5) as f64)).collect();
        let weights = rational.then(|| (0..n).map(|k| 1.0 + 0.3 * ((k * k) as f64).cos()).collect());
        NurbsSurface::new(ku, kv, poles, weights).unwrap()
    }

    #[test]
    fn a_grid_equals_single_evaluations() {
        let us: Vec<f64> = (0..=13).map(|i| i as f64 / 13.0).collect();
        let vs: Vec<f64> = (0..=9).map(|j| -1.0 + j as f64 / 3.0).collect();
        for rational in [false, true] {
            let s = surface(rational);
            let grid = s.derivatives_on_grid(&us, &vs);
            let points = s.points_on_grid(&us, &vs);
            for (i, &u) in us.iter().enumerate() {
                for (j, &v) in vs.iter().enumerate() {
                    let (a, b) = (grid[i * vs.len() + j], s.derivatives(u, v));
                    let pairs =
                        [(a.s, b.s), (a.u, b.u), (a.v, b.v), (a.uu, b.uu), (a.uv, b.uv), (a.vv, b.vv)];
                    for (k, (x, y)) in pairs.into_iter().enumerate() {
                        let error = (x - y).length() / y.length().max(1.0);
                        assert!(error < 1e-11, "rational {rational}, ({u}, {v}), derivative {k}: {x} {y}");
                    }
                    assert!((points[i * vs.len() + j] - b.s).length() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn a_line_moves() {
        let s = surface(false);
        let mut line = IsoLine::<2>::new(&s, 0.1);
        line.move_to(1.3);
        let ([p, _], [du, _]) = (line.jet_at(0.7)[0], line.jet_at(0.7)[1]);
        let [q, dq, _] = s.first_derivatives(0.7, 1.3);
        assert!((p - q).length() < 1e-12 && (du - dq).length() < 1e-11, "{p} {q}, {du} {dq}");
    }
}
