//! The solids of `tests/data/morph`, and nodes on their faces.

use bladesmith::brep::{Brep, parse};
use bladesmith::fe::Field;
use bladesmith::morph::hot::Hot;
use flate2::read::GzDecoder;
use glam::{DVec2, DVec3};
use std::io::Read;
use std::path::Path;

/// A solid with fillets, seams, poles, splines or shared surfaces, by the name of its file.
pub const SOLIDS: [&str; 8] = ["plate", "filleted", "cylinder", "drop", "torus", "vase", "bar", "leaf"];

/// The part as its file has it.
pub fn part(name: &str) -> Brep {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/morph/{name}.brep.gz"));
    let packed = std::fs::read(&path).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()));
    let mut text = String::new();
    GzDecoder::new(&packed[..]).read_to_string(&mut text).expect("packed text");
    parse(name, &text).unwrap_or_else(|error| panic!("{error}"))
}

/// The part's only solid, without locations.
pub fn solid(name: &str) -> Brep {
    let mut brep = part(name);
    brep.normalise().and_then(|()| brep.solid(1)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

pub fn hot(brep: &Brep) -> Hot {
    Hot::new(brep).unwrap_or_else(|error| panic!("{error}"))
}

/// Places within the trims of a face, at most `n` in each direction.
pub fn inside(hot: &Hot, face: usize, n: usize) -> Vec<DVec2> {
    let trim = &hot.faces[face].trim;
    let (low, size) = (trim.low(), trim.high() - trim.low());
    let at = |i: usize, j: usize| low + size * (DVec2::new(i as f64, j as f64) + 0.5) / n as f64;
    (0..n * n).map(|k| at(k / n, k % n)).filter(|uv| trim.contains(*uv)).collect()
}

/// Points along the edges of a solid about `h` apart, ends included once.
fn on_edges(hot: &Hot, h: f64) -> Vec<DVec3> {
    let mut out: Vec<DVec3> = hot.topology.vertices.iter().map(|v| v.point).collect();
    for joint in &hot.joints {
        let Some(curve) = joint.curve.as_ref().filter(|_| !joint.degenerated) else { continue };
        let chord = |k: usize| {
            let at = |k: usize| curve.point(joint.parameter(k as f64 / 64.0));
            (at(k + 1) - at(k)).length()
        };
        let n = ((0..64).map(chord).sum::<f64>() / h).round().max(4.0) as usize;
        out.extend((1..n).map(|k| curve.point(joint.parameter(k as f64 / n as f64))));
    }
    out
}

/// Points on one face about `h` apart: rows of equal spacing.
fn on_face(brep: &Brep, hot: &Hot, face: usize, h: f64) -> Vec<DVec3> {
    let trim = &hot.faces[face].trim;
    let surface = &brep.surfaces[hot.topology.faces[face].surface];
    let (low, size) = (trim.low(), trim.high() - trim.low());
    let at = |s: f64, t: f64| low + size * DVec2::new(s, t);
    let length = |line: &dyn Fn(f64) -> DVec2| {
        let point = |k: usize| line(k as f64 / 32.0);
        let chord = |k: usize| {
            let (a, b) = (point(k), point(k + 1));
            (surface.point(b.x, b.y) - surface.point(a.x, a.y)).length()
        };
        (0..32).map(chord).sum::<f64>()
    };
    let count = |length: f64| (length / h).round().max(1.0) as usize;
    let rows = count((0..=4).map(|k| length(&|t| at(f64::from(k) / 4.0, t))).fold(0.0, f64::max));
    let mut out = Vec::new();
    for j in 0..rows {
        let t = (j as f64 + 0.5) / rows as f64;
        let columns = count(length(&|s| at(s, t)));
        let row = (0..columns).map(|i| at((i as f64 + 0.5) / columns as f64, t));
        out.extend(row.filter(|uv| trim.contains(*uv)).map(|uv| surface.point(uv.x, uv.y)));
    }
    out
}

/// Nodes on edges and faces about `h` apart, on the faces (from 0) that `wanted` asks for.
pub fn nodes(brep: &Brep, h: f64, wanted: impl Fn(usize) -> bool) -> Vec<DVec3> {
    let hot = hot(brep);
    let mut out = on_edges(&hot, h);
    if !(0..hot.faces.len()).all(&wanted) {
        out.clear();
    }
    let edges = out.len();
    for face in (0..hot.faces.len()).filter(|&f| wanted(f)) {
        for point in on_face(brep, &hot, face, h) {
            let crowded = out[..edges].iter().any(|p| (*p - point).length() < 0.4 * h);
            if !crowded {
                out.push(point);
            }
        }
    }
    out
}

/// A field of these nodes, all on the surface of the mesh.
pub fn field(points: Vec<DVec3>, u: impl Fn(DVec3) -> DVec3) -> Field {
    Field {
        name: "sampled.csv".into(),
        ids: (1..=points.len() as i64).collect(),
        displacements: points.iter().map(|p| u(*p)).collect(),
        surface_nodes: Some((0..points.len() as u32).collect()),
        points,
        step: 1,
        steps: 1,
        ..Field::default()
    }
}
