//! Derivatives of higher order, as offsets need them: those of the second order ask for the third
//! of what they are offset from.

use super::space::Space;
use crate::nurbs::basis::MAX_DEGREE;
use crate::nurbs::{NurbsCurve, NurbsSurface, Point};
use glam::DVec3;

/// Highest order of a curve's derivatives: an offset of an extrusion of an offset curve.
pub const CURVE_ORDER: usize = 4;
/// Highest total order of a surface's derivatives.
pub const SURFACE_ORDER: usize = 3;

/// The point and the derivatives of a curve; those beyond the order asked for are zero.
pub type CurveJet<P> = [P; CURVE_ORDER + 1];
/// The point and the derivatives of a surface, `[k][l]` being the `k`-th in `u` and `l`-th in `v`;
/// only those with `k + l` up to the order asked for are set.
pub type SurfaceJet = [[DVec3; SURFACE_ORDER + 1]; SURFACE_ORDER + 1];

const BINOMIAL: [[f64; 5]; 5] = [
    [1.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 2.0, 1.0, 0.0, 0.0],
    [1.0, 3.0, 3.0, 1.0, 0.0],
    [1.0, 4.0, 6.0, 4.0, 1.0],
];

/// Derivatives of a NURBS curve (A4.2). Sums run over differences from a pole of the span, so that
/// high derivatives on short spans do not lose the digits of the position.
pub fn nurbs_curve<P: Point>(curve: &NurbsCurve<P>, t: f64, order: usize) -> CurveJet<P> {
    let knots = curve.knots();
    let p = knots.degree();
    let span = knots.span(t);
    let mut n = [0.0; (CURVE_ORDER + 1) * (MAX_DEGREE + 1)];
    knots.basis_derivatives(span, t, order, &mut n);
    let weight = |i: usize| curve.weights().map_or(1.0, |w| w[i]);
    let origin = curve.poles()[span];
    let (mut jet, mut w) = ([P::default(); CURVE_ORDER + 1], [0.0; CURVE_ORDER + 1]);
    for k in 0..=order {
        for j in 0..=p {
            let (i, b) = (span - p + j, n[k * (p + 1) + j]);
            jet[k] = jet[k] + (curve.poles()[i] - origin) * (b * weight(i));
            w[k] += b * (weight(i) - weight(span));
        }
    }
    w[0] += weight(span);
    if curve.weights().is_some() {
        for k in 0..=order {
            for i in 1..=k {
                jet[k] = jet[k] - jet[k - i] * (BINOMIAL[k][i] * w[i]);
            }
            jet[k] = jet[k] / w[0];
        }
    }
    jet[0] = jet[0] + origin;
    jet
}

/// Derivatives of a NURBS surface (A4.4), summed as those of a curve.
pub fn nurbs_surface(surface: &NurbsSurface, u: f64, v: f64, order: usize) -> SurfaceJet {
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let (p, q) = (ku.degree(), kv.degree());
    let (su, sv) = (ku.span(u), kv.span(v));
    let mut nu = [0.0; (SURFACE_ORDER + 1) * (MAX_DEGREE + 1)];
    let mut nv = nu;
    ku.basis_derivatives(su, u, order, &mut nu);
    kv.basis_derivatives(sv, v, order, &mut nv);
    let weight = |i: usize| surface.weights().map_or(1.0, |w| w[i]);
    let last = su * kv.len() + sv;
    let origin = surface.poles()[last];
    let mut jet = SurfaceJet::default();
    let mut w = [[0.0; SURFACE_ORDER + 1]; SURFACE_ORDER + 1];
    for i in 0..=p {
        let row = (su - p + i) * kv.len() + sv - q;
        for j in row..=row + q {
            let pole = (surface.poles()[j] - origin) * weight(j);
            let excess = weight(j) - weight(last);
            for k in 0..=order {
                for l in 0..=order - k {
                    let b = nu[k * (p + 1) + i] * nv[l * (q + 1) + j - row];
                    jet[k][l] += pole * b;
                    w[k][l] += excess * b;
                }
            }
        }
    }
    w[0][0] += weight(last);
    if surface.weights().is_some() {
        divide(&mut jet, &w, order);
    }
    jet[0][0] += origin;
    jet
}

/// Divides homogeneous derivatives by those of the weight.
fn divide(jet: &mut SurfaceJet, w: &[[f64; SURFACE_ORDER + 1]; SURFACE_ORDER + 1], order: usize) {
    for k in 0..=order {
        for l in 0..=order - k {
            let mut sum = jet[k][l];
            for i in 0..=k {
                for j in 0..=l {
                    if i + j > 0 {
                        sum -= jet[k - i][l - j] * (BINOMIAL[k][i] * BINOMIAL[l][j] * w[i][j]);
                    }
                }
            }
            jet[k][l] = sum / w[0][0];
        }
    }
}

/// Derivatives of an offset curve from those of its basis, one order higher.
pub fn offset_curve<P: Space>(
    basis: &CurveJet<P>,
    offset: f64,
    normal: P::Normal,
    order: usize,
) -> CurveJet<P> {
    let side: Vec<P> = (0..=order).map(|k| P::offset_side(basis[k + 1], normal)).collect();
    let length = side[0].length();
    let mut n = [P::default(); CURVE_ORDER];
    let mut lengths = [length; CURVE_ORDER];
    let mut jet = [P::default(); CURVE_ORDER + 1];
    for k in 0..=order {
        if k > 0 {
            lengths[k] = (0..k).map(|j| BINOMIAL[k - 1][j] * n[j].dot(side[k - j])).sum();
        }
        let mut sum = side[k];
        for j in 0..k {
            sum = sum - n[j] * (BINOMIAL[k][j] * lengths[k - j]);
        }
        n[k] = sum / length;
        jet[k] = basis[k] + n[k] * offset;
    }
    jet
}

/// Derivatives up to the second order of an offset surface from those of its basis up to the third.
pub fn offset_surface(s: &SurfaceJet, offset: f64) -> SurfaceJet {
    let cross = |a: (usize, usize), b: (usize, usize)| s[a.0][a.1].cross(s[b.0][b.1]);
    let normal = cross((1, 0), (0, 1));
    let n_u = cross((2, 0), (0, 1)) + cross((1, 0), (1, 1));
    let n_v = cross((1, 1), (0, 1)) + cross((1, 0), (0, 2));
    let n_uu = cross((3, 0), (0, 1)) + 2.0 * cross((2, 0), (1, 1)) + cross((1, 0), (2, 1));
    let n_uv = cross((2, 1), (0, 1)) + cross((2, 0), (0, 2)) + cross((1, 0), (1, 2));
    let n_vv = cross((1, 2), (0, 1)) + 2.0 * cross((1, 1), (0, 2)) + cross((1, 0), (0, 3));
    let length = normal.length();
    let n = normal / length;
    let (l_u, l_v) = (n.dot(n_u), n.dot(n_v));
    let u = (n_u - n * l_u) / length;
    let v = (n_v - n * l_v) / length;
    let uu = (n_uu - u * (2.0 * l_u) - n * (n.dot(n_uu) + u.dot(n_u))) / length;
    let uv = (n_uv - u * l_v - v * l_u - n * (n.dot(n_uv) + v.dot(n_u))) / length;
    let vv = (n_vv - v * (2.0 * l_v) - n * (n.dot(n_vv) + v.dot(n_v))) / length;
    let mut jet = SurfaceJet::default();
    for (k, l, d) in [(0, 0, n), (1, 0, u), (0, 1, v), (2, 0, uu), (1, 1, uv), (0, 2, vv)] {
        jet[k][l] = s[k][l] + d * offset;
    }
    jet
}
