//! Numbers that look random, the same in each run: G. Marsaglia, "Xorshift RNGs", Journal of Statistical Software 8 (2003).

/// A generator; its state is any number but 0.
pub struct Xorshift(pub u64);

impl Xorshift {
    /// The next 64 bits, of which the higher ones are the better.
    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
}
