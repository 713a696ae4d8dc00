//! Sections of surfaces against closed forms and dense sampling.

use bladesmith::nurbs::{KnotVector, NurbsCurve, NurbsSurface};
use bladesmith::ops::closest;
use bladesmith::ops::section::{self, Branch, Section};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Sizes and places at which everything is tried: (scale in mm, distance from the origin in mm).
const PLACES: [(f64, f64); 4] = [(1.0, 0.0), (1e-3, 1.0), (1e4, 0.0), (50.0, 1e3)];

fn turn() -> DMat3 {
    DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7)
}

/// A map to one of the places.
fn placed((scale, away): (f64, f64)) -> impl Fn(DVec3) -> DVec3 {
    move |p| turn() * p * scale + DVec3::new(0.6, -0.3, 0.74) * away
}

fn sphere() -> NurbsSurface {
    let arc = NurbsCurve::arc(DVec3::ZERO, DVec3::X, DVec3::Z, -0.5 * PI, 0.5 * PI).unwrap();
    NurbsSurface::revolved(&arc, DVec3::ZERO, DVec3::Z, TAU).unwrap()
}

fn torus(large: f64, small: f64) -> NurbsSurface {
    let circle = NurbsCurve::arc(DVec3::X * large, DVec3::X * small, DVec3::Z * small, 0.0, TAU).unwrap();
    NurbsSurface::revolved(&circle, DVec3::ZERO, DVec3::Z, TAU).unwrap()
}

fn line(a: DVec3, b: DVec3) -> NurbsCurve<DVec3> {
    NurbsCurve::new(KnotVector::clamped(1, &[0.0, 1.0]).unwrap(), vec![a, b], None).unwrap()
}

/// Around an axis through the origin, from `-half` to `half`.
fn cylinder(axis: DVec3, radius: f64, half: f64) -> NurbsSurface {
    let start = axis.any_orthonormal_vector() * radius;
    NurbsSurface::revolved(&line(start - axis * half, start + axis * half), DVec3::ZERO, axis, TAU).unwrap()
}

fn length(section: &Section, tolerance: f64) -> f64 {
    section.branches.iter().map(|b| b.curve.length(0.01 * tolerance).unwrap()).sum()
}

/// Points along a branch with its parameters.
fn samples(branch: &Branch, n: usize) -> impl Iterator<Item = (DVec3, [DVec2; 2])> + '_ {
    let (a, b) = branch.curve.knots().domain();
    (0..=n)
        .map(move |i| a + (b - a) * i as f64 / n as f64)
        .map(|t| (branch.curve.point(t), [branch.parameters[0].point(t), branch.parameters[1].point(t)]))
}

/// All points on the surface and the plane, to the tolerance, and between the given ones.
fn check_plane(section: &Section, surface: &NurbsSurface, origin: DVec3, normal: DVec3, tolerance: f64) {
    assert!(section.uncertain.is_empty(), "uncertain at {:?}", section.uncertain);
    let [o, x, y] = section.axes.unwrap();
    for (k, branch) in section.branches.iter().enumerate() {
        assert!(branch.deviation_mm <= tolerance, "{k}: {}", branch.deviation_mm);
        let (start, end) = branch.curve.knots().domain();
        assert!(end - start > tolerance, "branch {k} is a point, {} mm long", end - start);
        for (p, [a, b]) in samples(branch, 2003) {
            let on = surface.point(a.x, a.y);
            assert!(on.distance(p) <= 1.1 * tolerance, "{k}: {p} is {} off the surface", on.distance(p));
            let off = (p - origin).dot(normal);
            assert!(off.abs() <= 1.1 * tolerance, "{k}: {p} is {off} off the plane");
            let on = o + x * b.x + y * b.y;
            assert!(on.distance(p) <= 1.1 * tolerance, "{k}: {p} is {} from its place", on.distance(p));
        }
    }
}

#[test]
fn a_sphere_is_cut_in_a_circle() {
    for place in PLACES {
        let map = placed(place);
        let scale = place.0;
        let surface = sphere().mapped(&map).unwrap();
        let tolerance = 1e-7 * scale;
        for (height, normal) in [
            (0.3, DVec3::Z),
            (0.0, DVec3::Z),
            (0.2, DVec3::new(1.0, 0.3, 0.4)),
            (-0.999, DVec3::new(-0.2, 1.0, 0.1)),
        ] {
            let normal = normal.normalize();
            let (origin, across) = (map(normal * height), turn() * normal);
            let found = section::with_plane(&surface, origin, across, tolerance).unwrap();
            check_plane(&found, &surface, origin, across, tolerance);
            let radius = scale * (1.0 - height * height).sqrt();
            let got = length(&found, tolerance);
            assert!(
                (got - TAU * radius).abs() < 20.0 * tolerance,
                "{place:?}, {height}: {got}, not {}",
                TAU * radius
            );
            for (p, _) in found.branches.iter().flat_map(|b| samples(b, 100)) {
                let off = p.distance(origin) - radius;
                assert!(off.abs() < 5.0 * tolerance, "{place:?}, {height}: {off} off the circle");
            }
        }
    }
}

#[test]
fn a_plane_through_the_poles_of_a_sphere_cuts_a_great_circle() {
    for place in PLACES {
        let map = placed(place);
        let surface = sphere().mapped(&map).unwrap();
        let tolerance = 1e-7 * place.0;
        for normal in [DVec3::new(0.3, 1.0, 0.0).normalize(), DVec3::Y] {
            let (origin, across) = (map(DVec3::ZERO), turn() * normal);
            let found = section::with_plane(&surface, origin, across, tolerance).unwrap();
            check_plane(&found, &surface, origin, across, tolerance);
            let (got, expected) = (length(&found, tolerance) / place.0, TAU);
            assert!((got - expected).abs() < 1e-5, "{place:?}, {normal}: {got}, not {expected}");
        }
    }
}

#[test]
fn a_tiny_circle_is_found_and_a_plane_just_outside_is_not_met() {
    let surface = sphere();
    let normal = DVec3::new(1.0, 0.3, 0.4).normalize();
    for below in [1e-4, 1e-6] {
        let origin = normal * (1.0 - below);
        let found = section::with_plane(&surface, origin, normal, 1e-9).unwrap();
        check_plane(&found, &surface, origin, normal, 1e-9);
        let radius = (1.0 - (1.0 - below) * (1.0 - below)).sqrt();
        let got = length(&found, 1e-9);
        assert!((got - TAU * radius).abs() < 1e-7, "{below}: {got}, not {}", TAU * radius);
        assert!(found.branches.iter().all(|b| b.closed && !b.touching));
    }
    let found = section::with_plane(&surface, normal * (1.0 + 1e-6), normal, 1e-9).unwrap();
    assert!(
        found.branches.is_empty() && found.touching.is_empty() && found.uncertain.is_empty(),
        "{found:?}"
    );
}

#[test]
fn a_tangent_plane_touches_in_a_point() {
    for place in PLACES {
        let map = placed(place);
        let surface = sphere().mapped(&map).unwrap();
        let normal = DVec3::new(1.0, 0.3, 0.4).normalize();
        let tolerance = 1e-7 * place.0;
        let found = section::with_plane(&surface, map(normal), turn() * normal, tolerance).unwrap();
        assert_eq!(found.touching.len(), 1, "{place:?}: {found:?}");
        let point = found.touching[0];
        assert!(!point.crossing && point.gap_mm <= tolerance, "{point:?}");
        assert!(point.point.distance(map(normal)) < 1e-4 * place.0, "{point:?}");
        assert!(length(&found, tolerance) < 1e-3 * place.0, "{place:?}: {:?}", found.branches.len());
    }
}

#[test]
fn the_plane_of_villarceau_cuts_a_torus_in_two_circles_that_cross() {
    for place in PLACES {
        let map = placed(place);
        let (large, small) = (3.0f64, 1.0f64);
        let surface = torus(large, small).mapped(&map).unwrap();
        let tilt = (small / large).asin();
        let normal = DMat3::from_rotation_z(0.4) * DVec3::new(-tilt.sin(), 0.0, tilt.cos());
        let (origin, across) = (map(DVec3::ZERO), turn() * normal);
        let tolerance = 1e-6 * place.0;
        let found = section::with_plane(&surface, origin, across, tolerance).unwrap();
        check_plane(&found, &surface, origin, across, tolerance);
        let crossings = found.touching.iter().filter(|t| t.crossing).count();
        assert_eq!((crossings, found.touching.len()), (2, 2), "{place:?}: {:?}", found.touching);
        let (got, expected) = (length(&found, tolerance), 2.0 * TAU * large * place.0);
        assert!((got - expected).abs() < 100.0 * tolerance, "{place:?}: {got}, not {expected}");
    }
}

#[test]
fn a_plane_on_top_of_a_torus_touches_along_a_circle() {
    let surface = torus(3.0, 1.0);
    let tolerance = 1e-7;
    let found = section::with_plane(&surface, DVec3::Z, DVec3::Z, tolerance).unwrap();
    check_plane(&found, &surface, DVec3::Z, DVec3::Z, tolerance);
    assert!(found.branches.iter().all(|b| b.touching), "{:?}", found.branches.len());
    let got = length(&found, tolerance);
    assert!((got - TAU * 3.0).abs() < 1e-5, "{got}, not {}", TAU * 3.0);
}

/// Many knot lines pass the branches within a rounding error or so of a seed.
#[test]
fn seeds_beside_knot_lines_make_no_branches_of_their_own() {
    let knots = |poles: usize| {
        let at = |i: usize| i as f64 / (poles - 3) as f64;
        KnotVector::clamped(3, &(0..=poles - 3).map(at).collect::<Vec<_>>()).unwrap()
    };
    let (ku, kv) = (knots(60), knots(40));
    let pole =
        |u: f64, v: f64| DVec3::new(100.0 * u, 60.0 * v, 3.0 * (9.0 * u).sin() * (6.0 * v + 0.5).cos());
    let (us, vs) = (ku.greville(), kv.greville());
    let poles = us.iter().flat_map(|&u| vs.iter().map(move |&v| pole(u, v))).collect();
    let sheet = NurbsSurface::new(ku, kv, poles, None).unwrap();
    let (origin, normal) = (DVec3::new(50.0, 30.0, 0.3), DVec3::new(0.01, 0.02, 1.0));
    let found = section::with_plane(&sheet, origin, normal, 1e-6).unwrap();
    check_plane(&found, &sheet, origin, normal, 1e-6);
    assert_eq!(found.branches.len(), 4, "waves between borders");
}

#[test]
fn a_flat_face_in_the_plane_overlaps_it() {
    let flat = NurbsSurface::ruled(&line(DVec3::ZERO, DVec3::X), &line(DVec3::Y, DVec3::new(1.0, 1.0, 0.0)))
        .unwrap();
    let found = section::with_plane(&flat, DVec3::ZERO, DVec3::Z, 1e-7).unwrap();
    assert_eq!(found.overlaps, [[DVec2::ZERO, DVec2::ONE]]);
    assert!(found.branches.is_empty());
}

#[test]
fn planes_and_tolerances_that_cannot_be_used_are_refused() {
    let surface = sphere();
    assert!(section::with_plane(&surface, DVec3::ZERO, DVec3::ZERO, 1e-6).is_err());
    for tolerance in [0.0, -1.0, 1e-20, f64::NAN] {
        let error = section::with_plane(&surface, DVec3::ZERO, DVec3::Z, tolerance).unwrap_err();
        assert!(error.to_string().contains("tolerance"), "{error}");
    }
}

/// Numbers in 0..1, the same in every run.
struct Random(u64);

impl Random {
    fn within(&mut self, a: f64, b: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        a + (b - a) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A sheet over [0, 8] × [0, 6] with waves of a height.
fn waves(random: &mut Random, degrees: [usize; 2], height: f64, rational: bool) -> NurbsSurface {
    let knots = |degree: usize, spans: usize| {
        KnotVector::clamped(degree, &(0..=spans).map(|i| i as f64).collect::<Vec<_>>()).unwrap()
    };
    let (ku, kv) = (knots(degrees[0], 6), knots(degrees[1], 5));
    let (gu, gv) = (ku.greville(), kv.greville());
    let mut poles = Vec::new();
    for u in &gu {
        for v in &gv {
            let z = random.within(-height, height);
            poles.push(DVec3::new(
                u * 8.0 / 6.0 + random.within(-0.2, 0.2),
                v * 1.2 + random.within(-0.2, 0.2),
                z,
            ));
        }
    }
    let weights = rational.then(|| poles.iter().map(|_| random.within(0.5, 2.0)).collect());
    NurbsSurface::new(ku, kv, poles, weights).unwrap()
}

fn grid(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=n).flat_map(move |i| (0..=n).map(move |j| (i, j)))
}

/// For each edge of a grid along which a distance changes its sign, the point in between.
fn sign_changes(surface: &NurbsSurface, n: usize, distance: impl Fn(DVec3) -> Option<f64>) -> Vec<DVec3> {
    let (u, v) = (surface.knots_u().domain(), surface.knots_v().domain());
    let place = |i: usize, j: usize| {
        surface.point(u.0 + (u.1 - u.0) * i as f64 / n as f64, v.0 + (v.1 - v.0) * j as f64 / n as f64)
    };
    let values: Vec<_> = grid(n).map(|(i, j)| place(i, j)).map(|p| (p, distance(p))).collect();
    let mut out = Vec::new();
    for (i, j) in grid(n) {
        for (k, l) in [(i + 1, j), (i, j + 1)] {
            if k > n || l > n {
                continue;
            }
            let ((p, a), (q, b)) = (values[i * (n + 1) + j], values[k * (n + 1) + l]);
            if let (Some(a), Some(b)) = (a, b)
                && a * b < 0.0
            {
                out.push(p.lerp(q, a / (a - b)));
            }
        }
    }
    out
}

/// That every point is nearer than `reach` to a branch.
fn assert_covered(section: &Section, points: &[DVec3], reach: f64, what: &str) {
    let on: Vec<DVec3> = section.branches.iter().flat_map(|b| samples(b, 1000)).map(|(p, _)| p).collect();
    for p in points {
        let nearest = on.iter().map(|q| q.distance(*p)).fold(f64::MAX, f64::min);
        assert!(nearest < reach, "{what}: no branch within {nearest} of {p}, {} points", points.len());
    }
}

#[test]
fn no_branch_of_random_surfaces_in_planes_is_missed() {
    let mut random = Random(5);
    for case in 0..40 {
        let degrees = [[3, 3], [2, 3], [3, 5], [1, 2]][case % 4];
        let surface = waves(&mut random, degrees, 1.0, case % 3 == 0);
        let normal = DVec3::new(random.within(-0.5, 0.5), random.within(-0.5, 0.5), 1.0).normalize();
        let origin = DVec3::new(4.0, 3.0, random.within(-0.3, 0.3));
        let found = section::with_plane(&surface, origin, normal, 1e-6).unwrap();
        check_plane(&found, &surface, origin, normal, 1e-6);
        let points = sign_changes(&surface, 150, |p| Some((p - origin).dot(normal)));
        assert_covered(&found, &points, 0.03, &format!("case {case}"));
    }
}

/// All points on both surfaces, to the tolerance.
fn check_pair(section: &Section, a: &NurbsSurface, b: &NurbsSurface, tolerance: f64) {
    assert!(section.uncertain.is_empty(), "uncertain at {:?}", section.uncertain);
    for (k, branch) in section.branches.iter().enumerate() {
        assert!(branch.deviation_mm <= tolerance, "{k}: {}", branch.deviation_mm);
        for (p, uv) in samples(branch, 2003) {
            for (surface, uv) in [a, b].into_iter().zip(uv) {
                let off = surface.point(uv.x, uv.y).distance(p);
                assert!(off <= 1.1 * tolerance, "{k}: {p} is {off} off the surface at {uv}");
            }
        }
    }
}

#[test]
fn two_cylinders_meet_in_two_curves_of_the_fourth_order() {
    let (radius, large) = (0.7f64, 1.0f64);
    // Both axes turned so that seams meet nothing in particular.
    let steps = 200_000;
    let at = |k: usize| {
        let (s, c) = (TAU * k as f64 / steps as f64).sin_cos();
        DVec3::new(radius * c, radius * s, (large * large - radius * radius * s * s).sqrt())
    };
    let expected = 2.0 * (0..steps).map(|k| at(k).distance(at(k + 1))).sum::<f64>();
    for place in PLACES {
        let map = placed(place);
        let tolerance = 1e-6 * place.0;
        let a = cylinder(DVec3::Z, radius, 3.0).mapped(&map).unwrap();
        let b = cylinder(DVec3::X, large, 3.0).mapped(&map).unwrap();
        let found = section::with_surface(&a, &b, tolerance).unwrap();
        check_pair(&found, &a, &b, tolerance);
        let got = length(&found, tolerance) / place.0;
        assert!((got - expected).abs() < 1e-4, "{place:?}: {got}, not {expected}");
        assert!(found.touching.is_empty() && found.overlaps.is_empty());
    }
}

#[test]
fn equal_cylinders_meet_in_two_ellipses_that_cross() {
    let tolerance = 1e-7;
    let turned = DMat3::from_rotation_z(0.3) * DMat3::from_rotation_x(1.1);
    let a = cylinder(DVec3::Z, 1.0, 3.0).mapped(|p| turned * p).unwrap();
    let b = cylinder(DVec3::X, 1.0, 3.0).mapped(|p| turned * p).unwrap();
    let found = section::with_surface(&a, &b, tolerance).unwrap();
    check_pair(&found, &a, &b, tolerance);
    assert_eq!(found.touching.iter().filter(|t| t.crossing).count(), 2, "{:?}", found.touching);
    // Perimeter of the ellipse with half axes 1 and √2.
    let ellipse = |k: usize| {
        let (s, c) = (TAU * k as f64 / 2e5).sin_cos();
        DVec2::new(c, s * 2f64.sqrt())
    };
    let expected = 2.0 * (0..200_000).map(|k| ellipse(k).distance(ellipse(k + 1))).sum::<f64>();
    let got = length(&found, tolerance);
    assert!((got - expected).abs() < 1e-5, "{got}, not {expected}");
}

#[test]
fn spheres_that_touch_share_a_point_and_crossing_ones_a_circle() {
    let turned = DMat3::from_rotation_y(0.3);
    let a = sphere().mapped(|p| turned * p).unwrap();
    let towards = DVec3::new(0.5, 0.6, 0.3).normalize();
    let b = sphere().mapped(|p| p * 0.5 + towards * 1.5).unwrap();
    let found = section::with_surface(&a, &b, 1e-7).unwrap();
    assert_eq!(found.touching.len(), 1, "{:?}", found.touching);
    assert!(found.touching[0].point.distance(towards) < 1e-4 && !found.touching[0].crossing);
    assert!(length(&found, 1e-7) < 1e-2, "{:?}", found.branches.len());
    let b = sphere().mapped(|p| p * 0.5 + towards).unwrap();
    let found = section::with_surface(&a, &b, 1e-7).unwrap();
    check_pair(&found, &a, &b, 1e-7);
    let height: f64 = 1.0 - 0.125;
    let (got, expected) = (length(&found, 1e-7), TAU * (1.0 - height * height).sqrt());
    assert!((got - expected).abs() < 1e-5, "{got}, not {expected}");
}

#[test]
fn a_sphere_inside_a_cylinder_touches_it_along_a_circle() {
    let turned = DMat3::from_rotation_y(0.3) * DMat3::from_rotation_z(0.2);
    let a = sphere().mapped(|p| turned * p).unwrap();
    let b = cylinder(DVec3::Z, 1.0, 3.0);
    let found = section::with_surface(&a, &b, 1e-6).unwrap();
    check_pair(&found, &a, &b, 1e-6);
    assert!(found.branches.iter().all(|b| b.touching), "{}", found.branches.len());
    let got = length(&found, 1e-6);
    assert!((got - TAU).abs() < 1e-4, "{got}, not {TAU}");
}

#[test]
fn overlapping_surfaces_are_reported_as_such() {
    let flat = |x: f64| {
        NurbsSurface::ruled(
            &line(DVec3::new(x, 0.0, 0.0), DVec3::new(x + 1.0, 0.2, 0.0)),
            &line(DVec3::new(x, 1.0, 0.0), DVec3::new(x + 1.0, 1.2, 0.0)),
        )
        .unwrap()
    };
    let found = section::with_surface(&flat(0.0), &flat(0.5), 1e-7).unwrap();
    assert!(
        !found.overlaps.is_empty() && found.branches.is_empty(),
        "{} {}",
        found.overlaps.len(),
        found.branches.len()
    );
    assert!(found.overlaps.iter().all(|[_, high]| high.x > 0.49), "{:?}", found.overlaps);
    let a = cylinder(DVec3::Z, 1.0, 2.0);
    let b = cylinder(DVec3::Z, 1.0, 1.0).mapped(|p| DMat3::from_rotation_z(0.5) * p).unwrap();
    let found = section::with_surface(&a, &b, 1e-7).unwrap();
    assert!(
        !found.overlaps.is_empty() && found.branches.is_empty(),
        "{} {}",
        found.overlaps.len(),
        found.branches.len()
    );
}

#[test]
fn no_branch_of_random_pairs_is_missed() {
    let mut random = Random(9);
    for case in 0..12 {
        let a = waves(&mut random, [3, 3], 1.0, case % 3 == 0);
        let tilt = DMat3::from_rotation_x(random.within(-0.3, 0.3))
            * DMat3::from_rotation_y(random.within(-0.3, 0.3));
        let b = waves(&mut random, [3, 2], 0.6, case % 2 == 0)
            .mapped(|p| tilt * p + DVec3::new(0.7, 0.4, 0.1))
            .unwrap();
        let found = section::with_surface(&a, &b, 1e-6).unwrap();
        check_pair(&found, &a, &b, 1e-6);
        let (u, v) = (b.knots_u().domain(), b.knots_v().domain());
        let place = |(i, j): (usize, usize)| {
            DVec2::new(u.0 + (u.1 - u.0) * i as f64 / 40.0, v.0 + (v.1 - v.0) * j as f64 / 40.0)
        };
        let known: Vec<_> = grid(40).map(place).map(|uv| (uv, b.point(uv.x, uv.y))).collect();
        let inside = |t: f64, (a, b): (f64, f64)| t > a && t < b;
        let points = sign_changes(&a, 60, |p| {
            let near = |k: &&(DVec2, DVec3)| k.1.distance_squared(p);
            let start = known.iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
            let foot = closest::foot(&b, p, start.0);
            let normal = b.normal(foot.uv.x, foot.uv.y).ok()?;
            let counts = foot.distance < 0.3 && inside(foot.uv.x, u) && inside(foot.uv.y, v);
            counts.then(|| (p - foot.point).dot(normal))
        });
        assert_covered(&found, &points, 0.1, &format!("case {case}"));
    }
}
