//! Parameters and knots for points that a curve shall pass.
//!
//! Affine-invariant choices after Foley and Nielson, "Knot selection for parametric spline
//! interpolation" (1989), in the form of Söderlund (Lund 2015, section 4), with the mean taken over
//! all points (print divides by one less) and the metric by the inverse covariance.

use crate::error::{Error, Result};
use crate::nurbs::{KnotVector, Point};

/// How parameters are spaced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spacing {
    /// Equally.
    Uniform,
    /// By the distance of neighbours.
    ChordLength,
    /// By the distance of neighbours to this power, usually one half.
    Centripetal(f64),
    /// By the distance in the metric of the points' own scatter.
    AffineChord,
    /// As that, widened where the points turn, by this factor, usually 1.5.
    AffineAngle(f64),
}

/// Parameters of the points, ascending from 0 to 1.
///
/// # Errors
/// [`Error::Argument`] for less than two points, or neighbours that coincide (they would get the
/// same parameter; with uniform spacing they may).
pub fn parameters<P: Point>(points: &[P], spacing: Spacing) -> Result<Vec<f64>> {
    let fail = |why: String| Err(Error::Argument { name: "points", why });
    if points.len() < 2 {
        return fail(format!("at least two points were expected, not {}", points.len()));
    }
    let chords = || points.windows(2).map(|w| (w[1] - w[0]).length());
    let steps: Vec<f64> = match spacing {
        Spacing::Uniform => vec![1.0; points.len() - 1],
        Spacing::ChordLength => chords().collect(),
        Spacing::Centripetal(power) => chords().map(|d| d.powf(power)).collect(),
        Spacing::AffineChord => Metric::new(points).chords(points),
        Spacing::AffineAngle(factor) => affine_angle(points, factor),
    };
    if let Some(i) = steps.iter().position(|h| !(h.is_finite() && *h > 0.0)) {
        return fail(format!("points {} and {} coincide: {:?}", i + 1, i + 2, points[i]));
    }
    let total: f64 = steps.iter().sum();
    let mut at = 0.0;
    let mut out = vec![0.0];
    out.extend(steps.iter().map(|h| {
        at += h;
        at / total
    }));
    out[points.len() - 1] = 1.0;
    Ok(out)
}

/// Clamped knots over the ascending parameters of conditions, each as often as it has conditions:
/// inner knots are means of `degree` neighbours (eq. 9.8 of *The NURBS Book*). There are as many
/// functions as conditions.
///
/// # Errors
/// [`Error::Spline`] when there are not more conditions than the degree, and as
/// [`KnotVector::new`].
pub fn averaged_knots(degree: usize, parameters: &[f64]) -> Result<KnotVector> {
    let n = parameters.len();
    if degree == 0 {
        return Err(Error::Spline { why: "degree 0: a curve has at least degree 1".into() });
    }
    if n <= degree {
        let why =
            format!("{n} conditions are too few for degree {degree}: at least {} are needed", degree + 1);
        return Err(Error::Spline { why });
    }
    let mut breaks = vec![parameters[0]];
    breaks.extend(parameters[1..n - 1].windows(degree).map(|w| w.iter().sum::<f64>() / degree as f64));
    breaks.push(parameters[n - 1]);
    KnotVector::clamped(degree, &breaks)
}

/// The metric of Nielson: distances after the map that makes the scatter of the points a unit one.
/// Where the points lie in a plane or on a line, it is that of the plane or line.
struct Metric {
    /// Coordinates that carry the scatter, with the rows of its Cholesky factor over them.
    rows: Vec<(usize, Vec<f64>)>,
}

impl Metric {
    fn new<P: Point>(points: &[P]) -> Self {
        let count = points.len() as f64;
        let centre = points.iter().fold(P::default(), |sum, &p| sum + p) / count;
        let share = |i: usize, j: usize| {
            let product = |&p: &P| (p - centre).coordinates()[i] * (p - centre).coordinates()[j];
            points.iter().map(product).sum::<f64>() / count
        };
        let mut rest: Vec<usize> = (0..P::DIMENSION).collect();
        let floor = 1e-24 * rest.iter().map(|&i| share(i, i)).sum::<f64>();
        let mut rows: Vec<(usize, Vec<f64>)> = Vec::new();
        // Cholesky with the largest remaining scatter first.
        loop {
            let reduced = |i: usize, row: &[f64]| share(i, i) - row.iter().map(|x| x * x).sum::<f64>();
            let row_of = |i: usize| {
                let mut row: Vec<f64> = Vec::new();
                for (j, other) in &rows {
                    let dot: f64 = row.iter().zip(other).map(|(a, b)| a * b).sum();
                    row.push((share(i, *j) - dot) / other[row.len()]);
                }
                row
            };
            let each = rest.iter().map(|&i| (i, row_of(i))).map(|(i, row)| (reduced(i, &row), i, row));
            let Some((left, i, mut row)) = each.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            if left.is_nan() || left <= floor.max(1e-13 * share(i, i)) {
                break;
            }
            row.push(left.sqrt());
            rest.retain(|&k| k != i);
            rows.push((i, row));
        }
        Self { rows }
    }

    fn distance<P: Point>(&self, a: P, b: P) -> f64 {
        let mut y: Vec<f64> = Vec::new();
        for (i, row) in &self.rows {
            let dot: f64 = row.iter().zip(&y).map(|(a, b)| a * b).sum();
            y.push(((b - a).coordinates()[*i] - dot) / row[row.len() - 1]);
        }
        y.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    fn chords<P: Point>(&self, points: &[P]) -> Vec<f64> {
        points.windows(2).map(|w| self.distance(w[0], w[1])).collect()
    }
}

fn affine_angle<P: Point>(points: &[P], factor: f64) -> Vec<f64> {
    let metric = Metric::new(points);
    let d = metric.chords(points);
    // How far the polygon turns at a point, at most a quarter; none at the ends.
    let turn = |i: usize| {
        if i == 0 || i == d.len() {
            return 0.0;
        }
        let across = metric.distance(points[i - 1], points[i + 1]);
        let cosine = (d[i - 1].powi(2) + d[i].powi(2) - across.powi(2)) / (2.0 * d[i] * d[i - 1]);
        (std::f64::consts::PI - cosine.clamp(-1.0, 1.0).acos()).min(std::f64::consts::FRAC_PI_2)
    };
    let widened = |i: usize| {
        let before = if i > 0 { turn(i) * d[i - 1] / (d[i - 1] + d[i]) } else { 0.0 };
        let after = d.get(i + 1).map_or(0.0, |next| turn(i + 1) * next / (d[i] + next));
        d[i] * (1.0 + factor * before + factor * after)
    };
    (0..d.len()).map(widened).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DAffine2, DMat2, DVec2, DVec3};

    const ALL: [Spacing; 5] = [
        Spacing::Uniform,
        Spacing::ChordLength,
        Spacing::Centripetal(0.5),
        Spacing::AffineChord,
        Spacing::AffineAngle(1.5),
    ];

    /// The points of example 9.1 of The NURBS Book.
    fn example() -> Vec<DVec2> {
        [(0.0, 0.0), (3.0, 4.0), (-1.0, 4.0), (-4.0, 0.0), (-4.0, -3.0)].map(|(x, y)| DVec2::new(x, y)).into()
    }

    #[test]
    fn example_9_1_of_the_nurbs_book() {
        let t = parameters(&example(), Spacing::ChordLength).unwrap();
        for (a, b) in t.iter().zip([0.0, 5.0 / 17.0, 9.0 / 17.0, 14.0 / 17.0, 1.0]) {
            assert!((a - b).abs() < 1e-15, "{t:?}");
        }
        let knots = averaged_knots(3, &t).unwrap();
        assert_eq!(knots.flat().len(), 9);
        assert!((knots.flat()[4] - 28.0 / 51.0).abs() < 1e-15, "{:?}", knots.flat());
    }

    #[test]
    fn affine_choices_do_not_see_affine_maps() {
        let map = DAffine2::from_mat2_translation(
            DMat2::from_cols_array(&[3.0, 0.4, -1.0, 0.02]),
            DVec2::new(50.0, -9.0),
        );
        for spacing in ALL {
            let before = parameters(&example(), spacing).unwrap();
            let moved: Vec<DVec2> = example().iter().map(|&p| map.transform_point2(p)).collect();
            let after = parameters(&moved, spacing).unwrap();
            let change = before.iter().zip(&after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let invariant = !matches!(spacing, Spacing::ChordLength | Spacing::Centripetal(_));
            assert_eq!(change < 1e-12, invariant, "{spacing:?} changed by {change}");
        }
    }

    #[test]
    fn points_of_a_plane_or_line_in_space_are_as_in_it() {
        let lift = |p: &DVec2| DVec3::new(p.x + 0.3 * p.y, 2.0 * p.y, p.x - p.y);
        let lifted: Vec<DVec3> = example().iter().map(lift).collect();
        let line: Vec<DVec3> = [0.0, 1.0, 4.0].map(|t| DVec3::new(1.0, 2.0, -1.0) * t).into();
        for spacing in [Spacing::AffineChord, Spacing::AffineAngle(1.5)] {
            let (flat, space) =
                (parameters(&example(), spacing).unwrap(), parameters(&lifted, spacing).unwrap());
            for (a, b) in flat.iter().zip(&space) {
                assert!((a - b).abs() < 1e-12, "{spacing:?}: {a} {b}");
            }
            let t = parameters(&line, spacing).unwrap();
            assert!((t[1] - 0.25).abs() < 1e-7, "{spacing:?}: {t:?}");
        }
    }

    #[test]
    fn a_square_turns_by_a_quarter() {
        // In the metric of a square all chords are equal and all turns a quarter, so ends are
        // 1 + 1.5 · π/4 long and the middle 1 + 1.5 · π/2.
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| DVec2::new(x, y));
        let t = parameters(&square, Spacing::AffineAngle(1.5)).unwrap();
        let (end, middle) = (1.0 + 0.375 * std::f64::consts::PI, 1.0 + 0.75 * std::f64::consts::PI);
        assert!((t[1] - end / (2.0 * end + middle)).abs() < 1e-14, "{t:?}");
    }

    #[test]
    fn points_that_coincide_are_named() {
        let twice = [DVec2::ZERO, DVec2::ONE, DVec2::ONE, DVec2::X];
        for spacing in &ALL[1..] {
            let message = parameters(&twice, *spacing).unwrap_err().to_string();
            assert!(message.contains("points 2 and 3 coincide"), "{message}");
        }
        assert!(parameters(&twice[..1], Spacing::Uniform).is_err());
        assert!(averaged_knots(3, &[0.0, 0.5, 1.0]).is_err());
    }
}
