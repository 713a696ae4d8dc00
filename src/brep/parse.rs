//! Parser: tables of geometry, then shapes, then the reference to the root.

use super::location::Location;
use super::model::{
    Brep, Continuity, Edge, EdgeRepresentation, Face, Orientation, PointRepresentation,
    PointRepresentationKind, Polygon3d, PolygonOnTriangulation, Shape, ShapeFlags, ShapeKind, ShapeRef,
    Triangulation, Vertex,
};
use super::parse_geometry::{curve, surface};
use super::scan::Scanner;
use crate::error::Result;
use glam::{DVec2, DVec3};

/// Shapes nested deeper than this are refused, so that walks over them cannot exhaust the stack.
const MAX_DEPTH: usize = 500;

/// The header of a text, before the version's number.
const HEADER: &str = "CASCADE Topology V";

/// Parses Open CASCADE's text B-rep; `name` is what errors call it (a file name, as a rule).
///
/// # Errors
/// [`crate::Error::Brep`] with the line where the text is malformed, refers to something that
/// does not exist, or holds a value that geometry cannot have.
pub fn parse(name: &str, text: &str) -> Result<Brep> {
    let mut scanner = Scanner::new(name, text);
    let version = version(&mut scanner, text)?;
    let mut brep = Brep {
        version,
        locations: locations(&mut scanner)?,
        curves2d: table(&mut scanner, "Curve2ds", 3, |s| curve(s, 0))?,
        curves: table(&mut scanner, "Curves", 5, |s| curve(s, 0))?,
        polygons: table(&mut scanner, "Polygon3D", 3, polygon)?,
        polygons_on_triangulations: table(
            &mut scanner,
            "PolygonOnTriangulations",
            4,
            polygon_on_triangulation,
        )?,
        surfaces: table(&mut scanner, "Surfaces", 5, |s| surface(s, 0))?,
        triangulations: table(&mut scanner, "Triangulations", 4, |s| triangulation(s, version))?,
        shapes: Vec::new(),
        root: ShapeRef { shape: 0, orientation: Orientation::Forward, location: 0 },
    };
    scanner.keyword("TShapes")?;
    let count = scanner.count("shapes", 3)?;
    let mut shapes = ShapeParser { brep: &mut brep, depths: Vec::with_capacity(count), count };
    for _ in 0..count {
        shapes.shape(&mut scanner)?;
    }
    match shapes.reference(&mut scanner)? {
        Some(root) => brep.root = root,
        None => return scanner.fail("the text holds no shape: '*' stands where its root is expected"),
    }
    Ok(brep)
}

fn version(scanner: &mut Scanner, text: &str) -> Result<u8> {
    let starts_line = |at: usize| at == 0 || text.as_bytes()[at - 1] == b'\n';
    let Some(at) = memchr::memmem::find(text.as_bytes(), HEADER.as_bytes()).filter(|&at| starts_line(at))
    else {
        return scanner.fail(format!("no text B-rep of Open CASCADE: no line starts with '{HEADER}'"));
    };
    scanner.jump(at + HEADER.len());
    let version = scanner.integer_in("the format version", 1..=3)? as u8;
    let rest = &text.as_bytes()[at..];
    let line = memchr::memchr(b'\n', rest).unwrap_or(rest.len());
    scanner.jump(at + line);
    Ok(version)
}

/// A table of entries that take at least `width` tokens each.
fn table<T>(
    scanner: &mut Scanner,
    keyword: &str,
    width: usize,
    mut entry: impl FnMut(&mut Scanner) -> Result<T>,
) -> Result<Vec<T>> {
    scanner.keyword(keyword)?;
    let count = scanner.count(keyword, width)?;
    let mut entries = Vec::with_capacity(count);
    for _ in 0..count {
        entries.push(entry(scanner)?);
    }
    Ok(entries)
}

fn locations(scanner: &mut Scanner) -> Result<Vec<Location>> {
    let mut index = 0;
    table(scanner, "Locations", 4, |s| {
        let location = match s.integer_in("a kind of location", 1..=2)? {
            1 => Location::Elementary([s.reals("a matrix")?, s.reals("a matrix")?, s.reals("a matrix")?]),
            _ => Location::Composite(powers(s, index)?),
        };
        index += 1;
        Ok(location)
    })
}

/// Factors of a composite location, which refer to those before it.
fn powers(scanner: &mut Scanner, before: usize) -> Result<Vec<(usize, i32)>> {
    let mut factors = Vec::new();
    loop {
        let factor = scanner.integer_in("a location", 0..=before as i64)?;
        if factor == 0 {
            return Ok(factors);
        }
        let at = scanner.mark();
        match i32::try_from(scanner.integer("a power")?) {
            Ok(power) => factors.push((factor, power)),
            Err(_) => return scanner.fail_at(at, "the power of a location is out of range"),
        }
    }
}

/// A list whose length stood earlier in the text.
fn list<T>(n: usize, scanner: &mut Scanner, entry: impl Fn(&mut Scanner) -> Result<T>) -> Result<Vec<T>> {
    (0..n).map(|_| entry(scanner)).collect()
}

fn point(scanner: &mut Scanner) -> Result<DVec3> {
    Ok(DVec3::from_array(scanner.reals("a coordinate")?))
}

fn point2d(scanner: &mut Scanner) -> Result<DVec2> {
    Ok(DVec2::from_array(scanner.reals("a parameter")?))
}

fn parameter(scanner: &mut Scanner) -> Result<f64> {
    scanner.real("a parameter")
}

fn node(scanner: &mut Scanner) -> Result<u32> {
    Ok(scanner.integer_in("a node", 1..=i64::from(i32::MAX))? as u32)
}

fn polygon(scanner: &mut Scanner) -> Result<Polygon3d> {
    let n = scanner.count("nodes", 3)?;
    let with_parameters = scanner.flag("parameters")?;
    let deflection = scanner.real("a deflection")?;
    let nodes = list(n, scanner, point)?;
    let parameters = if with_parameters { Some(list(n, scanner, parameter)?) } else { None };
    Ok(Polygon3d { deflection, nodes, parameters })
}

fn polygon_on_triangulation(scanner: &mut Scanner) -> Result<PolygonOnTriangulation> {
    let n = scanner.count("nodes", 1)?;
    let nodes = list(n, scanner, node)?;
    scanner.keyword("p")?;
    let deflection = scanner.real("a deflection")?;
    let with_parameters = scanner.flag("parameters")?;
    let parameters = if with_parameters { Some(list(n, scanner, parameter)?) } else { None };
    Ok(PolygonOnTriangulation { deflection, nodes, parameters })
}

fn triangulation(scanner: &mut Scanner, version: u8) -> Result<Triangulation> {
    let at = scanner.mark();
    let (n, m) = (scanner.count("nodes", 3)?, scanner.count("triangles", 3)?);
    let with_parameters = scanner.flag("parameters")?;
    let with_normals = version >= 3 && scanner.flag("normals")?;
    let deflection = scanner.real("a deflection")?;
    let nodes = list(n, scanner, point)?;
    let parameters = if with_parameters { Some(list(n, scanner, point2d)?) } else { None };
    let triangles = list(m, scanner, |s| Ok([node(s)?, node(s)?, node(s)?]))?;
    if let Some(t) = triangles.iter().position(|t| t.iter().any(|&i| i as usize > n)) {
        let why = format!("triangle {} uses a node that does not exist: there are {n}", t + 1);
        return scanner.fail_at(at, why);
    }
    let normals = if with_normals { Some(list(n, scanner, point)?) } else { None };
    Ok(Triangulation { deflection, nodes, parameters, triangles, normals })
}

/// Parses the table of shapes.
struct ShapeParser<'a> {
    brep: &'a mut Brep,
    /// How deep the parts of each shape are nested.
    depths: Vec<usize>,
    count: usize,
}

impl ShapeParser<'_> {
    fn shape(&mut self, scanner: &mut Scanner) -> Result<()> {
        let at = scanner.mark();
        let kind = match scanner.token("a kind of shape")? {
            b"Ve" => ShapeKind::Vertex(self.vertex(scanner)?),
            b"Ed" => ShapeKind::Edge(self.edge(scanner)?),
            b"Wi" => ShapeKind::Wire,
            b"Fa" => ShapeKind::Face(self.face(scanner)?),
            b"Sh" => ShapeKind::Shell,
            b"So" => ShapeKind::Solid,
            b"CS" => ShapeKind::CompSolid,
            b"Co" => ShapeKind::Compound,
            other => {
                let found = String::from_utf8_lossy(&other[..other.len().min(40)]);
                let why = format!("expected a shape (Ve, Ed, Wi, Fa, Sh, So, CS or Co), found '{found}'");
                return scanner.fail_at(at, why);
            }
        };
        let flags = flags(scanner)?;
        let mut children = Vec::new();
        while let Some(child) = self.reference(scanner)? {
            children.push(child);
        }
        let depth = 1 + children.iter().map(|c| self.depths[c.shape]).max().unwrap_or(0);
        if depth > MAX_DEPTH {
            return scanner.fail_at(at, format!("shapes nested deeper than {MAX_DEPTH}"));
        }
        self.depths.push(depth);
        self.brep.shapes.push(Shape { kind, flags, children });
        Ok(())
    }

    /// A use of an earlier shape, or the end of a list.
    fn reference(&mut self, scanner: &mut Scanner) -> Result<Option<ShapeRef>> {
        let at = scanner.mark();
        let orientation = match scanner.peek().first() {
            Some(b'*') => {
                scanner.jump(at + 1);
                return Ok(None);
            }
            Some(b'+') => Orientation::Forward,
            Some(b'-') => Orientation::Reversed,
            Some(b'i') => Orientation::Internal,
            Some(b'e') => Orientation::External,
            _ => return scanner.fail("expected a shape's reference (as in '+12 0') or '*'"),
        };
        scanner.jump(at + 1);
        // The text numbers shapes from the last one.
        let shape = self.count - 1 - scanner.index("shape", self.count)?;
        if shape >= self.brep.shapes.len() {
            return scanner.fail_at(at, format!("shape {} is used before it is given", self.count - shape));
        }
        Ok(Some(ShapeRef { shape, orientation, location: self.location(scanner)? }))
    }

    fn location(&self, scanner: &mut Scanner) -> Result<usize> {
        scanner.integer_in("a location", 0..=self.brep.locations.len() as i64)
    }

    fn surface(&self, scanner: &mut Scanner) -> Result<usize> {
        scanner.index("surface", self.brep.surfaces.len())
    }

    fn pcurve(&self, scanner: &mut Scanner) -> Result<usize> {
        scanner.index("2-D curve", self.brep.curves2d.len())
    }

    fn vertex(&self, scanner: &mut Scanner) -> Result<Vertex> {
        let tolerance = scanner.length("a tolerance")?;
        let point = point(scanner)?;
        let mut representations = Vec::new();
        loop {
            let parameter = parameter(scanner)?;
            let kind = match scanner.integer_in("a kind of point", 0..=3)? {
                0 => return Ok(Vertex { tolerance, point, representations }),
                1 => {
                    PointRepresentationKind::Curve { curve: scanner.index("curve", self.brep.curves.len())? }
                }
                2 => PointRepresentationKind::Pcurve {
                    pcurve: self.pcurve(scanner)?,
                    surface: self.surface(scanner)?,
                },
                _ => PointRepresentationKind::Surface {
                    v: scanner.real("a parameter")?,
                    surface: self.surface(scanner)?,
                },
            };
            let location = self.location(scanner)?;
            representations.push(PointRepresentation { parameter, kind, location });
        }
    }

    fn edge(&self, scanner: &mut Scanner) -> Result<Edge> {
        let mut edge = Edge {
            tolerance: scanner.length("a tolerance")?,
            same_parameter: scanner.flag("same parameter")?,
            same_range: scanner.flag("same range")?,
            degenerated: scanner.flag("degenerated")?,
            representations: Vec::new(),
        };
        loop {
            let kind = scanner.integer_in("a kind of edge representation", 0..=7)?;
            if kind == 0 {
                return Ok(edge);
            }
            edge.representations.push(self.edge_representation(scanner, kind)?);
        }
    }

    fn edge_representation(&self, scanner: &mut Scanner, kind: usize) -> Result<EdgeRepresentation> {
        let polygons = self.brep.polygons_on_triangulations.len();
        let polygon = |s: &mut Scanner| s.index("polygon on triangulation", polygons);
        Ok(match kind {
            1 => EdgeRepresentation::Curve {
                curve: scanner.index("curve", self.brep.curves.len())?,
                location: self.location(scanner)?,
                range: scanner.reals("a parameter")?,
            },
            2 => EdgeRepresentation::Pcurve {
                pcurve: self.pcurve(scanner)?,
                surface: self.surface(scanner)?,
                location: self.location(scanner)?,
                range: scanner.reals("a parameter")?,
                ends: self.ends(scanner)?,
            },
            3 => EdgeRepresentation::Seam {
                pcurves: [self.pcurve(scanner)?, self.pcurve(scanner)?],
                continuity: continuity(scanner)?,
                surface: self.surface(scanner)?,
                location: self.location(scanner)?,
                range: scanner.reals("a parameter")?,
                ends: self.ends(scanner)?,
            },
            4 => {
                let continuity = continuity(scanner)?;
                let (s, l) = (self.surface(scanner)?, self.location(scanner)?);
                let (s2, l2) = (self.surface(scanner)?, self.location(scanner)?);
                EdgeRepresentation::Regularity { continuity, surfaces: [s, s2], locations: [l, l2] }
            }
            5 => EdgeRepresentation::Polygon3d {
                polygon: scanner.index("polygon", self.brep.polygons.len())?,
                location: self.location(scanner)?,
            },
            6 => EdgeRepresentation::PolygonOnTriangulation {
                polygon: polygon(scanner)?,
                triangulation: self.triangulation(scanner)?,
                location: self.location(scanner)?,
            },
            _ => EdgeRepresentation::SeamOnTriangulation {
                polygons: [polygon(scanner)?, polygon(scanner)?],
                triangulation: self.triangulation(scanner)?,
                location: self.location(scanner)?,
            },
        })
    }

    fn triangulation(&self, scanner: &mut Scanner) -> Result<usize> {
        scanner.index("triangulation", self.brep.triangulations.len())
    }

    fn ends(&self, scanner: &mut Scanner) -> Result<Option<[DVec2; 2]>> {
        Ok(if self.brep.version == 2 { Some([point2d(scanner)?, point2d(scanner)?]) } else { None })
    }

    fn face(&self, scanner: &mut Scanner) -> Result<Face> {
        let mut face = Face {
            tolerance: 0.0,
            natural_restriction: false,
            surface: None,
            location: 0,
            triangulation: None,
        };
        let kind = scanner.integer_in("a face (0, 1, or 2 for a triangulation only)", 0..=2)?;
        if kind == 2 {
            face.triangulation = Some(self.triangulation(scanner)?);
            return Ok(face);
        }
        face.natural_restriction = kind == 1;
        face.tolerance = scanner.length("a tolerance")?;
        if scanner.peek() == b"0" {
            scanner.integer("a surface")?;
        } else {
            face.surface = Some(self.surface(scanner)?);
        }
        face.location = self.location(scanner)?;
        if scanner.peek() == b"2" {
            scanner.integer("a triangulation")?;
            face.triangulation = Some(self.triangulation(scanner)?);
        }
        Ok(face)
    }
}

fn flags(scanner: &mut Scanner) -> Result<ShapeFlags> {
    let at = scanner.mark();
    let token = scanner.token("flags")?;
    match <[u8; 7]>::try_from(token) {
        Ok(bits) if bits.iter().all(|b| matches!(b, b'0' | b'1')) => {
            Ok(ShapeFlags::from(bits.map(|b| b == b'1')))
        }
        _ => scanner.fail_at(at, "expected seven flags, each 0 or 1"),
    }
}

fn continuity(scanner: &mut Scanner) -> Result<Continuity> {
    let at = scanner.mark();
    let token = scanner.token("a continuity")?;
    match Continuity::NAMES.into_iter().find(|(_, name)| name.as_bytes() == token) {
        Some((continuity, _)) => Ok(continuity),
        None => scanner.fail_at(at, "expected a continuity: C0, C1, C2, C3, CN, G1 or G2"),
    }
}
