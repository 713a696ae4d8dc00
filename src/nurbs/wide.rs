//! Four numbers at once: AVX2 where the processor has it, plain arrays elsewhere, chosen at run
//! time. Neither fuses products with sums, so both give the same bits.
//!
//! The unsafe code of evaluation is here and nowhere else. Its one condition is that AVX2
//! instructions run only on a processor that has them: [`run`] asks the processor, and the type
//! that stands for them has no other way into the world.

use std::ops::{Add, Mul, Sub};

/// Four numbers; operations work on each.
pub(crate) trait Four: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    fn splat(x: f64) -> Self;
    fn load(x: &[f64; 4]) -> Self;
    fn store(self, out: &mut [f64; 4]);
    /// Has the processor fetch what will be read soon, where it takes such hints.
    #[inline(always)]
    fn prefetch<T>(_soon: &T) {}
    fn to_array(self) -> [f64; 4] {
        let mut out = [0.0; 4];
        self.store(&mut out);
        out
    }
}

/// Something to do with fours, all of it `#[inline(always)]`.
pub(crate) trait Work {
    /// Does it.
    fn run<F: Four>(self);
}

/// Does the work with the widest registers that the processor and this crate know.
pub(crate) fn run(work: impl Work) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has the one feature that the function asks for.
        #[allow(unsafe_code)]
        return unsafe { avx2::run(work) };
    }
    work.run::<Plain>();
}

/// Fours of the target's baseline.
#[derive(Debug, Clone, Copy)]
struct Plain([f64; 4]);

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl $trait for Plain {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
                Self([a $operator e, b $operator f, c $operator g, d $operator h])
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);

impl Four for Plain {
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; 4])
    }
    #[inline(always)]
    fn load(x: &[f64; 4]) -> Self {
        Self(*x)
    }
    #[inline(always)]
    fn store(self, out: &mut [f64; 4]) {
        *out = self.0;
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod avx2 {
    use super::{Add, Four, Mul, Sub, Work};
    use std::arch::x86_64::{
        __m256d, _MM_HINT_T0, _mm_prefetch, _mm256_add_pd, _mm256_loadu_pd, _mm256_mul_pd, _mm256_set1_pd,
        _mm256_storeu_pd, _mm256_sub_pd,
    };

    #[target_feature(enable = "avx2")]
    pub(super) fn run(work: impl Work) {
        work.run::<Wide>();
    }

    /// Private to this module: only `run` above, on a processor that has AVX2, hands it out.
    #[derive(Clone, Copy)]
    struct Wide(__m256d);

    macro_rules! operator {
        ($trait:ident, $method:ident, $instruction:ident) => {
            impl $trait for Wide {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    // SAFETY: values of this type exist only where the processor has AVX2.
                    Self(unsafe { $instruction(self.0, other.0) })
                }
            }
        };
    }

    operator!(Add, add, _mm256_add_pd);
    operator!(Sub, sub, _mm256_sub_pd);
    operator!(Mul, mul, _mm256_mul_pd);

    impl Four for Wide {
        #[inline(always)]
        fn splat(x: f64) -> Self {
            // SAFETY: this type is named only where the processor has AVX2.
            Self(unsafe { _mm256_set1_pd(x) })
        }
        #[inline(always)]
        fn load(x: &[f64; 4]) -> Self {
            // SAFETY: as above; the array holds the four numbers read, of any alignment.
            Self(unsafe { _mm256_loadu_pd(x.as_ptr()) })
        }
        #[inline(always)]
        fn store(self, out: &mut [f64; 4]) {
            // SAFETY: as above; the array holds the four numbers written, of any alignment.
            unsafe { _mm256_storeu_pd(out.as_mut_ptr(), self.0) }
        }
        #[inline(always)]
        fn prefetch<T>(soon: &T) {
            // SAFETY: a hint changes no memory, and the address is that of a reference.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(soon).cast()) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Blend<'a>(&'a [[f64; 4]], &'a mut [f64; 4]);

    impl Work for Blend<'_> {
        #[inline(always)]
        fn run<F: Four>(self) {
            let mut sum = F::splat(0.5);
            for (i, row) in self.0.iter().enumerate() {
                sum = sum - (sum + F::load(row)) * F::splat(1.0 / (i + 3) as f64);
            }
            sum.store(self.1);
        }
    }

    #[test]
    fn both_ways_give_the_same_bits() {
        let rows: Vec<[f64; 4]> =
            (0..1000).map(|i| std::array::from_fn(|k| ((i * 4 + k) as f64).sin())).collect();
        let (mut plain, mut wide) = ([0.0; 4], [0.0; 4]);
        Blend(&rows, &mut plain).run::<Plain>();
        run(Blend(&rows, &mut wide));
        assert_eq!(plain.map(f64::to_bits), wide.map(f64::to_bits));
    }
}
