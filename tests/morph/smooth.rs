//! Smooth fields that no motion of a rigid or affine body gives: errors fall as the nodes get
//! denser, and what was closed, tangent or a point stays so.

use crate::fields::{bend, heat, twist};
use crate::judge::{Verdict, judge};
use crate::run;
use crate::solids::{SOLIDS, field, hot, nodes, solid};
use bladesmith::brep::Brep;
use bladesmith::morph::Options;
use glam::DVec3;

type Displacement = fn(DVec3) -> DVec3;

const FIELDS: [(&str, Displacement); 3] =
    [("bending", |x| bend(x, 0.004)), ("twist", |x| twist(x, 0.008)), ("heat", |x| heat(x, 2e-5))];

fn morphed(name: &str, brep: &Brep, h: f64, u: Displacement) -> (Brep, Verdict) {
    let done = run(brep, &field(nodes(brep, h, |_| true), u), &Options::default());
    let verdict = judge(brep, &done.brep, u);
    assert_eq!((verdict.folded, done.report.solid.folded), (0, 0), "{name}, h {h}: {verdict:?}");
    assert!(verdict.beyond_tolerance <= 0.0, "{name}, h {h}: {verdict:?}");
    (done.brep, verdict)
}

/// Errors below this come from the residual that the fit leaves alone, not from the mesh, mm.
const FLOOR_MM: f64 = 1e-4;
/// What an edge may gape, and what a tangent one may open by.
const GAP_MM: f64 = 5e-5;
const OPENED_DEG: f64 = 0.1;

#[test]
fn errors_fall_with_the_node_spacing() {
    for name in SOLIDS {
        let brep = solid(name);
        for (what, u) in FIELDS {
            let (_, coarse) = morphed(name, &brep, 1.0, u);
            let (_, fine) = morphed(name, &brep, 0.5, u);
            let falls = fine.error <= FLOOR_MM.max(0.6 * coarse.error);
            assert!(falls, "{what} of {name}: {} to {}", coarse.error, fine.error);
            assert!(coarse.error < 5e-3 && coarse.gap < GAP_MM, "{what} of {name}: {coarse:?}");
            assert!(fine.gap < GAP_MM && fine.opened_deg < OPENED_DEG, "{what} of {name}: {fine:?}");
        }
    }
}

/// What a seam or a pole may open, mm: rounding.
const CLOSED_MM: f64 = 1e-12;

#[test]
fn seams_and_poles_stay_closed_exactly() {
    for name in ["cylinder", "drop", "torus", "vase", "leaf"] {
        let brep = solid(name);
        let (cold, _) = morphed(name, &brep, 1.0, |x| bend(x, 0.004) + heat(x, 2e-5));
        let (old, new) = (hot(&brep), hot(&cold));
        for joint in &new.joints {
            let own = joint.sides.len() == 2 && joint.sides[0].face == joint.sides[1].face;
            if !own && !joint.degenerated {
                continue;
            }
            let on = |side: usize, k: u32| {
                let side = &joint.sides[side];
                let uv = side.pcurve.point(joint.parameter(f64::from(k) / 50.0));
                cold.surfaces[new.topology.faces[side.face].surface].point(uv.x, uv.y)
            };
            for k in 0..=50 {
                let apart = if joint.degenerated { on(0, k) - on(0, 0) } else { on(0, k) - on(1, k) };
                assert!(apart.length() < CLOSED_MM, "{name}: open by {}", apart.length());
            }
        }
        assert_eq!(old.joints.len(), new.joints.len());
    }
}
