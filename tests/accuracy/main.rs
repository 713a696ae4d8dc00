//! Splines against exact arithmetic.

mod curves;
mod exact;
mod reshape;
mod surfaces;
mod wild;
