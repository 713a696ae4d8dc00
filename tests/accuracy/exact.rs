//! Splines in exact arithmetic. Doubles are whole numbers times powers of two, so every point and
//! derivative is a fraction of whole numbers, and no digit of the reference is rounded.

use bladesmith::nurbs::{KnotVector, NurbsCurve, NurbsSurface, Point};
use num_bigint::BigInt;

/// Sign, whole number and exponent of two of a double.
fn parts(x: f64) -> (BigInt, i32) {
    if x == 0.0 {
        return (BigInt::from(0), 0);
    }
    let (bits, sign) = (x.abs().to_bits(), if x < 0.0 { -1 } else { 1 });
    let (high, low) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    let whole = if high == 0 { low } else { low | 1 << 52 };
    let zeros = whole.trailing_zeros();
    (BigInt::from(whole >> zeros) * sign, high.max(1) - 1075 + zeros as i32)
}

/// Doubles times a common power of two, which makes them whole, and its exponent.
fn whole(numbers: &[f64]) -> (Vec<BigInt>, i32) {
    let parts: Vec<_> = numbers.iter().map(|&x| parts(x)).collect();
    let up = parts.iter().map(|&(_, e)| -e).max().unwrap_or(0).max(0);
    (parts.into_iter().map(|(x, e)| x << (e + up)).collect(), up)
}

/// `top / bottom · 2^exponent`.
#[derive(Clone)]
pub struct Fraction {
    top: BigInt,
    bottom: BigInt,
    exponent: i32,
}

impl Fraction {
    pub fn of(x: f64) -> Self {
        let (top, exponent) = parts(x);
        Self { top, bottom: BigInt::from(1), exponent }
    }

    pub fn minus(&self, other: &Self) -> Self {
        let low = self.exponent.min(other.exponent);
        let raised = |a: &Self, b: &Self| (&a.top * &b.bottom) << (a.exponent - low);
        let top = raised(self, other) - raised(other, self);
        Self { top, bottom: &self.bottom * &other.bottom, exponent: low }
    }

    /// The double near it, to some 60 digits of two.
    pub fn value(&self) -> f64 {
        let shift = 62 + self.bottom.bits() as i32 - self.top.bits() as i32;
        let quotient = if shift >= 0 {
            (&self.top << shift) / &self.bottom
        } else {
            (&self.top >> -shift) / &self.bottom
        };
        let (digits, exponent) = (i128::try_from(quotient).expect("63 digits"), self.exponent - shift);
        let half = exponent / 2;
        digits as f64 * 2f64.powi(half) * 2f64.powi(exponent - half)
    }
}

/// The functions on a span as series about a parameter: `series[j][k] / (bottom · 2^(-up k))` is the
/// `k`-th derivative of the `j`-th function over `k` factorial.
struct Functions {
    series: Vec<Vec<BigInt>>,
    bottom: BigInt,
    up: i32,
}

impl Functions {
    /// What stands for the missing direction of a curve.
    fn one(orders: usize) -> Self {
        let mut series = vec![BigInt::from(0); orders];
        series[0] = BigInt::from(1);
        Self { series: vec![series], bottom: BigInt::from(1), up: 0 }
    }

    /// Cox and de Boor's recurrence, literally (eq. 2.5), on series instead of numbers; all
    /// functions of one degree share a denominator.
    fn new(knots: &KnotVector, span: usize, t: f64, orders: usize) -> Self {
        let p = knots.degree();
        let mut numbers = knots.flat()[span + 1 - p..=span + p].to_vec();
        numbers.push(t);
        let (numbers, up) = whole(&numbers);
        // `near(i)` is knot `span + i`.
        let near = |i: isize| &numbers[(i + p as isize - 1) as usize];
        let t = &numbers[2 * p];
        let mut this = Self::one(orders);
        this.up = up;
        for degree in 1..=p {
            let support = |r: usize| near(r as isize + 1) - near(r as isize + 1 - degree as isize);
            let bottom: BigInt = (0..degree).map(support).product();
            let mut next = vec![vec![BigInt::from(0); orders]; degree + 1];
            for r in 0..degree {
                let share = &bottom / support(r);
                let (left, right) = (near(r as isize + 1 - degree as isize), near(r as isize + 1));
                for k in 0..orders {
                    let a = &this.series[r][k] * &share;
                    next[r][k] += &a * (right - t);
                    next[r + 1][k] += &a * (t - left);
                    if k + 1 < orders {
                        next[r][k + 1] -= &a;
                        next[r + 1][k + 1] += a;
                    }
                }
            }
            (this.series, this.bottom) = (next, this.bottom * bottom);
        }
        this
    }

    /// The derivatives as doubles: `[j][k]`.
    fn values(&self) -> Vec<Vec<f64>> {
        let value = |(k, top): (usize, &BigInt)| {
            let exponent = self.up * k as i32;
            Fraction { top: top * factorial(k), bottom: self.bottom.clone(), exponent }.value()
        };
        self.series.iter().map(|s| s.iter().enumerate().map(value).collect()).collect()
    }
}

fn factorial(k: usize) -> u64 {
    (1..=k as u64).product()
}

fn binomial(n: usize, k: usize) -> f64 {
    (factorial(n) / factorial(k) / factorial(n - k)) as f64
}

/// One coordinate of the derivatives `[k][l]`, `k < K` in the first and `l < L` in the second
/// parameter, with their condition: the sum of the sizes of all terms that make them up (eq. 4.20).
pub type Jet = Vec<Vec<(Fraction, f64)>>;

/// A point of a curve or surface on a given span.
struct Place {
    along: [Functions; 2],
    orders: [usize; 2],
    /// Poles of the span (coordinates), the second direction fastest.
    poles: Vec<[f64; 3]>,
    weights: Vec<f64>,
}

impl Place {
    /// The end of the orders in one direction beside an order in the other.
    fn below(&self, order: usize) -> usize {
        self.orders[0] - order
    }

    /// Series of one coordinate of the homogeneous shape, and the exponent to take off.
    fn series(&self, factors: &[f64]) -> (Vec<Vec<BigInt>>, i32) {
        let (factors, up) = whole(factors);
        let [first, second] = &self.along;
        let mut sum = vec![vec![BigInt::from(0); self.orders[1]]; self.orders[0]];
        for (i, a) in first.series.iter().enumerate() {
            for l in 0..self.orders[1] {
                let row = &factors[i * second.series.len()..];
                let line: BigInt = second.series.iter().zip(row).map(|(b, f)| &b[l] * f).sum();
                for k in 0..self.below(l) {
                    sum[k][l] += &a[k] * &line;
                }
            }
        }
        (sum, up)
    }

    /// The quotient's series over powers of the weight: whole numbers throughout.
    fn jet(&self, axis: usize) -> Jet {
        // The product of a pole and a weight is no double: both digits of it are taken along.
        let products = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            self.poles.iter().zip(&self.weights).map(|(p, &w)| f(p[axis], w)).collect()
        };
        let high = products(&|x, w| x * w);
        let low = products(&|x, w| x.mul_add(w, -(x * w)));
        let ((high, up_high), (low, up_low)) = (self.series(&high), self.series(&low));
        let (w, up_w) = self.series(&self.weights);
        let up = up_high.max(up_low);
        let conditions = self.conditions(axis);
        let mut q = vec![vec![BigInt::from(0); self.orders[1]]; self.orders[0]];
        let mut out: Jet = Vec::new();
        for k in 0..self.orders[0] {
            out.push(Vec::new());
            for l in 0..self.below(k).min(self.orders[1]) {
                let a = (&high[k][l] << (up - up_high)) + (&low[k][l] << (up - up_low));
                let mut sum = a * w[0][0].pow((k + l) as u32);
                for (i, j) in (0..=k).flat_map(|i| (0..=l).map(move |j| (i, j))).skip(1) {
                    sum -= &w[i][j] * &q[k - i][l - j] * w[0][0].pow((i + j) as u32 - 1);
                }
                q[k][l] = sum;
                let exponent = up_w - up + self.along[0].up * k as i32 + self.along[1].up * l as i32;
                let top = &q[k][l] * factorial(k) * factorial(l);
                let bottom = w[0][0].pow((k + l) as u32 + 1);
                out[k].push((Fraction { top, bottom, exponent }, conditions[k][l]));
            }
        }
        out
    }

    fn conditions(&self, axis: usize) -> Vec<Vec<f64>> {
        let [m, n] = self.along.each_ref().map(Functions::values);
        let mut size = vec![vec![0.0; self.orders[1]]; self.orders[0]];
        let mut weight = size.clone();
        for k in 0..self.orders[0] {
            for l in 0..self.below(k).min(self.orders[1]) {
                for (at, (pole, w)) in self.poles.iter().zip(&self.weights).enumerate() {
                    let b = (m[at / n.len()][k] * n[at % n.len()][l] * w).abs();
                    weight[k][l] += b;
                    size[k][l] += b * pole[axis].abs();
                }
                for (i, j) in (0..=k).flat_map(|i| (0..=l).map(move |j| (i, j))).skip(1) {
                    size[k][l] += binomial(k, i) * binomial(l, j) * weight[i][j] * size[k - i][l - j];
                }
                size[k][l] /= weight[0][0];
            }
        }
        size
    }
}

/// The derivatives of a curve below this order on a span, for each axis.
pub fn curve<P: Point>(c: &NurbsCurve<P>, span: usize, t: f64, orders: usize) -> Vec<Jet> {
    let range = span - c.knots().degree()..=span;
    let place = Place {
        along: [Functions::new(c.knots(), span, t, orders), Functions::one(1)],
        orders: [orders, 1],
        poles: c.poles()[range.clone()].iter().map(|p| p.coordinates()).collect(),
        weights: range.map(|i| c.weights().map_or(1.0, |w| w[i])).collect(),
    };
    (0..P::DIMENSION).map(|axis| place.jet(axis)).collect()
}

/// The same of a surface, both parameters' orders below this one.
pub fn surface(s: &NurbsSurface, spans: [usize; 2], [u, v]: [f64; 2], orders: usize) -> Vec<Jet> {
    let (ku, kv) = (s.knots_u(), s.knots_v());
    let rows = spans[0] - ku.degree()..=spans[0];
    let columns = spans[1] - kv.degree()..=spans[1];
    let indices: Vec<usize> = rows.flat_map(|i| columns.clone().map(move |j| i * kv.len() + j)).collect();
    let place = Place {
        along: [Functions::new(ku, spans[0], u, orders), Functions::new(kv, spans[1], v, orders)],
        orders: [orders; 2],
        poles: indices.iter().map(|&i| s.poles()[i].to_array()).collect(),
        weights: indices.iter().map(|&i| s.weights().map_or(1.0, |w| w[i])).collect(),
    };
    (0..3).map(|axis| place.jet(axis)).collect()
}
