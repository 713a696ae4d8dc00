//! Linear algebra: banded collocation, banded and sparse normal equations.

pub mod banded;
pub mod banded_qr;
pub mod sparse;

pub use banded::{BandedCholesky, BandedLu};
pub use banded_qr::BandedQr;
pub use sparse::{SparseCholesky, SymmetricEntries, SymmetricMatrix};
