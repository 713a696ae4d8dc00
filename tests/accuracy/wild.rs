//! Curves and surfaces of all degrees, multiplicities and weights.

use bladesmith::nurbs::{KnotVector, NurbsCurve, NurbsSurface, Point};

/// Numbers in 0..1, the same in every run.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    /// From 1e-3 to 1e3, evenly by their logarithm.
    fn weight(&mut self) -> f64 {
        10f64.powf(6.0 * self.next() - 3.0)
    }

    /// Coordinates about zero, about one place, and of another size.
    fn point<P: Point>(&mut self) -> P {
        P::from_coordinates([self.next() - 0.5, 50.0 + self.next(), 1e3 * self.next()])
    }
}

/// How the ends of the knots are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ends {
    Clamped,
    Unclamped,
    Periodic,
}

pub const ENDS: [Ends; 3] = [Ends::Clamped, Ends::Unclamped, Ends::Periodic];

/// Knots of `spans` spans; inner ones of all multiplicities up to the degree unless periodic.
pub fn knots(random: &mut Random, degree: usize, spans: usize, ends: Ends) -> KnotVector {
    let mut breaks = vec![random.next() - 0.5];
    for i in 0..spans {
        // One span in four is short.
        let step = if random.below(4) == 0 { 0.01 } else { 0.2 } + random.next();
        breaks.push(breaks[i] + step);
    }
    if ends == Ends::Periodic {
        return KnotVector::periodic(degree, &breaks).expect("periodic knots");
    }
    let mut flat = Vec::new();
    for (i, &t) in breaks.iter().enumerate() {
        let end = i == 0 || i == spans;
        let times = if end && ends == Ends::Clamped { degree + 1 } else { 1 + random.below(degree) };
        flat.extend(std::iter::repeat_n(t, times));
    }
    if ends == Ends::Unclamped {
        // Knots beyond both ends of the domain, as many as make it that of the breaks.
        let (mut low, mut high) = (breaks[0], breaks[spans]);
        let count = |t: f64, flat: &[f64]| flat.iter().filter(|&&k| k == t).count();
        for _ in count(low, &flat)..degree + 1 {
            low -= random.next();
            flat.insert(0, low);
        }
        for _ in count(high, &flat)..degree + 1 {
            high += random.next();
            flat.push(high);
        }
    }
    KnotVector::new(degree, flat).expect("knots")
}

pub fn curve<P: Point>(random: &mut Random, degree: usize, ends: Ends, rational: bool) -> NurbsCurve<P> {
    let knots = knots(random, degree, 5, ends);
    let different = if ends == Ends::Periodic { 5 } else { knots.len() };
    let poles: Vec<P> = (0..different).map(|_| random.point()).collect();
    let weights: Vec<f64> = (0..different).map(|_| random.weight()).collect();
    let (poles, weights) = (knots.wrapped(&poles), rational.then(|| knots.wrapped(&weights)));
    NurbsCurve::new(knots, poles, weights).expect("a curve")
}

pub fn surface(random: &mut Random, degrees: [usize; 2], ends: [Ends; 2], rational: bool) -> NurbsSurface {
    let ku = knots(random, degrees[0], 3, ends[0]);
    let kv = knots(random, degrees[1], 2, ends[1]);
    let count = ku.len() * kv.len();
    let poles = (0..count).map(|_| random.point()).collect();
    let weights = rational.then(|| (0..count).map(|_| random.weight()).collect());
    NurbsSurface::new(ku, kv, poles, weights).expect("a surface")
}

/// Every break of the domain, and a few parameters between.
pub fn places(knots: &KnotVector, shares: &[f64]) -> Vec<f64> {
    let breaks = knots.breaks();
    let inner = breaks.windows(2).flat_map(|w| shares.iter().map(move |s| w[0] + s * (w[1] - w[0])));
    breaks.iter().copied().chain(inner).collect()
}
