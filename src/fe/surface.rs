//! The surface of a mesh: the faces that only one volume element has.
//!
//! Faces with the same smallest corner hang together in a chain, in which a new face is looked
//! for. Chains are short, so the work grows with the number of elements alone.

use super::elements::ElementKind;

/// Stands for the mid-side nodes that a linear triangle lacks.
pub const NO_NODE: u32 = u32::MAX;

/// The end of a chain of faces.
const NO_FACE: u32 = u32::MAX;

/// The surface of a mesh, as indices of nodes.
#[derive(Debug, Default, Clone, PartialEq)]
pub(super) struct Surface {
    /// Nodes on the surface, ascending.
    pub nodes: Vec<u32>,
    /// Each mid-side node on the surface with its two corners, ascending.
    pub mid_sides: Vec<[u32; 3]>,
    /// Triangles: corners anticlockwise from outside, then the nodes between the first and second,
    /// second and third, third and first, or [`NO_NODE`].
    ///
    /// A linear quadrilateral gives two of them. A second-order one gives six linear triangles over
    /// its eight nodes, because it has no node on its diagonal.
    pub faces: Vec<[u32; 6]>,
    /// Faces that three or more elements claim: the mesh overlaps itself there.
    pub crowded: usize,
}

/// A face of an element, and how many elements have it.
#[derive(Clone, Copy)]
struct Face {
    /// Its distinct corners but the smallest, ascending, filled up with [`NO_NODE`].
    others: [u32; 3],
    /// Next face with the same smallest corner.
    next: u32,
    /// Where its element's nodes begin.
    element: u32,
    kind: ElementKind,
    local: u8,
    owners: u8,
}

/// Extracts the surface of elements whose nodes are given one after the other as indices below
/// `node_count`: the free faces of the volumes, or all shells where there are no volumes.
pub(super) fn extract(kinds: &[ElementKind], nodes: &[u32], node_count: usize) -> Surface {
    let shells = !kinds.iter().any(|kind| kind.shape.is_volume());
    let faces = distinct_faces(kinds, nodes, node_count, shells);
    let mut surface = Surface::default();
    let mut marks = Marks { seen: vec![false; node_count], corners: vec![[NO_NODE; 2]; node_count] };
    for face in &faces {
        if face.owners == 1 || shells {
            surface.add(face, nodes, &mut marks);
        }
        surface.crowded += usize::from(face.owners > 2);
    }
    surface.nodes = (0..node_count as u32).filter(|&node| marks.seen[node as usize]).collect();
    let mid_sides = marks.corners.iter().enumerate().filter(|(_, corners)| corners[0] != NO_NODE);
    surface.mid_sides = mid_sides.map(|(mid_side, &[a, b])| [mid_side as u32, a, b]).collect();
    surface
}

/// The different faces of the shells or of the volumes, in the order of the elements.
fn distinct_faces(kinds: &[ElementKind], nodes: &[u32], node_count: usize, shells: bool) -> Vec<Face> {
    let mut faces: Vec<Face> = Vec::with_capacity(3 * kinds.len());
    let mut chains = vec![NO_FACE; node_count];
    let mut element = 0;
    for &kind in kinds {
        let taken = if shells { kind.shape.is_shell() } else { kind.shape.is_volume() };
        for (local, (corners, _)) in kind.faces().iter().enumerate().filter(|_| taken) {
            let Some([first, others @ ..]) = distinct_corners(corners, &nodes[element..]) else { continue };
            let chain = &mut chains[first as usize];
            let mut place = *chain;
            while place != NO_FACE && faces[place as usize].others != others {
                place = faces[place as usize].next;
            }
            if let Some(known) = faces.get_mut(place as usize) {
                known.owners = known.owners.saturating_add(1);
                continue;
            }
            let (next, element, local) = (*chain, element as u32, local as u8);
            *chain = faces.len() as u32;
            faces.push(Face { others, next, element, kind, local, owners: 1 });
        }
        element += kind.nodes();
    }
    faces
}

/// The distinct corners in order, filled up with [`NO_NODE`]; `None` for a face collapsed to a line.
fn distinct_corners(corners: &[u8], nodes: &[u32]) -> Option<[u32; 4]> {
    let mut sorted = [NO_NODE; 4];
    for (place, &corner) in sorted.iter_mut().zip(corners) {
        *place = nodes[usize::from(corner)];
    }
    sorted.sort_unstable();
    for place in 1..4 {
        if sorted[place] == sorted[place - 1] {
            sorted[place - 1] = NO_NODE;
        }
    }
    sorted.sort_unstable();
    (sorted[2] != NO_NODE).then_some(sorted)
}

/// What is known of each node while the faces are gathered.
struct Marks {
    /// Whether it is on the surface.
    seen: Vec<bool>,
    /// The corners that it lies between.
    corners: Vec<[u32; 2]>,
}

impl Surface {
    fn add(&mut self, face: &Face, nodes: &[u32], marks: &mut Marks) {
        let (corners, mid_sides) = face.kind.faces()[usize::from(face.local)];
        let node = |local: &u8| nodes[face.element as usize + usize::from(*local)];
        let sides = corners.len();
        let mut c = [NO_NODE; 4];
        let mut m = [NO_NODE; 4];
        c.iter_mut().zip(corners).for_each(|(place, local)| *place = node(local));
        if face.kind.second_order {
            m.iter_mut().zip(mid_sides).for_each(|(place, local)| *place = node(local));
        }
        for side in 0..sides {
            let (a, b) = (c[side], c[(side + 1) % sides]);
            marks.seen[a as usize] = true;
            if m[side] != NO_NODE && a != b {
                marks.seen[m[side] as usize] = true;
                marks.corners[m[side] as usize] = [a.min(b), a.max(b)];
            }
        }
        match (sides, face.kind.second_order) {
            (3, _) => self.faces.push([c[0], c[1], c[2], m[0], m[1], m[2]]),
            (_, false) => self.add_triangles(&[[c[0], c[1], c[2]], [c[0], c[2], c[3]]]),
            (_, true) => {
                let corner = |side: usize| [c[side], m[side], m[(side + 3) % 4]];
                self.add_triangles(&[corner(0), corner(1), corner(2), corner(3)]);
                self.add_triangles(&[[m[0], m[1], m[2]], [m[0], m[2], m[3]]]);
            }
        }
    }

    /// Adds linear triangles, without those that are collapsed.
    fn add_triangles(&mut self, triangles: &[[u32; 3]]) {
        let sound = triangles.iter().filter(|[a, b, c]| a != b && b != c && c != a);
        self.faces.extend(sound.map(|&[a, b, c]| [a, b, c, NO_NODE, NO_NODE, NO_NODE]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fe::elements::Shape;
    use std::collections::HashMap;

    const fn kind(shape: Shape, second_order: bool) -> ElementKind {
        ElementKind { shape, second_order }
    }

    /// Every directed edge of a closed, oriented triangle mesh has its opposite exactly once.
    fn assert_closed(faces: &[[u32; 6]]) {
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for face in faces {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                *edges.entry((face[a], face[b])).or_default() += 1;
            }
        }
        for (&(a, b), &count) in &edges {
            assert_eq!((count, edges.get(&(b, a))), (1, Some(&1)), "edge {a}-{b}");
        }
    }

    #[test]
    fn the_face_between_two_tetrahedra_is_inside() {
        let surface = extract(&[kind(Shape::Tetrahedron, false); 2], &[0, 1, 2, 3, 1, 2, 3, 4], 6);
        assert_eq!(surface.faces.len(), 6);
        assert_eq!(surface.nodes, [0, 1, 2, 3, 4]);
        assert!(surface.mid_sides.is_empty() && surface.crowded == 0);
        assert!(surface.faces.iter().all(|face| face[3..] == [NO_NODE; 3]));
    }

    #[test]
    fn a_second_order_tetrahedron_keeps_its_mid_sides() {
        let surface = extract(&[kind(Shape::Tetrahedron, true)], &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9], 10);
        assert_eq!(surface.faces.len(), 4);
        assert_closed(&surface.faces);
        assert_eq!(surface.mid_sides, [[4, 0, 1], [5, 1, 2], [6, 0, 2], [7, 0, 3], [8, 1, 3], [9, 2, 3]]);
        let base = surface.faces.iter().find(|face| !face[..3].contains(&3)).unwrap();
        assert_eq!(base, &[0, 2, 1, 6, 5, 4]);
    }

    #[test]
    fn bricks_and_wedges_give_closed_triangles() {
        let brick: Vec<u32> = (0..20).collect();
        let surface = extract(&[kind(Shape::Hexahedron, true)], &brick, 20);
        assert_eq!((surface.faces.len(), surface.nodes.len(), surface.mid_sides.len()), (36, 20, 12));
        assert_closed(&surface.faces);
        let linear = extract(&[kind(Shape::Hexahedron, false)], &brick[..8], 8);
        assert_eq!(linear.faces.len(), 12);
        assert_closed(&linear.faces);
        let wedge = extract(&[kind(Shape::Wedge, true)], &brick[..15], 15);
        assert_eq!((wedge.faces.len(), wedge.nodes.len()), (2 + 3 * 6, 15));
    }

    #[test]
    fn a_brick_collapsed_to_a_wedge_joins_its_neighbour() {
        let collapsed = [0, 1, 2, 2, 3, 4, 5, 5];
        let above = [3, 4, 5, 6];
        let nodes: Vec<u32> = collapsed.into_iter().chain(above).collect();
        let surface = extract(&[kind(Shape::Hexahedron, false), kind(Shape::Tetrahedron, false)], &nodes, 7);
        assert_closed(&surface.faces);
        assert_eq!(surface.faces.len(), 1 + 2 * 3 + 3);
    }

    #[test]
    fn shells_are_the_surface_only_where_there_are_no_volumes() {
        let shell = extract(&[kind(Shape::Triangle, true)], &[3, 4, 5, 0, 1, 2], 6);
        assert_eq!(shell.faces, [[3, 4, 5, 0, 1, 2]]);
        let both = [kind(Shape::Triangle, false), kind(Shape::Tetrahedron, false)];
        assert_eq!(extract(&both, &[0, 1, 2, 0, 1, 2, 3], 4).faces.len(), 4);
    }

    #[test]
    fn overlapping_elements_are_counted() {
        let nodes = [0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5];
        assert_eq!(extract(&[kind(Shape::Tetrahedron, false); 3], &nodes, 6).crowded, 1);
    }
}
