//! Where two pieces come nearest to each other, and feet of points on a piece: Newton steps within
//! the parameters of the pieces.

use super::tree::Tree;
use crate::nurbs::Point;

/// Newton steps at most.
pub const STEPS: usize = 16;
/// A step of a parameter, of 0 to 1, after which one more would change nothing: convergence is
/// quadratic.
pub const SETTLED: f64 = 1e-10;

/// A piece of a curve: a node of its tree.
pub type Piece<'a, P> = (&'a Tree<P>, usize);

/// A place on two pieces.
#[derive(Debug, Clone, Copy)]
pub struct Place<P> {
    /// Parameters on both, 0 to 1 within each piece.
    pub at: [f64; 2],
    /// The points.
    pub points: [P; 2],
    /// First derivatives over these parameters.
    pub derivatives: [P; 2],
}

impl<P: Point> Place<P> {
    /// On two pieces.
    pub fn new(pieces: [Piece<P>; 2], at: [f64; 2]) -> Self {
        let [[p, dp], [q, dq]] = [0, 1].map(|k| pieces[k].0.at(pieces[k].1, at[k]));
        Self { at, points: [p, q], derivatives: [dp, dq] }
    }

    /// Distance of the points.
    pub fn distance(&self) -> f64 {
        (self.points[1] - self.points[0]).length()
    }

    /// Sine of the angle between the tangents; 1 where one has none.
    pub fn sine(&self) -> f64 {
        let [d, e] = self.derivatives;
        let (dd, ee) = (d.dot(d), e.dot(e));
        if dd == 0.0 || ee == 0.0 {
            return 1.0;
        }
        let off = e - d * (d.dot(e) / dd);
        (off.dot(off) / ee).sqrt().min(1.0)
    }
}

/// The step within the unit square, from a place in it, after which `gap + e v − d u` is shortest.
pub fn step<P: Point>([u, v]: [f64; 2], gap: P, [d, e]: [P; 2]) -> [f64; 2] {
    let (dd, de, ee) = (d.dot(d), d.dot(e), e.dot(e));
    let (gd, ge) = (gap.dot(d), gap.dot(e));
    // What is across the second curve keeps its digits where the tangents are nearly parallel.
    let across = |x: P, along: f64| x - e * (along / ee);
    let off = across(d, de);
    let squared = off.dot(off);
    if ee > 0.0 && squared > 0.0 {
        let by = across(gap, ge).dot(off) / squared;
        let free = [by, (de * by - ge) / ee];
        if (0.0..=1.0).contains(&(u + free[0])) && (0.0..=1.0).contains(&(v + free[1])) {
            return free;
        }
    }
    // The least of the quadratic on the sides of the square, or with one parameter kept.
    let along = |t: f64, along: f64, squared: f64| {
        let best = if squared > 0.0 { along / squared } else { 0.0 };
        (t + best).clamp(0.0, 1.0) - t
    };
    let with_u = |a: f64| [a, along(v, de * a - ge, ee)];
    let with_v = |b: f64| [along(u, de * b + gd, dd), b];
    let height = |[a, b]: &[f64; 2]| (gap + e * *b - d * *a).dot(gap + e * *b - d * *a);
    let all = [with_u(0.0), with_v(0.0), with_u(-u), with_u(1.0 - u), with_v(-v), with_v(1.0 - v)];
    all.into_iter().min_by(|x, y| height(x).total_cmp(&height(y))).unwrap_or([0.0; 2])
}

/// Where the pieces come nearest to each other, sought from `start`; where they cross once, this
/// is the crossing if the steps converge.
pub fn nearest<P: Point>(pieces: [Piece<P>; 2], start: [f64; 2]) -> Place<P> {
    let mut place = Place::new(pieces, start);
    for _ in 0..STEPS {
        let gap = place.points[1] - place.points[0];
        let [a, b] = step(place.at, gap, place.derivatives);
        let [u, v] = place.at;
        place = Place::new(pieces, [(u + a).clamp(0.0, 1.0), (v + b).clamp(0.0, 1.0)]);
        if a.abs() < SETTLED && b.abs() < SETTLED {
            break;
        }
    }
    place
}

/// The parameter of a piece nearest to `p`, sought from `start`.
pub fn foot<P: Point>((tree, k): Piece<P>, p: P, start: f64) -> f64 {
    let mut t = start;
    for _ in 0..STEPS {
        let [c, d] = tree.at(k, t);
        let squared = d.dot(d);
        if squared == 0.0 {
            break;
        }
        let next = (t + (p - c).dot(d) / squared).clamp(0.0, 1.0);
        let moved = (next - t).abs();
        t = next;
        if moved < SETTLED {
            break;
        }
    }
    t
}
