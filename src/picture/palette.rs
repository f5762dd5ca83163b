//! All colours of drawings and pages, as they are written in SVG and CSS. Pages get them by name: style sheets as variables, scripts as JSON.

/// Texts and edges.
pub const INK: &str = "#24292f";
/// Parts for orientation only: names of joints, gravity, wheels of gears.
pub const FAINT: &str = "#8a929b";
/// Joints, supports and bars of joint limits. It reaches pages inside strokes, so it has no name in `NAMED`.
pub const JOINT: &str = "#3a3f45";
/// Loads.
pub const LOAD: &str = "#c2571a";
/// Driven motions, and ports that motions come into.
pub const MOTION: &str = "#2e7d4f";
/// Springs.
pub const SPRING: &str = "#6f4a9e";
/// Forces and moments of joints and motions.
pub const REACTION: &str = "#b3246b";
/// Bodies of still drawings.
pub const BODY: &str = "#2b5c8a";
/// The inside of bodies of still drawings.
pub const INSIDE: &str = "#dce6f0";
/// Surfaces that bodies touch, lighter than all that touches them.
pub const BED: &str = "#d3dae1";
/// Paper, and the inside of pins.
pub const PAPER: &str = "#ffffff";

/// Colours by the names that style sheets and scripts know them by. Those that reach pages inside strokes alone have none.
const NAMED: [(&str, &str); 22] = [
    ("ink", INK),
    ("faint", FAINT),
    ("load", LOAD),
    ("spring", SPRING),
    ("reaction", REACTION),
    ("bed", BED),
    ("paper", PAPER),
    // Behind the moving picture.
    ("stage", "#fcfdfe"),
    // The grid below bodies in space: its middle lines, the others.
    ("floor-axis", "#cfd6dd"),
    ("floor", "#e3e8ec"),
    // Light from above and from below.
    ("sky", "#ffffff"),
    ("soil", "#9aa5b1"),
    // Bodies without a value, where others are coloured by one.
    ("unpainted", "#c8ced5"),
    // Grids and numbers of charts.
    ("grid", "#e4e8ec"),
    ("number", "#57606a"),
    // Lines between parts of a page, between rows of a table; buttons.
    ("rule", "#d8dde3"),
    ("row", "#eceff2"),
    ("button", "#f6f8fa"),
    ("button-edge", "#d0d7de"),
    ("slider", "#4a78b5"),
    ("remark", "#6b737c"),
    // What a plan does not keep.
    ("warning", "#b00020"),
];

/// Bodies of moving pictures and of glTF, one after the other.
pub const BODIES: [&str; 8] = [
    "#4a78b5", "#c47a3d", "#5a9a6e", "#a4648c", "#8c8048", "#4795a3", "#b35b52", "#7569b0",
];

/// Colours by the names that scripts know them by: curves one after the other, global axes, values from zero to the largest, values from the
/// least over zero to the largest.
const LISTS: [(&str, &[&str]); 5] = [
    ("bodies", &BODIES),
    (
        "curves",
        &[
            "#4a78b5", LOAD, MOTION, "#8f4f9e", "#8c8048", REACTION, "#4795a3", "#6b737c", INK,
        ],
    ),
    ("axes", &["#b35b52", "#4c8a5d", "#4a78b5"]),
    ("rising", &["#3b5fa3", "#4fa3a5", "#e9c84a", "#c0392b"]),
    ("signed", &["#2f5fb3", "#dfe3e8", "#b3312f"]),
];

/// The colours with a name as variables of a style sheet: `ink` is `var(--ink)`.
pub fn style_sheet() -> String {
    let named = NAMED.map(|(name, colour)| format!("--{name}: {colour};"));
    format!(":root {{ {} }}\n", named.join(" "))
}

/// All colours as a JSON object for scripts.
pub fn json() -> String {
    let named = NAMED.map(|(name, colour)| format!("\"{name}\":\"{colour}\""));
    let lists = LISTS.map(|(name, colours)| format!("\"{name}\":{colours:?}"));
    format!("{{{},{}}}", named.join(","), lists.join(","))
}

/// Red, green and blue of a colour such as `#4a78b5`, linear in intensity as glTF wants them, from 0 to 1.
///
/// Source: IEC 61966-2-1 (1999), sRGB.
pub fn linear(colour: &str) -> [f32; 3] {
    [1, 3, 5].map(|at| {
        let part = colour.get(at..at + 2).unwrap_or_default();
        let value = f64::from(u8::from_str_radix(part, 16).unwrap_or_default()) / 255.0;
        let linear = if value <= 0.040_45 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        };
        linear as f32
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_has_six_digits_and_linear_ones_keep_black_and_white() {
        let lists = LISTS.iter().flat_map(|(_, colours)| colours.iter());
        for colour in NAMED.iter().map(|(_, colour)| colour).chain(lists) {
            let digits = colour.strip_prefix('#').expect("a colour");
            assert_eq!(digits.len(), 6);
            assert!(u32::from_str_radix(digits, 16).is_ok());
        }
        assert_eq!(linear("#000000"), [0.0; 3]);
        assert_eq!(linear("#ffffff"), [1.0; 3]);
        assert!((linear("#bcbcbc")[0] - 0.502_9).abs() < 1e-4);
    }
}
