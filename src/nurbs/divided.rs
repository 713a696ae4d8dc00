//! Divided differences of poles: the poles of derivatives (*The NURBS Book*, eq. 3.8 and 3.24).
//!
//! Sums over them with functions of the lower degrees keep the digits that derivatives of the
//! functions lose on short spans. They are rounded once: their differences are taken with twice
//! the digits, products with weights included.

use super::basis::KnotVector;
use super::double::Double;
use super::wide::{self, Four, Work};

/// Homogeneous poles `(w (P − c), w)`, with the centre `c`; without weights `w` is 0.
#[derive(Debug, Clone)]
pub(super) struct Net {
    /// The centre: in each place the coordinate nearest to zero, so that no error is added beyond
    /// that of the coordinates themselves.
    pub centre: [f64; 4],
    pub poles: Vec<[f64; 4]>,
    /// What rounding took off the poles.
    rest: Vec<[f64; 4]>,
}

impl Net {
    /// Of poles given with their weights in the last place, all of them 0 if there are none.
    pub(super) fn new(poles: Vec<[f64; 4]>) -> Self {
        let nearer = |a: f64, b: f64| if b.abs() < a.abs() { b } else { a };
        let nearest = |least: [f64; 4], p: &[f64; 4]| std::array::from_fn(|k| nearer(least[k], p[k]));
        let [x, y, z, _] = poles.iter().fold([f64::INFINITY; 4], nearest);
        let mut net = Self { centre: [x, y, z, 0.0], rest: vec![[0.0; 4]; poles.len()], poles };
        wide::run(Centred(&mut net));
        net
    }

    #[inline(always)]
    fn pole<F: Four>(&self, at: usize) -> Double<F> {
        // Behind the last pole nothing is summed.
        let at = at.min(self.poles.len() - 1);
        Double { high: F::load(&self.poles[at]), low: F::load(&self.rest[at]) }
    }
}

struct Centred<'a>(&'a mut Net);

impl Work for Centred<'_> {
    #[inline(always)]
    fn run<F: Four>(self) {
        let centre = F::load(&self.0.centre);
        for (pole, rest) in self.0.poles.iter_mut().zip(&mut self.0.rest) {
            let w = pole[3];
            let mut exact = Double::difference(F::load(pole), centre);
            if w != 0.0 {
                exact = exact.times(Double::of(F::load(&[w, w, w, 1.0])));
            }
            exact.high.store(pole);
            exact.low.store(rest);
        }
    }
}

/// What divides differences along one direction of a net.
#[derive(Debug, Clone)]
struct Along {
    stride: usize,
    /// The degree over the supports of the functions one degree lower, and what rounding took off.
    first: Vec<[f64; 2]>,
    /// That of the next degree.
    second: Vec<f64>,
}

impl Along {
    #[inline(always)]
    fn new<F: Four>(knots: &KnotVector, stride: usize) -> Self {
        let (p, flat) = (knots.degree(), knots.flat());
        // Empty supports, and places behind the last function, carry nothing.
        let over = |i: usize, k: usize| {
            let support = flat.get(i + p + 1).map_or(0.0, |end| end - flat[i + k]);
            if i + k < knots.len() && support > 0.0 { (p + 1 - k) as f64 / support } else { 0.0 }
        };
        let mut first: Vec<[f64; 2]> = (0..knots.len()).map(|i| [over(i, 1), 0.0]).collect();
        let degree = F::splat(p as f64);
        for (i, [high, low]) in first.iter_mut().enumerate().filter(|(_, f)| f[0] != 0.0) {
            let support = Double::difference(F::splat(flat[i + p + 1]), F::splat(flat[i + 1]));
            let rest = Double::of(degree).minus(support.times(Double::of(F::splat(*high)))).rounded();
            *low = *high * rest.to_array()[0] / p as f64;
        }
        Self { stride, first, second: (0..knots.len()).map(|i| over(i, 2)).collect() }
    }

    #[inline(always)]
    fn slope<F: Four>(&self, net: &Net, at: usize, index: usize) -> Double<F> {
        let [high, low] = self.first[index];
        let over = Double { high: F::splat(high), low: F::splat(low) };
        net.pole(at + self.stride).minus(net.pole(at)).times(over)
    }

    #[inline(always)]
    fn bend<F: Four>(&self, net: &Net, at: usize, index: usize) -> F {
        let next = self.slope::<F>(net, at + self.stride, (index + 1).min(self.first.len() - 1));
        next.minus(self.slope(net, at, index)).rounded() * F::splat(self.second[index])
    }
}

/// The poles of the derivatives of a surface, each at the place of its first pole: in v, in v twice,
/// in u, mixed, in u twice.
pub(super) fn of_surface(net: &Net, knots: [&KnotVector; 2]) -> Vec<[[f64; 4]; 5]> {
    let mut out = vec![[[0.0; 4]; 5]; net.poles.len()];
    wide::run(OfSurface { net, knots, out: &mut out });
    out
}

struct OfSurface<'a> {
    net: &'a Net,
    knots: [&'a KnotVector; 2],
    out: &'a mut [[[f64; 4]; 5]],
}

impl Work for OfSurface<'_> {
    #[inline(always)]
    fn run<F: Four>(self) {
        let columns = self.knots[1].len();
        let [along_u, along_v] = [Along::new::<F>(self.knots[0], columns), Along::new::<F>(self.knots[1], 1)];
        for (at, [v, vv, u, uv, uu]) in self.out.iter_mut().enumerate() {
            let (i, j) = (at / columns, at % columns);
            let in_v = along_v.slope::<F>(self.net, at, j);
            let mixed = along_v.slope::<F>(self.net, at + columns, j).minus(in_v).rounded();
            in_v.rounded().store(v);
            along_v.bend::<F>(self.net, at, j).store(vv);
            along_u.slope::<F>(self.net, at, i).rounded().store(u);
            (mixed * F::splat(along_u.first[i][0])).store(uv);
            along_u.bend::<F>(self.net, at, i).store(uu);
        }
    }
}

/// The poles of both derivatives of a curve, each at the place of its first pole.
pub(super) fn of_curve(net: &Net, knots: &KnotVector) -> Vec<[[f64; 4]; 2]> {
    let mut out = vec![[[0.0; 4]; 2]; net.poles.len()];
    wide::run(OfCurve { net, knots, out: &mut out });
    out
}

struct OfCurve<'a> {
    net: &'a Net,
    knots: &'a KnotVector,
    out: &'a mut [[[f64; 4]; 2]],
}

impl Work for OfCurve<'_> {
    #[inline(always)]
    fn run<F: Four>(self) {
        let along = Along::new::<F>(self.knots, 1);
        for (i, [slope, bend]) in self.out.iter_mut().enumerate() {
            along.slope::<F>(self.net, i, i).rounded().store(slope);
            along.bend::<F>(self.net, i, i).store(bend);
        }
    }
}
