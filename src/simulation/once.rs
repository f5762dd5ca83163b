//! Findings of a run that are told once.

/// The first finding, and whether it was told.
#[derive(Clone, Copy, Debug)]
pub(super) struct Once<T> {
    found: Option<T>,
    is_told: bool,
}

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self {
            found: None,
            is_told: false,
        }
    }
}

impl<T: Copy> Once<T> {
    /// Whether nothing was found.
    pub fn is_open(&self) -> bool {
        self.found.is_none()
    }

    /// Keeps what is found.
    pub fn find(&mut self, found: Option<T>) {
        self.found = found;
    }

    /// Returns the finding, the first time that it is asked for.
    pub fn tell(&mut self) -> Option<T> {
        let found = self.found.filter(|_| !self.is_told)?;
        self.is_told = true;
        Some(found)
    }
}
