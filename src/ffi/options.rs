//! Settings of a morph as C passes them, and their way into the core's.

use super::guard::guard_silent;
use super::slice::{slice, text};
use crate::error::{Error, Result};
use crate::morph::Options;
use std::ffi::c_char;
use std::mem::offset_of;

/// Settings of a morph. Fill it with bladesmith_morph_options_init() and change what you need.
/// Pointers may be NULL where their count is 0; all they point to is only read, during the call.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct MorphOptions {
    /// sizeof(bladesmith_morph_options) as you compiled it; set by bladesmith_morph_options_init().
    pub size: usize,
    /// Multiplies the displacement: 1 adds the field, -1 takes it away. Default 1.
    pub factor: f64,
    /// Largest deviation, in mm, that still counts as success; the fit itself aims lower. Positive;
    /// default 1e-3.
    pub tolerance_mm: f64,
    /// How far a node may lie off the part, in mm; 0, the default, chooses from the part's size.
    pub match_tolerance_mm: f64,
    /// Length unit of the field in mm (1000 for metres); 0, the default, means mm and refuses a
    /// field whose size shows another unit.
    pub field_unit_mm: f64,
    /// Further factor on the displacements alone. Default 1.
    pub displacement_scale: f64,
    /// Solid to morph, from 1; 0, the default, takes the only one that the field covers.
    pub solid: u32,
    /// Not 0: extend the field over areas without nodes however far that is. Default 0.
    pub extrapolate: u32,
    /// Not 0: also fit without the nodes whose number is divisible by 10, and report the error
    /// there. Default 0.
    pub holdout: u32,
    /// Number of threads; 0, the default, uses all processors. The result does not depend on it.
    pub threads: u32,
    /// [moving_count] faces that move, from 1; all others stay. None: all move.
    pub moving_faces: *const u32,
    /// Length of moving_faces.
    pub moving_count: usize,
    /// [fixed_count] faces that stay where they are, from 1.
    pub fixed_faces: *const u32,
    /// Length of fixed_faces.
    pub fixed_count: usize,
    /// [face_names_count] names of the part's faces by index, for messages and the report, UTF-8;
    /// NULL or "" for a face without a name.
    pub face_names: *const *const c_char,
    /// Length of face_names: the part's number of faces, or 0.
    pub face_names_count: usize,
    /// What the report calls the solid, UTF-8; may be NULL.
    pub solid_name: *const c_char,
}

/// Bytes of the struct as first released: smaller ones were never made.
const FIRST_SIZE: usize = offset_of!(MorphOptions, solid_name) + size_of::<*const c_char>();

/// A size beyond this is no size but memory that nobody set.
const LARGEST_SIZE: usize = 4096;

/// More threads than this are a mistake.
const MOST_THREADS: u32 = 1024;

impl Default for MorphOptions {
    fn default() -> Self {
        let core = Options::default();
        Self {
            size: size_of::<Self>(),
            factor: core.factor,
            tolerance_mm: core.tolerance_mm,
            match_tolerance_mm: 0.0,
            field_unit_mm: 0.0,
            displacement_scale: core.displacement_scale,
            solid: 0,
            extrapolate: u32::from(core.extrapolate),
            holdout: u32::from(core.holdout),
            threads: 0,
            moving_faces: std::ptr::null(),
            moving_count: 0,
            fixed_faces: std::ptr::null(),
            fixed_count: 0,
            face_names: std::ptr::null(),
            face_names_count: 0,
            solid_name: std::ptr::null(),
        }
    }
}

/// Sets all options to their defaults.
///
/// options: the struct to fill; nothing happens if it is NULL.
/// size: sizeof(bladesmith_morph_options); bytes that this library does not know become 0, and so
/// does everything if the struct is smaller than any released one, which bladesmith_morph() then
/// refuses.
/// Owner: the caller's struct; it holds nothing to be freed.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_morph_options_init(options: *mut MorphOptions, size: usize) {
    guard_silent(|| {
        if options.is_null() {
            return;
        }
        let defaults = MorphOptions { size, ..MorphOptions::default() };
        // SAFETY: the header asks for room for `size` bytes; no more are written.
        unsafe {
            options.cast::<u8>().write_bytes(0, size);
            if size >= FIRST_SIZE {
                let known = size.min(size_of::<MorphOptions>());
                options.cast::<u8>().copy_from_nonoverlapping((&raw const defaults).cast(), known);
            }
        }
    });
}

impl MorphOptions {
    /// Reads the struct of a program compiled against an older or newer header; NULL gives the
    /// defaults.
    ///
    /// # Errors
    /// [`Error::Argument`] for a size that cannot be, or one with settings unknown here.
    ///
    /// # Safety
    /// If not NULL, `options` must point to as many bytes as its `size` says.
    pub(super) unsafe fn read(options: *const Self) -> Result<Self> {
        let mut known = Self::default();
        if options.is_null() {
            return Ok(known);
        }
        let refuse = |why: String| Err(Error::Argument { name: "options", why });
        if !options.is_aligned() {
            return refuse(format!("is not aligned to {} bytes", align_of::<Self>()));
        }
        // SAFETY: every struct ever released starts with its size; the rest is within that.
        let (size, bytes) = unsafe {
            let size = options.cast::<usize>().read();
            if !(FIRST_SIZE..=LARGEST_SIZE).contains(&size) {
                return refuse(format!(
                    "its size is {size}, but it has {} bytes: fill it with bladesmith_morph_options_init first",
                    size_of::<Self>()
                ));
            }
            (size, std::slice::from_raw_parts(options.cast::<u8>(), size))
        };
        if let Some(unknown) = bytes.iter().skip(size_of::<Self>()).position(|&byte| byte != 0) {
            return refuse(format!(
                "byte {} is set, which this library of release {} does not know: update the library",
                size_of::<Self>() + unknown,
                env!("CARGO_PKG_VERSION")
            ));
        }
        // SAFETY: any bytes make a valid struct of numbers and pointers; both sides are long enough.
        unsafe {
            let target = (&raw mut known).cast::<u8>();
            target.copy_from_nonoverlapping(bytes.as_ptr(), size.min(size_of::<Self>()));
        }
        Ok(known)
    }

    /// The core's settings, checked as far as they do not depend on part and field.
    ///
    /// # Errors
    /// [`Error::Argument`] naming the option.
    ///
    /// # Safety
    /// The arrays and texts must be as long as their counts say.
    pub(super) unsafe fn to_core(self) -> Result<Options> {
        // SAFETY: promised by the caller.
        let (moving_faces, fixed_faces, face_names, solid_name) = unsafe {
            (
                faces(slice(self.moving_faces, self.moving_count, "moving_faces")?, "moving_faces")?,
                faces(slice(self.fixed_faces, self.fixed_count, "fixed_faces")?, "fixed_faces")?,
                slice(self.face_names, self.face_names_count, "face_names")?
                    .iter()
                    .map(|&name| Ok(text(name, "face_names")?.unwrap_or_default().to_owned()))
                    .collect::<Result<_>>()?,
                text(self.solid_name, "solid_name")?.unwrap_or_default().to_owned(),
            )
        };
        if self.threads > MOST_THREADS {
            let why = format!("is {}; give at most {MOST_THREADS}, or 0 for all processors", self.threads);
            return Err(Error::Argument { name: "threads", why });
        }
        Ok(Options {
            factor: number(self.factor, "factor", Range::Any)?,
            tolerance_mm: number(self.tolerance_mm, "tolerance_mm", Range::Positive)?,
            match_tolerance_mm: chosen(self.match_tolerance_mm, "match_tolerance_mm")?,
            field_unit_mm: chosen(self.field_unit_mm, "field_unit_mm")?,
            displacement_scale: number(self.displacement_scale, "displacement_scale", Range::Any)?,
            solid: (self.solid > 0).then_some(self.solid as usize),
            moving_faces,
            fixed_faces,
            extrapolate: self.extrapolate != 0,
            holdout: self.holdout != 0,
            face_names,
            solid_name,
        })
    }
}

/// Which finite numbers an option takes.
#[derive(Clone, Copy, PartialEq)]
enum Range {
    Any,
    Positive,
    NotNegative,
}

fn number(value: f64, name: &'static str, range: Range) -> Result<f64> {
    let (fits, expected) = match range {
        Range::Any => (true, "a finite number"),
        Range::Positive => (value > 0.0, "a finite number above 0"),
        Range::NotNegative => (value >= 0.0, "a finite number above 0, or 0 for the default"),
    };
    if fits && value.is_finite() {
        return Ok(value);
    }
    Err(Error::Argument { name, why: format!("is {value}; give {expected}") })
}

/// An option whose 0 leaves the choice to the core.
fn chosen(value: f64, name: &'static str) -> Result<Option<f64>> {
    let value = number(value, name, Range::NotNegative)?;
    Ok((value > 0.0).then_some(value))
}

fn faces(numbers: &[u32], name: &'static str) -> Result<Vec<usize>> {
    if let Some(at) = numbers.iter().position(|&face| face == 0) {
        let why = format!("entry {} is 0; faces are numbered from 1", at + 1);
        return Err(Error::Argument { name, why });
    }
    Ok(numbers.iter().map(|&face| face as usize).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A struct as a newer header might define it.
    #[repr(C)]
    struct Newer {
        known: MorphOptions,
        unknown: u64,
    }

    fn read_newer(unknown: u64) -> Result<MorphOptions> {
        let known = MorphOptions { size: size_of::<Newer>(), factor: -1.0, ..MorphOptions::default() };
        let newer = Newer { known, unknown };
        // SAFETY: the size is that of the struct.
        unsafe { MorphOptions::read((&raw const newer).cast()) }
    }

    #[test]
    fn init_gives_the_defaults_of_the_core() {
        let mut options = std::mem::MaybeUninit::<MorphOptions>::uninit();
        // SAFETY: init fills as many bytes as it is told.
        let core = unsafe {
            bladesmith_morph_options_init(options.as_mut_ptr(), size_of::<MorphOptions>());
            MorphOptions::read(options.as_ptr()).and_then(|options| options.to_core())
        };
        assert_eq!(core, Ok(Options::default()));
    }

    #[test]
    fn a_newer_struct_is_read_unless_it_sets_what_is_unknown() {
        assert_eq!(read_newer(0).unwrap().factor, -1.0);
        let why = read_newer(1).unwrap_err().to_string();
        assert!(why.contains(&format!("byte {} is set", size_of::<MorphOptions>())), "{why}");
    }

    #[test]
    fn init_fills_newer_structs_with_zeros_and_never_writes_past_the_size() {
        for size in [0, 7, FIRST_SIZE - 1, FIRST_SIZE, FIRST_SIZE + 16] {
            let mut bytes = [0xaau8; FIRST_SIZE + 24];
            // SAFETY: the array is longer than `size`; init needs no alignment.
            unsafe { bladesmith_morph_options_init(bytes.as_mut_ptr().cast(), size) };
            assert!(bytes[size..].iter().all(|&byte| byte == 0xaa), "size {size}");
            let zero_from = if size < FIRST_SIZE { 0 } else { FIRST_SIZE };
            assert!(bytes[zero_from..size].iter().all(|&byte| byte == 0), "size {size}");
        }
    }

    #[test]
    fn a_size_that_cannot_be_is_refused() {
        for size in [0, 8, FIRST_SIZE - 8, LARGEST_SIZE + 1, usize::MAX] {
            let options = MorphOptions { size, ..MorphOptions::default() };
            // SAFETY: a refused size is not used.
            let why = unsafe { MorphOptions::read(&options) }.unwrap_err().to_string();
            assert!(why.contains(&format!("its size is {size}")), "{why}");
        }
    }

    #[test]
    fn options_out_of_range_are_named() {
        let zero = [3u32, 0];
        let plain = MorphOptions::default();
        let cases = [
            (MorphOptions { factor: f64::NAN, ..plain }, "factor"),
            (MorphOptions { tolerance_mm: 0.0, ..plain }, "tolerance_mm"),
            (MorphOptions { match_tolerance_mm: -1.0, ..plain }, "match_tolerance_mm"),
            (MorphOptions { field_unit_mm: f64::INFINITY, ..plain }, "field_unit_mm"),
            (MorphOptions { displacement_scale: f64::NAN, ..plain }, "displacement_scale"),
            (MorphOptions { threads: MOST_THREADS + 1, ..plain }, "threads"),
            (MorphOptions { moving_faces: zero.as_ptr(), moving_count: 2, ..plain }, "moving_faces"),
            (MorphOptions { fixed_count: 2, ..plain }, "fixed_faces"),
            (MorphOptions { face_names_count: 1, ..plain }, "face_names"),
            (MorphOptions { solid_name: c"\xff".as_ptr(), ..plain }, "solid_name"),
        ];
        for (options, name) in cases {
            // SAFETY: the arrays are as long as announced, or NULL.
            let why = unsafe { options.to_core() }.unwrap_err().to_string();
            assert!(why.starts_with(&format!("argument '{name}'")), "{why}");
        }
    }
}
