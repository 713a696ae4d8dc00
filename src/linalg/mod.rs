//! Linear algebra: banded collocation, banded and sparse normal equations.

pub mod banded;
pub mod sparse;

pub use banded::{BandedCholesky, BandedLu};
pub use sparse::{SparseCholesky, SymmetricEntries, SymmetricMatrix};
