//! A tree of boxes, four in a node and side by side in memory.

/// Marks a child as a leaf; the other bits are its index.
const LEAF: u32 = 1 << 31;
/// Leaves are near if their boxes are apart by no more than this part of their size.
const NEAR: f64 = 0.1;
/// Nodes that wait to be visited, in most queries.
const WAITING: usize = 64;

/// The box around something: its smallest and largest coordinates.
pub type Bounds = [[f64; 3]; 2];

/// Boxes of four children; those that are missing are infinitely far.
#[derive(Debug, Clone, Copy)]
struct Node {
    low: [[f64; 4]; 3],
    high: [[f64; 4]; 3],
    children: [u32; 4],
}

/// The tree; leaves are numbered as the boxes it was made from after [`Tree::new`] has sorted them.
#[derive(Debug, Clone)]
pub struct Tree {
    nodes: Vec<Node>,
}

impl Tree {
    /// Sorts the items so that near ones stand together and builds the tree over them.
    pub fn new<T>(items: &mut [T], bounds: impl Fn(&T) -> Bounds) -> Self {
        let mut tree = Self { nodes: Vec::new() };
        tree.build(items, 0, &bounds);
        tree
    }

    /// Adds the node over `items`, whose first one has the index `first`; returns its index.
    fn build<T>(&mut self, items: &mut [T], first: usize, bounds: &impl Fn(&T) -> Bounds) -> u32 {
        let at = self.nodes.len();
        self.nodes.push(Node {
            low: [[f64::INFINITY; 4]; 3],
            high: [[f64::INFINITY; 4]; 3],
            children: [LEAF; 4],
        });
        let half = items.len() / 2;
        let (left, right) = halved(items, half, bounds);
        let (quarter, next) = (left.len() / 2, right.len() / 2);
        let ((a, b), (c, d)) = (halved(left, quarter, bounds), halved(right, next, bounds));
        let mut from = first;
        for (k, part) in [a, b, c, d].into_iter().enumerate().filter(|(_, part)| !part.is_empty()) {
            let around = part.iter().map(bounds).reduce(joined).unwrap_or_default();
            let len = part.len();
            let child = if len == 1 { LEAF | from as u32 } else { self.build(part, from, bounds) };
            let node = &mut self.nodes[at];
            node.children[k] = child;
            for axis in 0..3 {
                (node.low[axis][k], node.high[axis][k]) = (around[0][axis], around[1][axis]);
            }
            from += len;
        }
        at as u32
    }

    /// Visits the leaves, the nearest to a box first, as far as they may matter: `bound` is a lower
    /// bound of the squared distance from a leaf, `visit` returns that beyond which nothing matters
    /// any more. Nothing beyond `reach` matters to begin with.
    pub fn descend(
        &self,
        from: Bounds,
        mut reach: f64,
        bound: impl Fn(usize) -> f64,
        mut visit: impl FnMut(usize, f64) -> f64,
    ) {
        // The nearest last.
        let mut waiting = Vec::with_capacity(WAITING);
        waiting.push((0u32, 0.0f64));
        while let Some((at, least)) = waiting.pop() {
            if least > reach {
                break;
            }
            if at & LEAF != 0 {
                reach = visit((at ^ LEAF) as usize, least).min(reach);
                continue;
            }
            let node = &self.nodes[at as usize];
            for (&child, &d) in node.children.iter().zip(&node.squared_distances(&from)) {
                if d > reach || d == f64::INFINITY {
                    continue;
                }
                let d = if child & LEAF == 0 { d } else { bound((child ^ LEAF) as usize) };
                if d <= reach {
                    let nearer = waiting.iter().rev().take_while(|w| w.1 < d).count();
                    waiting.insert(waiting.len() - nearer, (child, d));
                }
            }
        }
    }
}

impl Node {
    fn squared_distances(&self, [low, high]: &Bounds) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for axis in 0..3 {
            for k in 0..4 {
                let (below, above) = (self.low[axis][k] - high[axis], low[axis] - self.high[axis][k]);
                let off = if below > above { below } else { above };
                let off = if off > 0.0 { off } else { 0.0 };
                sum[k] += off * off;
            }
        }
        sum
    }
}

/// Which leaves are near which.
#[derive(Debug, Clone)]
pub struct Neighbours {
    near: Vec<Neighbour>,
    ends: Vec<usize>,
    reach: Vec<f64>,
}

/// One of them.
#[derive(Debug, Clone, Copy)]
pub struct Neighbour {
    /// Its number.
    pub leaf: usize,
    /// The distance between both boxes.
    pub gap: f64,
}

impl Neighbours {
    /// Of a tree whose leaves have these boxes.
    pub fn new(tree: &Tree, boxes: &[Bounds]) -> Self {
        let mut out = Self { near: Vec::new(), ends: vec![0], reach: Vec::new() };
        let mut waiting = Vec::new();
        for bounds in boxes {
            let [low, high] = bounds;
            let reach = NEAR * (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
            waiting.push(0);
            while let Some(at) = waiting.pop() {
                let node = &tree.nodes[at as usize];
                for (&child, &d) in node.children.iter().zip(&node.squared_distances(bounds)) {
                    match child & LEAF {
                        _ if d > reach * reach => {}
                        0 => waiting.push(child),
                        _ => out.near.push(Neighbour { leaf: (child ^ LEAF) as usize, gap: d.sqrt() }),
                    }
                }
            }
            out.ends.push(out.near.len());
            out.reach.push(reach);
        }
        out
    }

    /// Those of a leaf, itself among them.
    pub fn of(&self, leaf: usize) -> &[Neighbour] {
        &self.near[self.ends[leaf]..self.ends[leaf + 1]]
    }

    /// How far all others are from its box at least.
    pub fn reach(&self, leaf: usize) -> f64 {
        self.reach[leaf]
    }
}

/// The box around two.
pub fn joined(a: Bounds, b: Bounds) -> Bounds {
    [std::array::from_fn(|k| a[0][k].min(b[0][k])), std::array::from_fn(|k| a[1][k].max(b[1][k]))]
}

/// Parts the items at an index, along the axis on which they extend most.
fn halved<'t, T>(
    items: &'t mut [T],
    at: usize,
    bounds: &impl Fn(&T) -> Bounds,
) -> (&'t mut [T], &'t mut [T]) {
    if let Some([low, high]) = items.iter().map(bounds).reduce(joined) {
        let side = |k: usize| high[k] - low[k];
        let axis = (0..3).max_by(|&a, &b| side(a).total_cmp(&side(b))).unwrap_or(0);
        let middle = |item: &T| {
            let [low, high] = bounds(item);
            low[axis] + high[axis]
        };
        items.select_nth_unstable_by(at, |a, b| middle(a).total_cmp(&middle(b)));
    }
    items.split_at_mut(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_of_many_boxes_is_found_with_few_visits() {
        for n in [1, 2, 3, 4, 5, 17, 1000] {
            let at = |i: usize| [0.7548, 0.5698, 0.3247].map(|s| (s * i as f64).fract());
            let mut points: Vec<[f64; 3]> = (0..n).map(at).collect();
            let tree = Tree::new(&mut points, |p| [*p, *p]);
            for q in (0..200).map(|i| at(i + 5000)) {
                let squared = |p: &[f64; 3]| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>();
                let (mut best, mut visits) = (f64::INFINITY, 0);
                let bound = |leaf: usize| squared(&points[leaf]);
                tree.descend([q, q], f64::INFINITY, bound, |leaf, _| {
                    visits += 1;
                    best = best.min(squared(&points[leaf]));
                    best
                });
                let expected = points.iter().map(squared).fold(f64::INFINITY, f64::min);
                assert_eq!(best, expected, "{n} boxes, {q:?}");
                assert!(visits <= 2, "{n} boxes, {q:?}: {visits} visits");
            }
        }
    }
}
