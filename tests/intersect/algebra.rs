//! Cubics whose crossings algebra counts: one parameter is eliminated exactly, and the roots of what
//! is left are isolated exactly, so that none is missed and none is there twice.

use super::sample::Random;
use bladesmith::nurbs::{KnotVector, NurbsCurve};
use bladesmith::ops::intersect::{Kind, curves};
use glam::DVec2;
use num_bigint::BigInt;

/// Coefficients, lowest first.
type Polynomial = Vec<BigInt>;

fn sum(a: &Polynomial, b: &Polynomial, sign: i32) -> Polynomial {
    let at = |p: &Polynomial, i: usize| p.get(i).cloned().unwrap_or_default();
    (0..a.len().max(b.len())).map(|i| at(a, i) + at(b, i) * sign).collect()
}

fn product(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let mut out = vec![BigInt::from(0); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            out[i + j] += x * y;
        }
    }
    out
}

/// A cubic in powers of its parameter from whole Bézier ordinates.
fn powers([a, b, c, d]: [i64; 4]) -> [i64; 4] {
    [a, 3 * (b - a), 3 * (a - 2 * b + c), d - 3 * c + 3 * b - a]
}

/// Poles by coordinate.
type Cubic = [[i64; 4]; 2];

/// What vanishes at the parameters of `second` where it crosses `first`, of degree 9: Bézout's
/// determinant of both coordinates' differences as cubics in the parameter of `first`.
fn eliminated(first: &Cubic, second: &Cubic) -> Polynomial {
    let difference = |axis: usize| -> Vec<Polynomial> {
        let (a, b) = (powers(first[axis]), powers(second[axis]));
        let mut out: Vec<Polynomial> = a.iter().map(|&x| vec![x.into()]).collect();
        out[0] = sum(&out[0], &b.iter().map(|&x| x.into()).collect(), -1);
        out
    };
    let (f, g) = (difference(0), difference(1));
    let entry = |i: usize, j: usize| {
        let terms = (0..=i.min(2 - j)).map(|k| {
            let (high, low) = (j + k + 1, i - k);
            sum(&product(&f[high], &g[low]), &product(&f[low], &g[high]), -1)
        });
        terms.fold(Polynomial::new(), |all, term| sum(&all, &term, 1))
    };
    let minor = |i: usize, j: usize| {
        let [r, s] = [[1, 2], [0, 2], [0, 1]][j];
        let cross = sum(&product(&entry(1, r), &entry(2, s)), &product(&entry(1, s), &entry(2, r)), -1);
        product(&entry(i, j), &cross)
    };
    sum(&sum(&minor(0, 0), &minor(0, 1), -1), &minor(0, 2), 1)
}

fn binomial(n: usize, k: usize) -> BigInt {
    (0..k).fold(BigInt::from(1), |b, i| b * (n - i) / (i + 1))
}

/// Disjoint intervals within (0, 1), each of one root, by Descartes' rule in Bernstein form.
fn isolated(polynomial: &Polynomial) -> Vec<[f64; 2]> {
    let n = polynomial.len() - 1;
    let factorial = |k: usize| (1..=k).map(BigInt::from).product::<BigInt>();
    let ordinate = |k: usize| -> BigInt {
        (0..=k).map(|i| binomial(k, i) * factorial(i) * factorial(n - i) * &polynomial[i]).sum()
    };
    let mut open = vec![(0.0, 1.0, (0..=n).map(ordinate).collect::<Polynomial>())];
    let mut out = Vec::new();
    while let Some((a, b, ordinates)) = open.pop() {
        let negative: Vec<bool> =
            ordinates.iter().filter(|x| **x != BigInt::from(0)).map(|x| *x < BigInt::from(0)).collect();
        match negative.windows(2).filter(|w| w[0] != w[1]).count() {
            0 => continue,
            // Narrow enough to start from.
            1 if b - a < 1e-12 => {
                out.push([a, b]);
                continue;
            }
            _ => assert!(b - a > 1e-15, "roots that cannot be told apart near {a}"),
        }
        let left = |k: usize| (0..=k).map(|i| binomial(k, i) * &ordinates[i]).sum::<BigInt>() << (n - k);
        let right = |k: usize| (k..=n).map(|i| binomial(n - k, i - k) * &ordinates[i]).sum::<BigInt>() << k;
        let middle = 0.5 * (a + b);
        assert!(left(n) != BigInt::from(0), "a root at the very middle {middle}");
        open.push((a, middle, (0..=n).map(left).collect()));
        open.push((middle, b, (0..=n).map(right).collect()));
    }
    out
}

fn spline(cubic: &Cubic) -> NurbsCurve<DVec2> {
    let poles = (0..4).map(|i| DVec2::new(cubic[0][i] as f64, cubic[1][i] as f64)).collect();
    NurbsCurve::new(KnotVector::clamped(3, &[0.0, 1.0]).unwrap(), poles, None).unwrap()
}

/// The parameter of `curve`, within its domain, of a point on it, if it has one.
fn parameter(curve: &NurbsCurve<DVec2>, point: DVec2) -> Option<f64> {
    let at = |t: f64| curve.point(t).distance(point);
    let start = (0..=4000).map(|i| i as f64 / 4000.0).min_by(|&a, &b| at(a).total_cmp(&at(b)))?;
    let mut t = start;
    for _ in 0..50 {
        let [p, d, _] = curve.derivatives(t);
        t = (t + (point - p).dot(d) / d.length_squared()).clamp(0.0, 1.0);
    }
    (at(t) < 1e-7).then_some(t)
}

fn cubic(random: &mut Random) -> Cubic {
    let mut ordinate = |size: f64| random.within(-size, size) as i64;
    [0, 1].map(|_| [ordinate(1e3), ordinate(4e3), ordinate(4e3), ordinate(1e3)])
}

#[test]
fn cubics_cross_exactly_where_algebra_says() {
    let mut random = Random(31);
    let mut total = 0;
    for case in 0..300 {
        let (mut a, mut b) = (cubic(&mut random), cubic(&mut random));
        if case % 4 > 0 {
            // One that swings upwards and downwards, and one that swings across it.
            (a[0], b[1]) = ([-900, -300, 300, 900], [-800, -250, 300, 850]);
            (a[1][1], b[0][1]) = (2500 + a[1][1].abs(), 2500 + b[0][1].abs());
            (a[1][2], b[0][2]) = (-2500 - a[1][2].abs(), -2500 - b[0][2].abs());
        }
        let (first, second) = (spline(&a), spline(&b));
        let expected: Vec<[f64; 2]> = isolated(&eliminated(&a, &b))
            .into_iter()
            .filter_map(|[from, to]| {
                let t = 0.5 * (from + to);
                parameter(&first, second.point(t)).map(|s| [s, t])
            })
            .collect();
        let found = curves(&first, &second, 1e-7).unwrap();
        assert!(found.overlaps.is_empty(), "pair {case}: {:?}", found.overlaps);
        assert_eq!(found.crossings.len(), expected.len(), "pair {case}: {found:?}, expected {expected:?}");
        for at in &expected {
            let near = |c: [f64; 2]| (c[0] - at[0]).abs() < 1e-7 && (c[1] - at[1]).abs() < 1e-7;
            let times = found.crossings.iter().filter(|c| near(c.at)).count();
            assert_eq!(times, 1, "pair {case}: {at:?} among {found:?}");
        }
        total += expected.len();
    }
    assert!(total > 800, "{total} crossings say little");
}

#[test]
fn lines_cross_at_the_parameters_of_their_formula() {
    let line = |from: DVec2, along: DVec2| {
        let knots = KnotVector::clamped(1, &[0.0, 1.0]).unwrap();
        NurbsCurve::new(knots, vec![from, from + along], None).unwrap()
    };
    let mut random = Random(32);
    let mut crossed = 0;
    for case in 0..500 {
        let mut vector = || DVec2::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0));
        let (a, b) = (vector(), vector());
        let (along_a, along_b) = (vector() - a, vector() - b);
        let det = along_a.perp_dot(along_b);
        let at = [(b - a).perp_dot(along_b) / det, (b - a).perp_dot(along_a) / det];
        let found = curves(&line(a, along_a), &line(b, along_b), 1e-12).unwrap().crossings;
        if at.iter().any(|t| !(0.0..=1.0).contains(t)) {
            assert!(found.is_empty(), "pair {case}: {found:?}, but {at:?}");
            continue;
        }
        assert_eq!(found.len(), 1, "pair {case}: {at:?}");
        let off = (found[0].at[0] - at[0]).abs().max((found[0].at[1] - at[1]).abs());
        assert!(off * det.abs() < 1e-14, "pair {case}: {found:?}, but {at:?}");
        assert_eq!(found[0].kind, Kind::Transversal, "pair {case}");
        let beside = line(a + along_a.perp() * 1e-3, along_a);
        assert!(curves(&line(a, along_a), &beside, 1e-12).unwrap().crossings.is_empty(), "pair {case}");
        crossed += 1;
    }
    assert!(crossed > 50, "{crossed} crossings say little");
}
