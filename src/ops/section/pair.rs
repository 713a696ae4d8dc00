//! Two sheets and the points that they share, by Newton's method in all four parameters.

use super::sheet::{Cell, Sheet};
use crate::error::{Error, Result};
use crate::nurbs::SurfaceDerivatives;
use glam::{DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};
use std::cell::Cell as Count;

/// Newton steps at most.
const STEPS: usize = 16;
/// Sine of the angle below which two tangent planes are one.
const PARALLEL: f64 = 1e-9;
/// Points and patches looked at for one intersection, at most: a second's work.
const MOST: usize = 1_000_000;

/// Two sheets of a common size.
#[derive(Debug)]
pub struct Pair {
    pub sheets: [Sheet; 2],
    /// A length that both have in common, in mm.
    pub size: f64,
    /// The largest coordinate, in mm: rounding errors are fractions of it.
    pub reach: f64,
    /// In mm.
    pub tolerance: f64,
    /// What has been looked at: pairs of points and of patches.
    pub work: Count<usize>,
}

/// How two sheets meet along a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// At an angle.
    Crossing,
    /// With one tangent plane.
    Touching,
}

/// Parameters on both sheets.
pub type At = [DVec2; 2];
/// A cell of each.
pub type Cells = [Cell; 2];

/// What picks one point of a curve.
#[derive(Debug, Clone, Copy)]
pub enum Cut {
    /// The plane through a point across a direction.
    Across { point: DVec3, direction: DVec3 },
    /// The value of one of the four parameters.
    Parameter { index: usize, value: f64 },
}

/// A point of the curve with two derivatives by its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    pub at: At,
    pub first: At,
    pub second: At,
    pub x: DVec3,
    pub tangent: DVec3,
    pub bend: DVec3,
}

impl Node {
    /// The same point of the curve run backwards.
    pub fn reversed(self) -> Self {
        Self { first: self.first.map(|d| -d), tangent: -self.tangent, ..self }
    }

    /// `Σ weight · node`.
    pub fn sum(terms: &[(f64, Node)]) -> Self {
        let at = |f: fn(&Node) -> At| [0, 1].map(|k| terms.iter().map(|(w, n)| f(n)[k] * *w).sum::<DVec2>());
        let of = |f: fn(&Node) -> DVec3| terms.iter().map(|(w, n)| f(n) * *w).sum();
        Self {
            at: at(|n| n.at),
            first: at(|n| n.first),
            second: at(|n| n.second),
            x: of(|n| n.x),
            tangent: of(|n| n.tangent),
            bend: of(|n| n.bend),
        }
    }
}

/// The four parameters as one vector.
pub fn joined([a, b]: At) -> DVec4 {
    DVec4::new(a.x, a.y, b.x, b.y)
}

/// And back.
pub fn parted(y: DVec4) -> At {
    [y.xy(), y.zw()]
}

/// Derivatives of both sheets and the linear system at one place. Unknowns are lengths in mm.
struct System {
    jets: [SurfaceDerivatives; 2],
    /// mm for each unit of a parameter.
    speeds: DVec4,
    /// Three residuals in mm, and for each unknown their change.
    residual: DVec3,
    columns: [DVec3; 4],
}

impl Pair {
    /// Counts one more thing looked at.
    ///
    /// # Errors
    /// [`Error::Numerics`] beyond the most.
    pub fn spend(&self) -> Result<()> {
        self.work.set(self.work.get() + 1);
        if self.is_spent() {
            let why =
                "the surfaces meet in too many places to follow: give a larger tolerance, or parts of them";
            return Err(Error::Numerics { why: why.into() });
        }
        Ok(())
    }

    /// Whether as much has been looked at as may be.
    pub fn is_spent(&self) -> bool {
        self.work.get() > MOST
    }

    pub fn jets(&self, cells: &Cells, at: At) -> [SurfaceDerivatives; 2] {
        self.work.set(self.work.get() + 1);
        [0, 1].map(|k| self.sheets[k].jet(&cells[k], at[k]))
    }

    /// The cells into which a direction leads.
    pub fn cells(&self, at: At, towards: At) -> Option<Cells> {
        let cell = |k: usize| self.sheets[k].cell(at[k], towards[k] * self.size);
        Some([cell(0)?, cell(1)?])
    }

    fn system(&self, kind: Kind, cells: &Cells, at: At) -> System {
        let jets = self.jets(cells, at);
        let [a, b] = &jets;
        let apart = a.s - b.s;
        let (residual, columns) = match kind {
            Kind::Crossing => (apart, [a.u, a.v, -b.u, -b.v]),
            Kind::Touching => self.touching(a, b, apart),
        };
        let speed = |d: DVec3| d.length().max(f64::MIN_POSITIVE);
        let speeds = DVec4::new(speed(a.u), speed(a.v), speed(b.u), speed(b.v));
        System { jets, speeds, residual, columns: std::array::from_fn(|k| columns[k] / speeds[k]) }
    }

    /// The parts of the distance along the tangent plane vanish, and the normal of one sheet stands
    /// across the direction in which the sheets leave each other fastest.
    fn touching(&self, a: &SurfaceDerivatives, b: &SurfaceDerivatives, apart: DVec3) -> (DVec3, [DVec3; 4]) {
        let (p, q) = (a.u.normalize(), (a.v - a.u * (a.v.dot(a.u) / a.u.length_squared())).normalize());
        let normal = a.normal();
        let length = normal.length();
        let [_, (_, away)] = parting(a, b);
        // The direction as one of the second sheet, with fixed parts along its derivatives.
        let across = b.normal().length_squared().max(f64::MIN_POSITIVE);
        let part = |c: DVec3, d: DVec3| c.cross(d).dot(b.normal()) / across;
        let (s, t) = (part(away, b.v), part(b.u, away));
        let direction = b.u * s + b.v * t;
        let normal_u = a.uu.cross(a.v) + a.u.cross(a.uv);
        let normal_v = a.uv.cross(a.v) + a.u.cross(a.vv);
        let scale = self.size / length.max(f64::MIN_POSITIVE);
        let row = |d: DVec3, turn: f64| DVec3::new(d.dot(p), d.dot(q), turn * scale);
        let columns = [
            row(a.u, normal_u.dot(direction)),
            row(a.v, normal_v.dot(direction)),
            row(-b.u, normal.dot(b.uu * s + b.uv * t)),
            row(-b.v, normal.dot(b.uv * s + b.vv * t)),
        ];
        (row(apart, normal.dot(direction)), columns)
    }

    /// The point of the curve near `guess` that `cut` picks; none where there is none.
    pub fn point(&self, kind: Kind, cells: &Cells, guess: At, cut: Cut) -> Option<(At, DVec3)> {
        let mut y = joined(guess);
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let system = self.system(kind, cells, parted(y));
            let (row, off) = match cut {
                Cut::Across { point, direction } => {
                    let a = &system.jets[0];
                    let row = [a.u / system.speeds.x, a.v / system.speeds.y].map(|d| d.dot(direction));
                    ([row[0], row[1], 0.0, 0.0], (a.s - point).dot(direction))
                }
                Cut::Parameter { index, value } => {
                    let mut row = [0.0; 4];
                    row[index] = 1.0;
                    (row, (y[index] - value) * system.speeds[index])
                }
            };
            let step = system.solve(row, system.residual.extend(off))?;
            y -= step / system.speeds;
            let moved = step.length();
            if !moved.is_finite() || moved > self.size {
                return None;
            }
            // Steps of this size are squared by the next, or rounding is all that is left of them.
            let done = moved < 1e-9 * self.size && moved * moved < 1e-15 * self.reach * self.size
                || (moved >= 0.5 * before && moved < 1e-8 * self.size);
            if done {
                let at = parted(y);
                let [a, b] = self.jets(cells, at);
                return ((a.s - b.s).length() <= self.tolerance).then_some((at, 0.5 * (a.s + b.s)));
            }
            before = moved;
        }
        None
    }

    /// The direction of the curve at a place; along the cross product of the normals where the
    /// sheets cross.
    pub fn direction(&self, kind: Kind, cells: &Cells, at: At) -> Option<DVec3> {
        let [a, b] = self.jets(cells, at);
        let normal = |d: &SurfaceDerivatives| d.normal().try_normalize();
        match kind {
            Kind::Crossing => {
                let cross = normal(&a)?.cross(normal(&b)?);
                (cross.length() > PARALLEL).then(|| cross.normalize())
            }
            Kind::Touching => parting(&a, &b)[0].1.try_normalize(),
        }
    }

    /// The point of the curve with its derivatives, in the sense of `along`.
    pub fn node(&self, kind: Kind, cells: &Cells, (at, x): (At, DVec3), along: DVec3) -> Option<Node> {
        let direction = self.direction(kind, cells, at)?;
        let direction = if direction.dot(along) < 0.0 { -direction } else { direction };
        let (first, tangent) = self.velocity(kind, cells, at, direction)?;
        let mut node = Node { at, first, second: [DVec2::ZERO; 2], x, tangent, bend: DVec3::ZERO };
        (node.second, node.bend) = match kind {
            Kind::Crossing => self.crossing_bend(cells, &node)?,
            Kind::Touching => self.touching_bend(cells, &node)?,
        };
        Some(node)
    }

    /// Derivatives of the parameters and of the point by the length.
    fn velocity(&self, kind: Kind, cells: &Cells, at: At, direction: DVec3) -> Option<(At, DVec3)> {
        let system = self.system(kind, cells, at);
        let a = &system.jets[0];
        let row = [a.u.dot(direction) / system.speeds.x, a.v.dot(direction) / system.speeds.y, 0.0, 0.0];
        let y = system.solve(row, DVec4::W)? / system.speeds;
        let velocity = a.u * y.x + a.v * y.y;
        let speed = velocity.length();
        Some((parted(y / speed), velocity / speed))
    }

    fn crossing_bend(&self, cells: &Cells, node: &Node) -> Option<(At, DVec3)> {
        let system = self.system(Kind::Crossing, cells, node.at);
        let [a, b] = &system.jets;
        let square = |d: &SurfaceDerivatives, p: DVec2| {
            d.uu * (p.x * p.x) + d.uv * (2.0 * p.x * p.y) + d.vv * (p.y * p.y)
        };
        let (qa, qb) = (square(a, node.first[0]), square(b, node.first[1]));
        let t = node.tangent;
        let row = [a.u.dot(t) / system.speeds.x, a.v.dot(t) / system.speeds.y, 0.0, 0.0];
        let y = system.solve(row, (qb - qa).extend(-t.dot(qa)))? / system.speeds;
        Some((parted(y), a.u * y.x + a.v * y.y + qa))
    }

    /// Second derivatives by central differences: exact ones would need third ones of the sheets.
    fn touching_bend(&self, cells: &Cells, node: &Node) -> Option<(At, DVec3)> {
        let h = 1e-4 * self.size;
        let beside = |h: f64| {
            let guess = [0, 1].map(|k| node.at[k] + node.first[k] * h);
            let cut = Cut::Across { point: node.x + node.tangent * h, direction: node.tangent };
            let (at, _) = self.point(Kind::Touching, cells, guess, cut)?;
            let direction = self.direction(Kind::Touching, cells, at)?;
            let direction = if direction.dot(node.tangent) < 0.0 { -direction } else { direction };
            self.velocity(Kind::Touching, cells, at, direction)
        };
        let ((p, after), (m, before)) = (beside(h)?, beside(-h)?);
        Some(([0, 1].map(|k| (p[k] - m[k]) / (2.0 * h)), (after - before) / (2.0 * h)))
    }
}

impl System {
    fn solve(&self, row: [f64; 4], right: DVec4) -> Option<DVec4> {
        let column = |k: usize| self.columns[k].extend(row[k]);
        let matrix = DMat4::from_cols(column(0), column(1), column(2), column(3));
        let size: f64 = (0..4).map(|k| column(k).length()).product();
        let determinant = matrix.determinant();
        (determinant.abs() > 1e-13 * size && size > 0.0).then(|| matrix.inverse() * right)
    }
}

/// How two sheets with one tangent plane leave each other: the principal values of the difference of
/// their second fundamental forms, in 1/mm, and unit tangents along which they hold; the smaller in
/// size first.
pub fn parting(a: &SurfaceDerivatives, b: &SurfaceDerivatives) -> [(f64, DVec3); 2] {
    let normal = a.normal().normalize_or(DVec3::Z);
    let x = a.u.normalize_or(normal.any_orthonormal_vector());
    let y = normal.cross(x);
    let form = |d: &SurfaceDerivatives| {
        // Inverse of the map from parameters to the plane of x and y.
        let (ux, uy, vx, vy) = (d.u.dot(x), d.u.dot(y), d.v.dot(x), d.v.dot(y));
        let det = ux * vy - uy * vx;
        let (px, py) = (DVec2::new(vy, -uy) / det, DVec2::new(-vx, ux) / det);
        let h = |p: DVec2, q: DVec2| {
            normal.dot(d.uu * (p.x * q.x) + d.uv * (p.x * q.y + p.y * q.x) + d.vv * (p.y * q.y))
        };
        DVec3::new(h(px, px), h(px, py), h(py, py))
    };
    let d = form(a) - form(b);
    let (mean, half) = (0.5 * (d.x + d.z), 0.5 * (d.x - d.z));
    let (radius, angle) = (half.hypot(d.y), 0.5 * d.y.atan2(half));
    let along = x * angle.cos() + y * angle.sin();
    let (large, small) = ((mean + radius, along), (mean - radius, normal.cross(along)));
    if large.0.abs() < small.0.abs() { [large, small] } else { [small, large] }
}
