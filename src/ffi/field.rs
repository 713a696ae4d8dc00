//! Displacement fields: from files, from arrays, and what is in them.

use super::guard::{guard, guard_silent};
use super::handle::{self, Out};
use super::slice::{file_name, finite, slice, text, total};
use super::text::{Json, TextOut};
use crate::error::Error;
use crate::fe;
use glam::DVec3;
use std::ffi::c_char;

/// A displacement field on the nodes of an FE mesh. Opaque and unchanging: any number of threads
/// may use one handle at once. Lengths are in the unit of the file or the arrays it came from.
pub struct Field {
    pub(super) field: fe::Field,
    info: Json,
}

/// Reads a displacement field from a CalculiX result file (`.frd`, text or binary) or from CSV with
/// the columns id,x,y,z,dx,dy,dz; either may be gzipped.
///
/// path: file name, NUL-terminated.
/// mesh_path: CalculiX deck (`.inp`) of the same nodes, for their full-precision coordinates
/// (an `.frd` keeps six digits), or NULL.
/// step: result step to use, from 1; 0 for the last.
/// Units: those of the file; nothing is converted.
/// Owner: `*out` is the caller's, for bladesmith_field_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_IO where a file cannot be opened;
/// BLADESMITH_STATUS_FIELD with file and line where one holds no usable displacements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_field_read(
    path: *const c_char,
    mesh_path: *const c_char,
    step: u32,
    out: *mut *mut Field,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for NUL-terminated texts and room for one handle.
        let (path, mesh, out) =
            unsafe { (file_name(path, "path")?, file_name(mesh_path, "mesh_path")?, Out::new(out, "out")?) };
        let path = path.ok_or(Error::Argument { name: "path", why: "is NULL; pass a file name".into() })?;
        let step = (step > 0).then_some(step as usize);
        let field = fe::read(&path, &fe::ReadOptions { mesh, step })?;
        out.hand_over(Field { field, info: Json::default() });
        Ok(())
    })
}

/// Makes a displacement field from arrays, which are copied.
///
/// name: what messages and the report call it, UTF-8; NULL for "arrays".
/// ids: [nodes] node numbers in any order. Of a node given more than once the last displacement is
/// used, with a warning in the report where they differ.
/// xyz: [nodes][3] coordinates of the nodes.
/// u: [nodes][3] displacements.
/// Units: one and the same length unit for xyz and u; mm unless the options of the morph say
/// otherwise.
/// Owner: `*out` is the caller's, for bladesmith_field_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for values that are not finite; BLADESMITH_STATUS_FIELD
/// for no nodes or a node at two places.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_field_from_arrays(
    name: *const c_char,
    ids: *const i64,
    xyz: *const f64,
    u: *const f64,
    nodes: usize,
    out: *mut *mut Field,
) -> i32 {
    guard(|| {
        let numbers = total(nodes, 3, "nodes")?;
        // SAFETY: the header states the lengths of the arrays.
        let (name, ids, xyz, u, out) = unsafe {
            (
                text(name, "name")?.unwrap_or("arrays"),
                slice(ids, nodes, "ids")?,
                slice(xyz, numbers, "xyz")?,
                slice(u, numbers, "u")?,
                Out::new(out, "out")?,
            )
        };
        finite(xyz, 3, "xyz")?;
        finite(u, 3, "u")?;
        let field = fe::Field::from_arrays(name, ids, &vectors(xyz), &vectors(u))?;
        out.hand_over(Field { field, info: Json::default() });
        Ok(())
    })
}

/// What is in a field, as JSON: {"name", "format", "compressed", "mesh", "blocks": [{"name", "rows"}],
/// "steps": [{"number", "time", "rows", ...}], "step", "nodes", "nodes_with_result", "surface_nodes",
/// "elements": [{"kind", "count"}], "bounds": [[x, y, z], [x, y, z]], "unit_guess",
/// "largest_displacement": {"value", "node", "at": [x, y, z]}, "warnings": [...]}. What a file does
/// not tell is null.
///
/// Units: those of the field.
/// Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
/// Owner: the caller gives the buffer.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
/// the buffer left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_field_info(
    field: *const Field,
    json: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle, `capacity` bytes and one number.
        let (field, out) =
            unsafe { (handle::borrow(field, "field")?, TextOut::new(json, capacity, length)?) };
        out.write(field.info.of(|| Ok(field.field.summary()))?)
    })
}

/// Frees a field; NULL is fine. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_field_free(field: *mut Field) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(field) });
}

/// Three numbers each.
fn vectors(numbers: &[f64]) -> Vec<DVec3> {
    numbers.chunks_exact(3).map(DVec3::from_slice).collect()
}
