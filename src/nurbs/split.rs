//! Parts of curves and surfaces: splitting, sub-curves, reversal, Bézier segments, isocurves.

use super::basis::{KnotVector, MAX_DEGREE};
use super::curve::{NurbsCurve, Point};
use super::degree::segments;
use super::refine::{Direction, Net, window};
use super::surface::NurbsSurface;
use crate::error::{Error, Result};
use glam::DVec3;

/// Refuses a part that is empty or reaches out of the domain.
fn check(knots: &KnotVector, from: f64, to: f64) -> Result<()> {
    let (a, b) = knots.domain();
    if a <= from && from < to && to <= b {
        return Ok(());
    }
    Err(Error::Spline { why: format!("[{from}, {to}] is no part of the domain [{a}, {b}]") })
}

impl<P: Point> NurbsCurve<P> {
    /// The part of the curve between two parameters, which keeps its parametrisation.
    ///
    /// # Errors
    /// [`Error::Spline`] when `[from, to]` is empty or not in the domain.
    pub fn part(&self, from: f64, to: f64) -> Result<Self> {
        check(self.knots(), from, to)?;
        self.reshape(|knots, net| window(knots, net, (from, to)))
    }

    /// The parts before and after `t`.
    ///
    /// # Errors
    /// [`Error::Spline`] when `t` is not inside the domain.
    pub fn split(&self, t: f64) -> Result<[Self; 2]> {
        let (a, b) = self.knots().domain();
        Ok([self.part(a, t)?, self.part(t, b)?])
    }

    /// The curve run backwards, over the same domain.
    pub fn reversed(&self) -> Self {
        let weights = self.weights().map(|w| w.iter().rev().copied().collect());
        Self::new(self.knots().reversed(), self.poles().iter().rev().copied().collect(), weights)
            .expect("poles in another order are as good")
    }

    /// Its Bézier segments, each over the span it came from.
    ///
    /// # Errors
    /// [`Error::Spline`] for curves that jump.
    pub fn bezier_segments(&self) -> Result<Vec<Self>> {
        let p = self.knots().degree();
        let mut net = Net::new(1, self.poles(), self.weights());
        let breaks = segments(self.knots(), &mut net)?;
        let (poles, weights) = net.project();
        let segment = |(k, w): (usize, &[(f64, usize)])| {
            let range = k * p..(k + 1) * p + 1;
            let knots = KnotVector::clamped(p, &[w[0].0, w[1].0])?;
            Self::new(knots, poles[range.clone()].to_vec(), weights.as_ref().map(|w| w[range].to_vec()))
        };
        breaks.windows(2).enumerate().map(segment).collect()
    }

    /// The same curve over the domain `[a, b]`.
    ///
    /// # Errors
    /// [`Error::Spline`] for an empty domain.
    pub fn over(&self, a: f64, b: f64) -> Result<Self> {
        Self::new(self.knots().over(a, b)?, self.poles().to_vec(), self.weights().map(<[f64]>::to_vec))
    }

    /// The curve with every pole moved by `map`; exact where that is affine (it may change the
    /// dimension).
    ///
    /// # Errors
    /// [`Error::Spline`] when a pole is no longer finite.
    pub fn mapped<Q: Point>(&self, map: impl Fn(P) -> Q) -> Result<NurbsCurve<Q>> {
        let poles = self.poles().iter().map(|&p| map(p)).collect();
        NurbsCurve::new(self.knots().clone(), poles, self.weights().map(<[f64]>::to_vec))
    }
}

impl NurbsSurface {
    /// The part of the surface between two parameters along `direction`.
    ///
    /// # Errors
    /// As [`NurbsCurve::part`].
    pub fn part(&self, direction: Direction, from: f64, to: f64) -> Result<Self> {
        check(self.knots(direction), from, to)?;
        self.reshape(direction, |knots, net| window(knots, net, (from, to)))
    }

    /// The parts before and after `t` along `direction`.
    ///
    /// # Errors
    /// As [`NurbsCurve::split`].
    pub fn split(&self, direction: Direction, t: f64) -> Result<[Self; 2]> {
        let (a, b) = self.knots(direction).domain();
        Ok([self.part(direction, a, t)?, self.part(direction, t, b)?])
    }

    /// The surface run backwards along `direction`, over the same domain.
    pub fn reversed(&self, direction: Direction) -> Self {
        let (n, m) = (self.knots_u().len(), self.knots_v().len());
        let (mut knots_u, mut knots_v) = (self.knots_u().clone(), self.knots_v().clone());
        let order: Vec<usize> = match direction {
            Direction::U => {
                knots_u = knots_u.reversed();
                (0..n * m).map(|k| (n - 1 - k / m) * m + k % m).collect()
            }
            Direction::V => {
                knots_v = knots_v.reversed();
                (0..n * m).map(|k| k / m * m + m - 1 - k % m).collect()
            }
        };
        let poles = order.iter().map(|&k| self.poles()[k]).collect();
        let weights = self.weights().map(|w| order.iter().map(|&k| w[k]).collect());
        Self::new(knots_u, knots_v, poles, weights).expect("poles in another order are as good")
    }

    /// Its Bézier patches, those along `v` next to each other.
    ///
    /// # Errors
    /// [`Error::Spline`] for surfaces that jump.
    pub fn bezier_patches(&self) -> Result<Vec<Self>> {
        let (us, vs) = (self.knots_u().breaks(), self.knots_v().breaks());
        let mut patches = Vec::new();
        for u in us.windows(2) {
            let strip = self.part(Direction::U, u[0], u[1])?;
            for v in vs.windows(2) {
                patches.push(strip.part(Direction::V, v[0], v[1])?);
            }
        }
        Ok(patches)
    }

    /// The same surface over the domain `[a, b]` along `direction`.
    ///
    /// # Errors
    /// [`Error::Spline`] for an empty domain.
    pub fn over(&self, direction: Direction, a: f64, b: f64) -> Result<Self> {
        let knots = self.knots(direction).over(a, b)?;
        let (u, v) = match direction {
            Direction::U => (knots, self.knots_v().clone()),
            Direction::V => (self.knots_u().clone(), knots),
        };
        Self::new(u, v, self.poles().to_vec(), self.weights().map(<[f64]>::to_vec))
    }

    /// The curve along which the parameter of `direction` is `t`, exactly; it runs over the other.
    pub fn isocurve(&self, direction: Direction, t: f64) -> Result<NurbsCurve<DVec3>> {
        let mut net = Net::new(self.knots_v().len(), self.poles(), self.weights());
        let (across, along) = match direction {
            Direction::U => (self.knots_u(), self.knots_v()),
            Direction::V => {
                net = net.transposed();
                (self.knots_v(), self.knots_u())
            }
        };
        let (span, mut n) = (across.span(t), [0.0; MAX_DEGREE + 1]);
        across.basis(span, t, &mut n);
        net.combine(&[(0..=across.degree()).map(|j| (span - across.degree() + j, n[j])).collect()]);
        let (poles, weights) = net.project();
        NurbsCurve::new(along.clone(), poles, weights)
    }

    /// The surface with every pole moved by `map`; exact where that is affine.
    ///
    /// # Errors
    /// [`Error::Spline`] when a pole is no longer finite.
    pub fn mapped(&self, map: impl Fn(DVec3) -> DVec3) -> Result<Self> {
        let poles = self.poles().iter().map(|&p| map(p)).collect();
        Self::new(self.knots_u().clone(), self.knots_v().clone(), poles, self.weights().map(<[f64]>::to_vec))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DAffine3, DVec2};

    fn curve() -> NurbsCurve<DVec3> {
        let knots =
            KnotVector::new(3, vec![-0.5, -0.2, -0.2, 0.0, 0.3, 0.3, 0.7, 1.0, 1.2, 1.9, 2.0]).unwrap();
        let poles = (0..7).map(|i| DVec3::new(i as f64, (i * i) as f64 * 0.3, (i as f64).sin())).collect();
        NurbsCurve::new(knots, poles, Some(vec![1.0, 2.0, 0.5, 1.0, 1.5, 0.8, 1.2])).unwrap()
    }

    fn surface() -> NurbsSurface {
        let (ku, kv) = (curve().knots().clone(), KnotVector::clamped(2, &[0.0, 0.5, 2.0]).unwrap());
        let poles = (0..28).map(|i| DVec3::new((i / 4) as f64, (i % 4) as f64, (i as f64).cos())).collect();
        NurbsSurface::new(ku, kv, poles, Some((0..28).map(|i| 1.0 + 0.1 * (i % 3) as f64).collect())).unwrap()
    }

    fn close(a: DVec3, b: DVec3) {
        assert!(a.distance(b) < 1e-13, "{a} and {b} are {} apart", a.distance(b));
    }

    #[test]
    fn parts_lie_on_the_curve() {
        let c = curve();
        let part = c.part(0.1, 0.7).unwrap();
        assert_eq!(part.knots().flat(), [0.1, 0.1, 0.1, 0.1, 0.3, 0.3, 0.7, 0.7, 0.7, 0.7]);
        let [before, after] = c.split(0.4).unwrap();
        for i in 0..=100 {
            let t = i as f64 / 100.0;
            close(part.point(0.1 + 0.6 * t), c.point(0.1 + 0.6 * t));
            close(before.point(0.4 * t), c.point(0.4 * t));
            close(after.point(0.4 + 0.6 * t), c.point(0.4 + 0.6 * t));
            close(c.reversed().point(1.0 - t), c.point(t));
        }
        for (a, b) in [(0.5, 0.5), (-0.1, 0.5), (0.5, 1.1), (f64::NAN, 1.0)] {
            assert!(c.part(a, b).is_err(), "[{a}, {b}]");
        }
    }

    #[test]
    fn extreme_numbers_run_backwards_as_well() {
        let next = 0.1f64.next_up();
        let flats = [
            vec![0.1, 0.1, next, 0.2, 0.3, 0.3],
            vec![-f64::MAX, -1.0, 1e300, f64::MAX],
            vec![-f64::MAX, -f64::MAX, f64::MAX, f64::MAX],
        ];
        for flat in flats {
            let n = flat.len() - 2;
            let poles = (0..n).map(|i| DVec2::new(1e300, 1e-300 * i as f64)).collect::<Vec<_>>();
            let weights = (0..n).map(|i| 1e200 * (i + 1) as f64).collect::<Vec<_>>();
            let c = NurbsCurve::new(KnotVector::new(1, flat).unwrap(), poles, Some(weights)).unwrap();
            let back = c.reversed().reversed();
            assert_eq!((back.poles(), back.weights()), (c.poles(), c.weights()));
            assert_eq!(c.reversed().knots().domain(), c.knots().domain());
        }
    }

    #[test]
    fn bezier_segments_make_up_the_curve() {
        let c = curve();
        let segments = c.bezier_segments().unwrap();
        assert_eq!(segments.len(), 3);
        for s in segments {
            assert_eq!(s.poles().len(), 4);
            let (a, b) = s.knots().domain();
            for i in 0..=20 {
                let t = a + (b - a) * i as f64 / 20.0;
                close(s.point(t), c.point(t));
            }
        }
        assert_eq!(surface().bezier_patches().unwrap().len(), 6);
    }

    #[test]
    fn isocurves_and_parts_lie_on_the_surface() {
        let s = surface();
        let (at_u, at_v) = (s.isocurve(Direction::U, 0.3).unwrap(), s.isocurve(Direction::V, 1.3).unwrap());
        let part = s.part(Direction::U, 0.2, 0.9).unwrap().reversed(Direction::V);
        for i in 0..=50 {
            let t = i as f64 / 50.0;
            close(at_u.point(2.0 * t), s.point(0.3, 2.0 * t));
            close(at_v.point(t), s.point(t, 1.3));
            close(part.point(0.2 + 0.7 * t, 0.6), s.point(0.2 + 0.7 * t, 1.4));
        }
    }

    #[test]
    fn affine_maps_and_domains_are_exact() {
        let map = DAffine3::from_axis_angle(DVec3::new(0.6, 0.8, 0.0), 0.7)
            * DAffine3::from_scale(DVec3::new(1.0, 2.0, 0.5));
        let c = curve();
        let (moved, flat) =
            (c.mapped(|p| map.transform_point3(p)).unwrap(), c.mapped(|p| DVec2::new(p.x, p.z)).unwrap());
        let (far, s) = (c.over(3.0, 5.0).unwrap(), surface().mapped(|p| map.transform_point3(p)).unwrap());
        let wide = surface().over(Direction::V, 3.0, 5.0).unwrap();
        for i in 0..=50 {
            let t = i as f64 / 50.0;
            close(moved.point(t), map.transform_point3(c.point(t)));
            close(far.point(3.0 + 2.0 * t), c.point(t));
            close(s.point(t, t), map.transform_point3(surface().point(t, t)));
            close(wide.point(t, 3.0 + t), surface().point(t, t));
            assert!((flat.point(t) - DVec2::new(c.point(t).x, c.point(t).z)).length() < 1e-14);
        }
    }
}
