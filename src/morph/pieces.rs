//! Pieces of an edge on which everything along it is smooth.

use super::hot::{Joint, Side};
use crate::brep::Curve2d;
use crate::nurbs::KnotVector;

/// Points at which an edge is looked at to find its pieces.
const PROBES: usize = 60;
/// Shortest piece, as a fraction of the edge.
const SHORTEST: f64 = 1e-4;
/// Longest piece for quadrature of a bent edge, as a fraction of it.
const BENT: f64 = 1.0 / 16.0;
/// The same of a straight edge.
const STRAIGHT: f64 = 1.0 / 4.0;

/// Fractions 0 ..= 1 of the edge between which its pcurves stay within one knot span of the given
/// knots (along u and v, for each side).
pub fn between_knots(joint: &Joint, sides: &[(&Side, &KnotVector, &KnotVector)]) -> Vec<f64> {
    let spans = |s: f64| {
        let span = |(side, ku, kv): &(&Side, &KnotVector, &KnotVector)| {
            let uv = side.pcurve.point(joint.parameter(s));
            [ku.span(uv.x), kv.span(uv.y)]
        };
        let both = sides.iter().map(span);
        both.fold([usize::MAX; 4], |[_, _, a, b], [u, v]| [a, b, u, v])
    };
    let mut out = vec![0.0];
    for k in 0..PROBES {
        let (a, b) = (k as f64 / PROBES as f64, (k + 1) as f64 / PROBES as f64);
        crossings(&spans, (a, spans(a)), (b, spans(b)), &mut out);
    }
    out.push(1.0);
    out
}

/// Adds the places between `a` and `b` where the spans change, in order.
fn crossings(
    spans: &dyn Fn(f64) -> [usize; 4],
    a: (f64, [usize; 4]),
    b: (f64, [usize; 4]),
    out: &mut Vec<f64>,
) {
    if a.1 == b.1 {
        return;
    }
    let middle = 0.5 * (a.0 + b.0);
    if b.0 - a.0 < 0.1 * SHORTEST {
        let apart = out.last().is_none_or(|last| middle - last > SHORTEST);
        if apart && 1.0 - middle > SHORTEST {
            out.push(middle);
        }
        return;
    }
    let m = (middle, spans(middle));
    crossings(spans, a, m, out);
    crossings(spans, m, b, out);
}

/// Cuts pieces further: at the knots of the pcurve, and so that none is longer than quadrature
/// along a bent or a straight pcurve allows.
pub fn for_quadrature(joint: &Joint, pcurve: &Curve2d, mut pieces: Vec<f64>) -> Vec<f64> {
    // Pcurves of fillets have degree 11 and are rough in every span.
    let mut least = 1.0;
    let longest = if matches!(pcurve, Curve2d::Line { .. }) { STRAIGHT } else { BENT };
    if let Curve2d::BSpline(c) = pcurve {
        least = (c.knots().degree() as f64 / 3.0).ceil();
        let length = joint.range[1] - joint.range[0];
        let inner = c.knots().knots().iter().map(|k| (k.0 - joint.range[0]) / length);
        pieces.extend(inner.filter(|s| *s > SHORTEST && *s < 1.0 - SHORTEST));
        pieces.sort_by(f64::total_cmp);
        pieces.dedup_by(|a, b| *a - *b < SHORTEST);
    }
    let mut out = Vec::new();
    for w in pieces.windows(2) {
        let n = ((w[1] - w[0]) / longest).ceil().max(least);
        out.extend((0..n as usize).map(|k| w[0] + (w[1] - w[0]) * k as f64 / n));
    }
    out.push(1.0);
    out
}
