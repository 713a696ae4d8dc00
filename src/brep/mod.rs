//! Open CASCADE's text B-rep: model, parser, writer.

/// A parsed B-rep.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Brep {}
