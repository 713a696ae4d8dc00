//! Results of unknown number: rows of numbers.

use crate::ffi::guard::{guard, guard_silent};
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::{check_pointer, total};
use crate::ffi::spline::filled;
use crate::ffi::status::Failure;

/// Rows of numbers that a call found, as many as there are. Opaque and unchanging.
pub struct Table {
    columns: usize,
    values: Vec<f64>,
}

impl Table {
    pub(super) fn new<const COLUMNS: usize>(rows: impl IntoIterator<Item = [f64; COLUMNS]>) -> Self {
        Self { columns: COLUMNS, values: rows.into_iter().flatten().collect() }
    }
}

/// Numbers of rows and columns of a table.
///
/// Owner: the caller gives the places.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_table_size(
    table: *const Table,
    rows: *mut usize,
    columns: *mut usize,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for two numbers.
        let (table, rows, columns) = unsafe {
            (handle::borrow(table, "table")?, Out::new(rows, "rows")?, Out::new(columns, "columns")?)
        };
        rows.write(table.values.len() / table.columns);
        columns.write(table.columns);
        Ok(())
    })
}

/// The numbers of a table.
///
/// rows: how many rows `out` has room for; fewer than bladesmith_table_size() tells are refused.
/// out: [rows][columns]. What the columns are is told where the table comes from.
/// Units: told there as well.
/// Owner: the caller gives the array; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_table_data(table: *const Table, rows: usize, out: *mut f64) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle.
        let table = unsafe { handle::borrow(table, "table")? };
        let needed = table.values.len() / table.columns;
        if rows < needed {
            return Err(Failure::TooSmall { capacity: rows, needed, unit: "rows" });
        }
        check_pointer(out, total(rows, table.columns, "rows")?, "out")?;
        // SAFETY: the header asks for room for as many rows.
        unsafe { filled(out, table.values.len(), "out")? }.fill(table.values.iter().copied());
        Ok(())
    })
}

/// Frees a table; NULL is fine. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_table_free(table: *mut Table) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(table) });
}
