//! Measures one operation on one case of files, for a harness that times this library beside
//! others: `driver OPERATION CASE_DIRECTORY OUTPUT_DIRECTORY REPETITIONS [POINTS]`.
//!
//! Prints one JSON line for each way of doing it, with wall and processor seconds of every
//! repetition and the file that holds the answers as little-endian doubles. What a library prepares
//! before its first answer is timed as well; reading and writing are not.

use bladesmith::nurbs::{KnotVector, NurbsCurve, NurbsSurface, SurfaceDerivatives, SurfaceEvaluator};
use bladesmith::ops::intersect::{curves, self_intersections};
use bladesmith::ops::invert::{Nearest, SurfaceInverter};
use bladesmith::ops::offset::{Offset, OffsetCurve};
use glam::{DVec2, DVec3};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Calls of one repetition that are too short to be measured alone.
const CALLS: usize = 10;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let [operation, case, out, repetitions, rest @ ..] = arguments.as_slice() else {
        return Err("arguments: OPERATION CASE_DIRECTORY OUTPUT_DIRECTORY REPETITIONS [POINTS]".into());
    };
    let most = rest.first().map_or(Ok(usize::MAX), |n| n.parse())?;
    let bench = Bench { case: case.into(), out: out.into(), repetitions: repetitions.parse()?, most };
    match operation.as_str() {
        "eval" => bench.evaluate(),
        "project" => bench.project(),
        "cci" => bench.crossings(),
        "selfx" => bench.own_crossings(),
        "offset" => bench.offsets(),
        other => Err(format!("operation {other} is not one of eval, project, cci, selfx, offset").into()),
    }
}

/// One case and how to measure it.
struct Bench {
    case: PathBuf,
    out: PathBuf,
    repetitions: usize,
    most: usize,
}

impl Bench {
    /// Points alone, and with first and second derivatives.
    fn evaluate(&self) -> Result<()> {
        let surface = surface(&self.case.join("surface.txt"))?;
        let uv: Vec<DVec2> = doubles::<2>(&self.case.join("uv.f64"))?.into_iter().map(DVec2::from).collect();
        let mut points = vec![DVec3::ZERO; uv.len()];
        let times = self
            .times(|| SurfaceEvaluator::new(&surface).points_into(&uv, std::hint::black_box(&mut points)));
        self.report(["eval0", "ours", "prepared in the time"], &times, &points, |p| p.to_array())?;
        let mut jets = vec![SurfaceDerivatives::default(); uv.len()];
        let times = self
            .times(|| SurfaceEvaluator::new(&surface).derivatives_into(&uv, std::hint::black_box(&mut jets)));
        let note = ["eval2", "ours", "prepared in the time"];
        self.report(note, &times, &jets, |d| [d.s, d.u, d.v, d.uu, d.uv, d.vv].map(|x| x.to_array()).concat())
    }

    /// Nearest points, one by one and as a batch.
    fn project(&self) -> Result<()> {
        let surface = surface(&self.case.join("surface.txt"))?;
        let all = doubles::<3>(&self.case.join("pts.f64"))?;
        let points: Vec<DVec3> = all.into_iter().take(self.most).map(DVec3::from).collect();
        let one_by_one = |i: &SurfaceInverter| points.iter().map(|&p| i.nearest(p)).collect();
        self.project_with(&surface, ["ours", "one by one"], one_by_one)?;
        self.project_with(&surface, ["ours-batch", "as a batch"], |i| i.nearest_many(&points))
    }

    fn project_with(
        &self,
        surface: &NurbsSurface,
        [name, way]: [&str; 2],
        nearest: impl Fn(&SurfaceInverter) -> Vec<Nearest<DVec2, DVec3>>,
    ) -> Result<()> {
        let (mut found, mut prepared) = (Vec::new(), 0.0);
        let times = self.times(|| {
            let start = processor_seconds();
            let inverter = SurfaceInverter::new(surface).expect("a prepared surface");
            prepared = processor_seconds() - start;
            found = nearest(&inverter);
        });
        let note = format!("{way}; {:.2} ms of the time to prepare", 1e3 * prepared);
        self.report(["project", name, &note], &times, &found, |f| f.at.to_array())
    }

    /// Crossings of two plane curves, ten times in each repetition.
    fn crossings(&self) -> Result<()> {
        let [a, b] = [curve(&self.case.join("a.txt"))?, curve(&self.case.join("b.txt"))?];
        let mut found = Vec::new();
        let times = self.times(|| {
            for _ in 0..CALLS {
                found = curves(std::hint::black_box(&a), &b, 1e-9).expect("few places").crossings;
            }
        });
        self.report_calls(
            ["cci", "ours", "tolerance 1e-9, 10 calls per sample"],
            CALLS,
            &times,
            &found,
            |c| c.at,
        )
    }

    /// Crossings of the untrimmed offset of a curve with itself, the making of it included.
    fn own_crossings(&self) -> Result<()> {
        let source = curve(&self.case.join("wavy.txt"))?;
        let mut found = Vec::new();
        let times = self.times(|| {
            let raw = Offset::new(2.5, 1e-7).raw(std::hint::black_box(&source)).expect("an offset");
            let own = |part: &OffsetCurve| {
                let all = self_intersections(&part.curve, 1e-7).expect("few places").crossings;
                all.into_iter().map(|c| c.at.map(|t| part.source_parameter(t))).collect::<Vec<_>>()
            };
            found = raw.iter().flat_map(own).collect();
        });
        let note = "offset as NURBS to 1e-7 in the time, its crossings within 1e-7";
        self.report_calls(["selfx", "ours", note], 1, &times, &found, |at| *at)
    }

    /// Trimmed offsets of a closed section, positive distances outward, ten times in each repetition.
    /// The answers are points along all curves.
    fn offsets(&self) -> Result<()> {
        let section = curve(&self.case.join("section.txt"))?;
        let area: f64 = section.poles().windows(2).map(|w| w[0].perp_dot(w[1])).sum();
        for outward in [1.0, 3.0, -1.5, -2.5] {
            let offset = Offset::new(-outward * area.signum(), 1e-6);
            let mut found = Vec::new();
            let times = self.times(|| {
                for _ in 0..CALLS {
                    found = offset.trimmed(std::hint::black_box(&section)).expect("an offset");
                }
            });
            let along = |part: &OffsetCurve| {
                let (a, b) = part.curve.knots().domain();
                let at = |k: usize| part.curve.point(a + (b - a) * k as f64 / 4000.0).to_array();
                (0..=4000).flat_map(at).collect::<Vec<f64>>()
            };
            let (name, poles) = (format!("offset{outward:+}"), found.iter().map(|f| f.curve.poles().len()));
            let note = format!(
                "tolerance 1e-6, 10 calls per sample, {} curves of {} poles",
                found.len(),
                poles.sum::<usize>()
            );
            self.report_calls([&name, "ours", &note], CALLS, &times, &found, along)?;
        }
        Ok(())
    }

    /// Wall and processor seconds of each repetition.
    fn times(&self, mut work: impl FnMut()) -> Vec<[f64; 2]> {
        let repetition = |_| {
            let (start, used) = (Instant::now(), processor_seconds());
            work();
            [start.elapsed().as_secs_f64(), processor_seconds() - used]
        };
        (0..self.repetitions).map(repetition).collect()
    }

    /// As [`report_calls`](Self::report_calls), with one answer to a call.
    fn report<T, N: AsRef<[f64]>>(
        &self,
        names: [&str; 3],
        times: &[[f64; 2]],
        answers: &[T],
        numbers: impl Fn(&T) -> N,
    ) -> Result<()> {
        self.report_calls(names, answers.len(), times, answers, numbers)
    }

    /// Writes the answers and prints the line; a repetition has so many calls.
    fn report_calls<T, N: AsRef<[f64]>>(
        &self,
        [operation, name, note]: [&str; 3],
        calls: usize,
        times: &[[f64; 2]],
        answers: &[T],
        numbers: impl Fn(&T) -> N,
    ) -> Result<()> {
        let case = self.case.file_name().ok_or("the case has no name")?.to_string_lossy();
        let file = self.out.join(format!("{case}.{operation}.{name}.f64"));
        let bytes = answers
            .iter()
            .flat_map(|a| numbers(a).as_ref().iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>());
        std::fs::write(&file, bytes.collect::<Vec<u8>>())?;
        let line = serde_json::json!({
            "peer": name, "op": operation, "case": case, "n": calls, "out": file, "note": note,
            "secs": times.iter().map(|t| t[0]).collect::<Vec<f64>>(),
            "cpu": times.iter().map(|t| t[1]).collect::<Vec<f64>>(),
        });
        println!("{line}");
        Ok(())
    }
}

/// Doubles in groups of `N`.
fn doubles<const N: usize>(file: &Path) -> Result<Vec<[f64; N]>> {
    let bytes = std::fs::read(file).map_err(|e| format!("{}: {e}", file.display()))?;
    let all: Vec<f64> = bytes.as_chunks::<8>().0.iter().map(|&b| f64::from_le_bytes(b)).collect();
    Ok(all.as_chunks::<N>().0.to_vec())
}

/// A surface as text: a word, a version, degrees and numbers of poles along u and v, whether
/// rational, the knots along u and v, and a pole with its weight in each line.
fn surface(file: &Path) -> Result<NurbsSurface> {
    let text = std::fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
    let mut words = text.split_whitespace().skip(2);
    let mut head = [0usize; 5];
    for (value, word) in head.iter_mut().zip(&mut words) {
        *value = word.parse()?;
    }
    let [p, q, nu, nv, rational] = head;
    let numbers = words.map(str::parse).collect::<std::result::Result<Vec<f64>, _>>()?;
    let (u, rest) = numbers.split_at_checked(nu + p + 1).ok_or("knots along u are missing")?;
    let (v, rest) = rest.split_at_checked(nv + q + 1).ok_or("knots along v are missing")?;
    let poles = rest.as_chunks::<4>().0;
    let weights = (rational == 1).then(|| poles.iter().map(|p| p[3]).collect());
    let poles = poles.iter().map(|&[x, y, z, _]| DVec3::new(x, y, z)).collect();
    Ok(NurbsSurface::new(KnotVector::new(p, u.to_vec())?, KnotVector::new(q, v.to_vec())?, poles, weights)?)
}

/// A plane curve as text: a word, a version, degree and number of poles, the knots, and a pole in
/// each line.
fn curve(file: &Path) -> Result<NurbsCurve<DVec2>> {
    let text = std::fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
    let mut words = text.split_whitespace().skip(2);
    let mut head = || words.next().ok_or("degree and number of poles are missing").map(str::parse::<usize>);
    let (p, n) = (head()??, head()??);
    let numbers = words.map(str::parse).collect::<std::result::Result<Vec<f64>, _>>()?;
    let (knots, rest) = numbers.split_at_checked(n + p + 1).ok_or("knots are missing")?;
    let poles = rest.as_chunks::<2>().0.iter().copied().map(DVec2::from).collect();
    Ok(NurbsCurve::new(KnotVector::new(p, knots.to_vec())?, poles, None)?)
}

/// Seconds that this process has spent on processors.
fn processor_seconds() -> f64 {
    unsafe extern "C" {
        fn clock_gettime(clock: i32, time: *mut [i64; 2]) -> i32;
    }
    const PROCESS: i32 = 2;
    let mut time = [0i64; 2];
    // SAFETY: the C library of 64-bit Linux writes two 64-bit numbers, seconds and nanoseconds.
    let status = unsafe { clock_gettime(PROCESS, &mut time) };
    assert_eq!(status, 0, "the system has no processor clock");
    time[0] as f64 + 1e-9 * time[1] as f64
}
