//! Choices from bytes, so that a random test and a fuzzer make the same calls.

/// Bytes that run out: then every choice is the first.
pub struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let (first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        *first
    }

    /// One of some choices.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[usize::from(self.byte()) % choices.len()]
    }

    /// True about once in `n`.
    pub fn once_in(&mut self, n: u8) -> bool {
        self.byte() % n == n - 1
    }

    /// A number of any size, or none at all.
    pub fn number(&mut self) -> f64 {
        let named = [
            0.0,
            -1.0,
            f64::NAN,
            f64::INFINITY,
            -1e300,
            1e300,
            f64::MAX,
            5e-324,
        ];
        match self.byte() {
            at @ 0..240 => named[usize::from(at) % named.len()],
            _ => f64::from_bits(u64::from_le_bytes([(); 8].map(|()| self.byte()))),
        }
    }
}
