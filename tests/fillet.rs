//! Fillets against centres found on sampled offsets, and the example that print gives.

use bladesmith::nurbs::{KnotVector, NurbsCurve};
use bladesmith::ops::fillet::{Fillet, corner_fillet, fillet_near, fillets};
use glam::DVec2;
use std::f64::consts::FRAC_PI_2;

type Curve = NurbsCurve<DVec2>;

/// Numbers in 0..1, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.next()
    }
}

fn line(a: (f64, f64), b: (f64, f64)) -> Curve {
    let poles = vec![DVec2::new(a.0, a.1), DVec2::new(b.0, b.1)];
    NurbsCurve::new(KnotVector::clamped(1, &[0.0, 1.0]).unwrap(), poles, None).unwrap()
}

/// The circle touches both curves where the fillet says, and the arc runs from one to the other.
fn check(name: &str, curves: [&Curve; 2], f: &Fillet) {
    let size = curves.iter().flat_map(|c| c.poles()).map(|p| p.length()).fold(f.radius, f64::max);
    let arc = f.arc(curves[0]).unwrap();
    let ends = [arc.point(0.0), arc.point(1.0)];
    for k in 0..2 {
        let [p, d, _] = curves[k].derivatives(f.parameters[k]);
        let r = f.centre - p;
        assert!((r.length() - f.radius).abs() < 1e-13 * size, "{name}: {} off", r.length() - f.radius);
        let slope = r.dot(d) / (r.length() * d.length());
        assert!(slope.abs() < 1e-12 * size / f.radius, "{name}: {slope} rad off the tangent of curve {k}");
        assert_eq!(d.perp_dot(r).signum(), f.sides[k], "{name}: side of curve {k}");
        assert!(ends[k].distance(p) < 1e-12 * size, "{name}: the arc misses curve {k}");
    }
    let [first, second] = f.trimmed(curves).unwrap();
    let tangents = [arc.derivatives(0.0)[1], arc.derivatives(1.0)[1]].map(|t| t.normalize());
    for (k, part) in [first, second].into_iter().enumerate() {
        let Some(part) = part else { continue };
        assert_eq!(part.knots().domain(), (0.0, 1.0));
        // What is left meets the arc at one end and goes on smoothly.
        let (t, sign) = if f.keeps_start(k) { (1.0, 1.0) } else { (0.0, -1.0) };
        let [p, d, _] = part.derivatives(t);
        assert!(p.distance(ends[k]) < 1e-12 * size, "{name}: a gap of {}", p.distance(ends[k]));
        let along = sign * d.normalize().dot(tangents[k]) * if k == 0 { 1.0 } else { -1.0 };
        assert!(along > 1.0 - 1e-9, "{name}: part {k} turns back at the arc: {along}");
    }
}

#[test]
fn the_circle_of_figure_2_12_lies_right_of_one_line_and_left_of_the_other() {
    let (first, second) = (line((-1.0, 1.0), (1.0, 1.0)), line((1.0, -1.0), (1.0, 1.0)));
    let all = fillets(&first, &second, 1.0, 1e-9).unwrap();
    assert_eq!(all.len(), 1, "{all:?}");
    let f = &all[0];
    assert!(f.centre.length() < 1e-15 && f.sides == [-1.0, 1.0], "{f:?}");
    assert!((f.angle + FRAC_PI_2).abs() < 1e-15 && f.parameters == [0.5, 0.5], "{f:?}");
    check("figure 2.12", [&first, &second], f);
    let [a, b] = f.trimmed([&first, &second]).unwrap().map(Option::unwrap);
    assert_eq!((a.point(0.0), a.point(1.0)), (DVec2::new(-1.0, 1.0), DVec2::new(0.0, 1.0)));
    assert_eq!((b.point(0.0), b.point(1.0)), (DVec2::new(1.0, -1.0), DVec2::new(1.0, 0.0)));
    assert_eq!(corner_fillet([&first, &second], 1.0, 1e-9).unwrap().as_ref(), Some(f));
}

#[test]
fn a_radius_too_large_for_its_lines_has_no_fillet() {
    let (first, second) = (line((-1.0, 1.0), (1.0, 1.0)), line((1.0, -1.0), (1.0, 1.0)));
    assert!(fillets(&first, &second, 2.1, 1e-9).unwrap().is_empty());
    assert_eq!(corner_fillet([&first, &second], 2.1, 1e-9).unwrap(), None);
    let apart = line((5.0, 5.0), (6.0, 5.0));
    assert!(corner_fillet([&first, &apart], 0.5, 1e-9).is_err());
    for (radius, tolerance) in [(0.0, 1e-9), (1.0, 0.0), (f64::NAN, 1e-9), (1.0, 2.0)] {
        assert!(fillets(&first, &second, radius, tolerance).is_err(), "{radius} {tolerance}");
    }
}

#[test]
fn crossing_lines_have_four_fillets_and_the_hint_chooses() {
    let (first, second) = (line((-3.0, 0.0), (3.0, 0.0)), line((0.0, -3.0), (0.0, 3.0)));
    assert_eq!(fillets(&first, &second, 1.0, 1e-9).unwrap().len(), 4);
    for (x, y) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        let f = fillet_near([&first, &second], 1.0, DVec2::new(2.0 * x, 0.5 * y), 1e-9).unwrap().unwrap();
        assert!(f.centre.distance(DVec2::new(x, y)) < 1e-14, "{f:?}");
        check("cross", [&first, &second], &f);
    }
}

#[test]
fn a_circle_that_cuts_a_curve_is_no_fillet() {
    // A wall crosses the corner where the circle would be.
    let first = line((0.0, 0.0), (4.0, 0.0));
    let poles = [(0.0, 0.0), (0.0, 3.0), (4.0, 3.0), (4.0, 1.2), (0.7, 1.2)];
    let knots = KnotVector::clamped(1, &[0.0, 1.0, 2.0, 3.0, 4.0]).unwrap();
    let second = NurbsCurve::new(knots, poles.map(|(x, y)| DVec2::new(x, y)).to_vec(), None).unwrap();
    let small = corner_fillet([&first, &second], 0.5, 1e-9).unwrap().unwrap();
    assert!(small.centre.distance(DVec2::new(0.5, 0.5)) < 1e-14, "{small:?}");
    let at = |f: &Fillet| f.centre.distance(DVec2::ONE) < 1e-9;
    assert!(!fillets(&first, &second, 1.0, 1e-9).unwrap().iter().any(at));
}

/// Centres on sampled offsets to the given sides, polished.
fn crossings(curves: [&Curve; 2], sides: [f64; 2], radius: f64) -> Vec<(DVec2, [f64; 2], f64)> {
    const N: usize = 1200;
    const BLOCK: usize = 24;
    let jet = |k: usize, t: f64| {
        let [c, d, dd] = curves[k].derivatives(t);
        let (speed, r) = (d.length(), sides[k] * radius);
        [c + d.perp() * (r / speed), d * (1.0 - r * d.perp_dot(dd) / speed.powi(3))]
    };
    let samples = [0, 1].map(|k| (0..=N).map(|i| jet(k, i as f64 / N as f64)[0]).collect::<Vec<_>>());
    let blocks = |k: usize| {
        let at = |from: usize| {
            let part = &samples[k][from..=from + BLOCK];
            let bound = |f: fn(DVec2, DVec2) -> DVec2| part.iter().copied().reduce(f).unwrap();
            (from, bound(DVec2::min), bound(DVec2::max))
        };
        (0..N).step_by(BLOCK).map(at).collect::<Vec<_>>()
    };
    let mut out = Vec::new();
    for (i0, low, high) in blocks(0) {
        for (j0, other_low, other_high) in blocks(1) {
            if low.cmpgt(other_high).any() || other_low.cmpgt(high).any() {
                continue;
            }
            for (i, j) in (i0..i0 + BLOCK).flat_map(|i| (j0..j0 + BLOCK).map(move |j| (i, j))) {
                let ([a, b], [c, d]) =
                    ([samples[0][i], samples[0][i + 1]], [samples[1][j], samples[1][j + 1]]);
                let side = |p: DVec2, q: DVec2, x: DVec2| (q - p).perp_dot(x - p) > 0.0;
                if side(a, b, c) == side(a, b, d) || side(c, d, a) == side(c, d, b) {
                    continue;
                }
                let [mut s, mut t] = [i, j].map(|i| (i as f64 + 0.5) / N as f64);
                for _ in 0..30 {
                    let ([p, dp], [q, dq]) = (jet(0, s), jet(1, t));
                    let (e, det) = (q - p, dp.perp_dot(dq));
                    s = (s + e.perp_dot(dq) / det).clamp(0.0, 1.0);
                    t = (t + e.perp_dot(dp) / det).clamp(0.0, 1.0);
                }
                let ([p, dp], [q, dq]) = (jet(0, s), jet(1, t));
                let angle = dp.perp_dot(dq).abs() / (dp.length() * dq.length());
                if p.distance(q) < 1e-10 {
                    out.push((p, [s, t], angle));
                }
            }
        }
    }
    out
}

/// The distance from a curve over [0, 1], by sampling and refining.
fn distance(curve: &Curve, p: DVec2) -> f64 {
    const N: usize = 1500;
    let at = |t: f64| curve.point(t.clamp(0.0, 1.0)).distance(p);
    let d: Vec<f64> = (0..=N).map(|i| at(i as f64 / N as f64)).collect();
    let least = d.iter().copied().fold(f64::MAX, f64::min);
    let mut best = least;
    for i in (0..=N).filter(|&i| d[i] < least + 0.05) {
        let (mut a, mut b) = ((i as f64 - 1.0) / N as f64, (i as f64 + 1.0) / N as f64);
        for _ in 0..60 {
            let (x, y) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if at(x) < at(y) { b = y } else { a = x }
        }
        best = best.min(at(0.5 * (a + b)));
    }
    best
}

/// A curve over [0, 1] from a point in about a direction.
fn random_curve(random: &mut Random, from: DVec2, along: DVec2) -> Curve {
    let degree = 1 + (random.next() * 4.0) as usize;
    let spans = 1 + (random.next() * 4.0) as usize;
    let spans = if degree == 1 { 1 } else { spans };
    let breaks: Vec<f64> = (0..=spans).map(|i| i as f64 / spans as f64).collect();
    let knots = KnotVector::clamped(degree, &breaks).unwrap();
    let n = knots.len();
    let pole = |i: usize, random: &mut Random| {
        let jitter = DVec2::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0));
        from + along * (6.0 * i as f64 / (n - 1) as f64) + if i > 0 { jitter } else { DVec2::ZERO }
    };
    let poles = (0..n).map(|i| pole(i, random)).collect();
    let weights = (random.next() < 0.3).then(|| (0..n).map(|_| random.within(0.5, 2.0)).collect());
    NurbsCurve::new(knots, poles, weights).unwrap()
}

/// A line and a curve at a narrow angle, whose one fillet was once missed.
#[test]
fn a_fillet_close_along_its_line_is_found() {
    let start = (0.783282516831515, -0.6981430793871708);
    let first = line(start, (-0.5957192224516705, 4.373926658800635));
    let poles = [
        start,
        (-0.16596709582803326, 0.253103649342618),
        (-2.0291273127564207, -0.59990403577008),
        (-3.3544280244115345, 0.5142926230513081),
        (-5.6796560028479535, 2.073280089676378),
    ];
    let knots = KnotVector::clamped(2, &[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]).unwrap();
    let second = Curve::new(knots, poles.map(DVec2::from).to_vec(), None).unwrap();
    let found = fillets(&first, &second, 1.0626809468575926, 1e-8).unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    check("corner", [&first, &second], &found[0]);
    assert_eq!(found[0].sides, [1.0, -1.0]);
    let expected = DVec2::new(-0.78145006, 1.00655339);
    assert!(found[0].centre.distance(expected) < 1e-7, "{}", found[0].centre);
}

#[test]
fn random_corners_have_exactly_the_fillets_that_sampling_finds() {
    let mut random = Random(7);
    let (mut seen, mut none) = (0, 0);
    for case in 0..500 {
        let angle = random.within(0.0, 6.3);
        let corner = DVec2::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0));
        let along = [DVec2::from_angle(angle), DVec2::from_angle(angle + random.within(0.3, 6.0))];
        // Every third pair crosses instead of meeting at its ends.
        let start = |k: usize| if case % 3 == 0 { corner - along[k] * 3.0 } else { corner };
        let mut first = random_curve(&mut random, start(0), along[0]);
        let second = random_curve(&mut random, start(1), along[1]);
        if case % 2 == 0 {
            first = first.reversed();
        }
        // Every tenth circle is too large for most corners.
        let large = if case % 10 == 9 { 5.0 } else { 1.0 };
        let (curves, radius) = ([&first, &second], large * random.within(0.1, 2.0));
        let found = fillets(&first, &second, radius, 1e-8).unwrap();
        none += usize::from(found.is_empty());
        for f in &found {
            let name = format!("case {case}");
            check(&name, curves, f);
            let free = curves.map(|c| distance(c, f.centre));
            assert!(free.iter().all(|d| *d >= radius - 1e-8), "{name}: {f:?} cuts: {free:?}");
        }
        for sides in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            for (centre, at, crossing) in crossings(curves, sides, radius) {
                let inside = at.iter().all(|t| *t > 1e-6 && *t < 1.0 - 1e-6);
                let free = curves.iter().all(|c| distance(c, centre) >= radius - 1e-10);
                if !inside || !free || crossing < 1e-3 {
                    continue;
                }
                seen += 1;
                let same = |f: &&Fillet| f.centre.distance(centre) < 1e-9 && f.sides == sides;
                assert!(
                    found.iter().any(|f| same(&f)),
                    "case {case}: {centre}, {sides:?}, {at:?} is missing"
                );
            }
        }
    }
    assert!(seen > 400 && none > 20, "{seen} centres and {none} pairs without any are too few");
}
