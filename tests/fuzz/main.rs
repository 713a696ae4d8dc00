//! The kernel's C interface under arbitrary arguments: no panic, no fault of ours, no call that
//! takes very long. `make fuzz SECONDS=600` runs it longer, under the address sanitizer where a
//! nightly compiler is installed.

mod calls;
mod cuts;
mod meets;
mod source;
mod surfaces;

use calls::{CALLS, Pool, SLOW, last_error};
use source::Source;
use std::collections::BTreeMap;
use std::io::Write;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Calls of one seed: what they leave is freed then.
const CALLS_OF_A_SEED: usize = 400;

/// Seeds that are always run, whatever time that takes.
const SEEDS: u64 = 5;

/// Longest time for one call; unoptimised sanitizers are slow.
const LONGEST: Duration = Duration::from_secs(20);

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// The call that is running: when it began, seed, number and name.
static RUNNING: Mutex<Option<(Instant, u64, usize, &str)>> = Mutex::new(None);

/// Ends the process with the name of a call that takes too long: it cannot be stopped otherwise.
fn watch() {
    loop {
        std::thread::sleep(Duration::from_secs(1));
        let running = *RUNNING.lock().expect("nobody panics with it");
        if let Some((start, seed, number, name)) = running
            && start.elapsed() > LONGEST
        {
            // The harness keeps what is printed, and ends here with it.
            let text = format!("seed {seed}, call {number}, {name} takes more than {LONGEST:?}\n");
            let _ = std::io::stderr().write_all(text.as_bytes());
            std::process::exit(1);
        }
    }
}

/// Makes the calls of a seed; counts those of each name that succeeded and that failed.
fn run(seed: u64, counts: &mut BTreeMap<&'static str, [u64; 2]>) -> (Duration, &'static str) {
    let (mut source, mut pool) = (Source::new(seed), Pool::default());
    let mut slowest = (Duration::ZERO, "");
    for number in 0..CALLS_OF_A_SEED {
        let (name, call) = CALLS[source.below(CALLS.len())];
        if SLOW.contains(&name) && source.once_in(2) {
            continue;
        }
        let start = Instant::now();
        *RUNNING.lock().expect("nobody panics with it") = Some((start, seed, number, name));
        let status = call(&mut source, &mut pool);
        let usual = status == 0 || status == 1 || (100..300).contains(&status);
        assert!(usual, "seed {seed}, call {number}, {name}: status {status}, {}", last_error());
        let said = status == 0 || !last_error().is_empty();
        assert!(said, "seed {seed}, call {number}, {name}: status {status} without a text");
        slowest = slowest.max((start.elapsed(), name));
        counts.entry(name).or_default()[usize::from(status != 0)] += 1;
    }
    slowest
}

#[test]
fn arbitrary_arguments_are_used_or_refused() {
    let seconds = setting("BLADESMITH_FUZZ_SECONDS", 0);
    let first = setting("BLADESMITH_FUZZ_SEED", 0);
    std::thread::spawn(watch);
    let (start, mut counts) = (Instant::now(), BTreeMap::new());
    let mut slowest = (Duration::ZERO, "");
    let mut seed = first;
    while start.elapsed() < Duration::from_secs(seconds) || seed < first + SEEDS {
        slowest = slowest.max(run(seed, &mut counts));
        seed += 1;
    }
    let total: u64 = counts.values().flatten().sum();
    println!(
        "{total} calls of seeds {first} to {}; the slowest, {}, took {:?}",
        seed - 1,
        slowest.1,
        slowest.0
    );
    for (name, [good, refused]) in &counts {
        println!("{name:40} {good:9} used {refused:9} refused");
        assert!(*good > 0, "no call of {name} was ever used: the fuzz does not reach its inside");
    }
}
