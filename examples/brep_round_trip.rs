//! Reads every `*.brep` of a directory and writes it again: `brep_round_trip [--sample] IN
//! OUT`.
//!
//! `--sample` also writes `NAME.json` with points and derivatives of all surfaces and curves, for
//! comparison with another kernel.

use bladesmith::brep::{self, Brep, Coedge, FaceTopology, Topology};
use serde_json::{Value, json};
use std::error::Error;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let (options, paths): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let [input, output] = paths.as_slice() else {
        return Err("usage: brep_round_trip [--sample] IN OUT".into());
    };
    let asked = |option: &str| options.iter().any(|o| o == option);
    let mut failed = false;
    for entry in std::fs::read_dir(input)? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "brep")
            && let Err(error) = round_trip(&path, Path::new(output), asked("--sample"))
        {
            eprintln!("{}: {error}", path.display());
            failed = true;
        }
    }
    if failed { Err("not every file could be written again".into()) } else { Ok(()) }
}

fn round_trip(path: &Path, output: &Path, sample: bool) -> Result<(), Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    let name = path.file_name().ok_or("no file name")?;
    let start = Instant::now();
    let brep = brep::parse(&name.to_string_lossy(), &text)?;
    let parsed = start.elapsed();
    let start = Instant::now();
    let written = brep.write();
    let (name, bytes, seconds) = (name.to_string_lossy(), text.len(), start.elapsed());
    println!("{name}: {bytes} bytes, parsed in {parsed:?}, written in {seconds:?}");
    std::fs::write(output.join(&*name), written)?;
    if sample {
        std::fs::write(output.join(&*name).with_extension("json"), samples(&brep)?.to_string())?;
    }
    Ok(())
}

/// Parameters, points and derivatives of all faces and edges, in order.
fn samples(brep: &Brep) -> Result<Value, Box<dyn Error>> {
    let topology = Topology::new(brep)?;
    let faces: Vec<Value> = topology.faces.iter().map(|f| face_samples(brep, f)).collect();
    let edges = topology.edges.iter().map(|edge| {
        let curve = edge.curve.map(|c| &brep.curves[c]);
        let points = curve.map(|curve| {
            let [a, b] = edge.range;
            let sample = |i: i32| {
                let t = a + (b - a) * f64::from(i) / 8.0;
                let derivatives = curve.derivatives(t).map(|d| d.to_array());
                json!([[t], derivatives])
            };
            (0..=8).map(sample).collect::<Vec<_>>()
        });
        let vertices = edge.vertices.map(|v| v.map(|v| topology.vertices[v].point.to_array()));
        let faces: Vec<usize> = edge.coedges.iter().map(|c| c.0).collect();
        json!({"kind": curve.map(|c| c.kind_name()), "points": points, "vertices": vertices, "faces": faces})
    });
    let edges: Vec<Value> = edges.collect();
    let solids: Vec<&[usize]> = topology.solids.iter().map(|s| &s.faces[..]).collect();
    Ok(json!({"faces": faces, "edges": edges, "solids": solids}))
}

fn face_samples(brep: &Brep, face: &FaceTopology) -> Value {
    let surface = &brep.surfaces[face.surface];
    let [u, v] = window(brep, face);
    let mut points = Vec::new();
    for i in 0..=6 {
        for j in 0..=6 {
            let (u, v) = (u[0] + (u[1] - u[0]) * i as f64 / 6.0, v[0] + (v[1] - v[0]) * j as f64 / 6.0);
            let d = surface.derivatives(u, v);
            let derivatives = [d.s, d.u, d.v, d.uu, d.uv, d.vv].map(|d| d.to_array());
            points.push(json!([[u, v], derivatives]));
        }
    }
    let wire = |wire: &Vec<Coedge>| wire.iter().map(|c| trace(brep, c)).collect();
    let traces: Vec<Vec<Value>> = face.wires.iter().map(wire).collect();
    json!({"kind": surface.kind_name(), "reversed": face.reversed, "points": points, "traces": traces})
}

/// Points of a coedge's curve in the surface's parameters.
fn trace(brep: &Brep, coedge: &Coedge) -> Value {
    let ends = coedge.pcurve.map(|p| {
        let at = |s: f64| {
            let t = coedge.range[0] + (coedge.range[1] - coedge.range[0]) * s;
            brep.curves2d[p].derivatives(t).map(|d| d.to_array())
        };
        [0.0, 0.25, 0.5, 0.75, 1.0].map(at)
    });
    json!({"edge": coedge.edge, "reversed": coedge.reversed, "range": coedge.range, "points": ends})
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
