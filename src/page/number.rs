//! Numbers as text.

/// The shortest text that reads back as the same number, with an exponent where plain digits would
/// be long.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-4..1e7).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_read_back_as_they_were() {
        for value in [0.0, -9.81, 1.215e-8, 7e5, 2.1e11, 0.1 + 0.2, 1e-4, -1e300] {
            assert_eq!(number(value).parse(), Ok(value));
        }
        assert_eq!(number(1.215e-8), "1.215e-8");
        assert_eq!(number(700_000.0), "700000");
    }
}
