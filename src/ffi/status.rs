//! Status numbers by name, as C sees them.

use crate::error::Error;

/// What a call returns. Numbers are only ever added: 1-19 the caller of this interface, 100-199
/// unusable input, 200-299 numerics, 900 a fault of Bladesmith. The text to a status other than
/// BLADESMITH_STATUS_OK is given by bladesmith_last_error().
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// Success.
    Ok = 0,
    /// An argument cannot be used: NULL, misaligned, not finite, out of range.
    Argument = 1,
    /// A buffer is too small; the length needed has been set.
    BufferTooSmall = 2,
    /// The progress callback asked to stop.
    Cancelled = 10,
    /// A file could not be opened, read or written.
    Io = 100,
    /// The text of a B-rep is malformed or uses something unknown.
    Brep = 110,
    /// A solid that cannot be worked on.
    Solid = 120,
    /// A face that cannot be worked on.
    Face = 121,
    /// Knots, degree, poles or weights do not make a spline.
    Spline = 130,
    /// A field or mesh file that cannot be used.
    Field = 150,
    /// Field and solid do not belong together: position, unit, coverage.
    Mismatch = 160,
    /// A numerical method failed.
    Numerics = 200,
    /// A fault of Bladesmith; please report it with the text.
    Internal = 900,
}

/// Why a call failed.
#[derive(Debug)]
pub(super) enum Failure {
    /// An error of the core.
    Core(Error),
    /// An output does not fit.
    TooSmall {
        /// What was offered.
        capacity: usize,
        /// What it takes.
        needed: usize,
        /// Of what.
        unit: &'static str,
    },
}

/// What the inside of an exported function returns.
pub(super) type Outcome = Result<(), Failure>;

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Core(error)
    }
}

impl Failure {
    /// Status number and message.
    pub(super) fn describe(&self) -> (i32, String) {
        match self {
            Failure::Core(error) => (error.code(), error.to_string()),
            Failure::TooSmall { capacity, needed, unit } => (
                Status::BufferTooSmall as i32,
                format!("the buffer holds {capacity} {unit}, {needed} are needed: enlarge it and call again"),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The compiler asks for a line here whenever a variant is added.
    fn named(error: &Error) -> Status {
        match error {
            Error::Argument { .. } => Status::Argument,
            Error::Cancelled => Status::Cancelled,
            Error::Io { .. } => Status::Io,
            Error::Brep { .. } => Status::Brep,
            Error::Solid { .. } => Status::Solid,
            Error::Face { .. } => Status::Face,
            Error::Field { .. } => Status::Field,
            Error::Mismatch { .. } => Status::Mismatch,
            Error::Spline { .. } => Status::Spline,
            Error::Numerics { .. } => Status::Numerics,
            Error::Internal { .. } => Status::Internal,
        }
    }

    #[test]
    fn every_error_has_the_number_of_its_name() {
        let why = String::new();
        let errors = [
            Error::Argument { name: "", why: why.clone() },
            Error::Cancelled,
            Error::Io { path: why.clone(), why: why.clone() },
            Error::Brep { name: why.clone(), line: 1, why: why.clone() },
            Error::Solid { why: why.clone() },
            Error::Face { face: 1, why: why.clone() },
            Error::Field { path: why.clone(), line: 1, why: why.clone() },
            Error::Mismatch { why: why.clone() },
            Error::Spline { why: why.clone() },
            Error::Numerics { why: why.clone() },
            Error::Internal { why },
        ];
        for error in errors {
            assert_eq!(error.code(), named(&error) as i32, "{error:?}");
        }
    }
}
