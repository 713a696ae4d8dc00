//! Placements of shapes and geometry.

/// An entry of the table of locations.
#[derive(Debug, Clone, PartialEq)]
pub enum Location {
    /// Rows of a 3×4 matrix: linear part, then translation in mm.
    Elementary([[f64; 4]; 3]),
    /// A product of powers of other entries (numbered from 1); the first acts first.
    Composite(Vec<(usize, i32)>),
}
