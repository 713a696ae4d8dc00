//! The B-spline recurrence prepared span by span: no search and no division is left for a point.

use super::basis::KnotVector;
use super::wide::Four;

/// Highest degree that is prepared.
pub(super) const MOST: usize = 5;
/// Functions on a span, at most.
pub(super) const WIDE: usize = MOST + 1;
/// Buckets of the span search for each span.
const BUCKETS: usize = 8;
/// Buckets at most.
const MOST_BUCKETS: usize = 1 << 14;

/// For four parameters: index of the first function on the span, and the functions there of `K`
/// degrees, the highest first; those of a lower degree begin with as many fewer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Functions<const K: usize> {
    pub first: [usize; 4],
    pub n: [[[f64; 4]; WIDE]; K],
}

impl<const K: usize> Functions<K> {
    pub(super) const NONE: Self = Self { first: [0; 4], n: [[[0.0; 4]; WIDE]; K] };
}

/// What the recurrence needs on one span.
#[derive(Debug, Clone, Copy)]
struct Span {
    first: usize,
    /// The `degree` knots up to the start of the span, and those from its end.
    below: [f64; MOST],
    above: [f64; MOST],
    /// Reciprocal lengths of the supports, by degree and place.
    inverse: [[f64; MOST]; MOST],
}

/// The spans of a knot vector of degree [`MOST`] or less, with what finds the one of a parameter.
#[derive(Debug, Clone)]
pub(super) struct SpanTable {
    degree: usize,
    spans: Vec<Span>,
    /// Ends of the spans; the last is infinite, as the last span holds what lies behind.
    ends: Vec<f64>,
    start: f64,
    scale: f64,
    /// The last span that starts in a bucket before this one.
    buckets: Vec<u32>,
    /// Spans that start in one bucket, at most.
    steps: usize,
}

impl SpanTable {
    /// Prepares knots of a degree up to [`MOST`].
    pub(super) fn new(knots: &KnotVector) -> Option<Self> {
        let (p, flat) = (knots.degree(), knots.flat());
        if p > MOST {
            return None;
        }
        let (a, b) = knots.domain();
        let spans: Vec<Span> =
            (p..knots.len()).filter(|&i| flat[i] < flat[i + 1]).map(|i| Span::new(p, flat, i)).collect();
        let mut ends: Vec<f64> = spans.iter().map(|s| s.above[0]).collect();
        *ends.last_mut()? = f64::INFINITY;
        let count = (BUCKETS * spans.len()).min(MOST_BUCKETS);
        let mut table = Self {
            degree: p,
            spans,
            ends,
            start: a,
            scale: count as f64 / (b - a),
            buckets: vec![0; count],
            steps: 0,
        };
        let mut starts = vec![0usize; count];
        for k in 1..table.spans.len() {
            starts[table.bucket(table.ends[k - 1])] += 1;
        }
        let mut before = 0;
        for (bucket, &inside) in table.buckets.iter_mut().zip(&starts) {
            *bucket = before as u32;
            before += inside;
        }
        table.steps = starts.into_iter().max().unwrap_or(0);
        Some(table)
    }

    /// Grows with `u`, so that comparing with the breaks of the same bucket finds the span.
    #[inline(always)]
    fn bucket(&self, u: f64) -> usize {
        let place = ((u - self.start) * self.scale) as i64;
        (place.max(0) as usize).min(self.buckets.len() - 1)
    }

    #[inline(always)]
    fn span(&self, u: f64) -> &Span {
        let mut k = self.buckets[self.bucket(u)] as usize;
        for _ in 0..self.steps {
            k += usize::from(u >= self.ends[k]);
        }
        &self.spans[k]
    }

    /// The functions at parameters in fours.
    #[inline(always)]
    pub(super) fn functions<F: Four, const K: usize>(
        &self,
        parameters: impl Iterator<Item = [f64; 4]>,
        out: &mut [Functions<K>],
    ) {
        match self.degree {
            1 => self.functions_of::<F, K, 1>(parameters, out),
            2 => self.functions_of::<F, K, 2>(parameters, out),
            3 => self.functions_of::<F, K, 3>(parameters, out),
            4 => self.functions_of::<F, K, 4>(parameters, out),
            _ => self.functions_of::<F, K, 5>(parameters, out),
        }
    }

    #[inline(always)]
    fn functions_of<F: Four, const K: usize, const P: usize>(
        &self,
        parameters: impl Iterator<Item = [f64; 4]>,
        out: &mut [Functions<K>],
    ) {
        for ([a, b, c, d], out) in parameters.zip(out) {
            let spans = [self.span(a), self.span(b), self.span(c), self.span(d)];
            out.first = [spans[0].first, spans[1].first, spans[2].first, spans[3].first];
            recurrence::<F, K, P>(spans, F::load(&[a, b, c, d]), &mut out.n);
        }
    }
}

impl Span {
    fn new(p: usize, flat: &[f64], i: usize) -> Self {
        let mut span =
            Self { first: i - p, below: [0.0; MOST], above: [0.0; MOST], inverse: [[0.0; MOST]; MOST] };
        span.below[..p].copy_from_slice(&flat[i + 1 - p..=i]);
        span.above[..p].copy_from_slice(&flat[i + 1..=i + p]);
        for j in 1..=p {
            for r in 0..j {
                span.inverse[j - 1][r] = 1.0 / (span.above[r] - span.below[p + r - j]);
            }
        }
        span
    }
}

/// The recurrence (A2.2), with the functions of the lower degrees that derivatives are sums of.
#[inline(always)]
fn recurrence<F: Four, const K: usize, const P: usize>(
    spans: [&Span; 4],
    u: F,
    out: &mut [[[f64; 4]; WIDE]; K],
) {
    let of = |value: fn(&Span, usize, usize) -> f64, j: usize, r: usize| {
        F::load(&[value(spans[0], j, r), value(spans[1], j, r), value(spans[2], j, r), value(spans[3], j, r)])
    };
    let zero = F::splat(0.0);
    let (mut left, mut right) = ([zero; MOST], [zero; MOST]);
    for r in 0..P {
        left[r] = u - of(|s, _, r| s.below[r], 0, r);
        right[r] = of(|s, _, r| s.above[r], 0, r) - u;
    }
    let mut n = [zero; WIDE];
    n[0] = F::splat(1.0);
    macro_rules! raise {
        ($($j:literal)*) => {$(
            if $j <= P {
                if P - $j + 1 < K {
                    keep(&n, $j - 1, &mut out[P - $j + 1]);
                }
                let lower = n;
                n[$j] = zero;
                for r in 0..$j {
                    let t = lower[r] * of(|s, j, r| s.inverse[j - 1][r], $j, r);
                    n[r] = if r == 0 { right[r] * t } else { n[r] + right[r] * t };
                    n[r + 1] = left[P + r - $j] * t;
                }
            }
        )*};
    }
    raise!(1 2 3 4 5);
    keep(&n, P, &mut out[0]);
}

#[inline(always)]
fn keep<F: Four>(n: &[F; WIDE], degree: usize, out: &mut [[f64; 4]; WIDE]) {
    for r in 0..=degree {
        n[r].store(&mut out[r]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::wide::{self, Work};
    use super::*;

    #[test]
    fn prepared_functions_equal_the_recurrence() {
        for degree in 1..=MOST {
            let knots = KnotVector::new(degree, {
                let mut flat: Vec<f64> = (0..=degree).map(|i| -0.1 * (degree - i) as f64).collect();
                flat.extend([1e-9, 0.3, 0.3, 0.45, 0.45 + 1e-12, 1.0]);
                flat.extend((1..=degree).map(|i| 1.0 + 0.2 * i as f64));
                flat
            })
            .unwrap();
            let table = SpanTable::new(&knots).unwrap();
            let inside = (0..=997).map(|i| i as f64 / 997.0);
            let us: Vec<f64> = inside.chain(knots.breaks()).collect();
            let mut out = vec![Functions::<3>::NONE; us.len()];
            wide::run(All { table: &table, us: &us, out: &mut out });
            for (&u, f) in us.iter().zip(&out) {
                let span = knots.span(u);
                assert_eq!(f.first, [span - degree; 4], "degree {degree}, u {u}");
                for k in 0..3.min(degree) {
                    let flat = &knots.flat()[k..knots.flat().len() - k];
                    let lower = KnotVector::new(degree - k, flat.to_vec()).unwrap();
                    let mut expected = [0.0; WIDE];
                    lower.basis(span - k, u, &mut expected);
                    for j in 0..=degree - k {
                        let (is, want) = (f.n[k][j][3], expected[j]);
                        assert!((is - want).abs() <= 4e-15, "degree {degree} - {k}, u {u}: {is} {want}");
                    }
                }
            }
        }
    }

    struct All<'a> {
        table: &'a SpanTable,
        us: &'a [f64],
        out: &'a mut [Functions<3>],
    }

    impl Work for All<'_> {
        #[inline(always)]
        fn run<F: Four>(self) {
            self.table.functions::<F, 3>(self.us.iter().map(|&u| [u; 4]), self.out);
        }
    }

    #[test]
    fn high_degrees_are_not_prepared() {
        assert!(SpanTable::new(&KnotVector::clamped(MOST + 1, &[0.0, 1.0]).unwrap()).is_none());
    }
}
