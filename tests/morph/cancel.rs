//! A morph stops wherever the caller asks it to.

use crate::fields::bend;
use crate::solids::{field, nodes, solid};
use bladesmith::Error;
use bladesmith::morph::{Options, morph};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn every_call_of_the_progress_can_cancel() {
    let brep = solid("drop");
    let field = field(nodes(&brep, 1.0, |_| true), |x| bend(x, 0.004));
    let options = Options { holdout: true, ..Options::default() };
    let seen = Mutex::new(Vec::new());
    let all = |stage: &str, fraction: f64| {
        seen.lock().expect("no panic").push((stage.to_string(), fraction));
        true
    };
    morph(&brep, &field, &options, &all).unwrap_or_else(|error| panic!("{error}"));
    let seen = seen.into_inner().expect("no panic");
    assert!(seen.len() >= 7, "few stages: {seen:?}");
    for pair in seen.windows(2) {
        assert!(pair[0].1 <= pair[1].1, "the fraction done falls: {pair:?}");
    }
    assert_eq!(seen.last().map(|s| s.1), Some(1.0));
    for k in 0..seen.len() {
        let calls = AtomicUsize::new(0);
        let stop = |_: &str, _: f64| calls.fetch_add(1, Ordering::Relaxed) < k;
        let result = morph(&brep, &field, &options, &stop);
        assert_eq!(result.err(), Some(Error::Cancelled), "at call {k}: {:?}", seen[k]);
        assert_eq!(calls.into_inner(), k + 1, "the work went on after {:?}", seen[k]);
    }
}
