//! The only error type. Each variant carries what a user needs to act on, and maps to one number
//! of the C ABI (append-only: 1-19 the caller of the ABI, 100s the input, 200s numerics, 300s
//! design rules, 900 ours).

use std::fmt;

/// Shorthand for results of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// Everything that can go wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// An argument of an API call cannot be used.
    Argument {
        /// The argument's name.
        name: &'static str,
        /// What was expected, and what came.
        why: String,
    },
    /// The caller's progress callback asked to stop.
    Cancelled,
    /// A file could not be opened, read or written.
    Io {
        /// The file.
        path: String,
        /// The operating system's reason.
        why: String,
    },
    /// The text of a B-rep is malformed or uses something unknown.
    Brep {
        /// The name the caller gave to the text.
        name: String,
        /// Line, from 1.
        line: usize,
        /// What was expected there, and what stood there.
        why: String,
    },
    /// A solid that cannot be worked on (no solid, an open shell, an unusable face).
    Solid {
        /// What is wrong and what to do.
        why: String,
    },
    /// A face that cannot be worked on.
    Face {
        /// Number of the face, from 1.
        face: usize,
        /// What is wrong and what to do.
        why: String,
    },
    /// A field or mesh file that cannot be used.
    Field {
        /// The file.
        path: String,
        /// Line, from 1; 0 where no single line is at fault.
        line: usize,
        /// What is wrong and what to do.
        why: String,
    },
    /// Field and solid do not belong together (position, unit, coverage).
    Mismatch {
        /// What is wrong, with figures, and which option to give.
        why: String,
    },
    /// Knots, degree, poles or weights do not make a spline.
    Spline {
        /// What is wrong, with figures.
        why: String,
    },
    /// A numerical method failed.
    Numerics {
        /// Which, with residuals.
        why: String,
    },
    /// Ours: a broken invariant or a caught panic.
    Internal {
        /// What happened.
        why: String,
    },
}

/// A number of things, for messages: `1 face`, `2 faces`.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

impl Error {
    /// A file that cannot be opened or read, with the system's reason.
    pub(crate) fn io(path: &str, cause: &std::io::Error) -> Self {
        let mut why = cause.to_string();
        // Rust adds the number, which says no more than the words.
        if let Some(number) = why.find(" (os error") {
            why.truncate(number);
        }
        Error::Io { path: path.into(), why: why + "; give an existing, readable file" }
    }

    /// The status number of the C ABI.
    pub fn code(&self) -> i32 {
        match self {
            Error::Argument { .. } => 1,
            Error::Cancelled => 10,
            Error::Io { .. } => 100,
            Error::Brep { .. } => 110,
            Error::Solid { .. } => 120,
            Error::Face { .. } => 121,
            Error::Spline { .. } => 130,
            Error::Field { .. } => 150,
            Error::Mismatch { .. } => 160,
            Error::Numerics { .. } => 200,
            Error::Internal { .. } => 900,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Argument { name, why } => write!(f, "argument '{name}': {why}"),
            Error::Cancelled => write!(f, "cancelled"),
            Error::Io { path, why } => write!(f, "{path}: {why}"),
            Error::Brep { name, line, why } => write!(f, "{name}, line {line}: {why}"),
            Error::Solid { why } => write!(f, "{why}"),
            Error::Face { face, why } => write!(f, "face {face}: {why}"),
            Error::Field { path, line: 0, why } => write!(f, "{path}: {why}"),
            Error::Field { path, line, why } => write!(f, "{path}, line {line}: {why}"),
            Error::Mismatch { why } => write!(f, "{why}"),
            Error::Spline { why } => write!(f, "{why}"),
            Error::Numerics { why } => write!(f, "{why}"),
            Error::Internal { why } => write!(f, "internal error: {why}"),
        }
    }
}

impl std::error::Error for Error {}
