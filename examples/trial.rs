use bladesmith::{brep, fe::Field, morph};
use glam::DVec3;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(&a[1]).unwrap();
    let t = std::time::Instant::now();
    let part = brep::parse(&a[1], &text).unwrap();
    println!("parse {:.3}", t.elapsed().as_secs_f64());
    let mut f = Field { name: a[2].clone(), step: 1, steps: 1, ..Default::default() };
    let mut surface = vec![];
    for (k, l) in std::fs::read_to_string(&a[2]).unwrap().lines().enumerate() {
        let w: Vec<f64> = l.split(' ').map(|x| x.parse().unwrap()).collect();
        f.ids.push(w[0] as i64);
        f.points.push(DVec3::new(w[1], w[2], w[3]));
        f.displacements.push(DVec3::new(w[4], w[5], w[6]));
        if w[7] > 0.5 { surface.push(k as u32); }
    }
    f.surface_nodes = Some(surface);
    let o = morph::Options { factor: -1.0, holdout: a.get(4).is_some(), ..Default::default() };
    let r = morph::morph(&part, &f, &o, &|s, x| { if std::env::var("V").is_ok() { eprintln!("{:.3} {s} {x:.2}", t.elapsed().as_secs_f64()); } true });
    let m = match r { Ok(m) => m, Err(e) => { println!("ERROR {e}"); return; } };
    std::fs::write(&a[3], m.brep.write()).unwrap();
    let r = &m.report;
    for f in &r.faces { println!("{:3} p{:?} n{:?} nodes {:5} foot {:.1e} dev {:.1e}/{:.1e} dist {:.1e} hold {} spans {}/{} ins {} {}", f.index, f.degree, f.poles, f.nodes, f.foot_mm.max, f.deviation_mm.mean, f.deviation_mm.max, f.distance_mm.max, f.holdout_mm.map_or("-".into(), |h| format!("{:.1e}/{:.1e}", h.mean, h.max)), f.spans_filled, f.spans, f.knots_inserted, if f.held {"HELD"} else {""}); }
    for e in &r.edges { let bad = e.gap_mm.after > e.gap_mm.before + 2e-5 || (e.tangent && e.angle_deg.after > e.angle_deg.before + 0.02); if bad || std::env::var("E").is_ok() { println!("edge {:3} {:?} gap {:.2e} -> {:.2e} angle {:.4} -> {:.4} {} {}", e.index, e.faces, e.gap_mm.before, e.gap_mm.after, e.angle_deg.before, e.angle_deg.after, if e.tangent {"T"} else {""}, if e.held {"HELD"} else {""}); } }
    println!("dev {:?} hold {:?} unm {} solid {:?}", r.deviation_mm, r.holdout_mm, r.unmatched_nodes, r.solid);
    println!("{:#?} {:?}", r.warnings, r.seconds);
    if std::env::var("W").is_ok() { let mut n = m.nodes.clone(); n.sort_by(|a, b| b.deviation.length().total_cmp(&a.deviation.length())); for x in n.iter().filter(|x| [3, 7, 8, 9].contains(&x.face)).take(14) { println!("node {} face {} at {:.4} dev {:.2e} disp {:.5}", x.id, x.face, x.foot, x.deviation.length(), x.displacement); } }
    println!("poles {}", r.faces.iter().map(|f| f.poles[0]*f.poles[1]).sum::<usize>());
}
