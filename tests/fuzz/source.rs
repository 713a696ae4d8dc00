//! Arbitrary values for calls: mostly sensible ones, and now and then what nobody would pass.

/// A stream of pseudo-random values (SplitMix64), the same for the same seed.
pub struct Source(u64);

impl Source {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }

    /// True once in so many times.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number as a caller might pass it: small and round as a rule, seldom extreme or no number.
    pub fn number(&mut self) -> f64 {
        match self.below(40) {
            0 => [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][self.below(3)],
            1 => [0.0, -0.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, -f64::MAX, 1e300, 1e-300, 1e150, 1e20]
                [self.below(10)],
            2 => f64::from_bits(self.bits()),
            3..=12 => self.below(9) as f64 - 4.0,
            13..=20 => (self.below(17) as f64 - 4.0) * 0.125,
            _ => 20.0 * self.unit() - 10.0,
        }
    }

    /// A number that is hardly ever unusable.
    pub fn sane(&mut self) -> f64 {
        if self.once_in(300) { self.number() } else { 20.0 * self.unit() - 10.0 }
    }

    /// A whole number such as degrees, orders and options.
    pub fn small(&mut self) -> u32 {
        match self.below(30) {
            0 => [u32::MAX, 25, 26, 100, 1 << 31][self.below(5)],
            _ => self.below(5) as u32,
        }
    }

    pub fn degree(&mut self) -> u32 {
        if self.once_in(60) { self.small() } else { 1 + self.below(5) as u32 }
    }

    pub fn dimension(&mut self) -> u32 {
        if self.once_in(60) { self.small() } else { 2 + self.below(2) as u32 }
    }

    pub fn numbers(&mut self, count: usize) -> Vec<f64> {
        let wild = self.once_in(6);
        (0..count).map(|_| if wild { self.number() } else { self.sane() }).collect()
    }

    /// Flat knots for a degree: ascending, clamped or not, inner ones repeated now and then.
    pub fn knots(&mut self, degree: u32) -> Vec<f64> {
        let (degree, spans) = (degree.min(30) as usize, 1 + self.below(5));
        let scale = if self.once_in(20) { self.number() } else { 1.0 };
        let mut knots = Vec::new();
        let clamped = !self.once_in(4);
        let mut at = 0.0;
        for k in 0..=spans + if clamped { 0 } else { 2 * degree } {
            let end = clamped && (k == 0 || k == spans);
            let inner = if self.once_in(3) { 1 + self.below(degree + 2) } else { 1 };
            knots.extend(std::iter::repeat_n(at * scale, if end { degree + 1 } else { inner }));
            at += if self.once_in(50) { 1e-13 } else { 0.1 + self.unit() };
        }
        if self.once_in(40) {
            let hit = self.below(knots.len());
            knots[hit] = self.number();
        }
        knots
    }

    /// Positive weights as a rule, or none.
    pub fn weights(&mut self, count: usize) -> Option<Vec<f64>> {
        let wild = self.once_in(40);
        let each = |source: &mut Self| if wild { source.number() } else { (6.0 * source.unit() - 3.0).exp() };
        self.once_in(2).then(|| (0..count).map(|_| each(self)).collect())
    }
}
