//! Places where two sheets have one tangent plane: common normals, found by damped Gauss-Newton
//! steps, and what kind of contact they are.

use super::pair::{At, Cells, Pair, joined, parted, parting};
use glam::{DMat4, DVec2, DVec3, DVec4};

const STEPS: usize = 40;
/// Damping relative to the largest column: steps stay finite where the normals are common along a
/// whole curve.
const DAMPING: f64 = 1e-9;
/// Ratio of the principal values of the parting below which the sheets touch along a curve.
const ALONG_A_CURVE: f64 = 1e-4;

/// Difference of curvatures, times the size, that is none.
const ALIKE: f64 = 1e-7;

/// What the sheets do where they touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Contact {
    /// They lie on either side of each other around one point.
    Point,
    /// Two branches cross.
    Node,
    /// They touch along a curve, or to a higher order.
    Curve,
    /// They bend alike: over an area, or to a still higher order.
    Area,
}

/// A common normal.
#[derive(Debug, Clone, Copy)]
pub struct Normal {
    pub at: At,
    pub x: DVec3,
    /// Distance of the sheets along it, in mm.
    pub gap: f64,
    pub contact: Contact,
}

/// Residuals and their derivatives by the unknowns in mm.
fn system(pair: &Pair, cells: &Cells, at: At) -> (DVec4, DMat4, DVec4) {
    let [a, b] = pair.jets(cells, at);
    let least = f64::MIN_POSITIVE;
    let speeds = DVec4::new(a.u.length(), a.v.length(), b.u.length(), b.v.length()).max(DVec4::splat(least));
    let (apart, normal) = (a.s - b.s, a.normal());
    let turn = pair.size / normal.length().max(least);
    let (tu, tv) = (a.u / speeds.x, a.v / speeds.y);
    let (ts, tt) = (b.u * (turn / speeds.z), b.v * (turn / speeds.w));
    let residual = DVec4::new(apart.dot(tu), apart.dot(tv), normal.dot(ts), normal.dot(tt));
    let (nu, nv) = (a.uu.cross(a.v) + a.u.cross(a.uv), a.uv.cross(a.v) + a.u.cross(a.vv));
    let along = |d: DVec3, du: DVec3, dv: DVec3, n: DVec3| {
        let bend = (apart.dot(du) / speeds.x, apart.dot(dv) / speeds.y);
        DVec4::new(d.dot(tu) + bend.0, d.dot(tv) + bend.1, n.dot(ts), n.dot(tt))
    };
    let other = |d: DVec3, ds: DVec3, dt: DVec3| {
        let n = normal * turn;
        DVec4::new(-d.dot(tu), -d.dot(tv), n.dot(ds) / speeds.z, n.dot(dt) / speeds.w)
    };
    let matrix = DMat4::from_cols(
        along(a.u, a.uu, a.uv, nu) / speeds.x,
        along(a.v, a.uv, a.vv, nv) / speeds.y,
        other(b.u, b.uu, b.uv) / speeds.z,
        other(b.v, b.uv, b.vv) / speeds.w,
    );
    (residual, matrix, speeds)
}

/// The common normal near a guess, if the iteration finds one.
pub fn common_normal(pair: &Pair, cells: &Cells, guess: At) -> Option<Normal> {
    let mut y = joined(guess);
    for _ in 0..STEPS {
        let (residual, matrix, speeds) = system(pair, cells, parted(y));
        let largest = (0..4).map(|k| matrix.col(k).length_squared()).fold(0.0, f64::max);
        let mut step = least_squares(&matrix, residual, DAMPING * largest)?;
        let length = step.length();
        if !length.is_finite() {
            return None;
        }
        step *= (0.2 * pair.size / length).min(1.0);
        y -= step / speeds;
        if length < 1e-11 * pair.size + 4.0 * f64::EPSILON * pair.reach {
            return classified(pair, cells, parted(y));
        }
    }
    None
}

/// `(MᵀM + damping)⁻¹ Mᵀ r`. The matrix may lack up to two ranks: factors keep what cofactors lose.
fn least_squares(matrix: &DMat4, residual: DVec4, damping: f64) -> Option<DVec4> {
    let normal = nalgebra::Matrix4::from_fn(|i, j| {
        matrix.col(i).dot(matrix.col(j)) + if i == j { damping } else { 0.0 }
    });
    let right = nalgebra::Vector4::from_fn(|i, _| matrix.col(i).dot(residual));
    let step = normal.cholesky()?.solve(&right);
    Some(DVec4::new(step[0], step[1], step[2], step[3]))
}

fn classified(pair: &Pair, cells: &Cells, at: At) -> Option<Normal> {
    let (residual, ..) = system(pair, cells, at);
    if residual.length() > 1e-7 * pair.size {
        return None;
    }
    let [a, b] = pair.jets(cells, at);
    let [(small, _), (large, _)] = parting(&a, &b);
    let contact = if large.abs() * pair.size < ALIKE {
        Contact::Area
    } else if small.abs() < ALONG_A_CURVE * large.abs() {
        Contact::Curve
    } else if small * large > 0.0 {
        Contact::Point
    } else {
        Contact::Node
    };
    Some(Normal { at, x: 0.5 * (a.s + b.s), gap: (a.s - b.s).length(), contact })
}

/// The parameters on a plane of the point nearest to `p`.
pub fn on_plane(origin: DVec3, x: DVec3, y: DVec3, p: DVec3) -> DVec2 {
    DVec2::new((p - origin).dot(x), (p - origin).dot(y))
}
