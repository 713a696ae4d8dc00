//! Element kinds: how many nodes they have and which of them make up each face.
//!
//! Node order is that of Abaqus and of CalculiX decks; the `.frd` reader reorders to it. Faces run
//! anticlockwise seen from outside, for elements of positive volume.

use super::source::ElementCount;
use std::fmt;

/// The basic shape of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shape {
    /// Two-node or three-node line; it bounds nothing.
    Line,
    /// Shell with three corners.
    Triangle,
    /// Shell with four corners.
    Quadrilateral,
    /// Volume with four corners.
    Tetrahedron,
    /// Volume with six corners.
    Wedge,
    /// Volume with eight corners.
    Hexahedron,
}

/// A shape, with straight or with curved edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct ElementKind {
    /// The shape.
    pub shape: Shape,
    /// Whether every edge has a mid-side node.
    pub second_order: bool,
}

/// Local node numbers of a face: the corners in turn, and the mid-side nodes, each on the edge
/// that begins at the corner of the same place. Linear elements lack the second.
pub(super) type FaceNodes = (&'static [u8], &'static [u8]);

const TETRAHEDRON: [FaceNodes; 4] =
    [(&[0, 2, 1], &[6, 5, 4]), (&[0, 1, 3], &[4, 8, 7]), (&[1, 2, 3], &[5, 9, 8]), (&[0, 3, 2], &[7, 9, 6])];
const WEDGE: [FaceNodes; 5] = [
    (&[0, 2, 1], &[8, 7, 6]),
    (&[3, 4, 5], &[9, 10, 11]),
    (&[0, 1, 4, 3], &[6, 13, 9, 12]),
    (&[1, 2, 5, 4], &[7, 14, 10, 13]),
    (&[2, 0, 3, 5], &[8, 12, 11, 14]),
];
const HEXAHEDRON: [FaceNodes; 6] = [
    (&[0, 3, 2, 1], &[11, 10, 9, 8]),
    (&[4, 5, 6, 7], &[12, 13, 14, 15]),
    (&[0, 1, 5, 4], &[8, 17, 12, 16]),
    (&[1, 2, 6, 5], &[9, 18, 13, 17]),
    (&[2, 3, 7, 6], &[10, 19, 14, 18]),
    (&[3, 0, 4, 7], &[11, 16, 15, 19]),
];
const TRIANGLE: [FaceNodes; 1] = [(&[0, 1, 2], &[3, 4, 5])];
const QUADRILATERAL: [FaceNodes; 1] = [(&[0, 1, 2, 3], &[4, 5, 6, 7])];

impl Shape {
    /// Whether it encloses a volume.
    pub fn is_volume(self) -> bool {
        matches!(self, Shape::Tetrahedron | Shape::Wedge | Shape::Hexahedron)
    }

    /// Whether it is a shell.
    pub fn is_shell(self) -> bool {
        matches!(self, Shape::Triangle | Shape::Quadrilateral)
    }

    /// Corners and, with second order, mid-side nodes.
    fn node_counts(self) -> (usize, usize) {
        match self {
            Shape::Line => (2, 1),
            Shape::Triangle => (3, 3),
            Shape::Quadrilateral => (4, 4),
            Shape::Tetrahedron => (4, 6),
            Shape::Wedge => (6, 9),
            Shape::Hexahedron => (8, 12),
        }
    }
}

impl ElementKind {
    /// Number of nodes.
    pub fn nodes(self) -> usize {
        let (corners, mid_sides) = self.shape.node_counts();
        if self.second_order { corners + mid_sides } else { corners }
    }

    /// The faces with their mid-side nodes, which only second-order elements have.
    pub(super) fn faces(self) -> &'static [FaceNodes] {
        match self.shape {
            Shape::Line => &[],
            Shape::Triangle => &TRIANGLE,
            Shape::Quadrilateral => &QUADRILATERAL,
            Shape::Tetrahedron => &TETRAHEDRON,
            Shape::Wedge => &WEDGE,
            Shape::Hexahedron => &HEXAHEDRON,
        }
    }

    /// The kind with this number in the element block of an `.frd` file.
    pub(super) fn from_frd(number: i64) -> Option<Self> {
        let (shape, second_order) = match number {
            1 => (Shape::Hexahedron, false),
            2 => (Shape::Wedge, false),
            3 => (Shape::Tetrahedron, false),
            4 => (Shape::Hexahedron, true),
            5 => (Shape::Wedge, true),
            6 => (Shape::Tetrahedron, true),
            7 => (Shape::Triangle, false),
            8 => (Shape::Triangle, true),
            9 => (Shape::Quadrilateral, false),
            10 => (Shape::Quadrilateral, true),
            11 => (Shape::Line, false),
            12 => (Shape::Line, true),
            _ => return None,
        };
        Some(Self { shape, second_order })
    }

    /// Puts nodes from the order of an `.frd` file into that of a deck: there the mid-side nodes of
    /// the upright edges come before those of the top.
    pub(super) fn reorder_from_frd(self, nodes: &mut [i64]) {
        let (_, mid_sides) = self.shape.node_counts();
        if self.second_order && matches!(self.shape, Shape::Wedge | Shape::Hexahedron) {
            let third = mid_sides / 3;
            let corners = nodes.len() - mid_sides;
            nodes[corners + third..].rotate_left(third);
        }
    }

    /// The kind a deck calls `name` (capitals); `None` for elements without a surface of their own.
    pub(super) fn from_deck(name: &str) -> Option<Self> {
        let of = |shape, second_order| Some(Self { shape, second_order });
        match name {
            "STRI3" => return of(Shape::Triangle, false),
            "STRI65" => return of(Shape::Triangle, true),
            "SC6R" => return of(Shape::Wedge, false),
            "SC8R" => return of(Shape::Hexahedron, false),
            _ => (),
        }
        let split = |family: &str| {
            let rest = name.strip_prefix(family)?;
            let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
            rest[..digits].parse::<u32>().ok()
        };
        if let Some(nodes) = ["C3D", "DC3D", "AC3D", "F3D", "DCC3D"].into_iter().find_map(split) {
            return Self::volume_of(nodes);
        }
        match ["S", "DS", "M3D", "SFM3D", "R3D"].into_iter().find_map(split)? {
            3 => of(Shape::Triangle, false),
            4 => of(Shape::Quadrilateral, false),
            6 => of(Shape::Triangle, true),
            8 => of(Shape::Quadrilateral, true),
            _ => None,
        }
    }

    fn volume_of(nodes: u32) -> Option<Self> {
        let (shape, second_order) = match nodes {
            4 => (Shape::Tetrahedron, false),
            6 => (Shape::Wedge, false),
            8 => (Shape::Hexahedron, false),
            10 => (Shape::Tetrahedron, true),
            15 => (Shape::Wedge, true),
            20 => (Shape::Hexahedron, true),
            _ => return None,
        };
        Some(Self { shape, second_order })
    }
}

impl fmt::Display for ElementKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let family = match self.shape {
            Shape::Line => "B3",
            shape if shape.is_shell() => "S",
            _ => "C3D",
        };
        let nodes = if self.shape == Shape::Line { self.nodes() - 1 } else { self.nodes() };
        write!(f, "{family}{nodes}")
    }
}

/// Elements as read, their nodes by number, one after the other.
#[derive(Debug, Default)]
pub(super) struct Elements {
    /// Kind of each element.
    pub kinds: Vec<ElementKind>,
    /// Node numbers of all elements.
    pub nodes: Vec<i64>,
    /// Names and counts of elements that are not understood.
    pub unknown: Vec<(String, usize)>,
}

impl Elements {
    /// Notes an element that is not understood.
    pub fn skip(&mut self, name: &str) {
        match self.unknown.iter_mut().find(|(known, _)| known == name) {
            Some((_, count)) => *count += 1,
            None => self.unknown.push((name.to_string(), 1)),
        }
    }

    /// Kinds and how many there are of each, with those not understood at the end.
    pub fn counts(&self) -> Vec<ElementCount> {
        let mut sorted = self.kinds.clone();
        sorted.sort_unstable();
        let known = sorted.chunk_by(|a, b| a == b).map(|same| (same[0].to_string(), same.len()));
        known.chain(self.unknown.iter().cloned()).map(|(kind, count)| ElementCount { kind, count }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn corners(shape: Shape) -> Vec<DVec3> {
        let at = |list: &[[f64; 3]]| list.iter().map(|&p| DVec3::from(p)).collect();
        match shape {
            Shape::Tetrahedron => at(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]]),
            Shape::Wedge => {
                at(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [1., 0., 1.], [0., 1., 1.]])
            }
            _ => {
                let base = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
                let mut all: Vec<DVec3> = at(&base);
                all.extend(base.iter().map(|&p| DVec3::from(p) + DVec3::Z));
                all
            }
        }
    }

    /// Corner pairs of the mid-side nodes, as the Abaqus manual numbers them.
    fn edges(shape: Shape) -> &'static [(usize, usize)] {
        match shape {
            Shape::Tetrahedron => &[(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
            Shape::Wedge => &[(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
            _ => &[
                (0, 1),
                (1, 2),
                (2, 3),
                (3, 0),
                (4, 5),
                (5, 6),
                (6, 7),
                (7, 4),
                (0, 4),
                (1, 5),
                (2, 6),
                (3, 7),
            ],
        }
    }

    #[test]
    fn faces_look_outward_and_mid_sides_lie_between_their_corners() {
        for shape in [Shape::Tetrahedron, Shape::Wedge, Shape::Hexahedron] {
            let mut points = corners(shape);
            let centre = points.iter().sum::<DVec3>() / points.len() as f64;
            points
                .extend(edges(shape).iter().map(|&(a, b)| (points[a] + points[b]) / 2.0).collect::<Vec<_>>());
            let kind = ElementKind { shape, second_order: true };
            assert_eq!(points.len(), kind.nodes());
            for (face, mid_sides) in kind.faces() {
                let p: Vec<DVec3> = face.iter().map(|&k| points[usize::from(k)]).collect();
                let normal = (p[1] - p[0]).cross(p[2] - p[0]);
                assert!(normal.dot(p[0] - centre) > 0.0, "{kind}: face {face:?} looks inward");
                for (k, &mid) in mid_sides.iter().enumerate() {
                    let between = (p[k] + p[(k + 1) % p.len()]) / 2.0;
                    assert_eq!(points[usize::from(mid)], between, "{kind}: mid-side {mid} of face {face:?}");
                }
            }
        }
    }

    #[test]
    fn frd_order_becomes_deck_order() {
        let mut brick: Vec<i64> = (1..=12).chain(17..=20).chain(13..=16).collect();
        ElementKind::from_frd(4).unwrap().reorder_from_frd(&mut brick);
        assert_eq!(brick, (1..=20).collect::<Vec<_>>());
        let mut wedge: Vec<i64> = (1..=9).chain(13..=15).chain(10..=12).collect();
        ElementKind::from_frd(5).unwrap().reorder_from_frd(&mut wedge);
        assert_eq!(wedge, (1..=15).collect::<Vec<_>>());
        let mut tetrahedron: Vec<i64> = (1..=10).collect();
        ElementKind::from_frd(6).unwrap().reorder_from_frd(&mut tetrahedron);
        assert_eq!(tetrahedron, (1..=10).collect::<Vec<_>>());
    }

    #[test]
    fn deck_names_are_understood_with_their_variants() {
        for (name, shown) in [
            ("C3D10", "C3D10"),
            ("C3D10M", "C3D10"),
            ("C3D20R", "C3D20"),
            ("C3D8I", "C3D8"),
            ("DC3D4", "C3D4"),
            ("S8R5", "S8"),
            ("M3D6", "S6"),
            ("STRI65", "S6"),
        ] {
            assert_eq!(ElementKind::from_deck(name).map(|kind| kind.to_string()).as_deref(), Some(shown));
        }
        for name in ["B31", "SPRING1", "MASS", "C3D5", "CPS4", "T3D2"] {
            assert_eq!(ElementKind::from_deck(name), None, "{name}");
        }
    }
}
