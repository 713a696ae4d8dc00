//! Evaluation against a reference of twice the digits: sums of two numbers (Dekker 1971).

use super::*;
use glam::{DVec2, DVec3};
use std::ops::{Add, Div, Mul, Sub};

/// A number of about 32 digits, `high + low`.
#[derive(Clone, Copy)]
struct Twice(f64, f64);

impl Twice {
    fn of(a: f64, b: f64) -> Self {
        let sum = a + b;
        let part = sum - a;
        Self(sum, (a - (sum - part)) + (b - part))
    }
}

impl Add for Twice {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        let (high, low) = (Self::of(self.0, o.0), Self::of(self.1, o.1));
        let sum = Self::of(high.0, high.1 + low.0);
        Self::of(sum.0, sum.1 + low.1)
    }
}

impl Sub for Twice {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + Self(-o.0, -o.1)
    }
}

impl Mul for Twice {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let product = self.0 * o.0;
        let error = self.0.mul_add(o.0, -product);
        Self::of(product, error + (self.0 * o.1 + self.1 * o.0))
    }
}

impl Div for Twice {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let first = self.0 / o.0;
        let rest = self - o * Self(first, 0.0);
        let second = rest.0 / o.0;
        let rest = rest - o * Self(second, 0.0);
        Self::of(first, second) + Self(rest.0 / o.0, 0.0)
    }
}

const ZERO: Twice = Twice(0.0, 0.0);

fn whole(x: usize) -> Twice {
    Twice(x as f64, 0.0)
}

/// The `order`-th derivative of function `i`, literally as defined, on the given span (eq. 2.9).
fn function(k: &[f64], i: usize, p: usize, span: usize, t: f64, order: usize) -> Twice {
    if p == 0 {
        return whole(usize::from(i == span && order == 0));
    }
    let knot = |j: usize| Twice(k[j], 0.0);
    let over = |a: Twice, low: usize, high: usize| {
        if k[low] == k[high] { ZERO } else { a / (knot(high) - knot(low)) }
    };
    let lower = |i: usize, order: usize| function(k, i, p - 1, span, t, order);
    if order > 0 {
        let factor = whole(p);
        return over(factor * lower(i, order - 1), i, i + p)
            - over(factor * lower(i + 1, order - 1), i + 1, i + p + 1);
    }
    let t = Twice(t, 0.0);
    over((t - knot(i)) * lower(i, 0), i, i + p)
        + over((knot(i + p + 1) - t) * lower(i + 1, 0), i + 1, i + p + 1)
}

/// One coordinate of a rational derivative and the sum of the sizes of what it is made of: for
/// orders `0..=top` (eq. 4.8).
fn reference(c: &NurbsCurve<DVec3>, axis: usize, t: f64, top: usize) -> Vec<(f64, f64)> {
    let (k, p) = (c.knots().flat(), c.knots().degree());
    let span = c.knots().span(t);
    let weight = |i: usize| c.weights().map_or(1.0, |w| w[i]);
    let (mut out, mut a_sizes): (Vec<Twice>, Vec<f64>) = (Vec::new(), Vec::new());
    let (mut weights, mut w_sizes): (Vec<Twice>, Vec<f64>) = (Vec::new(), Vec::new());
    for order in 0..=top {
        let (mut a, mut w, mut a_size, mut w_size) = (ZERO, ZERO, 0.0, 0.0);
        for i in span - p..=span {
            let n = function(k, i, p, span, t, order) * Twice(weight(i), 0.0);
            a = a + n * Twice(c.poles()[i][axis], 0.0);
            w = w + n;
            a_size += (n.0 * c.poles()[i][axis]).abs();
            w_size += n.0.abs();
        }
        weights.push(w);
        w_sizes.push(w_size);
        for i in 1..=order {
            let factor = Twice(derivatives::binomial(order, i), 0.0);
            a = a - factor * weights[i] * out[order - i];
            a_size += factor.0 * w_sizes[i] * a_sizes[order - i];
        }
        out.push(a / weights[0]);
        a_sizes.push(a_size / weights[0].0);
    }
    out.iter().zip(a_sizes).map(|(v, size)| (v.0, size)).collect()
}

/// A curve of this degree with knots of all multiplicities and weights from 1e-3 to 1e3.
fn wild(degree: usize, seed: usize, rational: bool) -> NurbsCurve<DVec3> {
    let chance = |i: usize| ((i * 7919 + seed * 104_729 + 17) as f64 * 0.754_877_666).fract();
    let breaks: Vec<f64> = (0..6).map(|i| i as f64 + 0.9 * chance(i)).collect();
    let mut multiplicities: Vec<usize> = (0..6).map(|i| 1 + (i + seed) % degree).collect();
    (multiplicities[0], multiplicities[5]) = (degree + 1, degree + 1);
    let knots = KnotVector::with_multiplicities(degree, &breaks, &multiplicities).expect("knots");
    let n = knots.len();
    let pole = |i: usize| DVec3::new(chance(i + 10) - 0.5, 50.0 + chance(i + 50), 1e3 * chance(i + 90));
    let weights = rational.then(|| (0..n).map(|i| 10f64.powf(6.0 * chance(i + 130) - 3.0)).collect());
    NurbsCurve::new(knots, (0..n).map(pole).collect(), weights).expect("a curve")
}

#[test]
fn curves_are_right_to_eight_units_times_the_condition() {
    let mut worst = 0.0f64;
    for degree in 1..=9 {
        for seed in 0..4 {
            for rational in [false, true] {
                let c = wild(degree, seed, rational);
                let evaluator = CurveEvaluator::new(&c);
                let breaks = c.knots().breaks();
                let between =
                    breaks.windows(2).flat_map(|w| [0.01, 0.37, 0.99].map(|s| w[0] + s * (w[1] - w[0])));
                for t in breaks.iter().copied().chain(between) {
                    let top = degree.min(3);
                    let is = c.derivatives_to(t, top);
                    let (fast, points) = (evaluator.derivatives(&[t]), evaluator.points(&[t]));
                    for axis in 0..3 {
                        for (k, (value, size)) in reference(&c, axis, t, top).into_iter().enumerate() {
                            let unit = f64::EPSILON * size + f64::MIN_POSITIVE;
                            let mut error = ((is[k][axis] - value) / unit).abs();
                            if k < 3 {
                                error = error.max(((fast[0][k][axis] - value) / unit).abs());
                                error = error.max(((c.derivatives(t)[k][axis] - value) / unit).abs());
                            }
                            if k == 0 {
                                error = error.max(((points[0][axis] - value) / unit).abs());
                                error = error.max(((c.point(t)[axis] - value) / unit).abs());
                            }
                            worst = worst.max(error);
                            assert!(
                                error <= 8.0,
                                "degree {degree}, seed {seed}, rational {rational}, t {t}, order {k}, axis \
                                 {axis}: off by {error} units"
                            );
                        }
                    }
                }
            }
        }
    }
    println!("largest error: {worst} units times the condition");
}

/// A sum with the sum of the sizes of its terms.
type Sum = (Twice, f64);

/// One coordinate of the derivatives up to the second, `[k][l]`, with the sums of the sizes of what
/// they are made of (eq. 4.20).
fn surface_reference(s: &NurbsSurface, axis: usize, uv: DVec2) -> [[(f64, f64); 3]; 3] {
    let table = |knots: &KnotVector, t: f64| {
        let (p, span) = (knots.degree(), knots.span(t));
        let of = |order| (span - p..=span).map(|i| function(knots.flat(), i, p, span, t, order)).collect();
        (span - p, [0, 1, 2].map(|order| -> Vec<Twice> { of(order) }))
    };
    let ((first_u, nu), (first_v, nv)) = (table(s.knots_u(), uv.x), table(s.knots_v(), uv.y));
    let (mut a, mut w) = ([[(ZERO, 0.0); 3]; 3], [[(ZERO, 0.0); 3]; 3]);
    let add = |sum: &mut Sum, x: Twice| *sum = (sum.0 + x, sum.1 + x.0.abs());
    for (k, l) in (0..3).flat_map(|k| (0..3 - k).map(move |l| (k, l))) {
        for (i, &m) in nu[k].iter().enumerate() {
            for (j, &n) in nv[l].iter().enumerate() {
                let pole = (first_u + i) * s.knots_v().len() + first_v + j;
                let n = m * n * Twice(s.weights().map_or(1.0, |w| w[pole]), 0.0);
                add(&mut w[k][l], n);
                add(&mut a[k][l], n * Twice(s.poles()[pole][axis], 0.0));
            }
        }
    }
    for (k, l) in (0..3).flat_map(|k| (0..3 - k).map(move |l| (k, l))) {
        for (i, j) in (0..=k).flat_map(|i| (0..=l).map(move |j| (i, j))).skip(1) {
            let factor = derivatives::binomial(k, i) * derivatives::binomial(l, j);
            let (lower, weight) = (a[k - i][l - j], w[i][j]);
            a[k][l].0 = a[k][l].0 - Twice(factor, 0.0) * weight.0 * lower.0;
            a[k][l].1 += factor * weight.1 * lower.1;
        }
        a[k][l] = (a[k][l].0 / w[0][0].0, a[k][l].1 / w[0][0].0.0);
    }
    a.map(|row| row.map(|(value, size)| (value.0, size)))
}

/// A surface of these degrees over the knots of two wild curves.
fn wild_surface(degrees: [usize; 2], seed: usize, rational: bool) -> NurbsSurface {
    let curves = [wild(degrees[0], seed, true), wild(degrees[1], seed + 3, true)];
    let [u, v] = curves.each_ref();
    let pairs = || u.poles().iter().flat_map(|&a| v.poles().iter().map(move |&b| (a, b)));
    let poles = pairs().map(|(a, b)| DVec3::new(a.x * 7.0 - b.x, a.y - b.y, a.z + 30.0 * b.x)).collect();
    let weight = |(a, b): (&f64, &f64)| (a * b).clamp(1e-3, 1e3);
    let (wu, wv) = (u.weights().unwrap_or_default(), v.weights().unwrap_or_default());
    let weights = wu.iter().flat_map(|a| wv.iter().map(move |b| weight((a, b)))).collect();
    let knots = curves.map(|c| c.knots().clone());
    let [ku, kv] = knots;
    NurbsSurface::new(ku, kv, poles, rational.then_some(weights)).expect("a surface")
}

#[test]
fn surfaces_are_right_to_eight_units_times_the_condition() {
    let places = |knots: &KnotVector| {
        let breaks = knots.breaks();
        let between = breaks.windows(2).map(|w| w[0] + 0.37 * (w[1] - w[0])).collect::<Vec<f64>>();
        [breaks, between].concat().into_iter().step_by(2).collect::<Vec<f64>>()
    };
    for degree in 1..=9 {
        for (seed, rational) in [(0, false), (1, true), (2, true)] {
            let s = wild_surface([degree, (4 * degree + seed) % 9 + 1], seed, rational);
            let evaluator = SurfaceEvaluator::new(&s);
            let (us, vs) = (places(s.knots_u()), places(s.knots_v()));
            for uv in us.iter().flat_map(|&u| vs.iter().map(move |&v| DVec2::new(u, v))) {
                let (jet, points) = (s.derivatives_to(uv.x, uv.y, 2), evaluator.points(&[uv]));
                let of = |d: SurfaceDerivatives| [[d.s, d.v, d.vv], [d.u, d.uv, d.uu], [d.uu; 3]];
                let ways = [of(s.derivatives(uv.x, uv.y)), of(evaluator.derivatives(&[uv])[0])];
                for axis in 0..3 {
                    let expected = surface_reference(&s, axis, uv);
                    for (k, l) in (0..3).flat_map(|k| (0..3 - k).map(move |l| (k, l))) {
                        let (value, size) = expected[k][l];
                        let unit = f64::EPSILON * size + f64::MIN_POSITIVE;
                        let mut answers = vec![jet[k][l], ways[0][k][l], ways[1][k][l]];
                        if (k, l) == (0, 0) {
                            answers.extend([points[0], s.point(uv.x, uv.y)]);
                        }
                        for (way, answer) in answers.iter().enumerate() {
                            let error = ((answer[axis] - value) / unit).abs();
                            assert!(
                                error <= 8.0,
                                "degree {degree}, seed {seed}, rational {rational}, {uv}, derivative {k} {l}, \
                                 way {way}, axis {axis}: off by {error} units"
                            );
                        }
                    }
                }
            }
        }
    }
}

/// A sheet like the side of a blade, hardly bent along v, over 60 × 40 poles with uneven knots.
fn sheet(rational: bool, size: f64, off: DVec3) -> NurbsSurface {
    let knots = |spans: usize| {
        let at = |i: usize| (i as f64 + 0.3 * (i as f64).sin() * f64::from(i < spans)) / spans as f64;
        KnotVector::clamped(3, &(0..=spans).map(at).collect::<Vec<_>>()).expect("knots")
    };
    let (ku, kv) = (knots(57), knots(37));
    let pole = |(u, v): (f64, f64)| DVec3::new(100.0 * u * u, 8.0 * (3.0 * u).sin() + 3.0 * v * v, 150.0 * v);
    let (us, vs) = (ku.greville(), kv.greville());
    let places: Vec<_> = us.iter().flat_map(|&u| vs.iter().map(move |&v| (u, v))).collect();
    let poles = places.iter().map(|&at| pole(at) * size + off).collect();
    let weights = places.iter().map(|(u, v)| (0.45 * (9.0 * u).sin() * (5.0 * v).cos()).exp()).collect();
    NurbsSurface::new(ku, kv, poles, rational.then_some(weights)).expect("a surface")
}

#[test]
fn second_derivatives_on_short_spans_are_right_to_1e_13_of_their_largest() {
    let uv: Vec<DVec2> = (1..=60)
        .map(|k| DVec2::new((k as f64 * 0.754_877_666).fract(), (k as f64 * 0.569_840_291).fract()))
        .collect();
    for (size, off) in [(1.0, DVec3::ZERO), (1.0, DVec3::new(1e4, -2e4, 5e3)), (1e-3, DVec3::splat(1e3))] {
        for rational in [false, true] {
            let s = sheet(rational, size, off);
            let jets = SurfaceEvaluator::new(&s).derivatives(&uv);
            let mut worst = [[[0.0f64; 2]; 3]; 3];
            for (&at, jet) in uv.iter().zip(&jets) {
                let is = [[jet.s, jet.v, jet.vv], [jet.u, jet.uv, DVec3::ZERO], [jet.uu; 3]];
                for axis in 0..3 {
                    let expected = surface_reference(&s, axis, at);
                    for (k, l) in (0..3).flat_map(|k| (0..3 - k).map(move |l| (k, l))) {
                        let (value, error) = (expected[k][l].0, is[k][l][axis] - expected[k][l].0);
                        let [most, largest] = &mut worst[k][l];
                        (*most, *largest) = (most.max(error.abs()), largest.max(value.abs()));
                    }
                }
            }
            for (k, l) in (0..3).flat_map(|k| (0..3 - k).map(move |l| (k, l))) {
                let [most, largest] = worst[k][l];
                let off_by = most / largest;
                assert!(off_by < 1e-13, "rational {rational} at {off}, derivative {k} {l}: {off_by}");
            }
        }
    }
}
