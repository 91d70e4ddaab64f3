//! Numbers that look random and are the same in every run, for tests.

/// xorshift64* (Vigna 2016).
pub(crate) struct PseudoRandom(u64);

impl PseudoRandom {
    pub(crate) fn new(seed: u32) -> Self {
        // Zero would stay zero.
        Self(0x2545_F491_4F6C_DD1D ^ (u64::from(seed) << 32))
    }

    fn next(&mut self) -> u32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 32) as u32
    }

    /// From 0 to one less than `count`; 0 where `count` is 0.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        self.next() as usize % count.max(1)
    }

    /// From 0 on, below 1.
    pub(crate) fn unit(&mut self) -> f32 {
        (self.next() >> 8) as f32 / (1 << 24) as f32
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.next() as u8
    }
}
