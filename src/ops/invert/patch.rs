//! A piece of a surface with what bounds it.
//!
//! A prism whose sides follow those of the piece holds its control points, and with them the piece.
//!
//! A foot `q` of `p` on the piece is the only nearest point there if `|S − p|² − |q − p|²` stays
//! positive over it. With `r = q − p`, and for a step `δ` of the parameters from `q`, that is at
//! least `m²·δᵀGδ + δᵀ(r·S_ij)δ − |r|·E·δᵀGδ`: `G` is the metric in the middle, `m` what chords are
//! at least as long as in it, and the second derivatives differ in it by no more than `E` from the
//! `S_ij` in the middle. `m` and `E` come from the coefficients of the piece and hold for all of
//! it. Where a side of the piece holds the foot, the slope there adds to the sum.

use super::bezier::SurfacePiece;
use super::taylor::{Powers, Taylor};
use super::tree::Bounds;
use crate::nurbs::{Direction, SurfaceDerivatives};
use crate::ops::closest::Local;
use glam::{DMat3, DVec2, DVec3, Vec4Swizzles};

/// Chords of prepared pieces are at least as long as this, in the metric of their middles.
const FLAT: f64 = 0.6;
/// Curvature may use up this fraction of the certainty that a foot is the only one.
const CERTAIN: f64 = 1.0 - 1e-9;

/// A piece with its bounds.
#[derive(Debug, Clone)]
pub struct Patch {
    low: DVec2,
    high: DVec2,
    /// What holds the control points.
    pub hull: Hull,
    /// A box along the axes that does.
    pub bounds: Bounds,
    taylor: Taylor,
    spread: Spread,
    /// Largest distance of a control point from the centre.
    pub size: f64,
    piece: SurfacePiece,
    /// Halvings that led here.
    pub depth: usize,
}

/// A prism along the normal of a piece, whose sides follow those of the piece: two of its three
/// pairs of parallel planes are at right angles to the third.
#[derive(Debug, Clone, Copy)]
pub struct Hull {
    centre: DVec3,
    /// Rows: unit normals of the planes, the last one at right angles to the others.
    frame: DMat3,
    /// Extent from the centre along them.
    low: DVec3,
    high: DVec3,
}

impl Hull {
    /// Around nothing yet.
    fn new(centre: DVec3, middle: &SurfaceDerivatives) -> Self {
        let sides =
            |n: DVec3| Some([middle.v.cross(n).try_normalize()?, n.cross(middle.u).try_normalize()?, n]);
        let [a, b, n] = middle.normal().try_normalize().and_then(sides).unwrap_or(DVec3::AXES);
        Self { centre, frame: DMat3::from_cols(a, b, n).transpose(), low: DVec3::MAX, high: DVec3::MIN }
    }

    fn include(&mut self, x: DVec3) {
        let local = self.frame * (x - self.centre);
        (self.low, self.high) = (self.low.min(local), self.high.max(local));
    }

    /// A lower bound of the squared distance to `p`.
    pub fn nearest_squared(&self, p: DVec3) -> f64 {
        let local = self.frame * (p - self.centre);
        let off = (self.low - local).max(local - self.high).max(DVec3::ZERO);
        let side = off.x.max(off.y);
        side * side + off.z * off.z
    }
}

/// How much derivatives differ over a piece; see the head of the file. Pairs are in u and in v,
/// triples in u, mixed and in v.
#[derive(Debug, Clone, Default)]
struct Spread {
    /// `m`; 0 or less if unknown.
    chord: f64,
    /// `E`.
    variation: f64,
    /// `G`.
    metric: [f64; 3],
    /// `S_ij`.
    second: [DVec3; 3],
    /// Change of the tangents.
    turn: [f64; 2],
}

impl Patch {
    /// Of a piece, with the powers of its degrees.
    pub fn new(piece: SurfacePiece, powers: [&Powers; 2], rational: bool, depth: usize) -> Self {
        let [[u0, u1], [v0, v1]] = piece.range;
        let taylor = Taylor::new(&piece, powers, rational);
        let middle = taylor.middle();
        let mut hull = Hull::new(taylor.centre, &middle);
        let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
        let mut squared = 0.0f64;
        for x in piece.points() {
            hull.include(x);
            (low, high) = (low.min(x), high.max(x));
            squared = squared.max(x.distance_squared(taylor.centre));
        }
        let bounds = [low.to_array(), high.to_array()];
        let size = squared.sqrt();
        let least_weight = piece.weights.iter().copied().fold(f64::INFINITY, f64::min);
        let spread = Spread::new(&taylor, &middle, size, least_weight);
        let (low, high) = (DVec2::new(u0, v0), DVec2::new(u1, v1));
        Self { low, high, hull, bounds, taylor, spread, size, piece, depth }
    }

    /// A local minimum of the distance to `p`, in parameters −1..1 and relative to the centre.
    pub fn foot(&self, p: DVec3) -> Local {
        self.taylor.foot(p)
    }

    /// The parameters on the surface of those of a local foot, and the point in space.
    pub fn place(&self, foot: &Local) -> (DVec2, DVec3) {
        let side =
            |x: f64, a: f64, b: f64| if x >= 1.0 { b } else { (a + (b - a) * (0.5 * (1.0 + x))).max(a) };
        let uv =
            DVec2::new(side(foot.at.x, self.low.x, self.high.x), side(foot.at.y, self.low.y, self.high.y));
        (uv, self.taylor.centre + foot.point)
    }

    /// Whether no point of the piece is nearer to `p` than this foot.
    pub fn is_only(&self, foot: &Local, p: DVec3) -> bool {
        let Spread { chord, variation, metric: [guu, guv, gvv], second: [uu, uv, vv], .. } = self.spread;
        if chord <= 0.0 || !foot.settled {
            return false;
        }
        let r = self.taylor.centre + foot.point - p;
        let rest = CERTAIN * chord * chord - r.length() * variation;
        // A side is two units of the parameter away from the other.
        let push = CERTAIN * foot.push;
        let a = rest * guu + r.dot(uu) + push.x;
        let b = rest * guv + r.dot(uv);
        let c = rest * gvv + r.dot(vv) + push.y;
        a > 0.0 && a * c > b * b
    }

    /// Whether tangents change so little that feet of near points are certain.
    pub fn is_flat(&self) -> bool {
        self.spread.chord > FLAT
    }

    /// Both halves, across the direction along which tangents change more.
    pub fn halves(self, powers: [&Powers; 2], rational: bool) -> [Self; 2] {
        let [along_u, along_v] = self.spread.turn;
        let direction = if along_u >= along_v { Direction::U } else { Direction::V };
        self.piece.halves(direction).map(|half| Self::new(half, powers, rational, self.depth + 1))
    }
}

impl Spread {
    fn new(taylor: &Taylor, middle: &SurfaceDerivatives, size: f64, least_weight: f64) -> Self {
        let SurfaceDerivatives { u, v, uu, uv, vv, .. } = *middle;
        let (a, b) = (u.length().max(f64::MIN_POSITIVE), v.length().max(f64::MIN_POSITIVE));
        let sums = Sums::new(taylor, middle);
        let [wu, wv, wuu, wuv, wvv] = sums.weights;
        let [du, dv, duu, duv, dvv] = sums.numerators;
        let (du, dv) = ((du + size * wu) / least_weight, (dv + size * wv) / least_weight);
        let duu = duu + 2.0 * du * wu + size * wuu;
        let duv = duv + du * wv + dv * wu + size * wuv;
        let dvv = dvv + 2.0 * dv * wv + size * wvv;
        // Weights that change along one direction turn tangents as far as the piece extends in the
        // other.
        let turn = [
            uu.length() / a + (uv.length() + a * wv / least_weight) / b,
            vv.length() / b + (uv.length() + b * wu / least_weight) / a,
        ];
        // With the metric's triangular root, tangents are perpendicular and of unit length.
        let skew = u.dot(v) / (a * a);
        let height = (v - u * skew).length();
        if u.length() == 0.0 || height == 0.0 {
            return Self { turn, ..Self::default() };
        }
        let across = (dv + skew.abs() * du) / height;
        let variations = [
            duu / (a * a),
            (duv + skew.abs() * duu) / (a * height),
            (dvv + 2.0 * skew.abs() * duv + skew * skew * duu) / (height * height),
        ];
        let [uu_part, uv_part, vv_part] = variations.map(|x| x * x);
        Self {
            chord: 1.0 - (du / a).hypot(across),
            variation: (uu_part + 2.0 * uv_part + vv_part).sqrt() / least_weight,
            metric: [u.dot(u), u.dot(v), v.dot(v)],
            second: [uu, uv, vv],
            turn,
        }
    }
}

/// Bounds over a piece, from its coefficients, by derivative: in u, in v, in u twice, mixed, in v
/// twice.
#[derive(Default)]
struct Sums {
    /// Of the numerators less their values in the middle; see eq. 4.20.
    numerators: [f64; 5],
    /// Of the weight.
    weights: [f64; 5],
}

impl Sums {
    fn new(taylor: &Taylor, middle: &SurfaceDerivatives) -> Self {
        let SurfaceDerivatives { u, v, uu, uv, vv, .. } = *middle;
        let mut out = Self::default();
        for (i, j) in taylor.each() {
            let ([i1, i2], [j1, j2]) = ([i + 1, i + 2], [j + 1, j + 2]);
            let of = |i: usize, j: usize, factor: usize| taylor.get(i, j) * factor as f64;
            let w = taylor.get(i, j).w;
            let (in_u, in_v) = (of(i1, j, i1), of(i, j1, j1));
            let derivatives = [in_u, in_v, of(i2, j, i1 * i2), of(i1, j1, i1 * j1), of(i, j2, j1 * j2)];
            let less = [
                u * w,
                v * w,
                uu * w + u * (2.0 * in_u.w),
                uv * w + v * in_u.w + u * in_v.w,
                vv * w + v * (2.0 * in_v.w),
            ];
            for k in 0..5 {
                out.numerators[k] += (derivatives[k].xyz() - less[k]).length();
                out.weights[k] += derivatives[k].w.abs();
            }
        }
        out
    }
}
