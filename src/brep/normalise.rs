//! B-reps without locations, triangulations and polygons, of a whole shape or of one solid.

use super::location::Placements;
use super::model::{
    Brep, Edge, EdgeRepresentation, Face, Orientation, PointRepresentation, PointRepresentationKind, Shape,
    ShapeKind, ShapeRef, Vertex,
};
use crate::error::{Error, Result};
use std::collections::HashMap;

/// Nested copies may multiply to more shapes than memory holds.
const MAX_SHAPES: usize = 10_000_000;

impl Brep {
    /// Bakes all locations into the geometry and drops triangulations and polygons. A shape used
    /// at several places becomes several shapes; order and orientation of all parts stay.
    ///
    /// # Errors
    /// [`Error::Solid`] when a location scales or shears, a face has no surface, or copies of
    /// copies come to over ten million shapes; then nothing is changed.
    pub fn normalise(&mut self) -> Result<()> {
        *self = baked(self, self.root)?;
        Ok(())
    }

    /// A normalised B-rep of only the `n`-th solid, counted from 1 in the order of
    /// [`super::Topology`].
    ///
    /// # Errors
    /// [`Error::Solid`] when there is no such solid, else as [`Brep::normalise`].
    pub fn solid(&self, n: usize) -> Result<Brep> {
        let whole = baked(self, self.root)?;
        let solids = solids(&whole);
        match n.checked_sub(1).and_then(|i| solids.get(i)) {
            Some(&solid) => baked(&whole, solid),
            None => {
                let why = format!("there is no solid {n}: the shape holds {}", solids.len());
                Err(Error::Solid { why })
            }
        }
    }
}

/// The distinct solids of a normalised B-rep.
fn solids(brep: &Brep) -> Vec<ShapeRef> {
    let mut seen = vec![false; brep.shapes.len()];
    let mut solids = Vec::new();
    let mut stack = vec![(brep.root, Orientation::Forward)];
    while let Some((reference, outer)) = stack.pop() {
        if std::mem::replace(&mut seen[reference.shape], true) {
            continue;
        }
        let orientation = outer.compose(reference.orientation);
        let shape = &brep.shapes[reference.shape];
        if shape.kind == ShapeKind::Solid {
            solids.push(ShapeRef { orientation, ..reference });
        }
        stack.extend(shape.children.iter().rev().map(|&child| (child, orientation)));
    }
    solids
}

/// A copy of what `root` reaches, without locations.
fn baked(brep: &Brep, root: ShapeRef) -> Result<Brep> {
    let empty = Brep {
        version: brep.version,
        locations: Vec::new(),
        curves2d: Vec::new(),
        curves: Vec::new(),
        polygons: Vec::new(),
        polygons_on_triangulations: Vec::new(),
        surfaces: Vec::new(),
        triangulations: Vec::new(),
        shapes: Vec::new(),
        root: ShapeRef { location: 0, ..root },
    };
    let mut baker = Baker {
        source: brep,
        placements: Placements::new(&brep.locations)?,
        target: empty,
        shapes: HashMap::new(),
        curves: HashMap::new(),
        surfaces: HashMap::new(),
        curves2d: HashMap::new(),
    };
    baker.target.root = baker.reference(root, 0)?;
    Ok(baker.target)
}

/// Copies shapes and geometry; keys are an index in the source and a placement.
struct Baker<'a> {
    source: &'a Brep,
    placements: Placements<'a>,
    target: Brep,
    shapes: HashMap<(usize, usize), usize>,
    curves: HashMap<(usize, usize), usize>,
    surfaces: HashMap<(usize, usize), usize>,
    curves2d: HashMap<usize, usize>,
}

impl Baker<'_> {
    fn reference(&mut self, reference: ShapeRef, outer: usize) -> Result<ShapeRef> {
        let placement = self.placements.compose(outer, reference.location)?;
        let shape = match self.shapes.get(&(reference.shape, placement)) {
            Some(&shape) => shape,
            None => self.shape(reference.shape, placement)?,
        };
        Ok(ShapeRef { shape, orientation: reference.orientation, location: 0 })
    }

    fn shape(&mut self, index: usize, placement: usize) -> Result<usize> {
        let source = self.source;
        let shape = &source.shapes[index];
        let children = shape.children.iter().map(|&c| self.reference(c, placement));
        let children = children.collect::<Result<Vec<ShapeRef>>>()?;
        let kind = match &shape.kind {
            ShapeKind::Vertex(vertex) => ShapeKind::Vertex(self.vertex(vertex, placement)?),
            ShapeKind::Edge(edge) => ShapeKind::Edge(self.edge(edge, placement)?),
            ShapeKind::Face(face) => ShapeKind::Face(self.face(face, placement)?),
            kind => kind.clone(),
        };
        if self.target.shapes.len() >= MAX_SHAPES {
            return Err(Error::Solid { why: format!("copies of copies come to over {MAX_SHAPES} shapes") });
        }
        self.target.shapes.push(Shape { kind, flags: shape.flags, children });
        let copy = self.target.shapes.len() - 1;
        self.shapes.insert((index, placement), copy);
        Ok(copy)
    }

    fn surface(&mut self, index: usize, location: usize, outer: usize) -> Result<usize> {
        let placement = self.placements.compose(outer, location)?;
        let motion = self.placements.motion(placement);
        let moved = || match motion {
            Some(motion) => self.source.surfaces[index].moved(motion),
            None => Ok(self.source.surfaces[index].clone()),
        };
        copy(&mut self.target.surfaces, &mut self.surfaces, (index, placement), moved)
    }

    fn curve(&mut self, index: usize, location: usize, outer: usize) -> Result<usize> {
        let placement = self.placements.compose(outer, location)?;
        let motion = self.placements.motion(placement);
        let moved = || match motion {
            Some(motion) => self.source.curves[index].moved(motion),
            None => Ok(self.source.curves[index].clone()),
        };
        copy(&mut self.target.curves, &mut self.curves, (index, placement), moved)
    }

    fn pcurve(&mut self, index: usize) -> usize {
        let (source, target) = (self.source, &mut self.target.curves2d);
        *self.curves2d.entry(index).or_insert_with(|| {
            target.push(source.curves2d[index].clone());
            target.len() - 1
        })
    }

    fn vertex(&mut self, vertex: &Vertex, placement: usize) -> Result<Vertex> {
        let mut representations = Vec::with_capacity(vertex.representations.len());
        for r in &vertex.representations {
            let kind = match r.kind {
                PointRepresentationKind::Curve { curve } => {
                    PointRepresentationKind::Curve { curve: self.curve(curve, r.location, placement)? }
                }
                PointRepresentationKind::Pcurve { pcurve, surface } => PointRepresentationKind::Pcurve {
                    pcurve: self.pcurve(pcurve),
                    surface: self.surface(surface, r.location, placement)?,
                },
                PointRepresentationKind::Surface { v, surface } => PointRepresentationKind::Surface {
                    v,
                    surface: self.surface(surface, r.location, placement)?,
                },
            };
            representations.push(PointRepresentation { parameter: r.parameter, kind, location: 0 });
        }
        let motion = self.placements.motion(placement);
        let point = motion.map_or(vertex.point, |m| m.point(vertex.point));
        Ok(Vertex { tolerance: vertex.tolerance, point, representations })
    }

    fn edge(&mut self, edge: &Edge, placement: usize) -> Result<Edge> {
        let mut representations = Vec::with_capacity(edge.representations.len());
        for representation in &edge.representations {
            representations.extend(self.edge_representation(representation, placement)?);
        }
        Ok(Edge { representations, ..*edge })
    }

    /// The representation without its location; none for polygons.
    fn edge_representation(
        &mut self,
        representation: &EdgeRepresentation,
        placement: usize,
    ) -> Result<Option<EdgeRepresentation>> {
        Ok(Some(match *representation {
            EdgeRepresentation::Curve { curve, location, range } => EdgeRepresentation::Curve {
                curve: self.curve(curve, location, placement)?,
                location: 0,
                range,
            },
            EdgeRepresentation::Pcurve { pcurve, surface, location, range, ends } => {
                EdgeRepresentation::Pcurve {
                    pcurve: self.pcurve(pcurve),
                    surface: self.surface(surface, location, placement)?,
                    location: 0,
                    range,
                    ends,
                }
            }
            EdgeRepresentation::Seam { pcurves, continuity, surface, location, range, ends } => {
                EdgeRepresentation::Seam {
                    pcurves: pcurves.map(|p| self.pcurve(p)),
                    continuity,
                    surface: self.surface(surface, location, placement)?,
                    location: 0,
                    range,
                    ends,
                }
            }
            EdgeRepresentation::Regularity { continuity, surfaces: [s, s2], locations: [l, l2] } => {
                let surfaces = [self.surface(s, l, placement)?, self.surface(s2, l2, placement)?];
                EdgeRepresentation::Regularity { continuity, surfaces, locations: [0; 2] }
            }
            EdgeRepresentation::Polygon3d { .. }
            | EdgeRepresentation::PolygonOnTriangulation { .. }
            | EdgeRepresentation::SeamOnTriangulation { .. } => return Ok(None),
        }))
    }

    fn face(&mut self, face: &Face, placement: usize) -> Result<Face> {
        let Some(surface) = face.surface else {
            let why = "a face has no surface, only triangles: give a solid of exact geometry".into();
            return Err(Error::Solid { why });
        };
        let surface = Some(self.surface(surface, face.location, placement)?);
        Ok(Face { surface, location: 0, triangulation: None, ..*face })
    }
}

/// The index of the copy with this key, made where there is none yet.
fn copy<T>(
    table: &mut Vec<T>,
    copies: &mut HashMap<(usize, usize), usize>,
    key: (usize, usize),
    make: impl FnOnce() -> Result<T>,
) -> Result<usize> {
    if let Some(&copy) = copies.get(&key) {
        return Ok(copy);
    }
    table.push(make()?);
    copies.insert(key, table.len() - 1);
    Ok(table.len() - 1)
}
