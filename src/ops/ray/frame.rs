//! A Bézier patch as seen along a ray.
//!
//! In coordinates across and along the ray, homogeneous ones, the ray meets the patch where the
//! polynomials `X` and `Y` across it vanish, rational or not; the length along it is `Z / w` there.

use super::Ray;
use crate::nurbs::Direction;
use crate::nurbs::basis::MAX_DEGREE;
use crate::ops::intersect::approach::{SETTLED, STEPS, step};
use crate::ops::intersect::tree::{Cone, GRAIN};
use crate::ops::invert::bezier::SurfacePiece;
use glam::{DMat3, DVec2, DVec3, DVec4, Vec4Swizzles};

/// A part of a patch in the coordinates of a ray.
#[derive(Debug, Clone)]
pub struct View {
    piece: SurfacePiece,
    /// Length below which differences of control points are rounding.
    grain: f64,
    /// The largest weight.
    heaviest: f64,
    /// The range of lengths along the ray.
    pub along: [f64; 2],
}

/// A point of a part.
#[derive(Debug, Clone, Copy)]
pub struct Sight {
    /// Parameters of the surface.
    pub at: DVec2,
    /// Length along the ray.
    pub s: f64,
    /// Distance from the ray.
    pub distance: f64,
}

impl View {
    /// A patch as seen along a ray.
    pub fn new(patch: &SurfacePiece, ray: &Ray<DVec3>) -> Self {
        let (x, y) = ray.direction.any_orthonormal_pair();
        let frame = DMat3::from_cols(x, y, ray.direction).transpose();
        let mut piece = patch.clone();
        for (pole, &w) in piece.poles.iter_mut().zip(&patch.weights) {
            *pole = frame * (*pole - ray.origin * w);
        }
        let reach = piece.poles.iter().chain([&ray.origin]).map(|p| p.abs().max_element());
        let grain = GRAIN * reach.fold(0.0, f64::max);
        Self { piece, grain, heaviest: 1.0, along: [0.0; 2] }.bounded()
    }

    fn bounded(mut self) -> Self {
        let lengths = self.piece.poles.iter().zip(&self.piece.weights).map(|(p, w)| p.z / w);
        self.along = lengths.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], s| [a.min(s), b.max(s)]);
        self.heaviest = self.piece.weights.iter().copied().fold(0.0, f64::max);
        self
    }

    fn across(&self) -> impl Iterator<Item = DVec2> + Clone + '_ {
        self.piece.poles.iter().map(|p| p.truncate())
    }

    /// Directions in which `X` and `Y` move with `u` and with `v`.
    pub fn cones(&self) -> [Cone<DVec2>; 2] {
        let (poles, columns) = (&self.piece.poles, self.piece.columns);
        let along_u = (columns..poles.len()).map(|k| (poles[k] - poles[k - columns]).truncate());
        let along_v = (0..poles.len()).filter(|k| (k + 1) % columns != 0);
        let along_v = along_v.map(|k| (poles[k + 1] - poles[k]).truncate());
        [Cone::new(along_u, self.grain), Cone::new(along_v, self.grain)]
    }

    /// Whether nothing of it is within `tolerance` of the ray.
    pub fn is_apart(&self, tolerance: f64, cones: &[Cone<DVec2>; 2]) -> bool {
        let tolerance = tolerance * self.heaviest + self.grain;
        let outside = |normal: DVec2| {
            let extent = self.across().map(|p| p.dot(normal));
            let [low, high] =
                extent.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
            low.max(-high) > tolerance
        };
        [DVec2::X, DVec2::Y, cones[0].axis.perp(), cones[1].axis.perp()].into_iter().any(outside)
    }

    /// Its extent with `u` and with `v`, at most, by some length of differences.
    fn extents(&self, length: impl Fn(DVec3) -> f64) -> [f64; 2] {
        let (piece, columns) = (&self.piece, self.piece.columns);
        let point = |k: usize| piece.poles[k] / piece.weights[k];
        let of = |first: usize, count: usize, stride: usize| {
            (1..count).map(|k| length(point(first + k * stride) - point(first))).fold(0.0, f64::max)
        };
        let rows = piece.poles.len() / columns;
        let u = (0..columns).map(|j| of(j, rows, columns)).fold(0.0, f64::max);
        let v = (0..rows).map(|i| of(i * columns, columns, 1)).fold(0.0, f64::max);
        [u, v]
    }

    /// Both halves along the direction of the larger extent across the ray; none of a part that is
    /// a point as seen along the ray.
    pub fn halves(&self, point: f64) -> Option<[Self; 2]> {
        self.halved(self.extents(|d| d.truncate().length()), point)
    }

    /// Both halves along the direction of the larger extent along the ray.
    pub fn halves_along(&self, point: f64) -> Option<[Self; 2]> {
        self.halved(self.extents(|d| d.z.abs()), point)
    }

    fn halved(&self, [u, v]: [f64; 2], point: f64) -> Option<[Self; 2]> {
        let room = |k: usize| {
            let [a, b] = self.piece.range[k];
            0.5 * (a + b) > a && 0.5 * (a + b) < b
        };
        let direction = match (room(0) && u > point, room(1) && v > point) {
            (false, false) => return None,
            (true, false) => Direction::U,
            (true, true) if u >= v => Direction::U,
            _ => Direction::V,
        };
        let halves = self.piece.clone().halves(direction);
        Some(halves.map(|piece| Self { piece, ..*self }.bounded()))
    }

    /// The nearest point to the ray, by Newton steps from the middle; where the part meets the ray
    /// once at an angle, this is the place if the steps converge.
    pub fn nearest(&self) -> Sight {
        let mut at = [0.5; 2];
        let mut jet = self.jet(at);
        for _ in 0..STEPS {
            let [u, v] = step(at, jet[0].xy(), [-jet[1].xy(), jet[2].xy()]);
            at = [(at[0] + u).clamp(0.0, 1.0), (at[1] + v).clamp(0.0, 1.0)];
            jet = self.jet(at);
            if u.abs() < SETTLED && v.abs() < SETTLED {
                break;
            }
        }
        let range = self.piece.range;
        let global = |k: usize| {
            if at[k] == 1.0 { range[k][1] } else { range[k][0] + (range[k][1] - range[k][0]) * at[k] }
        };
        let [x, y, z, w] = jet[0].to_array();
        Sight { at: DVec2::new(global(0), global(1)), s: z / w, distance: x.hypot(y) / w }
    }

    /// `X Y Z w` with both derivatives at parameters from 0 to 1 (de Casteljau).
    fn jet(&self, [u, v]: [f64; 2]) -> [DVec4; 3] {
        let columns = self.piece.columns;
        let (mut line, mut slope) = ([DVec4::ZERO; MAX_DEGREE + 1], [DVec4::ZERO; MAX_DEGREE + 1]);
        let mut rows = 0;
        let nets = self.piece.poles.chunks_exact(columns).zip(self.piece.weights.chunks_exact(columns));
        for (poles, weights) in nets {
            let mut row = [DVec4::ZERO; MAX_DEGREE + 1];
            for (out, (pole, &w)) in row.iter_mut().zip(poles.iter().zip(weights)) {
                *out = pole.extend(w);
            }
            [line[rows], slope[rows]] = casteljau(&mut row[..columns], v);
            rows += 1;
        }
        let [point, along_u] = casteljau(&mut line[..rows], u);
        [point, along_u, casteljau(&mut slope[..rows], u)[0]]
    }
}

/// The point and derivative of a Bézier polynomial; its control points are used up.
fn casteljau(points: &mut [DVec4], t: f64) -> [DVec4; 2] {
    let degree = points.len() - 1;
    for last in (1..degree).rev() {
        for i in 0..=last {
            points[i] = points[i].lerp(points[i + 1], t);
        }
    }
    let step = points[1] - points[0];
    [points[0] + step * t, step * degree as f64]
}
