//! The look at part and field before a morph says what the morph finds, and refuses what it refuses.

use crate::fields::bend;
use crate::solids::{field, nodes, solid};
use crate::{refusal, run};
use bladesmith::Error;
use bladesmith::brep::Brep;
use bladesmith::fe::Field;
use bladesmith::morph::{Options, check};
use glam::DVec3;

fn good() -> (Brep, Field) {
    let brep = solid("cylinder");
    let field = field(nodes(&brep, 0.8, |_| true), |x| bend(x, 0.004));
    (brep, field)
}

#[test]
fn it_counts_what_the_morph_counts() {
    let (brep, mut field) = good();
    let last = field.points.len() - 1;
    field.points[last] += DVec3::new(50.0, 0.0, 0.0);
    let options = Options::default();
    let found = check(&brep, &field, &options, &|_, _| true).expect("the field lies on the part");
    let report = run(&brep, &field, &options).report;
    assert_eq!(found.unmatched_nodes, report.unmatched_nodes);
    assert_eq!(found.nodes_on_faces + found.unmatched_nodes, found.nodes);
    assert!(found.faces_without_nodes.is_empty());
    let largest = report.faces.iter().map(|f| f.foot_mm.max).fold(0.0, f64::max);
    assert_eq!(found.foot_mm.max, largest);
    assert!(found.warnings.iter().all(|w| report.warnings.contains(w)), "{:?}", found.warnings);
}

#[test]
fn it_refuses_with_the_words_of_the_morph() {
    let (brep, field) = good();
    let mirrored =
        Field { points: field.points.iter().map(|p| DVec3::new(p.x, p.y, -p.z)).collect(), ..field };
    let options = Options::default();
    let error = check(&brep, &mirrored, &options, &|_, _| true).expect_err("it lies elsewhere");
    assert_eq!(error.to_string(), refusal(&brep, &mirrored, &options).to_string());
}

#[test]
fn it_can_be_cancelled() {
    let (brep, field) = good();
    let ended = check(&brep, &field, &Options::default(), &|_, _| false);
    assert!(matches!(ended, Err(Error::Cancelled)), "{ended:?}");
}
