//! Rays against curves and surfaces.

use bladesmith::nurbs::{Direction, KnotVector, NurbsCurve, NurbsSurface};
use bladesmith::ops::intersect::Kind;
use bladesmith::ops::ray::{Ray, SurfaceCaster};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

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

fn knots(random: &mut Random, degree: usize) -> KnotVector {
    let mut breaks = vec![0.0];
    for _ in 0..4 {
        breaks.push(breaks[breaks.len() - 1] + random.within(0.1, 1.0));
    }
    KnotVector::clamped(degree, &breaks).unwrap()
}

fn surface(random: &mut Random, degrees: [usize; 2], rational: bool) -> NurbsSurface {
    let (ku, kv) = (knots(random, degrees[0]), knots(random, degrees[1]));
    let (n, m) = (ku.len(), kv.len());
    let at = |k: usize| DVec3::new((k / m) as f64, (k % m) as f64, 0.0);
    let poles = (0..n * m).map(|k| at(k) + random.vector(1.2)).collect();
    let weights = rational.then(|| (0..n * m).map(|_| random.within(0.3, 3.0)).collect());
    NurbsSurface::new(ku, kv, poles, weights).unwrap()
}

/// Newton's method for `S(u, v) = origin + s direction`, kept within the domain.
fn newton(surface: &NurbsSurface, origin: DVec3, direction: DVec3, mut at: DVec2) -> Option<(DVec2, f64)> {
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let mut s = 0.0;
    for _ in 0..25 {
        let [p, du, dv] = surface.first_derivatives(at.x, at.y);
        let matrix = glam::DMat3::from_cols(du, dv, -direction);
        let by = matrix.inverse() * (p - origin);
        if !by.is_finite() {
            return None;
        }
        at = DVec2::new((at.x - by.x).clamp(u0, u1), (at.y - by.y).clamp(v0, v1));
        s = -by.z;
    }
    (surface.point(at.x, at.y).distance(origin + direction * s) < 1e-11).then_some((at, s))
}

/// Hits by Newton's method from every cell of a grid whose corners are near the ray.
fn brute_force(surface: &NurbsSurface, origin: DVec3, direction: DVec3) -> Vec<(DVec2, f64)> {
    const N: usize = 60;
    let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let at = |i: f64, j: f64| DVec2::new(u0 + (u1 - u0) * i / N as f64, v0 + (v1 - v0) * j / N as f64);
    let point = |i: usize, j: usize| {
        let at = at(i as f64, j as f64);
        surface.point(at.x, at.y)
    };
    let grid: Vec<DVec3> =
        (0..=N).flat_map(|i| (0..=N).map(move |j| (i, j))).map(|(i, j)| point(i, j)).collect();
    let mut found: Vec<(DVec2, f64)> = Vec::new();
    for i in 0..N {
        for j in 0..N {
            let corner = |a: usize, b: usize| grid[(i + a) * (N + 1) + j + b];
            let (p, q) = (corner(0, 0), corner(1, 1));
            let size = p.distance(q).max(corner(0, 1).distance(corner(1, 0)));
            let off = (0.5 * (p + q) - origin).reject_from_normalized(direction).length();
            if off > size {
                continue;
            }
            let Some(hit) = newton(surface, origin, direction, at(i as f64 + 0.5, j as f64 + 0.5)) else {
                continue;
            };
            if !found.iter().any(|known| known.0.distance(hit.0) < 1e-7) {
                found.push(hit);
            }
        }
    }
    found
}

#[test]
fn rays_hit_random_surfaces_where_brute_force_does() {
    let mut random = Random(1);
    let (mut total, mut more) = (0, 0);
    for case in 0..24 {
        let s = surface(&mut random, [1 + case % 4, 1 + case / 4 % 5], case % 2 == 1);
        let caster = SurfaceCaster::new(&s).unwrap();
        for ray in 0..30 {
            let through = DVec3::new(3.0, 3.0, 0.0) + random.vector(2.0);
            let direction = random.vector(1.0).normalize();
            let origin = through - direction * 10.0;
            let expected = brute_force(&s, origin, direction);
            let hits = caster.hits(&Ray::new(origin, direction * 3.0).unwrap(), 1e-9).unwrap();
            let what = format!("surface {case}, ray {ray}");
            for (at, length) in &expected {
                let times = hits.iter().filter(|h| h.at.distance(*at) < 1e-6).count();
                assert_eq!(times, 1, "{what}: {at}, {length} among {hits:?}");
            }
            for h in &hits {
                assert!(h.point.distance(origin + direction * h.s) <= 1e-9, "{what}: {h:?}");
                assert!(s.point(h.at.x, h.at.y).distance(h.point) < 1e-12, "{what}: {h:?}");
            }
            assert!(hits.windows(2).all(|w| w[0].s <= w[1].s), "{what}: {hits:?}");
            let first = caster.first_hit(&Ray::new(origin, direction).unwrap(), 1e-9).unwrap();
            let ends = [first, hits.first().copied()].map(|h| h.map_or(f64::INFINITY, |h| h.s));
            assert!(ends[0] == ends[1] || (ends[0] - ends[1]).abs() < 1e-10, "{what}: {first:?}, {hits:?}");
            total += expected.len();
            more += hits.len() - expected.len();
        }
    }
    assert!(total > 150, "{total} hits say little");
    assert!(more * 100 <= total, "{more} hits more than the {total} of brute force");
}

/// A sphere of radius 2 about the origin, its axis along z.
fn sphere() -> NurbsSurface {
    let half = NurbsCurve::arc(DVec3::ZERO, DVec3::X * 2.0, DVec3::Z * 2.0, -0.5 * PI, 0.5 * PI).unwrap();
    NurbsSurface::revolved(&half, DVec3::ZERO, DVec3::Z, TAU).unwrap()
}

#[test]
fn a_sphere_is_hit_grazed_or_missed() {
    let caster = SurfaceCaster::new(&sphere()).unwrap();
    let along = DVec3::new(0.3, 1.0, 0.2).normalize();
    let side = along.any_orthonormal_vector();
    for (off, expected) in [(0.0, 2), (1.5, 2), (1.999, 2), (2.001, 0), (2.0 + 2e-7, 0), (5.0, 0)] {
        let ray = Ray::new(side * off - along * 7.0, along).unwrap();
        let hits = caster.hits(&ray, 1e-7).unwrap();
        assert_eq!(hits.len(), expected, "{off}: {hits:?}");
        for h in &hits {
            let half = (4.0 - off * off).sqrt();
            assert!(((h.s - 7.0).abs() - half).abs() < 1e-9, "{off}: {h:?}");
            assert_eq!(h.kind, Kind::Transversal, "{off}: {h:?}");
        }
    }
    for off in [2.0 - 3e-8, 2.0, 2.0 + 3e-8] {
        let hits = caster.hits(&Ray::new(side * off - along * 7.0, along).unwrap(), 1e-7).unwrap();
        assert_eq!(hits.len(), 1, "{off}: {hits:?}");
        let h = hits[0];
        assert!(h.kind == Kind::Tangential && (h.s - 7.0).abs() < 1e-6, "{off}: {h:?}");
        // Within the tolerance for 2 √(2 r ε), and what lies between.
        assert!(h.along[0] < 7.0 && h.along[1] > 7.0 && h.along[1] - h.along[0] < 4e-3, "{off}: {h:?}");
    }
}

#[test]
fn poles_seams_and_origins_on_the_surface_are_hit_once() {
    let caster = SurfaceCaster::new(&sphere()).unwrap();
    let lengths = |ray: Result<Ray<DVec3>, _>| -> Vec<f64> {
        let ray: Ray<DVec3> = ray.map_err(|e: bladesmith::Error| e.to_string()).unwrap();
        caster.hits(&ray, 1e-9).unwrap().iter().map(|h| h.s).collect()
    };
    let near = |is: Vec<f64>, expected: &[f64], what: &str| {
        let same = is.len() == expected.len() && is.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-8);
        assert!(same, "{what}: {is:?}, expected {expected:?}");
    };
    near(lengths(Ray::new(DVec3::Z * 5.0, -DVec3::Z)), &[3.0, 7.0], "both poles");
    near(lengths(Ray::new(DVec3::X * 5.0, -DVec3::X)), &[3.0, 7.0], "the seam, and a knot line");
    near(lengths(Ray::new(DVec3::ZERO, DVec3::Y)), &[2.0], "from within");
    near(lengths(Ray::line(DVec3::ZERO, DVec3::Y)), &[-2.0, 2.0], "a line from within");
    near(lengths(Ray::new(DVec3::X * 2.0, -DVec3::X)), &[0.0, 4.0], "from the surface inwards");
    near(lengths(Ray::new(DVec3::X * 2.0, DVec3::X)), &[0.0], "from the surface outwards");
    near(lengths(Ray::new(DVec3::X * 2.1, DVec3::X)), &[], "from outside outwards");
    near(
        lengths(Ray::new(DVec3::new(5.0, 0.3, 0.4), -DVec3::X)),
        &[5.0 - 3.75f64.sqrt(), 5.0 + 3.75f64.sqrt()],
        "aside",
    );
}

#[test]
fn a_ray_in_a_plane_runs_along_it() {
    let k = || KnotVector::clamped(1, &[0.0, 1.0]).unwrap();
    let poles = vec![DVec3::ZERO, DVec3::Y, DVec3::X * 3.0, DVec3::new(3.0, 1.0, 0.0)];
    let plane = NurbsSurface::new(k(), k(), poles, None).unwrap();
    let plane = plane.refined(Direction::U, &[0.4]).unwrap();
    let caster = SurfaceCaster::new(&plane).unwrap();
    let hits = caster.hits(&Ray::new(DVec3::new(-1.0, 0.3, 0.0), DVec3::X).unwrap(), 1e-9).unwrap();
    assert_eq!(hits.len(), 1, "{hits:?}");
    let h = hits[0];
    assert!((h.along[0] - 1.0).abs() < 1e-8 && (h.along[1] - 4.0).abs() < 1e-8, "{h:?}");
    assert_eq!(h.kind, Kind::Tangential, "{h:?}");
}

#[test]
fn rays_along_a_cylinder_or_touching_it_at_its_seam_graze() {
    let side = NurbsCurve::new(
        KnotVector::clamped(1, &[0.0, 1.0]).unwrap(),
        vec![DVec3::X, DVec3::X + DVec3::Z * 3.0],
        None,
    );
    let cylinder = NurbsSurface::revolved(&side.unwrap(), DVec3::ZERO, DVec3::Z, TAU).unwrap();
    let caster = SurfaceCaster::new(&cylinder).unwrap();
    let rulings = [
        (DVec3::new(1.0, 0.0, -1.0), DVec3::Z, [1.0, 4.0]),
        (DVec3::new(0.6, 0.8, 5.0), -DVec3::Z, [2.0, 5.0]),
        (DVec3::new(1.0, 0.0, 1.0), DVec3::Z, [0.0, 2.0]),
        (DVec3::new(0.6, 0.8, 1.0), DVec3::Z, [0.0, 2.0]),
    ];
    for (origin, direction, along) in rulings {
        let hits = caster.hits(&Ray::new(origin, direction).unwrap(), 1e-9).unwrap();
        assert_eq!(hits.len(), 1, "{origin}: {hits:?}");
        let near = (0..2).all(|k| (hits[0].along[k] - along[k]).abs() < 1e-8);
        assert!(near && hits[0].kind == Kind::Tangential, "{origin}: {hits:?}");
        assert!(hits[0].s >= along[0] - 1e-8 && hits[0].s <= along[1] + 1e-8, "{origin}: {hits:?}");
    }
    for (x, z) in [(1.0, 1.0), (1.0, 0.0), (-1.0, 1.0)] {
        for tolerance in [1e-9, 1e-6, 1e-3] {
            let ray = Ray::new(DVec3::new(x, -3.0, z), DVec3::Y).unwrap();
            let hits = caster.hits(&ray, tolerance).unwrap();
            assert_eq!(hits.len(), 1, "{x}, {z}, {tolerance}: {hits:?}");
            assert!(
                hits[0].kind == Kind::Tangential && (hits[0].s - 3.0).abs() < 1e-6,
                "{x}, {z}, {tolerance}: {hits:?}"
            );
        }
    }
}

fn parabola() -> NurbsCurve<DVec2> {
    let poles = [[-1.0, 1.0], [0.0, -1.0], [1.0, 1.0]].map(DVec2::from).to_vec();
    NurbsCurve::new(KnotVector::clamped(2, &[0.0, 1.0]).unwrap(), poles, None).unwrap()
}

#[test]
fn rays_in_the_plane_hit_curves_with_their_parameter() {
    let c = parabola();
    for slope in [3.0, 1.0, 0.2, 1e-3, 1e-6] {
        // y = slope (x + 2) − 2 slope meets y = x² at 0 and at x = slope.
        let ray = Ray::new(DVec2::new(-2.0, -2.0 * slope), DVec2::new(1.0, slope) * 7.0).unwrap();
        let hits = ray.curve_hits(&c, 1e-14).unwrap();
        let expected: &[f64] = if slope > 1.0 { &[0.0] } else { &[0.0, slope] };
        assert_eq!(hits.len(), expected.len(), "{slope}: {hits:?}");
        for (h, x) in hits.iter().zip(expected) {
            assert!((h.at - 0.5 * (1.0 + x)).abs() < 1e-9, "{slope}: {h:?}");
            assert!((h.s - (2.0 + x) * slope.hypot(1.0)).abs() < 1e-9, "{slope}: {h:?}");
        }
    }
    let graze = Ray::new(DVec2::new(-5.0, 0.0), DVec2::X).unwrap().curve_hits(&c, 1e-9).unwrap();
    assert!(
        graze.len() == 1 && graze[0].kind == Kind::Tangential && (graze[0].s - 5.0).abs() < 1e-9,
        "{graze:?}"
    );
    // Passing by within less than a step of ray marching is no hit.
    let miss = Ray::new(DVec2::new(-5.0, -1e-6), DVec2::X).unwrap().curve_hits(&c, 1e-7).unwrap();
    assert!(miss.is_empty(), "{miss:?}");
}

#[test]
fn rays_begin_at_their_origin_and_lines_before_it() {
    let c = parabola();
    let count = |ray: Ray<DVec2>| ray.curve_hits(&c, 1e-9).unwrap().len();
    let origin = DVec2::new(0.0, 0.5);
    assert_eq!(count(Ray::new(origin, DVec2::X).unwrap()), 1);
    assert_eq!(count(Ray::new(origin, -DVec2::X).unwrap()), 1);
    assert_eq!(count(Ray::line(origin, DVec2::X).unwrap()), 2);
    assert_eq!(count(Ray::new(DVec2::ZERO, DVec2::Y).unwrap()), 1, "from the curve");
    assert_eq!(count(Ray::new(DVec2::new(0.0, 1e-3), DVec2::Y).unwrap()), 0, "from above it");
    assert_eq!(count(Ray::new(DVec2::new(1.0, 1.0), DVec2::X).unwrap()), 1, "from its end");
    let first =
        Ray::new(DVec2::new(-4.0, 0.25), DVec2::X).unwrap().first_curve_hit(&c, 1e-9).unwrap().unwrap();
    assert!((first.s - 3.5).abs() < 1e-12 && (first.at - 0.25).abs() < 1e-12, "{first:?}");
    let along =
        NurbsCurve::new(KnotVector::clamped(1, &[0.0, 1.0]).unwrap(), vec![DVec2::X, DVec2::X * 3.0], None);
    let hits = Ray::new(DVec2::ZERO, DVec2::X).unwrap().curve_hits(&along.unwrap(), 1e-9).unwrap();
    assert!(
        hits.len() == 1 && (hits[0].along[0] - 1.0).abs() < 1e-12 && (hits[0].along[1] - 3.0).abs() < 1e-12,
        "{hits:?}"
    );
}

#[test]
fn rays_without_a_direction_are_refused() {
    for direction in [DVec3::ZERO, DVec3::new(f64::NAN, 0.0, 1.0), DVec3::new(f64::INFINITY, 0.0, 0.0)] {
        let why = Ray::new(DVec3::ZERO, direction).unwrap_err().to_string();
        assert!(why.contains("direction"), "{why}");
    }
    assert!(Ray::new(DVec3::NAN, DVec3::X).is_err());
}
