//! A look at part and field before a morph.

use super::field::Field;
use super::guard::guard;
use super::handle;
use super::morph::in_pool;
use super::options::MorphOptions;
use super::part::Part;
use super::progress::{Progress, follow};
use super::text::{Json, TextOut};
use crate::morph;
use std::ffi::{c_char, c_void};

/// How a field lies on a part, as JSON, for a look before bladesmith_morph(): {"nodes",
/// "nodes_on_faces", "unmatched_nodes", "foot_mm": {"mean", "max"}, "match_tolerance_mm",
/// "faces_without_nodes": [...], "warnings": [...]}. It does the first stages of a morph, about a
/// third of the work, and fails where that would refuse the input.
///
/// options: NULL for the defaults.
/// progress, user: called on this thread with user; progress may be NULL.
/// Units: mm.
/// Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it. Each call does
/// the work: a buffer of 64 kB is nearly always enough for the first.
/// Owner: the caller gives the buffer.
/// Errors: those of bladesmith_morph(); BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
/// the buffer left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_check(
    part: *const Part,
    field: *const Field,
    options: *const MorphOptions,
    progress: Progress,
    user: *mut c_void,
    json: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for live handles, a filled struct, `capacity` bytes and one number.
        let (part, field, options, out) = unsafe {
            (
                handle::borrow(part, "part")?,
                handle::borrow(field, "field")?,
                MorphOptions::read(options)?,
                TextOut::new(json, capacity, length)?,
            )
        };
        let threads = options.threads as usize;
        // SAFETY: the header asks for arrays as long as their counts.
        let options = unsafe { options.to_core() }?;
        let work = |progress: morph::Progress<'_>| {
            in_pool(threads, || morph::check(&part.brep, &field.field, &options, progress))
        };
        // SAFETY: the header asks for a callback that may be called with `user`.
        let placement = unsafe { follow(progress, user, work) }?;
        out.write(Json::default().of(|| Ok(placement))?)
    })
}
