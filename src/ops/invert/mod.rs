//! Point inversion: the parameters of the nearest point of a curve or surface, always the global
//! one, with all ties on request.

pub mod bezier;
pub mod curve;
pub mod surface;

pub use curve::CurveInverter;
pub use surface::SurfaceInverter;

use std::cmp::Ordering;

/// Parameters closer than this fraction of their range are one place.
const SAME: f64 = 1e-7;

/// A slope of the squared distance below this fraction of speed times distance is zero.
const SLOPE: f64 = 1e-9;

/// A nearest point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest<T, P> {
    /// Its parameters.
    pub at: T,
    /// The point itself.
    pub point: P,
    /// Its distance, in the unit of the points.
    pub distance: f64,
}

/// Halvings in one query at most: only a point from which a whole arc or cap is equally far, the
/// centre of a sphere, asks for more, and then any of its points is right.
const HALVINGS: usize = 4096;

/// A piece that waits to be halved, the nearest first.
struct Pending<T> {
    bound: f64,
    piece: T,
}

impl<T> PartialEq for Pending<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<T> Eq for Pending<T> {}

impl<T> PartialOrd for Pending<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Pending<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

/// Whether a parameter at which the distance rises by `slope` for each unit of `scale` is a minimum
/// within `range`.
fn stationary(t: f64, range: (f64, f64), slope: f64, scale: f64) -> bool {
    let steep = SLOPE * scale;
    (slope <= steep || t <= range.0) && (slope >= -steep || t >= range.1)
}

/// The first of each group of values that are the same.
fn distinct<T>(values: Vec<T>, same: impl Fn(&T, &T) -> bool) -> Vec<T> {
    let mut out: Vec<T> = Vec::new();
    for value in values {
        if !out.iter().any(|known| same(known, &value)) {
            out.push(value);
        }
    }
    out
}
