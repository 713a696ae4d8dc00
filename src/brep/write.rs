//! Writer: the text that `parse` reads, numbers in the shortest form that reads back the same.

use super::curve::Curve;
use super::location::Location;
use super::model::{
    Brep, Edge, EdgeRepresentation, Face, Orientation, PointRepresentationKind, Polygon3d,
    PolygonOnTriangulation, Shape, ShapeKind, ShapeRef, Triangulation, Vertex,
};
use super::space::{Frame, Space};
use super::spline::{BSplineCurve, BSplineSurface, BezierSurface, SplineKnots};
use super::surface::Surface;
use glam::DVec2;

impl Brep {
    /// The text of this B-rep. Every number reads back the same.
    pub fn write(&self) -> String {
        let mut writer = Writer { text: String::with_capacity(1 << 16), version: self.version };
        writer.brep(self);
        writer.text
    }
}

/// Appends tokens, each followed by a space.
struct Writer {
    text: String,
    version: u8,
}

impl Writer {
    fn word(&mut self, word: &str) {
        self.text.push_str(word);
        self.text.push(' ');
    }

    fn line(&mut self) {
        self.text.push('\n');
    }

    fn integer(&mut self, value: usize) {
        self.word(&value.to_string());
    }

    /// The number in the text of something with an index from 0.
    fn index(&mut self, index: usize) {
        self.integer(index + 1);
    }

    fn flag(&mut self, value: bool) {
        self.word(if value { "1" } else { "0" });
    }

    fn real(&mut self, value: f64) {
        let mut buffer = zmij::Buffer::new();
        let text = buffer.format(value);
        self.word(text.strip_suffix(".0").unwrap_or(text));
    }

    fn reals(&mut self, values: &[f64]) {
        values.iter().for_each(|&x| self.real(x));
    }

    fn point<P: Space>(&mut self, point: P) {
        self.reals(&point.coordinates()[..P::DIMENSION]);
    }

    fn frame<P: Space>(&mut self, frame: &Frame<P>) {
        self.point(frame.origin);
        for d in &P::frame_directions(frame)[..P::FRAME_DIRECTIONS] {
            self.point(*d);
        }
    }

    fn heading(&mut self, keyword: &str, count: usize) {
        self.word(keyword);
        self.integer(count);
        self.line();
    }

    fn brep(&mut self, brep: &Brep) {
        let owner = if brep.version >= 3 { "Open Cascade" } else { "Matra-Datavision" };
        self.text.push_str(&format!("\nCASCADE Topology V{}, (c) {owner}\n", brep.version));
        self.heading("Locations", brep.locations.len());
        brep.locations.iter().for_each(|l| self.location(l));
        self.heading("Curve2ds", brep.curves2d.len());
        brep.curves2d.iter().for_each(|c| self.curve(c));
        self.heading("Curves", brep.curves.len());
        brep.curves.iter().for_each(|c| self.curve(c));
        self.heading("Polygon3D", brep.polygons.len());
        brep.polygons.iter().for_each(|p| self.polygon(p));
        self.heading("PolygonOnTriangulations", brep.polygons_on_triangulations.len());
        brep.polygons_on_triangulations.iter().for_each(|p| self.polygon_on_triangulation(p));
        self.heading("Surfaces", brep.surfaces.len());
        brep.surfaces.iter().for_each(|s| self.surface(s));
        self.heading("Triangulations", brep.triangulations.len());
        brep.triangulations.iter().for_each(|t| self.triangulation(t));
        self.line();
        self.heading("TShapes", brep.shapes.len());
        brep.shapes.iter().for_each(|s| self.shape(brep, s));
        self.line();
        self.reference(brep, brep.root);
        self.line();
    }

    fn location(&mut self, location: &Location) {
        match location {
            Location::Elementary(rows) => {
                self.word("1");
                self.line();
                for row in rows {
                    self.reals(row);
                    self.line();
                }
            }
            Location::Composite(factors) => {
                self.word("2");
                for &(factor, power) in factors {
                    self.integer(factor);
                    self.word(&power.to_string());
                }
                self.word("0");
                self.line();
            }
        }
    }

    fn curve<P: Space>(&mut self, curve: &Curve<P>) {
        match curve {
            Curve::Line { origin, direction } => {
                self.word("1");
                self.point(*origin);
                self.point(*direction);
            }
            Curve::Circle { frame, radius } => self.conic("2", frame, &[*radius]),
            Curve::Ellipse { frame, radii } => self.conic("3", frame, radii),
            Curve::Parabola { frame, focal } => self.conic("4", frame, &[*focal]),
            Curve::Hyperbola { frame, radii } => self.conic("5", frame, radii),
            Curve::Bezier(c) => {
                self.word("6");
                self.flag(c.nurbs().weights().is_some());
                self.integer(c.nurbs().poles().len() - 1);
                self.poles(c.nurbs().poles(), c.nurbs().weights());
            }
            Curve::BSpline(c) => self.bspline_curve(c),
            Curve::Trimmed { range, basis } => {
                self.word("8");
                self.reals(range);
                self.line();
                return self.curve(basis);
            }
            Curve::Offset { offset, normal, basis } => {
                self.word("9");
                self.real(*offset);
                self.reals(&P::normal_coordinates(*normal)[..P::NORMAL_COORDINATES]);
                self.line();
                return self.curve(basis);
            }
        }
        self.line();
    }

    /// A conic or quadric: its kind, frame and figures.
    fn conic<P: Space>(&mut self, kind: &str, frame: &Frame<P>, figures: &[f64]) {
        self.word(kind);
        self.frame(frame);
        self.reals(figures);
    }

    fn poles<P: Space>(&mut self, poles: &[P], weights: Option<&[f64]>) {
        for (i, &pole) in poles.iter().enumerate() {
            self.point(pole);
            if let Some(w) = weights {
                self.real(w[i]);
            }
        }
    }

    fn knots(&mut self, knots: &SplineKnots) {
        self.line();
        for &(knot, multiplicity) in knots.knots() {
            self.real(knot);
            self.integer(multiplicity);
        }
    }

    fn bspline_curve<P: Space>(&mut self, curve: &BSplineCurve<P>) {
        let knots = curve.knots();
        self.word("7");
        self.flag(curve.weights().is_some());
        self.flag(knots.is_periodic());
        self.integer(knots.degree());
        self.integer(curve.poles().len());
        self.integer(knots.knots().len());
        self.poles(curve.poles(), curve.weights());
        self.knots(knots);
    }

    fn surface(&mut self, surface: &Surface) {
        match surface {
            Surface::Plane(frame) => self.conic("1", frame, &[]),
            Surface::Cylinder { frame, radius } => self.conic("2", frame, &[*radius]),
            Surface::Cone { frame, radius, angle } => self.conic("3", frame, &[*radius, *angle]),
            Surface::Sphere { frame, radius } => self.conic("4", frame, &[*radius]),
            Surface::Torus { frame, radii } => self.conic("5", frame, radii),
            Surface::Extrusion { direction, curve } => {
                self.word("6");
                self.point(*direction);
                self.line();
                return self.curve(curve);
            }
            Surface::Revolution { origin, axis, curve } => {
                self.word("7");
                self.point(*origin);
                self.point(*axis);
                self.line();
                return self.curve(curve);
            }
            Surface::Bezier(s) => self.bezier_surface(s),
            Surface::BSpline(s) => self.bspline_surface(s),
            Surface::Trimmed { u, v, basis } => {
                self.word("10");
                self.reals(u);
                self.reals(v);
                self.line();
                return self.surface(basis);
            }
            Surface::Offset { offset, basis } => {
                self.word("11");
                self.real(*offset);
                self.line();
                return self.surface(basis);
            }
        }
        self.line();
    }

    fn bezier_surface(&mut self, surface: &BezierSurface) {
        let nurbs = surface.nurbs();
        self.word("8");
        surface.rational().into_iter().for_each(|r| self.flag(r));
        self.integer(nurbs.knots_u().degree());
        self.integer(nurbs.knots_v().degree());
        self.poles(nurbs.poles(), nurbs.weights());
    }

    fn bspline_surface(&mut self, surface: &BSplineSurface) {
        let knots = surface.knots();
        self.word("9");
        surface.rational().into_iter().for_each(|r| self.flag(r));
        knots.iter().for_each(|k| self.flag(k.is_periodic()));
        knots.iter().for_each(|k| self.integer(k.degree()));
        surface.pole_counts().into_iter().for_each(|n| self.integer(n));
        knots.iter().for_each(|k| self.integer(k.knots().len()));
        match surface.weights() {
            None => surface.poles().for_each(|p| self.point(p)),
            Some(weights) => surface.poles().zip(weights).for_each(|(pole, weight)| {
                self.point(pole);
                self.real(weight);
            }),
        }
        knots.iter().for_each(|k| self.knots(k));
    }

    fn polygon(&mut self, polygon: &Polygon3d) {
        self.integer(polygon.nodes.len());
        self.flag(polygon.parameters.is_some());
        self.line();
        self.real(polygon.deflection);
        self.line();
        self.poles(&polygon.nodes, None);
        self.line();
        if let Some(parameters) = &polygon.parameters {
            self.reals(parameters);
            self.line();
        }
    }

    fn polygon_on_triangulation(&mut self, polygon: &PolygonOnTriangulation) {
        self.integer(polygon.nodes.len());
        polygon.nodes.iter().for_each(|&n| self.integer(n as usize));
        self.line();
        self.word("p");
        self.real(polygon.deflection);
        self.flag(polygon.parameters.is_some());
        self.reals(polygon.parameters.as_deref().unwrap_or_default());
        self.line();
    }

    fn triangulation(&mut self, triangulation: &Triangulation) {
        self.integer(triangulation.nodes.len());
        self.integer(triangulation.triangles.len());
        self.flag(triangulation.parameters.is_some());
        if self.version >= 3 {
            self.flag(triangulation.normals.is_some());
        }
        self.real(triangulation.deflection);
        self.line();
        self.poles(&triangulation.nodes, None);
        self.poles(triangulation.parameters.as_deref().unwrap_or_default(), None);
        triangulation.triangles.iter().flatten().for_each(|&n| self.integer(n as usize));
        if self.version >= 3 {
            self.poles(triangulation.normals.as_deref().unwrap_or_default(), None);
        }
        self.line();
    }

    fn shape(&mut self, brep: &Brep, shape: &Shape) {
        let name = match &shape.kind {
            ShapeKind::Vertex(_) => "Ve",
            ShapeKind::Edge(_) => "Ed",
            ShapeKind::Wire => "Wi",
            ShapeKind::Face(_) => "Fa",
            ShapeKind::Shell => "Sh",
            ShapeKind::Solid => "So",
            ShapeKind::CompSolid => "CS",
            ShapeKind::Compound => "Co",
        };
        self.text.push_str(name);
        self.line();
        match &shape.kind {
            ShapeKind::Vertex(vertex) => self.vertex(vertex),
            ShapeKind::Edge(edge) => self.edge(brep, edge),
            ShapeKind::Face(face) => self.face(face),
            _ => {}
        }
        // Open CASCADE reads a face's triangulation from a line of its own: the line may be empty,
        // but it must be there.
        self.line();
        for flag in shape.flags.to_array() {
            self.text.push(if flag { '1' } else { '0' });
        }
        self.line();
        shape.children.iter().for_each(|&child| self.reference(brep, child));
        self.text.push_str("*\n");
    }

    fn reference(&mut self, brep: &Brep, reference: ShapeRef) {
        self.text.push(match reference.orientation {
            Orientation::Forward => '+',
            Orientation::Reversed => '-',
            Orientation::Internal => 'i',
            Orientation::External => 'e',
        });
        self.integer(brep.shapes.len() - reference.shape);
        self.integer(reference.location);
    }

    fn vertex(&mut self, vertex: &Vertex) {
        self.real(vertex.tolerance);
        self.line();
        self.point(vertex.point);
        self.line();
        for representation in &vertex.representations {
            self.real(representation.parameter);
            match representation.kind {
                PointRepresentationKind::Curve { curve } => {
                    self.word("1");
                    self.index(curve);
                }
                PointRepresentationKind::Pcurve { pcurve, surface } => {
                    self.word("2");
                    self.index(pcurve);
                    self.index(surface);
                }
                PointRepresentationKind::Surface { v, surface } => {
                    self.word("3");
                    self.real(v);
                    self.index(surface);
                }
            }
            self.integer(representation.location);
            self.line();
        }
        self.text.push_str("0 0\n");
    }

    fn edge(&mut self, brep: &Brep, edge: &Edge) {
        self.real(edge.tolerance);
        self.flag(edge.same_parameter);
        self.flag(edge.same_range);
        self.flag(edge.degenerated);
        self.line();
        for representation in &edge.representations {
            self.edge_representation(brep, representation);
        }
        self.text.push_str("0\n");
    }

    fn edge_representation(&mut self, brep: &Brep, representation: &EdgeRepresentation) {
        match representation {
            EdgeRepresentation::Curve { curve, location, range } => {
                self.word("1");
                self.index(*curve);
                self.placed_range(*location, range);
            }
            EdgeRepresentation::Pcurve { pcurve, surface, location, range, ends } => {
                self.word("2");
                self.index(*pcurve);
                self.index(*surface);
                self.placed_range(*location, range);
                self.ends(brep, *pcurve, range, ends);
            }
            EdgeRepresentation::Seam { pcurves, continuity, surface, location, range, ends } => {
                self.word("3");
                pcurves.iter().for_each(|&p| self.index(p));
                self.word(continuity.name());
                self.index(*surface);
                self.placed_range(*location, range);
                self.ends(brep, pcurves[1], range, ends);
            }
            EdgeRepresentation::Regularity { continuity, surfaces, locations } => {
                self.word("4");
                self.word(continuity.name());
                for (surface, location) in surfaces.iter().zip(locations) {
                    self.index(*surface);
                    self.integer(*location);
                }
            }
            EdgeRepresentation::Polygon3d { polygon, location } => {
                self.word("5");
                self.index(*polygon);
                self.integer(*location);
            }
            EdgeRepresentation::PolygonOnTriangulation { polygon, triangulation, location } => {
                self.word("6");
                self.index(*polygon);
                self.index(*triangulation);
                self.integer(*location);
            }
            EdgeRepresentation::SeamOnTriangulation { polygons, triangulation, location } => {
                self.word("7");
                polygons.iter().for_each(|&p| self.index(p));
                self.index(*triangulation);
                self.integer(*location);
            }
        }
        self.line();
    }

    fn placed_range(&mut self, location: usize, range: &[f64; 2]) {
        self.integer(location);
        self.reals(range);
    }

    /// Format version 2 gives the ends of parameter curves.
    fn ends(&mut self, brep: &Brep, pcurve: usize, range: &[f64; 2], ends: &Option<[DVec2; 2]>) {
        if self.version == 2 {
            self.line();
            let ends = ends.unwrap_or_else(|| range.map(|t| brep.curves2d[pcurve].point(t)));
            self.poles(&ends, None);
        }
    }

    fn face(&mut self, face: &Face) {
        self.flag(face.natural_restriction);
        self.real(face.tolerance);
        self.integer(face.surface.map_or(0, |s| s + 1));
        self.integer(face.location);
        self.line();
        if let Some(triangulation) = face.triangulation {
            self.word("2");
            self.index(triangulation);
        }
    }
}
