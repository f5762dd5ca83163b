//! Floor 7. How a scene is drawn, for still drawings and for pages that move: its colours ([`palette`]), and the symbols of joints, springs,
//! gears, motions, ports and loads as strokes ([`Stroke`]). Who draws knows strokes and no kinds. Pages are templates ([`filled`]).

mod actions;
mod marks;
pub mod palette;
mod stroke;
pub mod symbols;
mod template;

pub use actions::{KnownAction, known_actions};
pub use marks::{Mark, MarkLabel, marks};
pub use stroke::{
    Arc, Cells, FrameAxes, FramePoints, Radius, Stroke, StrokePoint, StrokeShape, Style,
    symbols_to_json,
};
pub use template::{PlaceValues, filled};
