//! The icon of an FMU, rendered from the drawing of its scene.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use fmu_package::shown;

/// Width and height of an icon in pixels.
const SIZE: u32 = 256;

/// Renders a drawing to a PNG file. Text is not supported: fonts differ from machine to machine.
///
/// # Errors
/// A drawing that is not valid, or a file that cannot be read or written.
pub fn render(drawing: &Path, icon: &Path) -> Result<()> {
    let text = std::fs::read(drawing)
        .with_context(|| format!("cannot read the drawing {}", shown(drawing)))?;
    let tree = Tree::from_data(&text, &Options::default())
        .with_context(|| format!("{} is no drawing", shown(drawing)))?;
    let mut pixmap = Pixmap::new(SIZE, SIZE).ok_or_else(|| anyhow!("no memory for an icon"))?;
    let (width, height) = (tree.size().width(), tree.size().height());
    let scale = SIZE as f32 / width.max(height);
    let margin = |length: f32| (SIZE as f32 - scale * length) / 2.0;
    let centred = Transform::from_scale(scale, scale).post_translate(margin(width), margin(height));
    resvg::render(&tree, centred, &mut pixmap.as_mut());
    let png = pixmap.encode_png().context("cannot encode the icon")?;
    std::fs::write(icon, png).with_context(|| format!("cannot write {}", shown(icon)))
}
