//! What a user can choose.

use crate::error::{Error, Result};

/// Settings of a morph. Lengths in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Multiplies the displacement: 1 adds the field, −1 takes it away.
    pub factor: f64,
    /// Largest deviation that still counts as success.
    pub tolerance_mm: f64,
    /// How far a node may lie off the part; `None` chooses from the part's size.
    pub match_tolerance_mm: Option<f64>,
    /// Length of the field file's unit in mm (coordinates and displacements); `None`: mm, and a
    /// mismatch with the part is an error that names the unit to give.
    pub field_unit_mm: Option<f64>,
    /// Further factor on the displacements alone.
    pub displacement_scale: f64,
    /// Solid to morph, from 1; `None`: the only one that the field covers.
    pub solid: Option<usize>,
    /// Faces that move, from 1 (all others stay); empty: all.
    pub moving_faces: Vec<usize>,
    /// Faces that stay where they are, from 1.
    pub fixed_faces: Vec<usize>,
    /// Extend the field over areas without nodes however far that is.
    pub extrapolate: bool,
    /// Also fit without the nodes whose id is divisible by 10, and report the error there.
    pub holdout: bool,
    /// Names of the faces for messages and the report, by index; may be empty.
    pub face_names: Vec<String>,
    /// What the report calls the solid.
    pub solid_name: String,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            factor: 1.0,
            tolerance_mm: 1e-3,
            match_tolerance_mm: None,
            field_unit_mm: None,
            displacement_scale: 1.0,
            solid: None,
            moving_faces: Vec::new(),
            fixed_faces: Vec::new(),
            extrapolate: false,
            holdout: false,
            face_names: Vec::new(),
            solid_name: String::new(),
        }
    }
}

impl Options {
    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// [`Error::Argument`] for a number that is not finite, or a length that is not positive.
    pub fn check(&self) -> Result<()> {
        let refuse = |name, value: f64, expected: &str| {
            Err(Error::Argument { name, why: format!("expected {expected}, got {value}") })
        };
        for (name, value) in [("factor", self.factor), ("displacement_scale", self.displacement_scale)] {
            if !value.is_finite() {
                return refuse(name, value, "a finite number");
            }
        }
        let lengths = [
            ("tolerance_mm", Some(self.tolerance_mm)),
            ("match_tolerance_mm", self.match_tolerance_mm),
            ("field_unit_mm", self.field_unit_mm),
        ];
        for (name, value) in lengths {
            if let Some(value) = value.filter(|v| !(v.is_finite() && *v > 0.0)) {
                return refuse(name, value, "a positive length in mm");
            }
        }
        Ok(())
    }
}
