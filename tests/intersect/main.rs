//! Intersections of curves against brute force, and where curves touch, overlap or turn back.

mod algebra;
mod overlaps;
mod own;
mod pairs;
mod sample;
mod touches;
