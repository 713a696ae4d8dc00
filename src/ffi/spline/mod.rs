//! Curves and surfaces for C: handles, arrays of numbers in and out, and batches.
//!
//! Each function checks its arguments and calls one of the core. Those that make one shape from
//! another pass through `reshape` of their file.

use super::slice::{ArrayOut, check_pointer, slice};
use crate::error::{Error, Result};
use crate::nurbs::{Direction, KnotVector, Point};
use glam::{DVec2, DVec3};

pub mod curve;
pub mod curve_fit;
pub mod curve_make;
pub mod curve_reshape;
pub mod curves;
pub mod fillet;
pub mod intersect;
pub mod nearest;
pub mod offset;
pub mod ray;
pub mod section;
pub mod surface;
pub mod surface_make;
pub mod surface_reshape;
pub mod surfaces;
pub mod table;

pub use curve::Curve;
pub use curve_fit::Spacing;
pub use curves::Curves;
pub use section::Section;
pub use surface::Surface;
pub use surfaces::Surfaces;
pub use table::Table;

/// Highest order of derivatives that arrays are made for: beyond the largest degree a polynomial
/// has none, and rational ones have lost all their digits.
const MAX_ORDER: u32 = 25;

/// Points that C passes as rows of numbers: rows and points lie in memory alike.
trait Row: Point {
    /// The `count` points of an array `[count][dimension]` of the caller.
    ///
    /// # Errors
    /// [`Error::Argument`] for an array that cannot be, or values that are not finite.
    ///
    /// # Safety
    /// If not NULL, `start` must point to as many numbers, which nobody changes meanwhile.
    unsafe fn rows<'a>(start: *const f64, count: usize, name: &'static str) -> Result<&'a [Self]> {
        // SAFETY: promised by the caller; see the trait for the cast.
        let rows: &[Self] = unsafe { slice(start.cast(), count, name)? };
        match rows.iter().position(|row| !row.is_finite()) {
            None => Ok(rows),
            Some(at) => {
                let why = format!("point {} is {:?}; only finite numbers can be used", at + 1, rows[at]);
                Err(Error::Argument { name, why })
            }
        }
    }

    /// The one point at `start`.
    ///
    /// # Errors
    /// As [`rows`](Self::rows).
    ///
    /// # Safety
    /// As [`rows`](Self::rows), for one point.
    unsafe fn row(start: *const f64, name: &'static str) -> Result<Self> {
        // SAFETY: promised by the caller.
        Ok(unsafe { Self::rows(start, 1, name) }?[0])
    }

    /// An array `[count][dimension]` of the caller to be filled; NULL takes nothing.
    ///
    /// # Errors
    /// [`Error::Argument`] for an array that cannot be.
    ///
    /// # Safety
    /// If not NULL, `start` must have room for as many numbers.
    unsafe fn rows_out(start: *mut f64, count: usize, name: &'static str) -> Result<ArrayOut<Self>> {
        // SAFETY: promised by the caller; see the trait for the cast.
        unsafe { ArrayOut::new(start.cast(), count, name) }
    }
}

impl Row for DVec2 {}
impl Row for DVec3 {}

/// Finite numbers of the caller.
///
/// # Errors
/// [`Error::Argument`] for an array that cannot be, or a value that is not finite.
///
/// # Safety
/// If not NULL, `start` must point to as many numbers, which nobody changes meanwhile.
unsafe fn numbers<'a>(start: *const f64, count: usize, name: &'static str) -> Result<&'a [f64]> {
    // SAFETY: promised by the caller.
    let values = unsafe { slice(start, count, name)? };
    super::slice::finite(values, 1, name)?;
    Ok(values)
}

/// As [`numbers`]; NULL is `None`.
///
/// # Errors
/// As there.
///
/// # Safety
/// As there.
unsafe fn optional<'a>(start: *const f64, count: usize, name: &'static str) -> Result<Option<&'a [f64]>> {
    // SAFETY: promised by the caller.
    (!start.is_null()).then(|| unsafe { numbers(start, count, name) }).transpose()
}

/// An array that must be there unless it is empty.
///
/// # Errors
/// [`Error::Argument`] for an array that cannot be.
///
/// # Safety
/// If not NULL, `start` must have room for as many values.
unsafe fn filled<T>(start: *mut T, count: usize, name: &'static str) -> Result<ArrayOut<T>> {
    check_pointer(start, count, name)?;
    // SAFETY: promised by the caller.
    unsafe { ArrayOut::new(start, count, name) }
}

/// Knots from an array of the caller.
///
/// # Errors
/// [`Error::Argument`] for an array that cannot be, [`Error::Spline`] for knots that cannot be.
///
/// # Safety
/// If not NULL, `flat` must point to `count` numbers, which nobody changes meanwhile.
unsafe fn knots(degree: u32, flat: *const f64, count: usize, name: &'static str) -> Result<KnotVector> {
    // SAFETY: promised by the caller.
    KnotVector::new(degree as usize, unsafe { slice(flat, count, name)? }.to_vec())
}

fn direction(number: u32) -> Result<Direction> {
    match number {
        0 => Ok(Direction::U),
        1 => Ok(Direction::V),
        _ => {
            let why = format!("is {number}; give 0 for u or 1 for v");
            Err(Error::Argument { name: "direction", why })
        }
    }
}

fn order(number: u32) -> Result<usize> {
    if number <= MAX_ORDER {
        return Ok(number as usize);
    }
    let why = format!("is {number}; give at most {MAX_ORDER}");
    Err(Error::Argument { name: "order", why })
}

/// A finite number as an argument.
fn number(value: f64, name: &'static str) -> Result<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Error::Argument { name, why: format!("is {value}; give a finite number") })
}

/// A finite number that is not negative, as tolerances are.
fn tolerance(value: f64, name: &'static str) -> Result<f64> {
    if value.is_finite() && value >= 0.0 {
        return Ok(value);
    }
    Err(Error::Argument { name, why: format!("is {value}; give a finite number of at least 0") })
}

/// An affine map as C passes it: [3][4], row by row, the last column a shift.
struct Affine([DVec3; 3], DVec3);

impl Affine {
    fn new(rows: &[f64]) -> Self {
        let row = |i: usize| DVec3::from_slice(&rows[4 * i..]);
        Self([row(0), row(1), row(2)], DVec3::new(rows[3], rows[7], rows[11]))
    }

    fn of<P: Point>(&self, p: P) -> DVec3 {
        let p = DVec3::from_array(p.coordinates());
        self.1 + DVec3::from_array(self.0.map(|row| row.dot(p)))
    }
}
