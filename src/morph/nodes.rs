//! The field on the solid's scale: units, what is missing, and whether both belong together.

use super::options::Options;
use super::warnings::{Severity, Warnings};
use crate::error::{Error, Result};
use crate::fe::{self, Field};
use glam::DVec3;

/// Units that a field may be in: name and length in mm.
const UNITS: [(&str, f64); 6] =
    [("mm", 1.0), ("m", 1000.0), ("in", 25.4), ("cm", 10.0), ("ft", 304.8), ("um", 1e-3)];
/// Sizes that agree to this are of one unit.
const SAME_SIZE: f64 = 0.05;
/// A displacement beyond this fraction of the part's size is an error, or worth a warning.
const TOO_LARGE: [f64; 2] = [0.5, 0.05];
/// A displacement below this fraction of the part's size is worth a warning.
const TOO_SMALL: f64 = 1e-5;

/// Nodes in mm with the displacement to apply.
#[derive(Debug, Clone)]
pub struct Nodes {
    /// Numbers in the FE model.
    pub ids: Vec<i64>,
    /// Coordinates, mm.
    pub points: Vec<DVec3>,
    /// `factor · u`, mm; NaN where the field has no result.
    pub displacements: Vec<DVec3>,
    /// Nodes that may lie on the part: on the mesh's surface, with a result.
    pub usable: Vec<u32>,
    /// Distance at which a node counts as on the part, mm.
    pub match_tolerance_mm: f64,
    /// Largest displacement, mm.
    pub largest_mm: f64,
}

/// Diagonal of the box around points.
fn diagonal(points: impl Iterator<Item = DVec3>) -> f64 {
    let (low, high) = points.fold((DVec3::MAX, DVec3::MIN), |(a, b), p| (a.min(p), b.max(p)));
    if low.x > high.x { 0.0 } else { (high - low).length() }
}

impl Nodes {
    /// Scales the field and checks it against the part, whose size is the diagonal of its box.
    ///
    /// # Errors
    /// [`Error::Mismatch`] for a field in another unit, or displacements beyond the part's size;
    /// [`Error::Field`] for too few nodes with a displacement.
    pub fn new(field: &Field, options: &Options, size_mm: f64, warnings: &mut Warnings) -> Result<Self> {
        let unit = options.field_unit_mm.unwrap_or(1.0);
        let scale = options.factor * unit * options.displacement_scale;
        let points: Vec<DVec3> = field.points.iter().map(|p| *p * unit).collect();
        let displacements: Vec<DVec3> = field.displacements.iter().map(|u| *u * scale).collect();
        let has_result = |n: u32| displacements[n as usize].is_finite();
        let all = 0..points.len() as u32;
        let usable: Vec<u32> = match &field.surface_nodes {
            Some(surface) => surface.iter().copied().filter(|&n| has_result(n)).collect(),
            None => all.filter(|&n| has_result(n)).collect(),
        };
        if let Some(why) = fe::shortage(usable.iter().map(|&n| points[n as usize])) {
            return Err(Error::Field { path: field.name.clone(), line: 0, why });
        }
        check_unit(field, options.field_unit_mm, size_mm)?;
        let largest_mm = usable.iter().map(|&n| displacements[n as usize].length()).fold(0.0, f64::max);
        check_size(largest_mm, size_mm, options, warnings)?;
        let coordinate = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let match_tolerance_mm = options.match_tolerance_mm.unwrap_or_else(|| default_tolerance(coordinate));
        Ok(Self { ids: field.ids.clone(), points, displacements, usable, match_tolerance_mm, largest_mm })
    }
}

/// Twice what six digits of a coordinate lose in space, and at least two micrometres.
fn default_tolerance(coordinate: f64) -> f64 {
    let digits = 10f64.powf(coordinate.max(1e-3).log10().floor() + 1.0);
    (2.0 * digits * 1e-6).max(2e-3)
}

/// Refuses a field whose size shows another unit than the one that was stated, or millimetres.
fn check_unit(field: &Field, stated: Option<f64>, size_mm: f64) -> Result<()> {
    let size = diagonal(field.points.iter().copied());
    let ratio = size_mm / size;
    if size <= 0.0 || (ratio / stated.unwrap_or(1.0) - 1.0).abs() < 0.5 {
        return Ok(());
    }
    let Some((name, unit)) = UNITS.iter().find(|(_, mm)| (ratio / mm - 1.0).abs() < SAME_SIZE) else {
        return Ok(());
    };
    let flag = match *name {
        "mm" | "m" | "in" => format!("--field-unit {name}"),
        _ => format!("coordinates in mm ({unit} times as large)"),
    };
    let instead = if stated.is_some() { " instead of the unit that was stated" } else { "" };
    Err(Error::Mismatch {
        why: format!(
            "{}: the mesh measures {size:.6} and the part {size_mm:.6} mm, a ratio of {ratio:.1}: the field seems to be in \
             {name}; give {flag}{instead}",
            field.name
        ),
    })
}

fn check_size(largest: f64, size: f64, options: &Options, warnings: &mut Warnings) -> Result<()> {
    let ratio = largest / size;
    if ratio > TOO_LARGE[0] {
        return Err(Error::Mismatch {
            why: format!(
                "the largest displacement, {largest:.4} mm, is {ratio:.1} times the part's size ({size:.1} mm): the solid \
                 would be folded; check the unit of the displacements (--displacement-scale scales them alone) and the factor"
            ),
        });
    }
    if ratio > TOO_LARGE[1] {
        let text = format!(
            "the largest displacement, {largest:.4} mm, is {:.0} % of the part's size ({size:.1} mm): check unit and factor",
            100.0 * ratio
        );
        warnings.push(Severity::Doubtful, text);
    }
    if largest == 0.0 && options.factor != 0.0 {
        warnings.push(Severity::Doubtful, "all displacements are zero: the result equals the input");
    } else if ratio < TOO_SMALL {
        let text = format!(
            "the largest displacement, {largest:.3e} mm, is only {ratio:.1e} of the part's size ({size:.1} mm): if the \
             displacements are in metres, give --displacement-scale 1000"
        );
        warnings.push(Severity::Doubtful, text);
    }
    Ok(())
}
