//! The same input gives the same output to the last bit, whatever the number of threads.

use crate::fields::{bend, heat};
use crate::run;
use crate::solids::{field, nodes, solid};
use bladesmith::morph::{Morphed, NodeResult, Options, Report};

/// Everything but the times.
fn timeless(done: &Morphed) -> (String, Vec<NodeResult>, Report) {
    let mut report = done.report.clone();
    report.seconds = Default::default();
    (done.brep.write(), done.nodes.clone(), report)
}

#[test]
fn one_thread_two_threads_and_a_second_run_agree() {
    let pool = |threads: usize| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads")
    };
    for name in ["plate", "drop", "filleted"] {
        let brep = solid(name);
        let field = field(nodes(&brep, 0.8, |_| true), |x| bend(x, 0.004) + heat(x, 2e-5));
        let options = Options { holdout: true, ..Options::default() };
        let with = |threads: usize| pool(threads).install(|| timeless(&run(&brep, &field, &options)));
        let (text, nodes, report) = with(1);
        for (what, other) in [("two threads", with(2)), ("three threads", with(3)), ("a second run", with(2))]
        {
            assert!(other.0 == text, "{name}, {what}: another B-rep");
            assert!(other.1 == nodes, "{name}, {what}: other node results");
            assert_eq!(other.2, report, "{name}, {what}");
        }
    }
}
