//! Offsets against dense sampling of their source, and the counter-examples to the printed rules.

use bladesmith::nurbs::{KnotVector, NurbsCurve, Side};
use bladesmith::ops::invert::CurveInverter;
use bladesmith::ops::offset::{Corner, Offset, OffsetCurve, domain_map};
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, TAU};

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

    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }
}

fn even(a: f64, b: f64, n: usize) -> impl Iterator<Item = f64> + Clone {
    (0..=n).map(move |i| a + (b - a) * i as f64 / n as f64)
}

fn spline(degree: usize, points: &[(f64, f64)]) -> Curve {
    let breaks: Vec<f64> = even(0.0, 1.0, points.len() - degree).collect();
    let poles = points.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
    NurbsCurve::new(KnotVector::clamped(degree, &breaks).unwrap(), poles, None).unwrap()
}

/// The distance from a curve by sampling, refined around every sample that may be the nearest.
struct Sampled<'a> {
    curve: &'a Curve,
    at: Vec<(f64, DVec2)>,
    step: f64,
}

impl<'a> Sampled<'a> {
    fn new(curve: &'a Curve, n: usize) -> Self {
        let breaks = curve.knots().breaks();
        let each = n / (breaks.len() - 1);
        let mut at: Vec<(f64, DVec2)> =
            breaks.windows(2).flat_map(|w| even(w[0], w[1], each)).map(|t| (t, curve.point(t))).collect();
        at.dedup_by(|a, b| a.0 == b.0);
        let step = at.windows(2).map(|w| w[0].1.distance(w[1].1)).fold(0.0, f64::max);
        Self { curve, at, step }
    }

    fn distance(&self, p: DVec2) -> f64 {
        let d: Vec<f64> = self.at.iter().map(|s| s.1.distance(p)).collect();
        let least = d.iter().copied().fold(f64::MAX, f64::min);
        let mut best = least;
        for i in 0..d.len() - 1 {
            let (low, is_lowest) = (d[i].min(d[i + 1]), |k: usize| {
                d[k] <= d[k.saturating_sub(1)] && d[k] <= d[(k + 1).min(d.len() - 1)]
            });
            // Near a centre of curvature a minimum may lie between two samples of a slope.
            let is_flat = low <= least + 0.005 * self.step;
            if is_flat || (low <= least + self.step && (is_lowest(i) || is_lowest(i + 1))) {
                best = best.min(self.lowest(p, self.at[i].0, self.at[i + 1].0));
            }
        }
        best
    }

    /// The least distance between two parameters.
    fn lowest(&self, p: DVec2, from: f64, to: f64) -> f64 {
        let at = |t: f64| self.curve.point(t).distance(p);
        let (lowest, step) = (even(from, to, 8).min_by(|&x, &y| at(x).total_cmp(&at(y))), (to - from) / 8.0);
        let lowest = lowest.expect("nine places");
        let (mut a, mut b) = ((lowest - step).max(from), (lowest + step).min(to));
        for _ in 0..36 {
            let (x, y) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if at(x) < at(y) { b = y } else { a = x }
        }
        at(0.5 * (a + b))
    }
}

/// Points of the untrimmed offset from its definition, also on arcs around outward corners if asked.
fn untrimmed(curve: &Curve, d: f64, n: usize, arcs: bool) -> Vec<DVec2> {
    let breaks = curve.knots().breaks();
    let normal = |side: Side, t: f64| {
        let jet = curve.derivatives_from(side, t, 1);
        (jet[0], jet[1].normalize().perp() * d)
    };
    let mut out = Vec::new();
    let mut corner = |c: DVec2, from: DVec2, to: DVec2| {
        let turn = from.angle_to(to);
        if arcs && turn * d < -1e-6 * d.abs() {
            out.extend(even(0.0, turn, 20).map(|a| c + DVec2::from_angle(a).rotate(from)));
        }
    };
    for &t in &breaks[1..breaks.len() - 1] {
        corner(curve.point(t), normal(Side::Below, t).1, normal(Side::Above, t).1);
    }
    let (a, b) = curve.knots().domain();
    if curve.point(a).distance(curve.point(b)) < 1e-9 * d.abs() {
        corner(curve.point(a), normal(Side::Below, b).1, normal(Side::Above, a).1);
    }
    for w in breaks.windows(2) {
        let each = n / (breaks.len() - 1);
        let inner = even(w[0], w[1], each).skip(1).take(each - 1);
        out.extend(inner.map(|t| normal(Side::Above, t)).map(|(c, n)| c + n));
    }
    out
}

/// No point of the result is nearer than asked, and none of the true one is missing.
fn judge(name: &str, curve: &Curve, offset: Offset, samples: usize) -> Vec<OffsetCurve> {
    let result = offset.trimmed(curve).unwrap_or_else(|e| panic!("{name}: {e}"));
    let (source, distance, tolerance) =
        (Sampled::new(curve, samples), offset.distance.abs(), offset.tolerance);
    let rounding = 1e-13 * curve.poles().iter().map(|p| p.length()).fold(0.0, f64::max);
    for (k, part) in result.iter().enumerate() {
        let (a, b) = part.curve.knots().domain();
        for t in even(a, b, 150) {
            let d = source.distance(part.curve.point(t));
            let short = distance - d;
            assert!(
                short <= tolerance + rounding,
                "{name}, curve {k} at {t}: {short:e} too near, {offset:?}"
            );
            let s = part.source_parameter(t);
            let arc = offset.corner == Corner::Arc;
            assert!(!arc || -short <= tolerance + rounding, "{name}, curve {k} at {t}: {:e} too far", -short);
            let foot = curve.point(s).distance(part.curve.point(t)) - distance;
            assert!(!arc || foot.abs() <= tolerance + rounding, "{name} at {t}: foot {s} is {foot:e} off");
        }
        let ends = part.curve.point(a).distance(part.curve.point(b));
        assert!(!part.closed || ends <= tolerance, "{name}: closed, but {ends} apart");
    }
    let found: Vec<CurveInverter<DVec2>> =
        result.iter().map(|r| CurveInverter::new(&r.curve).unwrap()).collect();
    for p in untrimmed(curve, offset.distance, 400, offset.corner == Corner::Arc) {
        let d = source.distance(p);
        let nearest = found.iter().map(|f| f.nearest(p).distance).fold(f64::MAX, f64::min);
        if d >= distance - rounding - 1e-3 * tolerance {
            assert!(
                nearest <= 20.0 * tolerance,
                "{name}: {p} is {d} away, but {nearest} is missing, {offset:?}"
            );
        }
    }
    result
}

fn sources(parts: &[OffsetCurve]) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = parts.iter().flat_map(|p| &p.pieces).map(|p| p.source).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all
}

#[test]
fn a_circle_smaller_than_the_distance_leaves_nothing_though_its_offset_has_no_loop() {
    let quarter = NurbsCurve::arc(DVec2::ZERO, DVec2::X * 0.5, DVec2::Y * 0.5, 0.0, FRAC_PI_2).unwrap();
    let offset = Offset::new(1.0, 1e-6);
    assert!(judge("quarter", &quarter, offset, 2000).is_empty());
    let raw = offset.raw(&quarter).unwrap();
    for t in even(0.0, 1.0, 20) {
        let p = raw[0].curve.point(t);
        assert!((p.length() - 0.5).abs() < 4e-15 && quarter.point(t).dot(p) < 0.0, "{p}");
        let away = Sampled::new(&quarter, 2000).distance(p);
        assert!((0.70..0.93).contains(&away), "{p} is {away} away, not 1");
    }
    // The other side is an exact arc of radius 1.5.
    let outer = judge("quarter", &quarter, Offset::new(-1.0, 1e-6), 2000);
    assert_eq!(outer[0].curve.poles().len(), 3);
    assert!(even(0.0, 1.0, 50).all(|t| (outer[0].curve.point(t).length() - 1.5).abs() < 4e-15));
}

#[test]
fn a_global_loop_is_cut_where_its_neck_is_too_narrow() {
    // A bulb with a neck 1.1 wide; its inner side is to the right.
    let points = [(-4.0, 0.0), (-1.5, 0.0), (0.6, 0.0), (-2.8, 2.2), (-1.6, 4.6), (1.6, 4.6), (2.8, 2.2)];
    let all: Vec<(f64, f64)> = points.into_iter().chain([(-0.6, 0.0), (1.5, 0.0), (4.0, 0.0)]).collect();
    let bulb = spline(3, &all);
    for (d, expected) in [(-0.2, 1), (-0.7, 3), (-0.8, 3), (-1.2, 3)] {
        let parts = judge("bulb", &bulb, Offset::new(d, 1e-7), 4000);
        let kept = sources(&parts);
        assert_eq!(kept.len(), expected, "{d}: {kept:?}");
        assert!(kept.iter().any(|k| k[0] < 0.5 && k[1] > 0.5), "{d}: the inside is lost: {kept:?}");
    }
}

#[test]
fn the_offset_of_a_hook_ends_where_its_end_comes_too_near() {
    let hook = spline(3, &[(0.0, 0.0), (4.0, 0.0), (6.0, 0.0), (6.0, 2.0), (2.0, 1.0), (1.5, 0.8)]);
    let offset = Offset::new(0.7, 1e-7);
    let parts = judge("hook", &hook, offset, 4000);
    let end = hook.point(1.0);
    let cut = parts[0].curve.point(parts[0].curve.knots().domain().1);
    assert!((cut.distance(end) - 0.7).abs() < 1e-12, "{} from the end", cut.distance(end));
}

#[test]
fn curvature_alone_makes_no_loop() {
    let parabola =
        |width: f64| spline(2, &[(-width, width * width), (0.0, -width * width), (width, width * width)]);
    let (wide, narrow) = (parabola(1.0), parabola(0.1));
    // The least radius is 0.5.
    let loops = sources(&judge("parabola", &wide, Offset::new(0.501, 1e-7), 4000));
    assert_eq!(loops.len(), 2, "{loops:?}");
    let (gap, expected) = (loops[1][0] - loops[0][1], 0.5 * (4.0 * 0.501f64.powi(2) - 1.0).sqrt());
    assert!((gap - expected).abs() < 1e-6, "a loop of {gap} where {expected} is cut");
    assert_eq!(sources(&judge("parabola", &wide, Offset::new(-0.6, 1e-7), 4000)).len(), 1);
    assert!(judge("parabola", &narrow, Offset::new(0.6, 1e-7), 4000).is_empty());
}

#[test]
fn the_domain_map_reaches_the_kept_parameters() {
    let wide = spline(2, &[(-1.0, 1.0), (0.0, -1.0), (1.0, 1.0)]);
    let parts = Offset::new(0.7, 1e-7).trimmed(&wide).unwrap();
    let map = domain_map(&wide, &parts).unwrap();
    assert_eq!(map.intervals(), sources(&parts));
    assert_eq!((map.at(0.0), map.at(1.0)), (0.0, 1.0));
    assert!(map.at(0.5 - 1e-9) < 0.5 && map.at(0.5 + 1e-9) > 0.5);
    assert!(domain_map(&wide, &[]).is_none());
}

#[test]
fn rectangles_grow_by_arcs_or_corners_and_shrink_by_cuts() {
    let square = spline(1, &[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0), (0.0, 0.0)]);
    let length = |parts: &[OffsetCurve]| -> Vec<f64> {
        parts.iter().map(|p| p.curve.length(1e-12).unwrap()).collect()
    };
    let inner = judge("inner", &square, Offset::new(0.5, 1e-7), 2000);
    assert!(inner[0].closed && (length(&inner)[0] - 10.0).abs() < 1e-11, "{:?}", length(&inner));
    let outer = judge("outer", &square, Offset::new(-0.5, 1e-7), 2000);
    assert!(outer[0].closed && (length(&outer)[0] - 14.0 - 0.5 * TAU).abs() < 1e-11, "{:?}", length(&outer));
    let corner = Corner::Extension { limit: 2.0 };
    let pointed = judge("pointed", &square, Offset { corner, ..Offset::new(-0.5, 1e-7) }, 2000);
    assert!(pointed[0].closed && (length(&pointed)[0] - 18.0).abs() < 1e-11, "{:?}", length(&pointed));
    assert!(judge("nothing", &square, Offset::new(1.6, 1e-7), 2000).is_empty());
    let blunt = Offset { corner: Corner::Extension { limit: 1.1 }, ..Offset::new(-0.5, 1e-7) };
    assert!((length(&blunt.trimmed(&square).unwrap())[0] - length(&outer)[0]).abs() < 1e-11);
}

#[test]
fn walls_twice_the_distance_apart_meet() {
    let slot = spline(1, &[(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0), (0.0, 0.0)]);
    let parts = judge("slot", &slot, Offset::new(1.0, 1e-6), 2000);
    let length: f64 = parts.iter().map(|p| p.curve.length(1e-9).unwrap()).sum();
    assert!((length - 4.0).abs() < 1e-5, "both sides of the middle line, {length}");
    let ring = NurbsCurve::arc(DVec2::ZERO, DVec2::X, DVec2::Y, 0.0, TAU).unwrap();
    assert!(Offset::new(1.0, 1e-6).trimmed(&ring).unwrap().is_empty(), "a point is no curve");
    assert!(judge("ring", &ring, Offset::new(0.9, 1e-6), 2000)[0].closed);
}

#[test]
fn unusable_input_is_refused() {
    let line = spline(1, &[(0.0, 0.0), (1.0, 0.0)]);
    for (distance, tolerance) in [(0.0, 1e-3), (f64::NAN, 1e-3), (1.0, 0.0), (1.0, 2.0), (1.0, f64::NAN)] {
        let offset = Offset::new(distance, tolerance);
        assert!(offset.trimmed(&line).is_err() && offset.raw(&line).is_err(), "{offset:?}");
    }
    let point = spline(2, &[(1.0, 1.0), (1.0, 1.0), (1.0, 1.0)]);
    let message = Offset::new(1.0, 1e-3).trimmed(&point).unwrap_err().to_string();
    assert!(message.contains("stands still"), "{message}");
    let corner = Corner::Extension { limit: 0.5 };
    assert!(Offset { corner, ..Offset::new(1.0, 1e-3) }.trimmed(&line).is_err());
}

/// An open or closed curve with or without corners.
fn random_curve(random: &mut Random, scale: f64, shift: DVec2) -> Curve {
    let (degree, spans) = (1 + random.below(5), 3 + random.below(8));
    let closed = random.below(2) == 0;
    let mut breaks = vec![0.0];
    for _ in 0..spans {
        breaks.push(breaks[breaks.len() - 1] + random.within(0.3, 1.0));
    }
    let kinked = random.below(3) == 0;
    let mut multiplicities: Vec<usize> =
        (0..=spans).map(|_| if kinked && random.below(3) == 0 { degree } else { 1 }).collect();
    (multiplicities[0], multiplicities[spans]) = (degree + 1, degree + 1);
    let knots = KnotVector::with_multiplicities(degree, &breaks, &multiplicities).unwrap();
    let n = knots.len();
    let (wave, lobes) = (random.within(0.1, 0.9), random.within(1.0, 6.0));
    let pole = |i: usize, random: &mut Random| {
        let s = i as f64 / (n - 1) as f64;
        let jitter = DVec2::new(random.within(-0.5, 0.5), random.within(-0.5, 0.5));
        if closed {
            DVec2::from_angle(TAU * s) * (3.0 + 2.0 * wave * (lobes * TAU * s).sin()) + jitter
        } else {
            DVec2::new(10.0 * s, 3.0 * wave * (lobes * TAU * s).sin()) + 2.0 * jitter
        }
    };
    let mut poles: Vec<DVec2> = (0..n).map(|i| pole(i, random) * scale + shift).collect();
    if closed {
        poles[n - 1] = poles[0];
    }
    let rational = random.below(3) == 0;
    let weights = rational.then(|| (0..n).map(|_| random.within(0.4, 2.5)).collect());
    let curve = NurbsCurve::new(knots, poles, weights).unwrap();
    if random.below(2) == 0 { curve } else { curve.reversed() }
}

/// A closed curve around a bent row of beads, with necks that an inward offset by 0.8 to 1.1 does not
/// pass, and such an offset.
fn random_beads(random: &mut Random, scale: f64, shift: DVec2) -> (Curve, f64) {
    let (beads, degree) = (2 + random.below(3), 1 + random.below(4));
    let (heading, bow) = (random.within(0.0, TAU), random.within(-0.03, 0.03));
    let mut sides = [Vec::new(), Vec::new()];
    for i in 0..5 * beads - 2 {
        let is_neck = i % 5 > 2;
        for (side, sign) in sides.iter_mut().zip([-1.0, 1.0]) {
            let half = if is_neck { random.within(0.1, 0.6) } else { random.within(1.4, 2.4) };
            let x = i as f64 + random.within(-0.2, 0.2);
            side.push(DVec2::from_angle(heading).rotate(DVec2::new(x, sign * half + bow * x * x)));
        }
    }
    let [lower, upper] = sides;
    let mut poles: Vec<DVec2> = lower.into_iter().chain(upper.into_iter().rev()).collect();
    poles.push(poles[0]);
    let poles: Vec<(f64, f64)> = poles.into_iter().map(|p| (p * scale + shift).into()).collect();
    let (curve, d) = (spline(degree, &poles), scale * random.within(0.8, 1.1));
    if random.below(2) == 0 { (curve, d) } else { (curve.reversed(), -d) }
}

#[test]
fn random_offsets_keep_their_distance_and_miss_nothing() {
    let mut random = Random(4);
    let (mut empty, mut several) = (0, 0);
    for case in 0..500 {
        let scale = [1.0, 1.0, 1e-3, 1e3][case % 4];
        let shift = if case % 8 == 3 { DVec2::new(1e3, -1e3) } else { DVec2::ZERO };
        let (curve, d) = if case % 7 == 6 {
            random_beads(&mut random, scale, shift)
        } else {
            let curve = random_curve(&mut random, scale, shift);
            (curve, scale * random.within(0.05, 2.5) * if random.below(2) == 0 { 1.0 } else { -1.0 })
        };
        let corner = if case % 5 == 4 { Corner::Extension { limit: 3.0 } } else { Corner::Arc };
        let offset = Offset { distance: d, tolerance: 1e-6 * scale, corner };
        let parts = judge(&format!("case {case}"), &curve, offset, 3000);
        empty += usize::from(parts.is_empty());
        several += usize::from(parts.len() > 1);
    }
    println!("{empty} empty, {several} in several parts");
    assert!(empty > 5 && several >= 50, "{empty} empty ones and {several} with several parts are too few");
}
