//! The text B-rep: round trip, evaluation, topology, normalisation.
//!
//! `catalogue.brep` (made by hand) has every kind of curve, surface, location and representation;
//! `three_solids.brep` (written by Open CASCADE 7.6) a cone on a cylinder, a box, and the former
//! again at another place.

use bladesmith::Error;
use bladesmith::brep::{BSplineCurve, BSplineSurface, Brep, Curve, Space, Surface, Topology, parse};
use bladesmith::nurbs::NurbsSurface;
use glam::DVec3;

const CATALOGUE: &str = include_str!("data/brep/catalogue.brep");
const THREE_SOLIDS: &str = include_str!("data/brep/three_solids.brep");

fn read(text: &str) -> Brep {
    parse("test.brep", text).unwrap_or_else(|e| panic!("{e}"))
}

fn normalised(text: &str) -> Brep {
    let mut brep = read(text);
    brep.normalise().unwrap_or_else(|e| panic!("{e}"));
    brep
}

#[test]
fn written_text_reads_back_equal() {
    for text in [CATALOGUE, THREE_SOLIDS] {
        let brep = read(text);
        assert_eq!(read(&brep.write()), brep);
    }
}

#[test]
fn every_format_version_reads_back_equal() {
    let mut brep = read(CATALOGUE);
    for triangulation in &mut brep.triangulations {
        triangulation.normals = Some(vec![DVec3::Z; triangulation.nodes.len()]);
    }
    brep.version = 3;
    assert_eq!(read(&brep.write()), brep);
    brep.version = 2;
    let second = read(&brep.write());
    assert_ne!(second, brep, "version 2 gives the ends of parameter curves, and has no normals");
    assert_eq!(read(&second.write()), second);
    assert_eq!(second.curves2d, brep.curves2d);
}

#[test]
fn text_before_the_header_is_skipped() {
    let text = format!("DBRep_DrawableShape\n{THREE_SOLIDS}");
    assert_eq!(read(&text), read(THREE_SOLIDS));
}

/// Parameters inside a domain, infinite ends replaced, away from knots.
fn inside([a, b]: [f64; 2]) -> Vec<f64> {
    let (a, b) = (a.max(-2.0), b.min(a.max(-2.0) + 7.0));
    (0..7).map(|i| a + (b - a) * (f64::from(i) + 0.37) / 7.0).collect()
}

/// The derivative of a vector function by central differences, error O(h⁴).
fn difference<P: Space>(f: impl Fn(f64) -> P, t: f64) -> P {
    let h = 2e-4;
    ((f(t + h) - f(t - h)) * 8.0 - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h)
}

fn assert_near<P: Space>(what: &str, found: P, expected: P) {
    let gap = (found - expected).length();
    assert!(gap <= 1e-7 * (1.0 + expected.length()), "{what}: {found:?} instead of {expected:?}");
}

fn check_curve<P: Space>(curve: &Curve<P>) {
    for t in inside(curve.domain()) {
        let [point, first, second] = curve.derivatives(t);
        let what = format!("{} at {t}", curve.kind_name());
        assert_near(&what, point, curve.point(t));
        assert_near(&format!("{what}, first derivative"), first, difference(|t| curve.point(t), t));
        let slope = difference(|t| curve.derivatives(t)[1], t);
        assert_near(&format!("{what}, second derivative"), second, slope);
        if let Some(period) = curve.period() {
            assert_near(&format!("{what}, a period on"), curve.point(t + period), point);
        }
    }
}

#[test]
fn derivatives_of_curves_are_limits_of_differences() {
    let brep = read(CATALOGUE);
    brep.curves.iter().for_each(check_curve);
    brep.curves2d.iter().for_each(check_curve);
}

fn check_surface(surface: &Surface, u: f64, v: f64) {
    let what = format!("{} at ({u}, {v})", surface.kind_name());
    let d = surface.derivatives(u, v);
    let along_u = |u| surface.derivatives(u, v);
    let along_v = |v| surface.derivatives(u, v);
    assert_near(&what, d.s, surface.point(u, v));
    assert_near(&format!("{what}, u"), d.u, difference(|u| along_u(u).s, u));
    assert_near(&format!("{what}, v"), d.v, difference(|v| along_v(v).s, v));
    assert_near(&format!("{what}, uu"), d.uu, difference(|u| along_u(u).u, u));
    assert_near(&format!("{what}, uv"), d.uv, difference(|v| along_v(v).u, v));
    assert_near(&format!("{what}, vv"), d.vv, difference(|v| along_v(v).v, v));
    let [period_u, period_v] = surface.period().map(|p| p.unwrap_or(0.0));
    assert_near(&format!("{what}, periods on"), surface.point(u + period_u, v - period_v), d.s);
}

#[test]
fn derivatives_of_surfaces_are_limits_of_differences() {
    for surface in &read(CATALOGUE).surfaces {
        let [domain_u, domain_v] = surface.domain();
        for u in inside(domain_u) {
            inside(domain_v).into_iter().for_each(|v| check_surface(surface, u, v));
        }
    }
}

#[test]
fn clamping_a_periodic_curve_keeps_it() {
    let mut periodic = 0;
    for curve in &read(CATALOGUE).curves {
        let Curve::BSpline(spline) = curve else { continue };
        let nurbs = spline.to_nurbs().unwrap();
        let (a, b) = nurbs.knots().domain();
        assert_eq!([a, b], curve.domain());
        assert_eq!(nurbs.knots().flat()[..=nurbs.knots().degree()], vec![a; nurbs.knots().degree() + 1]);
        if let Some(period) = curve.period() {
            periodic += 1;
            assert_eq!(period, b - a);
            assert_near("its ends", nurbs.poles()[0], nurbs.poles()[nurbs.poles().len() - 1]);
        }
        for t in inside([a, b]).into_iter().chain([a, b]) {
            assert!(nurbs.point(t).distance(curve.point(t)) < 1e-13, "at {t}");
        }
        let back = BSplineCurve::from(&nurbs);
        assert_eq!(back.to_nurbs().unwrap(), nurbs);
    }
    assert_eq!(periodic, 2);
}

#[test]
fn clamping_a_periodic_surface_keeps_it() {
    let mut periodic = 0;
    for surface in &read(CATALOGUE).surfaces {
        let Surface::BSpline(spline) = surface else { continue };
        let nurbs: NurbsSurface = spline.to_nurbs().unwrap();
        let [u, v] = surface.domain();
        assert_eq!([nurbs.knots_u().domain(), nurbs.knots_v().domain()], [u.into(), v.into()]);
        periodic += usize::from(surface.period() != [None; 2]);
        for u in inside(u).into_iter().chain(u) {
            for v in inside(v).into_iter().chain(v) {
                assert!(nurbs.point(u, v).distance(surface.point(u, v)) < 1e-13, "at ({u}, {v})");
            }
        }
        let back = BSplineSurface::from(&nurbs);
        assert_eq!(back.poles().collect::<Vec<_>>(), nurbs.poles());
        assert_eq!(back.to_nurbs().unwrap(), nurbs);
    }
    assert_eq!(periodic, 2);
}

#[test]
fn topology_of_three_solids() {
    let topology = Topology::new(&normalised(THREE_SOLIDS)).unwrap();
    let faces: Vec<usize> = topology.solids.iter().map(|s| s.faces.len()).collect();
    assert_eq!(faces, [3, 6, 3]);
    assert_eq!((topology.faces.len(), topology.edges.len(), topology.vertices.len()), (12, 22, 14));
    let reversed: Vec<usize> = (0..12).filter(|&f| topology.faces[f].reversed).collect();
    assert_eq!(reversed, [2, 3, 5, 7, 11]);
    let degenerated: Vec<usize> = (0..22).filter(|&e| topology.edges[e].degenerated).collect();
    assert_eq!(degenerated, [0, 17]);
    assert!(degenerated.iter().all(|&e| topology.edges[e].curve.is_none()));
    for (i, edge) in topology.edges.iter().enumerate() {
        let uses = if edge.degenerated { 1 } else { 2 };
        assert_eq!(edge.coedges.len(), uses, "edge {i}");
        for &(face, wire, position) in &edge.coedges {
            assert_eq!(topology.faces[face].wires[wire][position].edge, i);
        }
    }
}

#[test]
fn seams_have_two_curves_chosen_by_orientation() {
    let brep = normalised(THREE_SOLIDS);
    let topology = Topology::new(&brep).unwrap();
    let cylinder = &topology.faces[1];
    let Surface::Cylinder { .. } = brep.surfaces[cylinder.surface] else { panic!("face 2 is the cylinder") };
    let seam: Vec<_> = cylinder.wires[0].iter().filter(|c| c.edge == 3).collect();
    assert_eq!(seam.len(), 2);
    for coedge in seam {
        let pcurve = coedge.pcurve.expect("a seam has curves on its surface");
        let u = brep.curves2d[pcurve].point(coedge.range[0]).x;
        let expected = if coedge.reversed { 0.0 } else { std::f64::consts::TAU };
        assert!((u - expected).abs() < 1e-12, "reversed {}: u = {u}", coedge.reversed);
    }
}

#[test]
fn edges_meet_their_vertices_and_traces() {
    let brep = normalised(THREE_SOLIDS);
    let topology = Topology::new(&brep).unwrap();
    for edge in topology.edges.iter().filter(|e| !e.degenerated) {
        let curve = &brep.curves[edge.curve.expect("a curve in space")];
        for (t, vertex) in edge.range.into_iter().zip(edge.vertices) {
            let point = topology.vertices[vertex.expect("a vertex")].point;
            assert!(curve.point(t).distance(point) < 1e-7);
        }
        for &(face, wire, position) in &edge.coedges {
            let coedge = &topology.faces[face].wires[wire][position];
            let pcurve = &brep.curves2d[coedge.pcurve.expect("a curve on the surface")];
            for t in inside(coedge.range) {
                let uv = pcurve.point(t);
                let trace = brep.surfaces[topology.faces[face].surface].point(uv.x, uv.y);
                assert!(trace.distance(curve.point(t)) < 1e-7, "face {face}, {t}");
            }
        }
    }
}

#[test]
fn topology_asks_for_a_shape_without_locations() {
    let error = Topology::new(&read(THREE_SOLIDS)).unwrap_err();
    assert!(matches!(&error, Error::Solid { why } if why.contains("normalise")), "{error}");
}

#[test]
fn normalising_moves_a_copy_and_keeps_the_original() {
    let brep = normalised(THREE_SOLIDS);
    assert!(brep.locations.is_empty() && brep.triangulations.is_empty() && brep.polygons.is_empty());
    let topology = Topology::new(&brep).unwrap();
    let tips = [0, 17].map(|e| topology.vertices[topology.edges[e].vertices[0].unwrap()].point);
    assert!(tips[0].distance(DVec3::new(0.0, 0.0, 5.0)) < 1e-14);
    assert!(tips[1].distance(DVec3::new(0.0, -5.0, 20.0)) < 1e-14);
    let axis = |face: usize| match &brep.surfaces[topology.faces[face].surface] {
        Surface::Cylinder { frame, radius } => (frame.normal, *radius),
        other => panic!("a {}", other.kind_name()),
    };
    assert_eq!(axis(1), (DVec3::Z, 3.0));
    let (moved, radius) = axis(10);
    assert!(moved.distance(-DVec3::Y) < 1e-15 && radius == 3.0);
    let mut again = brep.clone();
    again.normalise().unwrap();
    assert_eq!(again, brep, "normalising twice changes nothing");
}

#[test]
fn a_solid_can_be_taken_out() {
    let (brep, whole) = (read(THREE_SOLIDS), normalised(THREE_SOLIDS));
    for (n, faces) in [(1, 3), (2, 6), (3, 3)] {
        let solid = brep.solid(n).unwrap();
        let topology = Topology::new(&solid).unwrap();
        assert_eq!((topology.solids.len(), topology.faces.len()), (1, faces));
        assert!(solid.surfaces.len() < whole.surfaces.len(), "geometry of other solids is left out");
        assert_eq!(read(&solid.write()), solid);
    }
    for n in [0, 4] {
        let error = brep.solid(n).unwrap_err();
        assert!(matches!(&error, Error::Solid { why } if why.contains("holds 3")), "{error}");
    }
}

#[test]
fn scaling_locations_are_refused() {
    let scaled = THREE_SOLIDS.replacen("\n1\n              1 ", "\n1\n              2 ", 1);
    assert_ne!(scaled, THREE_SOLIDS);
    let mut brep = read(&scaled);
    let before = brep.clone();
    let error = brep.normalise().unwrap_err();
    assert!(matches!(&error, Error::Solid { why } if why.contains("location 1")), "{error}");
    assert_eq!(brep, before, "a failed normalisation changes nothing");
}
