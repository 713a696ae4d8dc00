//! Parts: B-rep text in and out, what is in it, and its surfaces at given parameters.

use super::guard::{guard, guard_silent};
use super::handle::{self, Out};
use super::part_info::PartInfo;
use super::slice::{ArrayOut, check_pointer, finite, slice, text, total};
use super::text::{Json, TextOut};
use crate::brep::{self, Brep, Topology};
use crate::error::{Error, Result};
use crate::nurbs::SurfaceDerivatives;
use rayon::prelude::*;
use std::ffi::c_char;
use std::sync::{Arc, OnceLock};

/// A part: the shapes of one B-rep. Opaque and unchanging: any number of threads may use one
/// handle at once. Lengths are mm.
pub struct Part {
    pub(super) brep: Arc<Brep>,
    text: OnceLock<String>,
    info: Json,
    geometry: OnceLock<(Brep, Topology)>,
}

impl Part {
    pub(super) fn new(brep: Arc<Brep>) -> Self {
        Self { brep, text: OnceLock::new(), info: Json::default(), geometry: OnceLock::new() }
    }

    /// The shapes where they are in space, and how they hang together.
    fn geometry(&self) -> Result<&(Brep, Topology)> {
        if let Some(geometry) = self.geometry.get() {
            return Ok(geometry);
        }
        let mut placed = Brep::clone(&self.brep);
        placed.normalise()?;
        let topology = Topology::new(&placed)?;
        Ok(self.geometry.get_or_init(|| (placed, topology)))
    }
}

/// Reads a part from Open CASCADE's text B-rep (versions 1 to 3), as FreeCAD's exportBrepToString
/// writes it.
///
/// text: [length] bytes; a NUL at the end is not needed.
/// name: what messages call the text, UTF-8; NULL for "B-rep".
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_part_free(); written only on success. The text is
/// copied.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BREP with the line where the text is
/// malformed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_part_read(
    text: *const c_char,
    length: usize,
    name: *const c_char,
    out: *mut *mut Part,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for `length` bytes, a NUL-terminated name and room for a handle.
        let (bytes, name, out) = unsafe {
            (
                slice(text.cast::<u8>(), length, "text")?,
                self::text(name, "name")?.unwrap_or("B-rep"),
                Out::new(out, "out")?,
            )
        };
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
            let why = "this is not text; pass the text form of a B-rep".into();
            Error::Brep { name: name.to_owned(), line, why }
        })?;
        out.hand_over(Part::new(Arc::new(brep::parse(name, text)?)));
        Ok(())
    })
}

/// What is in a part, as JSON: {"solids": [{"index", "closed", "faces": [...]}], "faces": [{"index",
/// "surface", "degree": [u, v], "poles": [u, v], "rational"}], "edges", "vertices",
/// "bounding_box_mm": [[x, y, z], [x, y, z]]}. Faces are numbered from 1 in the order of Open
/// CASCADE's and FreeCAD's; degree and poles are null for surfaces without poles.
///
/// Units: mm. The box is that of points on the faces and edges: it may fall short of the true one
/// by the sag between them.
/// Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
/// Owner: the caller gives the buffer.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
/// the buffer left alone; BLADESMITH_STATUS_BREP, BLADESMITH_STATUS_FACE, BLADESMITH_STATUS_SPLINE
/// for shapes that do not hang together.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_part_info(
    part: *const Part,
    json: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle, `capacity` bytes and one number.
        let (part, out) = unsafe { (handle::borrow(part, "part")?, TextOut::new(json, capacity, length)?) };
        let info = part.info.of(|| {
            let (brep, topology) = part.geometry()?;
            Ok(PartInfo::new(brep, topology))
        })?;
        out.write(info)
    })
}

/// Writes a part as Open CASCADE's text B-rep, for FreeCAD's importBrepFromString. Numbers are
/// written so that they read back the same to the last bit.
///
/// Units: mm.
/// Text: `*length` is set to the bytes without the NUL; capacity 0 only asks for it.
/// Owner: the caller gives the buffer.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL, with `*length` set and
/// the buffer left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_part_write(
    part: *const Part,
    text: *mut c_char,
    capacity: usize,
    length: *mut usize,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle, `capacity` bytes and one number.
        let (part, out) = unsafe { (handle::borrow(part, "part")?, TextOut::new(text, capacity, length)?) };
        out.write(part.text.get_or_init(|| part.brep.write()))
    })
}

/// Points and derivatives of the surface under a face, trims left aside.
///
/// face: number of the face, from 1.
/// uv: [points][2] surface parameters.
/// order: highest derivative, 0 to 2.
/// out: [points][3 * k], where k is 1, 3 or 6 for order 0, 1 or 2: S, then S_u S_v, then
/// S_uu S_uv S_vv, x y z each. A reversed face does not change them; they are NaN where the basis
/// of an offset surface has no normal.
/// Units: mm, and mm per parameter.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for a face that is not there or parameters that are not
/// finite; BLADESMITH_STATUS_BREP, BLADESMITH_STATUS_FACE, BLADESMITH_STATUS_SPLINE for shapes that
/// do not hang together.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_part_evaluate(
    part: *const Part,
    face: u32,
    uv: *const f64,
    points: usize,
    order: u32,
    out: *mut f64,
) -> i32 {
    guard(|| {
        let refuse = |name, why| Err(Error::Argument { name, why }.into());
        let Some(&vectors) = [1, 3, 6].get(order as usize) else {
            return refuse("order", format!("is {order}; give 0, 1 or 2"));
        };
        let (parameters, numbers) = (total(points, 2, "points")?, total(points, 3 * vectors, "points")?);
        check_pointer(out, numbers, "out")?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (part, uv, out) = unsafe {
            (handle::borrow(part, "part")?, slice(uv, parameters, "uv")?, ArrayOut::new(out, numbers, "out")?)
        };
        finite(uv, 2, "uv")?;
        let (brep, topology) = part.geometry()?;
        let Some(face) = (face as usize).checked_sub(1).and_then(|face| topology.faces.get(face)) else {
            return refuse("face", format!("is {face}; the part's faces are 1 to {}", topology.faces.len()));
        };
        let surface = &brep.surfaces[face.surface];
        let values: Vec<_> = uv.par_chunks(2).map(|uv| flat(&surface.derivatives(uv[0], uv[1]))).collect();
        out.fill(values.iter().flat_map(|values| values[..3 * vectors].iter().copied()));
        Ok(())
    })
}

/// Frees a part; NULL is fine. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_part_free(part: *mut Part) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(part) });
}

/// S, S_u, S_v, S_uu, S_uv, S_vv.
fn flat(d: &SurfaceDerivatives) -> [f64; 18] {
    let mut numbers = [0.0; 18];
    for (target, vector) in numbers.chunks_mut(3).zip([d.s, d.u, d.v, d.uu, d.uv, d.vv]) {
        target.copy_from_slice(&vector.to_array());
    }
    numbers
}
