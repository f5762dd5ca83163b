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

/// Text of a number to four digits, as many as a computed mass or length is read with.
pub fn rounded(value: f64) -> String {
    format!("{value:.3e}")
        .parse()
        .map_or_else(|_| number(value), number)
}

#[cfg(test)]
mod tests {
    use super::{number, rounded};

    #[test]
    fn computed_numbers_are_rounded_to_four_digits() {
        let pairs = [
            (12.566_370_6, "12.57"),
            (0.1 + 0.2, "0.3"),
            (2.1e11, "2.1e11"),
            (0.0, "0"),
        ];
        for (value, text) in pairs {
            assert_eq!(rounded(value), text);
        }
    }

    #[test]
    fn numbers_read_back_as_they_were() {
        for value in [0.0, -9.81, 1.215e-8, 7e5, 2.1e11, 0.1 + 0.2, 1e-4, -1e300] {
            assert_eq!(number(value).parse(), Ok(value));
        }
        assert_eq!(number(1.215e-8), "1.215e-8");
        assert_eq!(number(700_000.0), "700000");
    }
}
