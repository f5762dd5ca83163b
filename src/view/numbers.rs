//! Numbers of a page: tracks of rows side by side in one block of bytes, in base64. What curves are drawn from is exact; what bodies are
//! drawn from are 65536 steps between the least and the largest value of every column.

use std::fmt::Write;

/// Steps between the least and the largest value.
const STEPS: f64 = 65535.0;
/// Letters of base64 (RFC 4648, section 4).
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
/// Bytes that tracks begin at multiples of.
const ALIGNED: usize = 8;

/// Tracks so far.
#[derive(Default)]
pub(super) struct Numbers {
    bytes: Vec<u8>,
    /// Entry of the header.
    tracks: Vec<String>,
}

impl Numbers {
    /// Adds rows as they are; the number of the track.
    pub fn exact(&mut self, rows: &[Vec<f64>]) -> usize {
        let number = self.begin("exact", rows, rows.len());
        let values = rows.iter().flatten();
        self.bytes
            .extend(values.flat_map(|value| value.to_le_bytes()));
        number
    }

    /// Adds rows in steps; one row alone where all are the same. The number of the track.
    pub fn stepped(&mut self, rows: &[Vec<f64>]) -> usize {
        let width = rows.first().map_or(0, Vec::len);
        let scales: Vec<[f32; 2]> = (0..width).map(|column| scale(rows, column)).collect();
        let is_still = scales.iter().all(|[_, step]| *step == 0.0);
        let kept = if is_still {
            rows.len().min(1)
        } else {
            rows.len()
        };
        let number = self.begin("steps", rows, kept);
        let both = scales.iter().flatten();
        self.bytes
            .extend(both.flat_map(|value| value.to_le_bytes()));
        for row in &rows[..kept] {
            for (value, scale) in row.iter().zip(&scales) {
                let [low, step] = scale.map(f64::from);
                let count = if step > 0.0 {
                    (value - low) / step
                } else {
                    0.0
                };
                let count = count.round().clamp(0.0, STEPS) as u16;
                self.bytes.extend(count.to_le_bytes());
            }
        }
        number
    }

    fn begin(&mut self, kind: &str, rows: &[Vec<f64>], kept: usize) -> usize {
        self.bytes
            .resize(self.bytes.len().next_multiple_of(ALIGNED), 0);
        let (at, width) = (self.bytes.len(), rows.first().map_or(0, Vec::len));
        self.tracks.push(format!(
            "{{\"kind\":\"{kind}\",\"at\":{at},\"rows\":{kept},\"width\":{width}}}"
        ));
        self.tracks.len() - 1
    }

    /// Entries of the header for the tracks, and all numbers in base64.
    pub fn finish(self) -> (String, String) {
        (self.tracks.join(","), base64(&self.bytes))
    }
}

/// Least value and step of a column.
fn scale(rows: &[Vec<f64>], column: usize) -> [f32; 2] {
    let values = || rows.iter().map(|row| row[column]);
    let (low, high) = (
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
    );
    // The least value as a single may be above it by rounding: no step is lost by that.
    let step = (high - low) / STEPS;
    // What is beyond the digits of a single stands still.
    let is_still = high - low <= 1e-7 * low.abs().max(high.abs());
    [low as f32, if is_still { 0.0 } else { step as f32 }]
}

/// Bytes in base64.
pub(super) fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |k: usize| u32::from(three.get(k).copied().unwrap_or(0));
        let whole = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let letter = LETTERS[(whole >> (18 - 6 * k) & 63) as usize];
            text.push(if k > three.len() {
                '='
            } else {
                char::from(letter)
            });
        }
    }
    text
}

/// A text for JSON inside a page.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            // No element of the page ends inside it.
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' | '\0'..='\u{1f}' => {
                let code = u32::from(letter);
                write!(quoted, "\\u{code:04x}").unwrap_or_default();
            }
            _ => quoted.push(letter),
        }
    }
    quoted + "\""
}

/// A list of JSON.
pub(super) fn list<T>(
    items: impl IntoIterator<Item = T>,
    written: impl FnMut(T) -> String,
) -> String {
    let items: Vec<String> = items.into_iter().map(written).collect();
    format!("[{}]", items.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        // RFC 4648, section 10.
        let pairs = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (bytes, text) in pairs {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xbf]), "+/+/");
    }

    #[test]
    fn texts_end_no_element() {
        assert_eq!(
            quoted("a\"\\</script>\n"),
            "\"a\\\"\\\\\\u003c/script\\u003e\\u000a\""
        );
    }

    #[test]
    fn steps_are_finer_than_is_seen() {
        let rows: Vec<Vec<f64>> = (0..50)
            .map(|k| vec![1e3 + (f64::from(k)).sin(), 7.0])
            .collect();
        let mut numbers = Numbers::default();
        assert_eq!(numbers.exact(&rows[..1]), 0);
        assert_eq!(numbers.stepped(&rows), 1);
        let (tracks, _) = {
            let bytes = numbers.bytes.clone();
            let single = |at: usize| f32::from_le_bytes(std::array::from_fn(|k| bytes[at + k]));
            let [low, step, seven, none] = [16, 20, 24, 28].map(single);
            assert_eq!([seven, none], [7.0, 0.0]);
            for (k, row) in rows.iter().enumerate() {
                let count = u16::from_le_bytes([bytes[32 + 4 * k], bytes[33 + 4 * k]]);
                let found = f64::from(low) + f64::from(step) * f64::from(count);
                // Half a step, and the digits of the least value.
                assert!((found - row[0]).abs() < 1.0 / STEPS + 1e3 * 1e-7, "{k}");
            }
            numbers.finish()
        };
        assert!(tracks.ends_with("{\"kind\":\"steps\",\"at\":16,\"rows\":50,\"width\":2}"));
        let mut still = Numbers::default();
        still.stepped(&vec![vec![3.0]; 9]);
        assert!(still.finish().0.contains("\"rows\":1"));
    }
}
