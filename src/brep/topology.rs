//! Faces, edges and vertices of a B-rep, each once, and how they hang together.
//!
//! The order is that of Open CASCADE's `TopExp::MapShapes`, which is FreeCAD's `shape.Faces`,
//! `shape.Edges` and `shape.Vertexes`: a shape counts where a walk over the parts, parents first,
//! meets it first, and keeps the orientation it has there.

use super::model::{Brep, Edge, EdgeRepresentation, Orientation, ShapeKind, ShapeRef};
use crate::error::{Error, Result};
use glam::DVec3;

/// Solids, faces, edges and vertices.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Topology {
    /// The solids.
    pub solids: Vec<SolidTopology>,
    /// The faces.
    pub faces: Vec<FaceTopology>,
    /// The edges.
    pub edges: Vec<EdgeTopology>,
    /// The vertices.
    pub vertices: Vec<VertexTopology>,
}

/// A solid.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidTopology {
    /// Its index among the B-rep's shapes.
    pub shape: usize,
    /// Its faces, as indices into the topology's.
    pub faces: Vec<usize>,
}

/// A face.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceTopology {
    /// Its index among the B-rep's shapes.
    pub shape: usize,
    /// Whether the outward normal is opposite to the surface's.
    pub reversed: bool,
    /// Index of the surface.
    pub surface: usize,
    /// The edges of each wire, in the order stored (as a rule the order in which they connect).
    pub wires: Vec<Vec<Coedge>>,
    /// Tolerance, mm.
    pub tolerance: f64,
}

/// A use of an edge by a wire of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct Coedge {
    /// The edge, as index into the topology's.
    pub edge: usize,
    /// Whether the wire runs against the edge; the face is taken as forward.
    pub reversed: bool,
    /// Index of the curve in the surface's parameters; none on planes that store none.
    pub pcurve: Option<usize>,
    /// First and last parameter of that curve, or of the edge where there is none.
    pub range: [f64; 2],
}

/// An edge.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeTopology {
    /// Its index among the B-rep's shapes.
    pub shape: usize,
    /// Index of its curve in space; none for degenerated edges.
    pub curve: Option<usize>,
    /// First and last parameter.
    pub range: [f64; 2],
    /// Whether it is a single point.
    pub degenerated: bool,
    /// Vertices at the first and last parameter, as indices into the topology's.
    pub vertices: [Option<usize>; 2],
    /// Where it is used: face, wire of the face, place in the wire.
    pub coedges: Vec<(usize, usize, usize)>,
    /// Tolerance, mm.
    pub tolerance: f64,
}

/// A vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexTopology {
    /// Its index among the B-rep's shapes.
    pub shape: usize,
    /// The point.
    pub point: DVec3,
    /// Tolerance, mm.
    pub tolerance: f64,
}

impl Topology {
    /// The topology of a B-rep without locations (see [`Brep::normalise`]).
    ///
    /// # Errors
    /// [`Error::Solid`] when a location is used, a wire holds something other than edges, or an
    /// edge has no curve at all; [`Error::Face`] when a face has no surface.
    pub fn new(brep: &Brep) -> Result<Self> {
        let mut builder = Builder {
            brep,
            places: vec![None; brep.shapes.len()],
            topology: Topology::default(),
            faces: Vec::new(),
        };
        builder.walk(brep.root, Orientation::Forward)?;
        let faces = std::mem::take(&mut builder.faces);
        for (face, (shape, reversed)) in faces.into_iter().enumerate() {
            builder.face(face, shape, reversed)?;
        }
        builder.solids()?;
        Ok(builder.topology)
    }
}

struct Builder<'a> {
    brep: &'a Brep,
    /// Each visited shape's index among those of its kind in the topology.
    places: Vec<Option<usize>>,
    topology: Topology,
    /// Shape and orientation of each face.
    faces: Vec<(usize, bool)>,
}

fn refuse<T>(why: impl Into<String>) -> Result<T> {
    Err(Error::Solid { why: why.into() })
}

impl Builder<'_> {
    /// Visits a shape and its parts, parents first, each shape once.
    fn walk(&mut self, reference: ShapeRef, outer: Orientation) -> Result<()> {
        if reference.location != 0 {
            return refuse("the shape is placed by locations: normalise it first");
        }
        if self.places[reference.shape].is_some() {
            return Ok(());
        }
        let orientation = outer.compose(reference.orientation);
        let shape = &self.brep.shapes[reference.shape];
        self.places[reference.shape] = Some(match &shape.kind {
            ShapeKind::Vertex(vertex) => {
                let (point, tolerance) = (vertex.point, vertex.tolerance);
                self.topology.vertices.push(VertexTopology { shape: reference.shape, point, tolerance });
                self.topology.vertices.len() - 1
            }
            ShapeKind::Edge(edge) => {
                self.topology.edges.push(edge_topology(reference.shape, edge)?);
                self.topology.edges.len() - 1
            }
            ShapeKind::Face(_) => {
                self.faces.push((reference.shape, orientation == Orientation::Reversed));
                self.faces.len() - 1
            }
            ShapeKind::Solid => {
                self.topology.solids.push(SolidTopology { shape: reference.shape, faces: Vec::new() });
                self.topology.solids.len() - 1
            }
            _ => 0,
        });
        for &child in &shape.children {
            self.walk(child, orientation)?;
        }
        if let (ShapeKind::Edge(_), Some(edge)) = (&shape.kind, self.places[reference.shape]) {
            self.edge_vertices(edge, &shape.children);
        }
        Ok(())
    }

    fn edge_vertices(&mut self, edge: usize, children: &[ShapeRef]) {
        let at = |orientation| {
            let child = children.iter().find(|c| c.orientation == orientation)?;
            self.places[child.shape]
        };
        self.topology.edges[edge].vertices = [at(Orientation::Forward), at(Orientation::Reversed)];
    }

    fn face(&mut self, index: usize, shape: usize, reversed: bool) -> Result<()> {
        let ShapeKind::Face(face) = &self.brep.shapes[shape].kind else {
            return Err(Error::Internal { why: format!("shape {shape} is no face") });
        };
        let Some(surface) = face.surface else {
            let why = "it has no surface, only triangles: give a solid of exact geometry".into();
            return Err(Error::Face { face: index + 1, why });
        };
        if face.location != 0 {
            return refuse("a surface is placed by a location: normalise the shape first");
        }
        let mut wires = Vec::new();
        for &wire in &self.brep.shapes[shape].children {
            if self.brep.shapes[wire.shape].kind == ShapeKind::Wire {
                let coedges = self.wire(wire, surface)?;
                for (position, coedge) in coedges.iter().enumerate() {
                    self.topology.edges[coedge.edge].coedges.push((index, wires.len(), position));
                }
                wires.push(coedges);
            }
        }
        let tolerance = face.tolerance;
        self.topology.faces.push(FaceTopology { shape, reversed, surface, wires, tolerance });
        Ok(())
    }

    fn wire(&self, wire: ShapeRef, surface: usize) -> Result<Vec<Coedge>> {
        let mut coedges = Vec::new();
        for child in &self.brep.shapes[wire.shape].children {
            let (ShapeKind::Edge(edge), Some(place)) =
                (&self.brep.shapes[child.shape].kind, self.places[child.shape])
            else {
                return refuse("a wire holds something other than edges");
            };
            let reversed = wire.orientation.compose(child.orientation) == Orientation::Reversed;
            let (pcurve, range) = match edge.pcurve(surface, reversed) {
                Some((pcurve, range)) => (Some(pcurve), range),
                None => (None, self.topology.edges[place].range),
            };
            coedges.push(Coedge { edge: place, reversed, pcurve, range });
        }
        Ok(coedges)
    }

    /// Collects the faces of each solid.
    fn solids(&mut self) -> Result<()> {
        for i in 0..self.topology.solids.len() {
            let mut faces = Vec::new();
            let mut seen = vec![false; self.brep.shapes.len()];
            let mut stack = vec![self.topology.solids[i].shape];
            while let Some(shape) = stack.pop() {
                if std::mem::replace(&mut seen[shape], true) {
                    continue;
                }
                match (&self.brep.shapes[shape].kind, self.places[shape]) {
                    (ShapeKind::Face(_), Some(face)) => faces.push(face),
                    _ => stack.extend(self.brep.shapes[shape].children.iter().rev().map(|c| c.shape)),
                }
            }
            self.topology.solids[i].faces = faces;
        }
        Ok(())
    }
}

fn edge_topology(shape: usize, edge: &Edge) -> Result<EdgeTopology> {
    if edge.representations.iter().any(|r| r.is_placed()) {
        return refuse("an edge is placed by a location: normalise the shape first");
    }
    let curve = edge.curve();
    let Some(range) = curve.map(|c| c.1).or_else(|| edge.first_range()) else {
        return refuse("an edge has no curve, neither in space nor on a surface");
    };
    Ok(EdgeTopology {
        shape,
        curve: curve.map(|c| c.0),
        range,
        degenerated: edge.degenerated,
        vertices: [None; 2],
        coedges: Vec::new(),
        tolerance: edge.tolerance,
    })
}

impl Edge {
    /// The curve in space with its range.
    pub fn curve(&self) -> Option<(usize, [f64; 2])> {
        self.representations.iter().find_map(|r| match r {
            EdgeRepresentation::Curve { curve, range, .. } => Some((*curve, *range)),
            _ => None,
        })
    }

    /// The curve on an unplaced surface with its range; `reversed` picks the side of a seam.
    pub fn pcurve(&self, on: usize, reversed: bool) -> Option<(usize, [f64; 2])> {
        self.representations.iter().find_map(|r| match r {
            EdgeRepresentation::Pcurve { pcurve, surface, range, .. } if *surface == on => {
                Some((*pcurve, *range))
            }
            EdgeRepresentation::Seam { pcurves, surface, range, .. } if *surface == on => {
                Some((pcurves[usize::from(reversed)], *range))
            }
            _ => None,
        })
    }

    /// The range of the first curve on a surface.
    fn first_range(&self) -> Option<[f64; 2]> {
        self.representations.iter().find_map(|r| match r {
            EdgeRepresentation::Pcurve { range, .. } | EdgeRepresentation::Seam { range, .. } => Some(*range),
            _ => None,
        })
    }
}

impl EdgeRepresentation {
    /// Whether a location other than the identity is used.
    fn is_placed(&self) -> bool {
        match self {
            EdgeRepresentation::Curve { location, .. }
            | EdgeRepresentation::Pcurve { location, .. }
            | EdgeRepresentation::Seam { location, .. }
            | EdgeRepresentation::Polygon3d { location, .. }
            | EdgeRepresentation::PolygonOnTriangulation { location, .. }
            | EdgeRepresentation::SeamOnTriangulation { location, .. } => *location != 0,
            EdgeRepresentation::Regularity { locations, .. } => *locations != [0; 2],
        }
    }
}
