//! A curve as a tree of Bézier pieces with bounds, halved only where somebody looks.

use crate::nurbs::basis::MAX_DEGREE;
use crate::nurbs::{NurbsCurve, Point};

/// Control points so near to each other, as a fraction of the coordinates, say nothing about a
/// direction.
pub const GRAIN: f64 = 4.0 * f64::EPSILON;

/// Directions around an axis; what their half-angle says is kept as cosine and sine.
#[derive(Debug, Clone, Copy)]
pub struct Cone<P> {
    /// Of length 1; of length 0 where there is no direction.
    pub axis: P,
    /// Cosine of the half-angle; -1 where any direction is possible.
    pub cosine: f64,
    /// Sine of the half-angle.
    pub sine: f64,
}

impl<P: Point> Cone<P> {
    /// Around all steps longer than `grain`. For a curve these lead from one control point to the
    /// next; the tangents of a rational curve with positive weights lie in it as well: `w² C′` is a
    /// sum of such steps, none taken negatively.
    pub fn new(steps: impl Iterator<Item = P> + Clone, grain: f64) -> Self {
        let sum = steps.clone().fold(P::default(), |sum, step| sum + step);
        let length = sum.length();
        if length <= grain {
            return Self { axis: P::default(), cosine: -1.0, sine: 0.0 };
        }
        let axis = sum / length;
        let mut cosine = 1.0f64;
        for step in steps {
            let length = step.length();
            if length > grain {
                cosine = cosine.min(step.dot(axis) / length);
            }
        }
        Self { axis, cosine, sine: (1.0 - cosine * cosine).max(0.0).sqrt() }
    }

    /// Whether no direction of one is parallel to one of the other, in either sense.
    pub fn is_apart(&self, other: &Self) -> bool {
        let both = self.cosine * other.cosine - self.sine * other.sine;
        let acute = self.cosine > 0.0 && other.cosine > 0.0 && both > 0.0;
        acute && self.axis.dot(other.axis).abs() < both * (1.0 - 1e-12)
    }

    /// Whether every direction of both has a positive component along one common direction, this
    /// cone's directions taken in their own sense and the other's times `sense`.
    pub fn agrees(&self, other: &Self, sense: f64) -> bool {
        let half = 0.5 * (self.axis + other.axis * sense).length();
        let sine = (1.0 - half * half).max(0.0).sqrt();
        let within = |cone: &Self| cone.cosine > 0.0 && half * cone.cosine > sine * cone.sine + 1e-12;
        within(self) && within(other)
    }
}

/// A stretch of the curve.
#[derive(Debug, Clone, Copy)]
pub struct Node<P> {
    /// Parameters at both ends.
    pub range: [f64; 2],
    /// The box of its control points.
    pub low: P,
    /// Its other corner.
    pub high: P,
    /// Diagonal of the box.
    pub size: f64,
    /// Its tangents; of a single Bézier piece only.
    pub cone: Cone<P>,
    /// The piece of a whole span that this is a part of; none for several spans.
    pub span: Option<usize>,
    first: usize,
    children: Option<[usize; 2]>,
}

/// A curve with its pieces.
#[derive(Debug)]
pub struct Tree<P> {
    degree: usize,
    rational: bool,
    /// Whether both ends are one point.
    pub closed: bool,
    /// First and last parameter.
    pub domain: [f64; 2],
    /// Length below which differences of control points are rounding.
    pub grain: f64,
    /// The node of the whole curve.
    pub root: usize,
    nodes: Vec<Node<P>>,
    poles: Vec<P>,
    weights: Vec<f64>,
}

impl<P: Point> Tree<P> {
    /// Bézier pieces of all spans, below nodes of two each; a curve whose ends are not further
    /// apart than `tolerance` is closed.
    pub fn new(curve: &NurbsCurve<P>, tolerance: f64) -> Self {
        let knots = curve.knots();
        let (a, b) = knots.domain();
        let order = knots.degree() + 1;
        let largest = |p: &P| p.coordinates().into_iter().map(f64::abs).fold(0.0, f64::max);
        let mut tree = Self {
            degree: knots.degree(),
            rational: curve.weights().is_some(),
            closed: false,
            domain: [a, b],
            grain: GRAIN * curve.poles().iter().map(largest).fold(0.0, f64::max),
            root: 0,
            nodes: Vec::with_capacity(4 * knots.len()),
            poles: Vec::with_capacity(4 * knots.len() * order),
            weights: Vec::new(),
        };
        for k in order - 1..knots.len() {
            if knots.flat()[k] < knots.flat()[k + 1] {
                tree.add_span(curve, k);
            }
        }
        let spans = tree.nodes.len();
        tree.closed = (tree.at(0, 0.0)[0] - tree.at(spans - 1, 1.0)[0]).length() <= tolerance;
        tree.root = tree.group(0, spans);
        tree
    }

    /// The Bézier points of a span: knots inserted at its start as often as the degree, then at
    /// its end (Boehm).
    fn add_span(&mut self, curve: &NurbsCurve<P>, k: usize) {
        let (p, flat) = (self.degree, curve.knots().flat());
        let (a, b) = (flat[k], flat[k + 1]);
        let first = self.poles.len();
        self.poles.extend_from_slice(&curve.poles()[k - p..=k]);
        if let Some(weights) = curve.weights() {
            self.weights.extend_from_slice(&weights[k - p..=k]);
        }
        let weights = self.rational.then(|| &mut self.weights[first..]);
        let mut net = Net { points: &mut self.poles[first..], weights };
        for r in 1..=p {
            for i in 0..=p - r {
                let (left, right) = (flat[k - p + i + r], flat[k + 1 + i]);
                net.blend(i, i + 1, (a - left) / (right - left), i);
            }
        }
        for r in 1..=p {
            for i in (r..=p).rev() {
                net.blend(i - 1, i, (b - a) / (flat[k + i + 1 - r] - a), i);
            }
        }
        self.add_piece([a, b], first, None);
    }

    fn add_piece(&mut self, range: [f64; 2], first: usize, span: Option<usize>) -> usize {
        let points = &self.poles[first..=first + self.degree];
        let (mut low, mut high) = (points[0], points[0]);
        for &p in &points[1..] {
            (low, high) = (low.min(p), high.max(p));
        }
        let span = Some(span.unwrap_or(self.nodes.len()));
        let (size, cone) =
            ((high - low).length(), Cone::new(points.windows(2).map(|w| w[1] - w[0]), self.grain));
        self.nodes.push(Node { range, low, high, size, cone, span, first, children: None });
        self.nodes.len() - 1
    }

    /// A node above the nodes `from..to` of spans.
    fn group(&mut self, from: usize, to: usize) -> usize {
        if to - from == 1 {
            return from;
        }
        let middle = (from + to) / 2;
        let children = [self.group(from, middle), self.group(middle, to)];
        let [a, b] = children.map(|k| self.nodes[k]);
        let (low, high) = (a.low.min(b.low), a.high.max(b.high));
        let cone = Cone { axis: P::default(), cosine: -1.0, sine: 0.0 };
        let (range, size) = ([a.range[0], b.range[1]], (high - low).length());
        let children = Some(children);
        self.nodes.push(Node { range, low, high, size, cone, span: None, first: 0, children });
        self.nodes.len() - 1
    }

    /// A node.
    pub fn node(&self, k: usize) -> &Node<P> {
        &self.nodes[k]
    }

    /// Control points of a piece.
    pub fn points(&self, k: usize) -> &[P] {
        let first = self.nodes[k].first;
        &self.poles[first..=first + self.degree]
    }

    /// Whether the parameters of a node leave room for one between.
    pub fn is_divisible(&self, k: usize) -> bool {
        let [a, b] = self.nodes[k].range;
        self.nodes[k].children.is_some() || (0.5 * (a + b) > a && 0.5 * (a + b) < b)
    }

    /// The two nodes below a node; pieces are halved when first asked.
    pub fn children(&mut self, k: usize) -> [usize; 2] {
        if let Some(children) = self.nodes[k].children {
            return children;
        }
        let Node { range: [a, b], first, span, .. } = self.nodes[k];
        let order = self.degree + 1;
        let halves = [self.poles.len(), self.poles.len() + order];
        for _ in 0..2 {
            self.poles.extend_from_within(first..first + order);
            if self.rational {
                self.weights.extend_from_within(first..first + order);
            }
        }
        // De Casteljau in place leaves the second half; its first points are those of the first.
        let (before, second) = self.poles.split_at_mut(halves[1]);
        let (weights_before, weights) = match self.rational {
            true => {
                let (before, second) = self.weights.split_at_mut(halves[1]);
                (Some(before), Some(second))
            }
            false => (None, None),
        };
        let mut net = Net { points: second, weights };
        let mut firsts = weights_before;
        for level in 1..order {
            for i in 0..order - level {
                net.blend(i, i + 1, 0.5, i);
            }
            before[halves[0] + level] = net.points[0];
            if let (Some(firsts), Some(weights)) = (&mut firsts, &net.weights) {
                firsts[halves[0] + level] = weights[0];
            }
        }
        let middle = 0.5 * (a + b);
        let children =
            [self.add_piece([a, middle], halves[0], span), self.add_piece([middle, b], halves[1], span)];
        self.nodes[k].children = Some(children);
        children
    }

    /// The point of a piece and its derivative, over a parameter that runs from 0 to 1.
    pub fn at(&self, k: usize, u: f64) -> [P; 2] {
        let (first, p) = (self.nodes[k].first, self.degree);
        let mut points = [P::default(); MAX_DEGREE + 1];
        points[..=p].copy_from_slice(&self.poles[first..=first + p]);
        if !self.rational {
            for last in (1..p).rev() {
                for i in 0..=last {
                    points[i] = points[i] + (points[i + 1] - points[i]) * u;
                }
            }
            let step = points[1] - points[0];
            return [points[0] + step * u, step * p as f64];
        }
        let mut weights = [0.0; MAX_DEGREE + 1];
        weights[..=p].copy_from_slice(&self.weights[first..=first + p]);
        let mut net = Net { points: &mut points, weights: Some(&mut weights) };
        for last in (1..p).rev() {
            for i in 0..=last {
                net.blend(i, i + 1, u, i);
            }
        }
        let (step, ends) = (points[1] - points[0], [weights[0], weights[1]]);
        let weight = ends[0] + (ends[1] - ends[0]) * u;
        let derivative = step * (p as f64 * ends[0] * ends[1] / (weight * weight));
        [points[0] + step * (u * ends[1] / weight), derivative]
    }

    /// The node of the span that holds a parameter; of two, the one `after` it or before.
    fn span(&self, t: f64, after: bool) -> usize {
        let mut k = self.root;
        while let (None, Some([a, b])) = (self.nodes[k].span, self.nodes[k].children) {
            let from = self.nodes[b].range[0];
            k = if t < from || t == from && !after { a } else { b };
        }
        k
    }

    /// The spans in which the stretch between two parameters begins and ends.
    pub fn spans_between(&self, [from, to]: [f64; 2]) -> [usize; 2] {
        [self.span(from, true), self.span(to, false)]
    }

    /// The point of the curve at a parameter.
    pub fn point(&self, t: f64) -> P {
        let k = self.span(t, true);
        self.at(k, self.local(k, t))[0]
    }

    /// The parameter of the curve at `u` of a node.
    pub fn parameter(&self, k: usize, u: f64) -> f64 {
        let [a, b] = self.nodes[k].range;
        if u == 1.0 { b } else { a + (b - a) * u }
    }

    /// Where a parameter of the curve stands on a node, 0 to 1 within it.
    pub fn local(&self, k: usize, t: f64) -> f64 {
        let [a, b] = self.nodes[k].range;
        ((t - a) / (b - a)).clamp(0.0, 1.0)
    }
}

/// Control points with their weights.
struct Net<'a, P> {
    points: &'a mut [P],
    weights: Option<&'a mut [f64]>,
}

impl<P: Point> Net<'_, P> {
    /// Replaces entry `into` by that between the entries `i` and `j`.
    fn blend(&mut self, i: usize, j: usize, share: f64, into: usize) {
        let step = self.points[j] - self.points[i];
        let mut by = share;
        if let Some(weights) = &mut self.weights {
            let weight = weights[i] + (weights[j] - weights[i]) * share;
            by *= weights[j] / weight;
            weights[into] = weight;
        }
        self.points[into] = self.points[i] + step * by;
    }
}
