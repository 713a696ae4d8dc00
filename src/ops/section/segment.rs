//! Pieces of traced curves as quintic polynomials, and curves put together of them.

use super::pair::{At, Node};
use crate::error::Result;
use crate::nurbs::{KnotVector, NurbsCurve, Point};
use glam::{DVec2, DVec3};

/// Derivatives on both sides of a joint that differ by less than this fraction are one.
const SMOOTH: f64 = 1e-6;

/// One piece between two points of a curve.
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    pub from: Node,
    pub to: Node,
    /// Its length, in mm.
    pub length: f64,
    /// The largest distance seen from the curve and from the sheets, in mm.
    pub deviation: f64,
}

/// Control points of the polynomial with these values and two derivatives at its ends.
fn control<P: Point>([p, dp, ddp]: [P; 3], [q, dq, ddq]: [P; 3], h: f64) -> [P; 6] {
    let (first, second) = (h / 5.0, h * h / 20.0);
    [
        p,
        p + dp * first,
        p + dp * (2.0 * first) + ddp * second,
        q - dq * (2.0 * first) + ddq * second,
        q - dq * first,
        q,
    ]
}

/// The value and the first derivative (by `h · t`) at the fraction `t`.
fn value<P: Point>(mut c: [P; 6], h: f64, t: f64) -> [P; 2] {
    for level in (1..6).rev() {
        if level == 1 {
            return [c[0] + (c[1] - c[0]) * t, (c[1] - c[0]) * (5.0 / h)];
        }
        for i in 0..level {
            c[i] = c[i] + (c[i + 1] - c[i]) * t;
        }
    }
    [c[0]; 2]
}

impl Segment {
    /// Between two nodes; the length is that of the polynomial.
    pub fn new(from: Node, to: Node) -> Self {
        let mut segment = Self { from, to, length: from.x.distance(to.x), deviation: 0.0 };
        for _ in 0..3 {
            segment.length = segment.measured();
        }
        segment
    }

    fn measured(&self) -> f64 {
        let c = self.space();
        let speed = |t: f64| value(c, self.length, t)[1].length() * self.length;
        let pair = |&(x, w): &(f64, f64)| 0.5 * w * (speed(0.5 - 0.5 * x) + speed(0.5 + 0.5 * x));
        crate::nurbs::length::GAUSS.iter().map(pair).sum()
    }

    fn space(&self) -> [DVec3; 6] {
        let of = |n: &Node| [n.x, n.tangent, n.bend];
        control(of(&self.from), of(&self.to), self.length)
    }

    fn parameters(&self, sheet: usize) -> [DVec2; 6] {
        let of = |n: &Node| [n.at[sheet], n.first[sheet], n.second[sheet]];
        control(of(&self.from), of(&self.to), self.length)
    }

    /// Point, first derivative and parameters at a fraction of the length.
    pub fn at(&self, t: f64) -> ([DVec3; 2], At) {
        let parameters = [0, 1].map(|k| value(self.parameters(k), self.length, t)[0]);
        (value(self.space(), self.length, t), parameters)
    }

    /// The same piece run backwards.
    pub fn reversed(self) -> Self {
        Self { from: self.to.reversed(), to: self.from.reversed(), ..self }
    }

    /// The distance of a point from the piece, roughly.
    pub fn distance(&self, p: DVec3) -> f64 {
        let c = self.space();
        let chord = self.to.x - self.from.x;
        let mut t = ((p - self.from.x).dot(chord) / chord.length_squared()).clamp(0.0, 1.0);
        for _ in 0..6 {
            let [x, d] = value(c, self.length, t);
            t = (t + (p - x).dot(d) / (d.length_squared() * self.length)).clamp(0.0, 1.0);
        }
        value(c, self.length, t)[0].distance(p)
    }
}

/// Whether the second derivatives continue from one piece to the next.
fn is_smooth(a: &Node, b: &Node) -> bool {
    let near = |x: f64, y: f64, scale: f64| (x - y).abs() <= SMOOTH * scale;
    let bend = a.bend.length().max(b.bend.length());
    let parameters = (0..2).all(|k| {
        let scale = |f: fn(&Node) -> At| f(a)[k].length().max(f(b)[k].length());
        let (first, second) = (scale(|n| n.first), scale(|n| n.second));
        near(a.first[k].distance(b.first[k]), 0.0, first)
            && near(a.second[k].distance(b.second[k]), 0.0, second)
    });
    parameters && near(a.tangent.distance(b.tangent), 0.0, 1.0) && near(a.bend.distance(b.bend), 0.0, bend)
}

/// A chain of pieces as one curve over its length, with the parameters on both sheets.
pub fn chained(segments: &[Segment]) -> Result<(NurbsCurve<DVec3>, [NurbsCurve<DVec2>; 2])> {
    let mut breaks = vec![0.0];
    breaks.extend(segments.iter().scan(0.0, |sum, s| {
        *sum += s.length;
        Some(*sum)
    }));
    let smooth: Vec<bool> = segments.windows(2).map(|w| is_smooth(&w[0].to, &w[1].from)).collect();
    let mut multiplicities = vec![6];
    multiplicities.extend(smooth.iter().map(|&s| if s { 3 } else { 5 }));
    multiplicities.push(6);
    let knots = KnotVector::with_multiplicities(5, &breaks, &multiplicities)?;
    let curve = NurbsCurve::new(knots.clone(), poles(segments, &smooth, Segment::space), None)?;
    let [a, b] = [0, 1].map(|k| {
        NurbsCurve::new(knots.clone(), poles(segments, &smooth, |s: &Segment| s.parameters(k)), None)
    });
    Ok((curve, [a?, b?]))
}

/// Poles over knots of multiplicity three where the joint is smooth, else five.
fn poles<P: Point>(segments: &[Segment], smooth: &[bool], of: impl Fn(&Segment) -> [P; 6]) -> Vec<P> {
    let mut out = Vec::new();
    for (i, segment) in segments.iter().enumerate() {
        let c = of(segment);
        if i == 0 {
            out.push(c[0]);
        }
        if i == 0 || !smooth[i - 1] {
            out.push(c[1]);
        }
        out.extend([c[2], c[3]]);
        match smooth.get(i) {
            // The blossom is affine in its last argument: from this piece's start to the next one's end.
            Some(true) => {
                let ratio = 1.0 + segments[i + 1].length / segment.length;
                out.push(c[3] + (c[4] - c[3]) * ratio);
            }
            _ => out.extend([c[4], c[5]]),
        }
    }
    out
}
