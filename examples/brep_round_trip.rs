//! Reads every `*.brep` of a directory and writes it again, to compare with another kernel:
//! `brep_round_trip [--normalise] [--sample] [--version=N] IN OUT`.
//!
//! `--normalise` bakes locations into the geometry first, `--version=N` writes another format
//! version, `--sample` also writes `NAME.json` with points and derivatives of surfaces and curves.

use bladesmith::brep::{self, Brep, Coedge, FaceTopology, Topology};
use serde_json::{Value, json};
use std::error::Error;
use std::path::Path;
use std::time::Instant;

struct Options {
    normalise: bool,
    sample: bool,
    version: Option<u8>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let (options, paths): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let [input, output] = paths.as_slice() else {
        return Err("usage: brep_round_trip [--normalise] [--sample] [--version=N] IN OUT".into());
    };
    let asked = |option: &str| options.iter().any(|o| o == option);
    let version = options.iter().find_map(|o| o.strip_prefix("--version=")).map(str::parse).transpose()?;
    let options = Options { normalise: asked("--normalise"), sample: asked("--sample"), version };
    let mut failed = false;
    for entry in std::fs::read_dir(input)? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "brep")
            && let Err(error) = round_trip(&path, Path::new(output), &options)
        {
            eprintln!("{}: {error}", path.display());
            failed = true;
        }
    }
    if failed { Err("not every file could be written again".into()) } else { Ok(()) }
}

fn round_trip(path: &Path, output: &Path, options: &Options) -> Result<(), Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    let name = path.file_name().ok_or("no file name")?.to_string_lossy();
    let start = Instant::now();
    let mut brep = brep::parse(&name, &text)?;
    let parsed = start.elapsed();
    if options.normalise {
        brep.normalise()?;
    }
    brep.version = options.version.unwrap_or(brep.version);
    let start = Instant::now();
    let written = brep.write();
    println!("{name}: {} bytes, parsed in {parsed:?}, written in {:?}", text.len(), start.elapsed());
    std::fs::write(output.join(&*name), written)?;
    if options.sample {
        std::fs::write(output.join(&*name).with_extension("json"), samples(&brep)?.to_string())?;
    }
    Ok(())
}

/// A parameter inside a range, off its middle and its ends, where splines may have knots.
fn inside([a, b]: [f64; 2], i: i32, n: i32) -> f64 {
    a + (b - a) * (f64::from(i) + 0.37) / f64::from(n)
}

/// Parameters, points and derivatives of all faces and edges, in order.
fn samples(brep: &Brep) -> Result<Value, Box<dyn Error>> {
    let topology = Topology::new(brep)?;
    let faces: Vec<Value> = topology.faces.iter().map(|f| face_samples(brep, f)).collect();
    let edges = topology.edges.iter().map(|edge| {
        let vertices = edge.vertices.map(|v| v.map(|v| topology.vertices[v].point.to_array()));
        let faces: Vec<usize> = edge.coedges.iter().map(|c| c.0).collect();
        let (mut points, mut ends) = (Vec::new(), Vec::new());
        if let Some(curve) = edge.curve.map(|c| &brep.curves[c]) {
            for i in 0..8 {
                let t = inside(edge.range, i, 8);
                let derivatives = curve.derivatives(t).map(|d| d.to_array());
                points.push(json!([[t], derivatives]));
            }
            ends.extend(edge.range.map(|t| json!([[t], [curve.point(t).to_array()]])));
        }
        json!({"points": points, "ends": ends, "vertices": vertices, "faces": faces})
    });
    let edges: Vec<Value> = edges.collect();
    let solids: Vec<&[usize]> = topology.solids.iter().map(|s| &s.faces[..]).collect();
    Ok(json!({"faces": faces, "edges": edges, "solids": solids}))
}

fn face_samples(brep: &Brep, face: &FaceTopology) -> Value {
    let surface = &brep.surfaces[face.surface];
    let window = window(brep, face);
    let (mut points, mut ends) = (Vec::new(), Vec::new());
    for i in 0..6 {
        for j in 0..6 {
            let (u, v) = (inside(window[0], i, 6), inside(window[1], j, 6));
            let d = surface.derivatives(u, v);
            let derivatives = [d.s, d.u, d.v, d.uu, d.uv, d.vv].map(|d| d.to_array());
            points.push(json!([[u, v], derivatives]));
        }
    }
    for u in window[0] {
        ends.extend(window[1].map(|v| json!([[u, v], [surface.point(u, v).to_array()]])));
    }
    let wire = |wire: &Vec<Coedge>| wire.iter().map(|c| trace(brep, face.surface, c)).collect();
    let traces: Vec<Vec<Value>> = face.wires.iter().map(wire).collect();
    json!({"kind": surface.kind_name(), "reversed": face.reversed, "points": points, "ends": ends,
        "traces": traces})
}

/// Points of a coedge's curve in the surface's parameters, and the surface's points there.
fn trace(brep: &Brep, surface: usize, coedge: &Coedge) -> Value {
    let mut points = Vec::new();
    if let Some(pcurve) = coedge.pcurve {
        for i in 0..4 {
            let t = inside(coedge.range, i, 4);
            let [uv, derivative, _] = brep.curves2d[pcurve].derivatives(t);
            let point = brep.surfaces[surface].point(uv.x, uv.y).to_array();
            points.push(json!([[t], uv.to_array(), derivative.to_array(), point]));
        }
    }
    json!({"edge": coedge.edge, "reversed": coedge.reversed, "range": coedge.range, "points": points})
}

/// The box of the face's parameter curves; a unit square where there are none.
fn window(brep: &Brep, face: &FaceTopology) -> [[f64; 2]; 2] {
    let mut window = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for coedge in face.wires.iter().flatten() {
        let Some(pcurve) = coedge.pcurve else { continue };
        for i in 0..=16 {
            let t = coedge.range[0] + (coedge.range[1] - coedge.range[0]) * i as f64 / 16.0;
            for (side, x) in window.iter_mut().zip(brep.curves2d[pcurve].point(t).to_array()) {
                *side = [side[0].min(x), side[1].max(x)];
            }
        }
    }
    if window[0][0].is_finite() { window } else { [[0.0, 1.0]; 2] }
}
