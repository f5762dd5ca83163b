//! Floor 7 (`ARCHITECTURE.md`). How a scene is drawn, for still drawings and for pages that move: its colours ([`palette`]), and the symbols
//! of joints, springs, gears, motions, ports and loads as strokes ([`Stroke`]). Code that draws sees strokes only, never kinds of joints or
//! loads. [`Skin`] is the surface of a reduced body. HTML pages are templates that [`filled`] fills in.

mod actions;
mod marks;
pub mod palette;
mod skin;
mod stroke;
pub mod symbols;
mod template;

pub use actions::{KnownAction, known_actions};
pub use marks::{Mark, MarkLabel, marks};
pub use skin::Skin;
pub use stroke::{
    Arc, Cells, FrameAxes, FramePoints, Radius, Stroke, StrokePoint, StrokeShape, Style,
    symbols_to_json,
};
pub use template::{PlaceValues, filled};
