//! Plane and space as one generic notion, and the coordinate frames of conics and quadrics.
//!
//! Directions read from a text carry 15 to 17 digits; they are made unit and orthogonal the way
//! Open CASCADE does on reading, so that both evaluate the same points.

use crate::nurbs::Point;
use glam::{DVec2, DVec3};

/// Squared lengths this close to one are left alone, so that normalising twice changes nothing.
const UNIT_SLACK: f64 = 1e-15;

/// A plane or space in which curves live.
pub trait Space: Point + 'static {
    /// What stands on the plane of a conic or of an offset: nothing in the plane, a direction in
    /// space.
    type Normal: Copy + PartialEq + std::fmt::Debug + Send + Sync;
    /// Directions that the text gives for a conic's frame.
    const FRAME_DIRECTIONS: usize;
    /// Coordinates that the text gives for an offset's normal.
    const NORMAL_COORDINATES: usize;

    /// A point from its coordinates; those beyond the dimension are ignored.
    fn from_coordinates(c: [f64; 3]) -> Self;
    /// The coordinates, padded with zeros.
    fn coordinates(self) -> [f64; 3];
    /// The frame of a conic from the directions in the order of the text; `None` when they are
    /// null or parallel.
    fn conic_frame(origin: Self, directions: [Self; 3]) -> Option<Frame<Self>>;
    /// The directions of a frame in the order of the text.
    fn frame_directions(frame: &Frame<Self>) -> [Self; 3];
    /// The normal of an offset from its coordinates; `None` when it is null.
    fn normal(c: [f64; 3]) -> Option<Self::Normal>;
    /// The coordinates of the normal of an offset.
    fn normal_coordinates(normal: Self::Normal) -> [f64; 3];
    /// The direction, not normalised, in which an offset leaves a curve of this tangent.
    fn offset_side(tangent: Self, normal: Self::Normal) -> Self;
}

/// An orthonormal frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame<P: Space> {
    /// The origin.
    pub origin: P,
    /// First axis.
    pub x: P,
    /// Second axis.
    pub y: P,
    /// Third axis, in space. Frames of surfaces may be left-handed.
    pub normal: P::Normal,
}

impl Frame<DVec3> {
    /// A frame from its main axis `z`, the direction `x` made orthogonal to it, and the side of
    /// `y`; `None` when `z` or `x` is null or both are parallel.
    pub fn new(origin: DVec3, z: DVec3, x: DVec3, y: DVec3) -> Option<Self> {
        let mut frame = DVec3::conic_frame(origin, [z, x, y])?;
        if y.dot(frame.y) < 0.0 {
            frame.y = -frame.y;
        }
        Some(frame)
    }
}

/// The unit vector along `v`; `None` when it is null or not finite.
pub fn unit<P: Point>(v: P) -> Option<P> {
    let squared = v.dot(v);
    if (squared - 1.0).abs() <= UNIT_SLACK {
        return Some(v);
    }
    (squared.is_finite() && squared > f64::MIN_POSITIVE).then(|| v / squared.sqrt())
}

impl Space for DVec2 {
    type Normal = ();
    const FRAME_DIRECTIONS: usize = 2;
    const NORMAL_COORDINATES: usize = 0;

    fn from_coordinates(c: [f64; 3]) -> Self {
        DVec2::new(c[0], c[1])
    }
    fn coordinates(self) -> [f64; 3] {
        [self.x, self.y, 0.0]
    }
    fn conic_frame(origin: Self, [x, y, _]: [Self; 3]) -> Option<Frame<Self>> {
        let x = unit(x)?;
        let side = if x.perp_dot(y) < 0.0 { -1.0 } else { 1.0 };
        Some(Frame { origin, x, y: x.perp() * side, normal: () })
    }
    fn frame_directions(frame: &Frame<Self>) -> [Self; 3] {
        [frame.x, frame.y, DVec2::ZERO]
    }
    fn normal(_: [f64; 3]) -> Option<()> {
        Some(())
    }
    fn normal_coordinates(_: ()) -> [f64; 3] {
        [0.0; 3]
    }
    fn offset_side(tangent: Self, _: ()) -> Self {
        DVec2::new(tangent.y, -tangent.x)
    }
}

impl Space for DVec3 {
    type Normal = DVec3;
    const FRAME_DIRECTIONS: usize = 3;
    const NORMAL_COORDINATES: usize = 3;

    fn from_coordinates(c: [f64; 3]) -> Self {
        DVec3::from_array(c)
    }
    fn coordinates(self) -> [f64; 3] {
        self.to_array()
    }
    fn conic_frame(origin: Self, [z, x, _]: [Self; 3]) -> Option<Frame<Self>> {
        let z = unit(z)?;
        let mut x = unit(x)?;
        if x.dot(z).abs() > UNIT_SLACK {
            x = unit(z.cross(x.cross(z)))?;
        }
        Some(Frame { origin, x, y: z.cross(x), normal: z })
    }
    fn frame_directions(frame: &Frame<Self>) -> [Self; 3] {
        [frame.normal, frame.x, frame.y]
    }
    fn normal(c: [f64; 3]) -> Option<DVec3> {
        unit(DVec3::from_array(c))
    }
    fn normal_coordinates(normal: DVec3) -> [f64; 3] {
        normal.to_array()
    }
    fn offset_side(tangent: Self, normal: DVec3) -> Self {
        tangent.cross(normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn making_a_frame_again_changes_nothing() {
        let (z, x, y) = (DVec3::new(0.1, 0.7, -0.3), DVec3::new(0.4, -0.2, 0.9), DVec3::new(1.0, 1.0, 1.0));
        let frame = Frame::new(DVec3::ONE, z, x, y).unwrap();
        assert_eq!(Frame::new(DVec3::ONE, frame.normal, frame.x, frame.y), Some(frame));
        assert!(frame.x.dot(frame.normal).abs() < 1e-15 && frame.y.dot(y) > 0.0);
    }

    #[test]
    fn frames_of_surfaces_keep_their_handedness() {
        let side = |y| Frame::new(DVec3::ZERO, DVec3::Z, DVec3::X, y).unwrap().y;
        assert_eq!([side(DVec3::Y), side(-DVec3::Y)], [DVec3::Y, -DVec3::Y]);
        let flat = |y| DVec2::conic_frame(DVec2::ZERO, [DVec2::X, y, DVec2::ZERO]).unwrap().y;
        assert_eq!([flat(DVec2::Y), flat(-DVec2::Y)], [DVec2::Y, -DVec2::Y]);
    }

    #[test]
    fn null_and_parallel_axes_make_no_frame() {
        for (z, x) in [(DVec3::ZERO, DVec3::X), (DVec3::Z, DVec3::ZERO), (DVec3::Z, -DVec3::Z)] {
            assert_eq!(Frame::new(DVec3::ZERO, z, x, DVec3::Y), None);
        }
    }
}
