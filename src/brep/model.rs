//! The model: tables of geometry, and shapes that refer to them.

use super::curve::{Curve2d, Curve3d};
use super::location::Location;
use super::surface::Surface;
use glam::{DVec2, DVec3};

/// A parsed B-rep.
#[derive(Debug, Clone, PartialEq)]
pub struct Brep {
    /// Format version, 1 to 3.
    pub version: u8,
    /// Placements; a reference of `n > 0` means entry `n - 1`, 0 the identity.
    pub locations: Vec<Location>,
    /// Curves in the parameter planes of surfaces.
    pub curves2d: Vec<Curve2d>,
    /// Curves in space.
    pub curves: Vec<Curve3d>,
    /// Polygons that approximate edges.
    pub polygons: Vec<Polygon3d>,
    /// Polygons of edges through nodes of triangulations.
    pub polygons_on_triangulations: Vec<PolygonOnTriangulation>,
    /// Surfaces.
    pub surfaces: Vec<Surface>,
    /// Triangulations of faces.
    pub triangulations: Vec<Triangulation>,
    /// Shapes, children before parents.
    pub shapes: Vec<Shape>,
    /// The shape that the text holds.
    pub root: ShapeRef,
}

/// How a shape is used by its parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Orientation {
    /// As it is.
    Forward,
    /// Turned round.
    Reversed,
    /// Inside its parent, both sides of it being material.
    Internal,
    /// Outside its parent's material.
    External,
}

impl Orientation {
    /// The orientation of a child of orientation `inner` in a parent of this one.
    pub fn compose(self, inner: Orientation) -> Orientation {
        match (self, inner) {
            (Orientation::Forward, o) => o,
            (Orientation::Reversed, Orientation::Forward) => Orientation::Reversed,
            (Orientation::Reversed, Orientation::Reversed) => Orientation::Forward,
            (Orientation::Reversed, o) => o,
            (o, _) => o,
        }
    }
}

/// A use of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ShapeRef {
    /// Index of the shape.
    pub shape: usize,
    /// How it is turned.
    pub orientation: Orientation,
    /// Its placement; 0 is the identity.
    pub location: usize,
}

/// A shape without orientation or placement (Open CASCADE's `TShape`).
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// What it is.
    pub kind: ShapeKind,
    /// Its flags.
    pub flags: ShapeFlags,
    /// Its parts, in order.
    pub children: Vec<ShapeRef>,
}

/// Kind of a shape with its geometry.
#[derive(Debug, Clone, PartialEq)]
pub enum ShapeKind {
    /// A point.
    Vertex(Vertex),
    /// A piece of curve between vertices.
    Edge(Edge),
    /// Connected edges.
    Wire,
    /// A piece of surface between wires.
    Face(Face),
    /// Connected faces.
    Shell,
    /// A volume between shells.
    Solid,
    /// Connected solids.
    CompSolid,
    /// Anything.
    Compound,
}

/// The flags of a shape.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "Open CASCADE's own names")]
pub struct ShapeFlags {
    pub free: bool,
    pub modified: bool,
    pub checked: bool,
    pub orientable: bool,
    pub closed: bool,
    pub infinite: bool,
    pub convex: bool,
}

impl ShapeFlags {
    /// The flags in the order of the text.
    pub fn to_array(self) -> [bool; 7] {
        [self.free, self.modified, self.checked, self.orientable, self.closed, self.infinite, self.convex]
    }
}

impl From<[bool; 7]> for ShapeFlags {
    fn from([free, modified, checked, orientable, closed, infinite, convex]: [bool; 7]) -> Self {
        Self { free, modified, checked, orientable, closed, infinite, convex }
    }
}

/// Geometry of a vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertex {
    /// Radius of the ball in which the ends of its edges lie, mm.
    pub tolerance: f64,
    /// The point.
    pub point: DVec3,
    /// The point as parameters on curves and surfaces.
    pub representations: Vec<PointRepresentation>,
}

/// A vertex's point given by parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct PointRepresentation {
    /// Parameter on the curve, or `u` on the surface.
    pub parameter: f64,
    /// On what.
    pub kind: PointRepresentationKind,
    /// Placement of the curve or surface.
    pub location: usize,
}

/// What a point's parameters refer to.
#[derive(Debug, Clone, PartialEq)]
pub enum PointRepresentationKind {
    /// A curve in space.
    Curve {
        /// Index of the curve.
        curve: usize,
    },
    /// A curve on a surface.
    Pcurve {
        /// Index of the parameter curve.
        pcurve: usize,
        /// Index of the surface.
        surface: usize,
    },
    /// A surface.
    Surface {
        /// The second parameter.
        v: f64,
        /// Index of the surface.
        surface: usize,
    },
}

/// Geometry of an edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Radius of the tube in which all its representations lie, mm.
    pub tolerance: f64,
    /// All representations agree at equal parameters, within the tolerance.
    pub same_parameter: bool,
    /// All representations have the same range.
    pub same_range: bool,
    /// The edge is a single point (a sphere's pole).
    pub degenerated: bool,
    /// Its curves, in order.
    pub representations: Vec<EdgeRepresentation>,
}

/// How smoothly two surfaces meet along an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the classes are named as everywhere")]
pub enum Continuity {
    C0,
    G1,
    C1,
    G2,
    C2,
    C3,
    CN,
}

impl Continuity {
    /// All classes with their names in the text.
    pub const NAMES: [(Continuity, &'static str); 7] = [
        (Continuity::C0, "C0"),
        (Continuity::G1, "G1"),
        (Continuity::C1, "C1"),
        (Continuity::G2, "G2"),
        (Continuity::C2, "C2"),
        (Continuity::C3, "C3"),
        (Continuity::CN, "CN"),
    ];

    /// The name in the text.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }
}

/// One representation of an edge. Locations are relative to the edge.
#[derive(Debug, Clone, PartialEq)]
pub enum EdgeRepresentation {
    /// A curve in space (1 in the text).
    Curve {
        /// Index of the curve.
        curve: usize,
        /// Its placement.
        location: usize,
        /// First and last parameter.
        range: [f64; 2],
    },
    /// A curve on a surface (2).
    Pcurve {
        /// Index of the parameter curve.
        pcurve: usize,
        /// Index of the surface.
        surface: usize,
        /// Placement of the surface.
        location: usize,
        /// First and last parameter.
        range: [f64; 2],
        /// Ends in (u, v), in format version 2.
        ends: Option<[DVec2; 2]>,
    },
    /// Two curves on a closed surface: a seam (3).
    Seam {
        /// Parameter curves of the forward and of the reversed edge.
        pcurves: [usize; 2],
        /// Continuity across the seam.
        continuity: Continuity,
        /// Index of the surface.
        surface: usize,
        /// Placement of the surface.
        location: usize,
        /// First and last parameter.
        range: [f64; 2],
        /// Ends of the second curve in (u, v), in format version 2.
        ends: Option<[DVec2; 2]>,
    },
    /// Continuity across the edge between two surfaces (4).
    Regularity {
        /// The class.
        continuity: Continuity,
        /// Indices of the surfaces.
        surfaces: [usize; 2],
        /// Placements of the surfaces.
        locations: [usize; 2],
    },
    /// A polygon in space (5).
    Polygon3d {
        /// Index of the polygon.
        polygon: usize,
        /// Its placement.
        location: usize,
    },
    /// A polygon through nodes of a triangulation (6).
    PolygonOnTriangulation {
        /// Index of the polygon.
        polygon: usize,
        /// Index of the triangulation.
        triangulation: usize,
        /// Placement of the triangulation.
        location: usize,
    },
    /// Two polygons through nodes of a closed triangulation (7).
    SeamOnTriangulation {
        /// Polygons of the forward and of the reversed edge.
        polygons: [usize; 2],
        /// Index of the triangulation.
        triangulation: usize,
        /// Placement of the triangulation.
        location: usize,
    },
}

/// Geometry of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Tolerance of the surface, mm.
    pub tolerance: f64,
    /// The face covers the whole surface.
    pub natural_restriction: bool,
    /// Index of the surface; none for a face that is only a triangulation.
    pub surface: Option<usize>,
    /// Placement of the surface, relative to the face.
    pub location: usize,
    /// Index of the triangulation.
    pub triangulation: Option<usize>,
}

/// A polygon in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon3d {
    /// Largest distance from the curve, mm.
    pub deflection: f64,
    /// The corners.
    pub nodes: Vec<DVec3>,
    /// Their parameters on the curve.
    pub parameters: Option<Vec<f64>>,
}

/// A polygon through nodes of a triangulation.
#[derive(Debug, Clone, PartialEq)]
pub struct PolygonOnTriangulation {
    /// Largest distance from the curve, mm.
    pub deflection: f64,
    /// Numbers of the nodes, from 1.
    pub nodes: Vec<u32>,
    /// Their parameters on the curve.
    pub parameters: Option<Vec<f64>>,
}

/// A triangulation of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulation {
    /// Largest distance from the surface, mm.
    pub deflection: f64,
    /// The nodes.
    pub nodes: Vec<DVec3>,
    /// Their surface parameters.
    pub parameters: Option<Vec<DVec2>>,
    /// Numbers of the nodes of each triangle, from 1.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals at the nodes, in format version 3.
    pub normals: Option<Vec<DVec3>>,
}
