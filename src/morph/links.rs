//! Rows that keep neighbouring patches together: equal displacement along every edge, and on
//! tangent edges equal derivative across it, so that tangent planes map alike.

use super::affine::AffineField;
use super::hot::{Hot, Joint};
use super::pieces::between_knots;
use super::space::Space;
use super::system::Link;
use crate::nurbs::SurfaceDerivatives;
use crate::tolerance::TANGENT_DEG;
use glam::{DVec2, DVec3};

/// Weight of a link of position against the nodes along the same length of edge. What is gained
/// in gap by more is lost many times over at the nodes.
const WEIGHT: f64 = 20.0;
/// Weight of a link of derivatives, whose jump counts over one node spacing.
const TANGENT_WEIGHT: f64 = 5.0;
/// Samples in each piece of edge that both patches see as one polynomial.
const SAMPLES: usize = 4;
/// Where a patch's area element falls below this fraction of its largest along the joint (a
/// sphere's pole), directions have no parameters.
const DEGENERATE: f64 = 1e-6;

/// How a joint is tied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tie {
    /// Displacements agree.
    Position,
    /// Displacements and their derivatives across the edge agree.
    Tangent,
}

/// The links of one joint, with the parameter of each sample.
#[derive(Debug, Clone, Default)]
pub struct JointLinks {
    /// Links of position; as many as `parameters`.
    pub position: Vec<Link>,
    /// Links of derivatives; empty for kinks.
    pub tangent: Vec<Link>,
    /// Parameters of the samples.
    pub parameters: Vec<f64>,
}

/// Geometry of one side of a joint at a parameter.
pub struct Trace {
    /// Parameters on the patch.
    pub uv: DVec2,
    /// Derivative of `uv` along the edge.
    pub along: DVec2,
    /// The hot patch there.
    pub d: SurfaceDerivatives,
}

/// One side of `joint` at parameter `t`.
pub fn trace(hot: &Hot, joint: &Joint, side: usize, t: f64) -> Trace {
    let side = &joint.sides[side];
    let [uv, along, _] = side.pcurve.derivatives(t);
    Trace { uv, along, d: hot.patches[side.patch].hot.derivatives(uv.x, uv.y) }
}

impl Trace {
    /// Unit tangent of the edge.
    pub fn tangent(&self) -> DVec3 {
        (self.d.u * self.along.x + self.d.v * self.along.y).normalize_or_zero()
    }

    /// Parameter direction of a vector of the tangent plane.
    fn resolve(&self, direction: DVec3) -> Option<DVec2> {
        let (guu, guv, gvv) = (self.d.u.dot(self.d.u), self.d.u.dot(self.d.v), self.d.v.dot(self.d.v));
        let det = guu * gvv - guv * guv;
        let (a, b) = (direction.dot(self.d.u), direction.dot(self.d.v));
        (det > 1e-12 * guu * gvv).then(|| DVec2::new(gvv * a - guv * b, guu * b - guv * a) / det)
    }
}

/// How a joint of this angle is tied. Beside a face that the field holds still (a clamp of the FE
/// model) the gradient truly jumps: asking for equal derivatives there would only bend the free
/// face off its nodes.
pub fn tie(joint: &Joint, angle_deg: f64, held: &[bool]) -> Tie {
    let clamped = joint.sides.len() == 2 && held[joint.sides[0].face] != held[joint.sides[1].face];
    if angle_deg < TANGENT_DEG && !clamped { Tie::Tangent } else { Tie::Position }
}

/// What the links of a joint depend on besides its geometry.
pub struct Context<'a> {
    /// Spaces of the patches.
    pub spaces: &'a [Space],
    /// Affine fields of the patches, to which their displacements are added.
    pub affine: &'a [AffineField],
    /// How the joint is tied.
    pub tie: Tie,
    /// Distance between nodes along it, mm.
    pub spacing: f64,
}

/// The links of `joint`.
pub fn links(hot: &Hot, joint: &Joint, context: &Context<'_>) -> JointLinks {
    let mut out = JointLinks::default();
    if joint.degenerated || joint.sides.len() != 2 {
        return out;
    }
    let spaces = context.spaces;
    let parameters = sample_parameters(joint, spaces);
    let [a, b] = [joint.sides[0].patch, joint.sides[1].patch];
    let traces: Vec<[Trace; 2]> =
        parameters.iter().map(|&t| [trace(hot, joint, 0, t), trace(hot, joint, 1, t)]).collect();
    let length: f64 = traces.windows(2).map(|w| (w[1][0].d.s - w[0][0].d.s).length()).sum();
    let nodes = (length / context.spacing.max(1e-9)).max(1.0);
    let share = nodes / parameters.len() as f64;
    let weight = WEIGHT * WEIGHT * share;
    let tangent_weight = (TANGENT_WEIGHT * context.spacing).powi(2) * share;
    let area = |t: &Trace| t.d.normal().length();
    let largest = [0, 1].map(|side| traces.iter().map(|t| area(&t[side])).fold(0.0, f64::max));
    for [ta, tb] in &traces {
        let target = context.affine[b].at(tb.d.s) - context.affine[a].at(ta.d.s);
        let (ra, rb) = (spaces[a].value(ta.uv), spaces[b].value(tb.uv));
        out.position.push(Link { a: (a, ra), b: (b, rb), target, weight });
        let regular = area(ta) > DEGENERATE * largest[0] && area(tb) > DEGENERATE * largest[1];
        if context.tie == Tie::Tangent && regular {
            let across = ta.d.normal().cross(ta.tangent()).normalize_or_zero();
            let (Some(wa), Some(wb)) = (ta.resolve(across), tb.resolve(across)) else { continue };
            let row = |s: &Space, uv: DVec2, w: DVec2| s.combine(uv, [0.0, w.x, w.y, 0.0, 0.0, 0.0]);
            let (ra, rb) = (row(&spaces[a], ta.uv, wa), row(&spaces[b], tb.uv, wb));
            let target = (context.affine[b].linear - context.affine[a].linear) * across;
            out.tangent.push(Link { a: (a, ra), b: (b, rb), target, weight: tangent_weight });
        }
    }
    out.parameters = parameters;
    out
}

/// Samples within each piece between the knots that either side crosses.
fn sample_parameters(joint: &Joint, spaces: &[Space]) -> Vec<f64> {
    let sides: Vec<_> = joint.sides.iter().map(|s| (s, &spaces[s.patch].ku, &spaces[s.patch].kv)).collect();
    let pieces = between_knots(joint, &sides);
    let mut out = Vec::with_capacity(pieces.len() * SAMPLES);
    for w in pieces.windows(2) {
        out.extend((0..SAMPLES).map(|k| joint.parameter(w[0] + (w[1] - w[0]) * k as f64 / SAMPLES as f64)));
    }
    out.push(joint.parameter(1.0));
    out
}
