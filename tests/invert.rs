//! Point inversion against dense sampling, which misses no minimum.

use bladesmith::nurbs::{KnotVector, NurbsCurve, NurbsSurface};
use bladesmith::ops::invert::{CurveInverter, SurfaceInverter};
use glam::{DVec2, DVec3};

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

    fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::new(self.within(-size, size), self.within(-size, size), self.within(-size, size))
    }
}

fn knots(random: &mut Random, degree: usize, spans: usize) -> KnotVector {
    let mut breaks = vec![0.0];
    for _ in 0..spans {
        breaks.push(breaks[breaks.len() - 1] + random.within(0.1, 1.0));
    }
    KnotVector::clamped(degree, &breaks).unwrap()
}

fn weights(random: &mut Random, n: usize, rational: bool) -> Option<Vec<f64>> {
    rational.then(|| (0..n).map(|_| random.within(0.3, 3.0)).collect())
}

fn random_curve(random: &mut Random, degree: usize, rational: bool) -> NurbsCurve<DVec3> {
    let knots = knots(random, degree, 6);
    let poles: Vec<DVec3> = (0..knots.len()).map(|_| random.vector(5.0)).collect();
    let weights = weights(random, poles.len(), rational);
    NurbsCurve::new(knots, poles, weights).unwrap()
}

fn random_surface(random: &mut Random, degrees: [usize; 2], rational: bool) -> NurbsSurface {
    let (ku, kv) = (knots(random, degrees[0], 4), knots(random, degrees[1], 3));
    let (n, m) = (ku.len(), kv.len());
    let poles: Vec<DVec3> = (0..n * m)
        .map(|k| DVec3::new((k / m) as f64 * 2.0, (k % m) as f64 * 2.0, 0.0) + random.vector(1.5))
        .collect();
    let weights = weights(random, n * m, rational);
    NurbsSurface::new(ku, kv, poles, weights).unwrap()
}

/// Parameters between two others, evenly.
fn even(a: f64, b: f64, n: usize) -> impl Iterator<Item = f64> + Clone {
    (0..=n).map(move |i| a + (b - a) * i as f64 / n as f64)
}

#[test]
fn no_sample_of_a_curve_is_nearer_than_the_foot() {
    let mut random = Random(1);
    for case in 0..40 {
        let curve = random_curve(&mut random, 1 + case % 5, case % 3 == 0);
        let inverter = CurveInverter::new(&curve).unwrap();
        let (a, b) = curve.knots().domain();
        let samples: Vec<DVec3> = even(a, b, 4000).map(|t| curve.point(t)).collect();
        for _ in 0..250 {
            let p = random.vector(8.0);
            let found = inverter.nearest(p);
            let best = samples.iter().map(|s| s.distance(p)).fold(f64::MAX, f64::min);
            assert!(found.distance <= best + 1e-9, "curve {case}: {found:?} for {p}, but {best} is possible");
            assert!(curve.point(found.at).distance(found.point) < 1e-12, "curve {case}: {found:?}");
            assert!((found.point.distance(p) - found.distance).abs() < 1e-12, "curve {case}: {found:?}");
        }
    }
}

#[test]
fn no_sample_of_a_surface_is_nearer_than_the_foot() {
    let mut random = Random(2);
    for (case, degrees) in [[1, 1], [2, 3], [3, 3], [5, 2], [3, 4], [3, 3]].into_iter().enumerate() {
        let surface = random_surface(&mut random, degrees, case % 2 == 1);
        let inverter = SurfaceInverter::new(&surface).unwrap();
        let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
        let grid = even(u0, u1, 150).flat_map(|u| even(v0, v1, 150).map(move |v| (u, v)));
        let samples: Vec<DVec3> = grid.map(|(u, v)| surface.point(u, v)).collect();
        for _ in 0..200 {
            let p = random.vector(8.0) + DVec3::new(6.0, 6.0, 0.0);
            let found = inverter.nearest(p);
            let best = samples.iter().map(|s| s.distance(p)).fold(f64::MAX, f64::min);
            assert!(found.distance <= best + 1e-9, "{case}: {found:?} for {p}, but {best} is possible");
            assert!(surface.point(found.at.x, found.at.y).distance(found.point) < 1e-12, "{found:?}");
        }
    }
}

#[test]
fn feet_of_points_off_the_surface_are_where_they_came_from() {
    let mut random = Random(3);
    let surface = random_surface(&mut random, [3, 3], false);
    let inverter = SurfaceInverter::new(&surface).unwrap();
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    for _ in 0..2000 {
        let uv = DVec2::new(random.within(u0, u1), random.within(v0, v1));
        let d = surface.derivatives(uv.x, uv.y);
        let p = d.s + d.normal().normalize() * random.within(-1e-3, 1e-3);
        let found = inverter.nearest(p);
        assert!(found.distance <= p.distance(d.s) + 1e-12, "{found:?} instead of {uv}");
        assert!(found.point.distance(d.s) < 1e-8, "{found:?} instead of {uv} for {p}");
    }
}

#[test]
fn a_batch_finds_what_single_questions_find() {
    let mut random = Random(4);
    for rational in [false, true] {
        let surface = random_surface(&mut random, [3, 2], rational);
        let inverter = SurfaceInverter::new(&surface).unwrap();
        let points: Vec<DVec3> = (0..500).map(|_| random.vector(5.0) + DVec3::new(6.0, 5.0, 0.0)).collect();
        let (many, parallel) = (inverter.nearest_many(&points), inverter.nearest_many_parallel(&points));
        assert_eq!(many.len(), points.len());
        for ((&p, a), b) in points.iter().zip(&many).zip(&parallel) {
            let one = inverter.nearest(p).distance;
            assert!((a.distance - one).abs() < 1e-12, "{a:?} instead of {one} from {p}");
            assert!((b.distance - one).abs() < 1e-12, "{b:?} instead of {one} from {p}");
            assert!(surface.point(a.at.x, a.at.y).distance(a.point) < 1e-12, "{a:?}");
        }
        assert!(inverter.nearest_many(&[]).is_empty());
    }
}

#[test]
fn size_and_place_do_not_matter() {
    for (size, off) in [(1e-3, DVec3::ZERO), (1e-3, DVec3::new(1e3, -500.0, 70.0)), (1e4, DVec3::ONE)] {
        let mut random = Random(5);
        let plain = random_surface(&mut random, [3, 3], false);
        let poles = plain.poles().iter().map(|&x| x * size + off).collect();
        let moved = NurbsSurface::new(plain.knots_u().clone(), plain.knots_v().clone(), poles, None).unwrap();
        let inverters = [&plain, &moved].map(|s| SurfaceInverter::new(s).unwrap());
        let rounding = 1e-14 * (off.length() + 20.0 * size);
        for _ in 0..500 {
            let p = random.vector(4.0) + DVec3::new(6.0, 4.0, 0.0);
            let [a, b] = [inverters[0].nearest(p), inverters[1].nearest(p * size + off)];
            let error = (a.distance * size - b.distance).abs();
            assert!(error < rounding, "times {size} at {off}: {b:?} instead of {a:?}, off by {error}");
        }
    }
}

#[test]
fn the_nose_of_a_blade_keeps_its_feet() {
    // A parabola of 0.05 mm radius at its end, swept along z: parameters run fast along the sides.
    let k = KnotVector::clamped(2, &[-1.0, 1.0]).unwrap();
    let line = KnotVector::clamped(1, &[0.0, 1.0]).unwrap();
    let at = |x: f64, y: f64| [DVec3::new(x, y, 0.0), DVec3::new(x, y, 100.0)];
    let poles = [at(100.0, -10f64.sqrt()), at(-100.0, 0.0), at(100.0, 10f64.sqrt())].concat();
    let surface = NurbsSurface::new(k, line, poles, None).unwrap();
    let inverter = SurfaceInverter::new(&surface).unwrap();
    let mut random = Random(6);
    for _ in 0..2000 {
        let uv = DVec2::new(random.within(-1.0, 1.0).powi(5), random.within(0.0, 1.0));
        let d = surface.derivatives(uv.x, uv.y);
        let p = d.s + d.normal().normalize() * random.within(-0.02, 0.02);
        let found = inverter.nearest(p);
        assert!(found.distance <= p.distance(d.s) + 1e-12, "{found:?} instead of {uv}");
    }
}

/// Most beside the shape, where one foot leads to the next, and some far from everything.
#[test]
fn long_batches_find_what_single_questions_find() {
    let mut random = Random(7);
    for (degrees, rational) in [([3, 3], false), ([5, 3], true), ([1, 2], false)] {
        let surface = random_surface(&mut random, degrees, rational);
        let inverter = SurfaceInverter::new(&surface).unwrap();
        let curve = random_curve(&mut random, degrees[0], rational);
        let along = CurveInverter::new(&curve).unwrap();
        let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
        let (a, b) = curve.knots().domain();
        let (mut beside, mut near) = (Vec::new(), Vec::new());
        for k in 0..3000 {
            let off = random.vector(if k % 10 == 0 { 20.0 } else { 0.05 });
            beside.push(surface.point(random.within(u0, u1), random.within(v0, v1)) + off);
            near.push(curve.point(random.within(a, b)) + off);
        }
        for (&p, found) in beside.iter().zip(inverter.nearest_many(&beside)) {
            let one = inverter.nearest(p).distance;
            assert!((found.distance - one).abs() < 1e-12, "{degrees:?}: {found:?} instead of {one} from {p}");
            assert!(surface.point(found.at.x, found.at.y).distance(found.point) < 1e-12, "{found:?}");
        }
        for (&p, found) in near.iter().zip(along.nearest_many(&near)) {
            let one = along.nearest(p).distance;
            assert!((found.distance - one).abs() < 1e-12, "{degrees:?}: {found:?} instead of {one} from {p}");
            assert!(curve.point(found.at).distance(found.point) < 1e-12, "{found:?}");
        }
    }
}

/// From one point to the next it is many pieces, and not always as many.
#[test]
fn sparse_batches_find_what_single_questions_find() {
    let mut random = Random(8);
    let breaks: Vec<f64> = (0..=400).map(f64::from).collect();
    let (ku, kv) = (KnotVector::clamped(2, &breaks).unwrap(), KnotVector::clamped(1, &[0.0, 1.0]).unwrap());
    let pole = |k: usize| DVec3::new((k / 2) as f64, (k % 2) as f64, 0.0) + random.vector(0.4);
    let poles = (0..ku.len() * 2).map(pole).collect();
    let surface = NurbsSurface::new(ku, kv, poles, None).unwrap();
    let inverter = SurfaceInverter::new(&surface).unwrap();
    for batch in 0..400 {
        let mut place = || surface.point(random.within(0.0, 400.0), random.next()) + random.vector(0.02);
        let points: Vec<DVec3> = (0..50).map(|_| place()).collect();
        for (&p, found) in points.iter().zip(inverter.nearest_many(&points)) {
            let one = inverter.nearest(p).distance;
            assert!((found.distance - one).abs() < 1e-12, "{batch}: {found:?} instead of {one} from {p}");
        }
    }
}

/// A full circle of nine poles.
fn circle() -> NurbsCurve<DVec2> {
    let s = std::f64::consts::FRAC_1_SQRT_2;
    let at = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
    let poles = at.map(|(x, y)| DVec2::new(x as f64, y as f64)).to_vec();
    let flat = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0].to_vec();
    let weights = (0..9).map(|k| if k % 2 == 0 { 1.0 } else { s }).collect();
    NurbsCurve::new(KnotVector::new(2, flat).unwrap(), poles, Some(weights)).unwrap()
}

/// Newton's method for a root of the distance, which has none here, ends on a bound or alternates.
#[test]
fn the_foot_on_a_parabola_is_where_its_cubic_says() {
    let knots = KnotVector::clamped(2, &[0.0, 1.0]).unwrap();
    let poles = [(-1.0, 1.0), (0.0, -1.0), (1.0, 1.0)].map(DVec2::from).to_vec();
    let found = CurveInverter::new(&NurbsCurve::new(knots, poles, None).unwrap())
        .unwrap()
        .nearest(DVec2::new(0.3, 1.0));
    let x = 2.0 * found.at - 1.0;
    assert!((found.at - 0.91282).abs() < 5e-6, "{found:?}");
    assert!((2.0 * x * x * x - x - 0.3).abs() < 1e-12, "{found:?}");
}

#[test]
fn ties_are_all_reported() {
    let parabola = NurbsCurve::new(
        KnotVector::clamped(2, &[0.0, 1.0]).unwrap(),
        vec![DVec2::new(-1.0, 1.0), DVec2::new(0.0, -1.0), DVec2::new(1.0, 1.0)],
        None,
    )
    .unwrap();
    let found = CurveInverter::new(&parabola).unwrap().nearest_all(DVec2::new(0.0, 2.0), 1e-9);
    assert_eq!(found.len(), 2, "{found:?}");
    for f in &found {
        // x² + (x² − 2)² is least where x² = 3/2, beyond the ends.
        assert!((f.point.x.abs() - 1.0).abs() < 1e-12, "{f:?}");
    }
    // x² + (x² − 1)² is least where x² = 1/2.
    let found = CurveInverter::new(&parabola).unwrap().nearest_all(DVec2::new(0.0, 1.0), 1e-9);
    let expected = 0.5f64.sqrt();
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().all(|f| (f.point.x.abs() - expected).abs() < 1e-7), "{found:?}");
}

#[test]
fn the_centre_of_a_circle_is_equally_far_from_many_points() {
    let inverter = CurveInverter::new(&circle()).unwrap();
    assert!((inverter.nearest(DVec2::ZERO).distance - 1.0).abs() < 1e-12);
    let all = inverter.nearest_all(DVec2::ZERO, 1e-9);
    assert!(all.len() > 4 && all.iter().all(|f| (f.distance - 1.0).abs() < 1e-9));
    let seam = inverter.nearest_all(DVec2::new(2.0, 0.0), 1e-9);
    assert_eq!(seam.len(), 2, "both ends of a closed curve: {seam:?}");
}

#[test]
fn a_degenerate_side_is_one_point() {
    // A triangle: the side v = 1 is the point (0, 0, 1).
    let k = || KnotVector::clamped(1, &[0.0, 1.0]).unwrap();
    let apex = DVec3::Z;
    let surface = NurbsSurface::new(k(), k(), vec![DVec3::ZERO, apex, DVec3::X, apex], None).unwrap();
    let inverter = SurfaceInverter::new(&surface).unwrap();
    let above = inverter.nearest(DVec3::new(0.1, 0.3, 4.0));
    assert!((above.point - apex).length() < 1e-9, "{above:?}");
    let below = inverter.nearest(DVec3::new(0.25, 1.0, 0.25));
    assert!((below.distance - 1.0).abs() < 1e-12, "{below:?}");
}

/// At a kink each piece has its own tangent, and Newton's method must not follow that of the next.
#[test]
fn feet_on_a_rational_polyline_lie_on_its_nearest_leg() {
    let points = [(0.0, 3.0), (0.4, 0.0), (4.0, 4.5), (7.0, 1.0), (7.5, 5.0)].map(DVec2::from);
    let knots = KnotVector::clamped(1, &[0.0, 0.4, 1.1, 1.4, 2.3]).unwrap();
    let weights = vec![2.0, 0.6, 2.5, 0.5, 1.5];
    let inverter =
        CurveInverter::new(&NurbsCurve::new(knots, points.to_vec(), Some(weights)).unwrap()).unwrap();
    let mut random = Random(11);
    for _ in 0..5000 {
        let leg = (4.0 * random.next()) as usize;
        let p = points[leg].lerp(points[leg + 1], random.next().powi(3))
            + 1e-2 * DVec2::new(random.next() - 0.5, random.next() - 0.5);
        let from_leg = |w: &[DVec2]| {
            let along = w[1] - w[0];
            let s = ((p - w[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            p.distance(w[0] + along * s)
        };
        let expected = points.windows(2).map(from_leg).fold(f64::MAX, f64::min);
        let found = inverter.nearest(p).distance;
        assert!((found - expected).abs() < 1e-13, "{p}: {found} instead of {expected}");
    }
}
