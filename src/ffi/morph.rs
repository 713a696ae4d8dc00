//! The morph and its results.

use super::field::Field;
use super::guard::{guard, guard_silent};
use super::handle::{self, Out};
use super::options::MorphOptions;
use super::part::Part;
use super::progress::{Progress, follow};
use super::slice::{ArrayOut, total};
use super::status::Failure;
use super::text::{Json, TextOut};
use crate::error::{Error, Result};
use crate::morph::{self, NodeResult, Report};
use std::ffi::{c_char, c_void};
use std::sync::Arc;

/// A morphed solid with its report. Opaque and unchanging: any number of threads may use one
/// handle at once. It depends on no other handle.
pub struct Morphed {
    brep: Arc<crate::brep::Brep>,
    report: Report,
    nodes: Vec<NodeResult>,
    json: Json,
}

/// Morphs one solid of a part by a field: x_out = x_in + factor * u(x_in) for every face, edge and
/// vertex, with the same topology and the same order of faces.
///
/// options: NULL for the defaults.
/// progress, user: called on this thread with user; progress may be NULL.
/// Units: mm, and those the options name. Equal input gives equal results, to the last bit.
/// Owner: `*out` is the caller's, for bladesmith_morphed_free(); written only on success. Part and
/// field may be freed before it.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_CANCELLED; BLADESMITH_STATUS_SOLID,
/// BLADESMITH_STATUS_FACE, BLADESMITH_STATUS_SPLINE for a part that cannot be worked on;
/// BLADESMITH_STATUS_MISMATCH where field and part do not belong together;
/// BLADESMITH_STATUS_NUMERICS. A deviation above tolerance_mm is no error: compare the report's
/// deviation_mm.max.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_morph(
    part: *const Part,
    field: *const Field,
    options: *const MorphOptions,
    progress: Progress,
    user: *mut c_void,
    out: *mut *mut Morphed,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for live handles, a filled struct and room for one handle.
        let (part, field, options, out) = unsafe {
            (
                handle::borrow(part, "part")?,
                handle::borrow(field, "field")?,
                MorphOptions::read(options)?,
                Out::new(out, "out")?,
            )
        };
        let threads = options.threads as usize;
        // SAFETY: the header asks for arrays as long as their counts.
        let options = unsafe { options.to_core() }?;
        let work = |progress: morph::Progress<'_>| {
            in_pool(threads, || morph::morph(&part.brep, &field.field, &options, progress))
        };
        // SAFETY: the header asks for a callback that may be called with `user`.
        let morph::Morphed { brep, report, nodes } = unsafe { follow(progress, user, work) }?;
        out.hand_over(Morphed { brep: Arc::new(brep), report, nodes, json: Json::default() });
        Ok(())
    })
}

/// The morphed solid as a part of its own.
///
/// Owner: `*out` is the caller's, for bladesmith_part_free(); written only on success. It does not
/// depend on the handle it came from.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_morphed_part(morphed: *const Morphed, out: *mut *mut Part) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for one.
        let (morphed, out) = unsafe { (handle::borrow(morphed, "morphed")?, Out::new(out, "out")?) };
        out.hand_over(Part::new(Arc::clone(&morphed.brep)));
        Ok(())
    })
}

/// The report of a morph as JSON: {"deviation_mm": {"mean", "max"}, "faces": [...], "edges": [...],
/// "solid": {...}, "warnings": [...], "seconds": {...}, ...}: deviations at the nodes by face, gaps
/// and angles at every edge, volume, area and tolerances before and after, warnings, times.
///
/// Units: mm, mm^2, mm^3, degrees, seconds; each name says so.
/// Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
/// Owner: the caller gives the buffer.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
/// the buffer left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_morphed_report(
    morphed: *const Morphed,
    json: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle, `capacity` bytes and one number.
        let (morphed, out) =
            unsafe { (handle::borrow(morphed, "morphed")?, TextOut::new(json, capacity, length)?) };
        out.write(morphed.json.of(|| Ok(&morphed.report))?)
    })
}

/// What became of every FE node on every face it lies on, for colour maps and tables. A node on an
/// edge has an entry for each face that meets there.
///
/// capacity: entries that each array given has room for; 0 only asks for their number.
/// ids: [capacity] node numbers.
/// faces: [capacity] faces, from 1.
/// feet: [capacity][3] foot points on the input solid.
/// displacements: [capacity][3] displacements applied there, factor included.
/// deviations: [capacity][3] what the output surface misses there.
/// Any of the arrays may be NULL and is then left out.
/// count: set to the number of entries, also where the arrays are too small.
/// Units: mm.
/// Owner: the caller gives the arrays.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*count` set and
/// the arrays left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_morphed_nodes(
    morphed: *const Morphed,
    capacity: usize,
    ids: *mut i64,
    faces: *mut u32,
    feet: *mut f64,
    displacements: *mut f64,
    deviations: *mut f64,
    count: *mut usize,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and one number.
        let (morphed, count) = unsafe { (handle::borrow(morphed, "morphed")?, Out::new(count, "count")?) };
        let nodes = &morphed.nodes;
        count.write(nodes.len());
        if capacity == 0 {
            return Ok(());
        }
        if capacity < nodes.len() {
            return Err(Failure::TooSmall { capacity, needed: nodes.len(), unit: "nodes" });
        }
        // SAFETY: the header asks for arrays with room for `capacity` entries, or NULL.
        let (ids, faces, feet, displacements, deviations) = unsafe {
            (
                ArrayOut::new(ids, capacity, "ids")?,
                ArrayOut::new(faces, capacity, "faces")?,
                ArrayOut::new(feet, total(capacity, 3, "capacity")?, "feet")?,
                ArrayOut::new(displacements, total(capacity, 3, "capacity")?, "displacements")?,
                ArrayOut::new(deviations, total(capacity, 3, "capacity")?, "deviations")?,
            )
        };
        ids.fill(nodes.iter().map(|node| node.id));
        faces.fill(nodes.iter().map(|node| node.face));
        feet.fill(nodes.iter().flat_map(|node| node.foot.to_array()));
        displacements.fill(nodes.iter().flat_map(|node| node.displacement.to_array()));
        deviations.fill(nodes.iter().flat_map(|node| node.deviation.to_array()));
        Ok(())
    })
}

/// Frees a morphed solid; NULL is fine. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_morphed_free(morphed: *mut Morphed) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(morphed) });
}

/// Runs `work` on so many threads; 0 takes the pool that uses all processors.
pub(super) fn in_pool<T: Send>(threads: usize, work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
    if threads == 0 {
        return work();
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| {
        Error::Internal { why: format!("{threads} threads could not be started: {error}") }
    })?;
    pool.install(work)
}
