//! Open CASCADE's text B-rep: model, parser, writer, evaluation, topology.
//!
//! Source: the format written by `BRepTools` (versions 1, 2 and 3), which is also what FreeCAD's
//! `Shape.exportBrepToString()` gives. Indices of geometry and shapes count from 0 here and from 1
//! in the text; a location of 0 is the identity in both. Shapes come children first.

mod curve;
mod jet;
mod location;
mod model;
mod normalise;
mod parse;
mod parse_geometry;
mod scan;
mod space;
mod spline;
mod surface;
mod topology;
mod transform;
mod write;

pub use curve::{Curve, Curve2d, Curve3d};
pub use location::Location;
pub use model::{
    Brep, Continuity, Edge, EdgeRepresentation, Face, Orientation, PointRepresentation,
    PointRepresentationKind, Polygon3d, PolygonOnTriangulation, Shape, ShapeFlags, ShapeKind, ShapeRef,
    Triangulation, Vertex,
};
pub use parse::parse;
pub use space::{Frame, Space, unit};
pub use spline::{BSplineCurve, BSplineSurface, BezierCurve, BezierSurface, SplineKnots};
pub use surface::Surface;
pub use topology::{Coedge, EdgeTopology, FaceTopology, SolidTopology, Topology, VertexTopology};
