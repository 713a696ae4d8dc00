//! Small good files with random damage: an answer or a clear error, never a panic.

use crate::p5::mix;
use crate::{file, packed};
use bladesmith::Error;
use bladesmith::fe::{ReadOptions, read};

const ROUNDS: u64 = 2000;

/// Bytes that mean something in these formats come more often than others.
const TELLING: &[u8] = b"-0123456789.,;*#=EeDN\n\r \t\"\xff\0";

const RESULTS: &str = "    1C
    2C                             5                                     1
 -1         1 0.00000E+00 0.00000E+00 0.00000E+00
 -1         2 1.00000E+00 0.00000E+00 0.00000E+00
 -1         3 0.00000E+00 1.00000E+00 0.00000E+00
 -1         4 0.00000E+00 0.00000E+00 1.00000E+00
 -1         5 1.00000E+00 1.00000E+00 1.00000E+00
 -3
    3C                             2                                     1
 -1         1    3    0    1
 -2         1         2         3         4
 -1         2    3    0    1
 -2         2         3         4         5
 -3
    1PSTEP                         1           1           1
  100CL  101 1.000000000           5                     0    1           1
 -4  DISP        4    1
 -5  D1          1    2    1    0
 -5  D2          1    2    2    0
 -5  D3          1    2    3    0
 -5  ALL         1    2    0    0    1ALL
 -1         1 1.00000E-03 0.00000E+00 0.00000E+00
 -1         2 1.00000E-03 0.00000E+00-1.50000E-03
 -1         3 1.00000E-03 0.00000E+00 0.00000E+00
 -1         4 1.00000E-03 2.00000E-04 0.00000E+00
 -1         5 1.00000E-03 0.00000E+00 0.00000E+00
 -3
 9999
";

const DECK: &str = "*HEADING
*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 0., 1., 0.
4, 0., 0., 1.
5, 1., 1., 1.
*ELEMENT, TYPE=C3D4, ELSET=E
1, 1, 2, 3, 4
2, 2, 3,
4, 5
*STEP
";

const TABLE: &str = "# nodes
id;x;y;z;dx;dy;dz
1;0,0;0;0;1e-3;0;0
2;1,0;0;0;1e-3;0;0
5;1,0;1;1;;;
";

struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 += 1;
        (mix(self.0) % limit.max(1) as u64) as usize
    }
}

fn damaged(good: &[u8], seed: u64) -> Vec<u8> {
    let mut dice = Dice(seed << 20);
    let mut bytes = good.to_vec();
    for _ in 0..=dice.below(4) {
        let at = dice.below(bytes.len());
        let byte =
            if dice.below(4) == 0 { dice.below(256) as u8 } else { TELLING[dice.below(TELLING.len())] };
        match dice.below(6) {
            0 => bytes.truncate(at),
            1 => bytes.insert(at, byte),
            2 => drop(bytes.drain(at..bytes.len().min(at + 1 + dice.below(40)))),
            3 => {
                let copy = bytes[at..bytes.len().min(at + dice.below(120))].to_vec();
                let to = dice.below(bytes.len());
                bytes.splice(to..to, copy);
            }
            _ if !bytes.is_empty() => bytes[at] = byte,
            _ => (),
        }
    }
    bytes
}

/// Reads damaged copies of `good`, as results or as the deck of good results; returns how many
/// were readable.
fn survive(name: &str, good: &[u8], as_deck: bool) -> u64 {
    let results = file(&format!("{name}.good.frd"), RESULTS);
    let mut readable = 0;
    for seed in 0..ROUNDS {
        let bad = file(name, damaged(good, seed));
        let outcome = if as_deck {
            read(&results, &ReadOptions { mesh: Some(bad), step: None })
        } else {
            read(&bad, &ReadOptions { mesh: None, step: (seed % 3 == 0).then_some(1) })
        };
        match outcome {
            Ok(field) => {
                readable += 1;
                let nodes = field.ids.len();
                assert!(field.ids.is_sorted_by(|a, b| a < b), "{name}, seed {seed}: numbers out of order");
                assert_eq!(
                    (field.points.len(), field.displacements.len()),
                    (nodes, nodes),
                    "{name}, seed {seed}"
                );
                assert!(field.points.iter().all(|point| point.is_finite()), "{name}, seed {seed}");
                field.summary();
            }
            Err(Error::Field { .. } | Error::Io { .. }) => (),
            Err(other) => panic!("{name}, seed {seed}: {other:?}"),
        }
    }
    readable
}

#[test]
fn damaged_files_never_cause_a_panic() {
    let binary = crate::data("fe/brick_and_wedge_binary.frd.gz");
    let binary = std::fs::read(binary).expect("the binary results");
    let mut plain = Vec::new();
    std::io::Read::read_to_end(&mut flate2::read::GzDecoder::new(&binary[..]), &mut plain)
        .expect("packed results");
    for (name, good, as_deck) in [
        ("mutated.frd", RESULTS.as_bytes(), false),
        ("mutated.csv", TABLE.as_bytes(), false),
        ("mutated.inp", DECK.as_bytes(), true),
        ("mutated_binary.frd", &plain, false),
        ("mutated.frd.gz", &packed(RESULTS), false),
    ] {
        let readable = survive(name, good, as_deck);
        println!("{name}: {readable} of {ROUNDS} were still readable");
        assert!(readable < ROUNDS, "{name}: no damage was noticed");
    }
}
