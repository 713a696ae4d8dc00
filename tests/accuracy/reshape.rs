//! Reshaping keeps the shape: insertion, clamping, elevation, parts and Bézier segments, at the
//! parameters of all knots and between.

use super::exact;
use super::wild::{ENDS, Ends, Random, curve, places, surface};
use bladesmith::nurbs::{Direction, KnotVector, NurbsCurve, NurbsSurface};
use glam::DVec3;

/// What reshaping may move a point by, relative to its coordinates' sizes.
const LIMIT: f64 = 1e-14;

/// The largest distance of a coordinate, relative to its condition.
fn moved(before: &[exact::Jet], after: &[exact::Jet]) -> f64 {
    let one = |(a, b): (&exact::Jet, &exact::Jet)| {
        let ((a, size), (b, _)) = (&a[0][0], &b[0][0]);
        b.minus(a).value().abs() / size
    };
    before.iter().zip(after).map(one).fold(0.0, f64::max)
}

/// How far a curve, over all its domain, is from another.
fn apart(is: &NurbsCurve<DVec3>, was: &NurbsCurve<DVec3>) -> f64 {
    let at = |t: f64| {
        let place = |c: &NurbsCurve<DVec3>| exact::curve(c, c.knots().span(t), t, 1);
        moved(&place(was), &place(is))
    };
    places(is.knots(), &[0.1, 0.55]).into_iter().map(at).fold(0.0, f64::max)
}

fn apart_surfaces(is: &NurbsSurface, was: &NurbsSurface) -> f64 {
    let mut worst = 0.0f64;
    for u in places(is.knots_u(), &[0.4]) {
        for v in places(is.knots_v(), &[0.7]) {
            let place =
                |s: &NurbsSurface| exact::surface(s, [s.knots_u().span(u), s.knots_v().span(v)], [u, v], 1);
            worst = worst.max(moved(&place(was), &place(is)));
        }
    }
    worst
}

/// Knots to insert: new ones, some of them twice, and inner ones up to their last place.
fn inserted(random: &mut Random, knots: &KnotVector) -> Vec<f64> {
    let (p, all) = (knots.degree(), knots.breaks_and_multiplicities());
    let mut out = Vec::new();
    for w in all.windows(2) {
        for share in [random.next(), 0.5] {
            let t = w[0].0 + share * (w[1].0 - w[0].0);
            out.extend(std::iter::repeat_n(t, 1 + random.below(p)));
        }
    }
    for &(t, times) in &all[1..all.len() - 1] {
        out.extend(std::iter::repeat_n(t, (p - times).min(random.below(p + 1))));
    }
    out.sort_by(f64::total_cmp);
    out
}

#[test]
fn curves_keep_their_shape() {
    let (mut random, mut worst) = (Random(10), 0.0f64);
    for degree in 1..=9 {
        for (ends, rational) in ENDS.into_iter().flat_map(|ends| [(ends, false), (ends, true)]) {
            let c: NurbsCurve<DVec3> = curve(&mut random, degree, ends, rational);
            let breaks = c.knots().breaks();
            let (a, b) = c.knots().domain();
            let cut = a + (b - a) * random.next();
            let [first, second] = c.split(cut).expect("two halves");
            let mut all = vec![
                ("clamped", c.clamped().expect("clamped")),
                ("refined", c.refined(&inserted(&mut random, c.knots())).expect("refined")),
                ("first half", first),
                ("second half", second),
                ("from knot to knot", c.part(breaks[1], breaks[3]).expect("a part")),
                ("elevated", c.elevated(1).expect("elevated")),
                ("elevated by three", c.elevated(3).expect("elevated")),
            ];
            all.extend(c.bezier_segments().expect("segments").into_iter().map(|s| ("segment", s)));
            for (what, is) in all {
                let off = apart(&is, &c);
                worst = worst.max(off);
                assert!(
                    off <= LIMIT,
                    "degree {degree}, {ends:?}, rational {rational}, {what}: moved by {off:e}"
                );
            }
        }
    }
    println!("moved by {worst:e} at most");
}

#[test]
fn surfaces_keep_their_shape() {
    let (mut random, mut worst) = (Random(11), 0.0f64);
    for degree in 1..=9 {
        let degrees = [degree, 1 + (degree + 3) % 5];
        let s = surface(&mut random, degrees, [ENDS[degree % 3], ENDS[degree / 3 % 3]], degree % 2 == 0);
        for direction in [Direction::U, Direction::V] {
            let (a, b) = s.knots(direction).domain();
            let new = inserted(&mut random, s.knots(direction));
            let [first, second] = s.split(direction, a + (b - a) * random.next()).expect("two halves");
            let all = [
                ("refined", s.refined(direction, &new).expect("refined")),
                ("first half", first),
                ("second half", second),
                ("elevated", s.elevated(direction, 1).expect("elevated")),
            ];
            for (what, is) in all {
                let off = apart_surfaces(&is, &s);
                worst = worst.max(off);
                assert!(off <= LIMIT, "degrees {degrees:?}, {direction:?}, {what}: moved by {off:e}");
            }
        }
        for patch in s.bezier_patches().expect("patches") {
            let off = apart_surfaces(&patch, &s);
            assert!(off <= LIMIT, "degrees {degrees:?}, a patch: moved by {off:e}");
        }
    }
    println!("moved by {worst:e} at most");
}

#[test]
fn a_reversed_curve_is_the_same_to_the_last_place() {
    let mut random = Random(12);
    for degree in 1..=9 {
        // Domains of whole numbers: the knots themselves are not rounded.
        let c = curve::<DVec3>(&mut random, degree, Ends::Clamped, true);
        let whole = KnotVector::clamped(
            degree,
            &(0..=c.poles().len() - degree).map(|k| k as f64).collect::<Vec<_>>(),
        );
        let c = NurbsCurve::new(whole.expect("knots"), c.poles().to_vec(), c.weights().map(<[f64]>::to_vec));
        let c = c.expect("a curve");
        let (back, end) = (c.reversed(), c.knots().domain().1);
        for t in places(c.knots(), &[0.5]) {
            let off = moved(
                &exact::curve(&c, c.knots().span(t), t, 1),
                &exact::curve(&back, back.knots().span(end - t), end - t, 1),
            );
            assert!(off <= f64::EPSILON, "degree {degree} at {t}: {off:e}");
        }
    }
}
