//! Floor 9. What a scene looks like on paper: its drawing, and the page that comes with a unit. The words of
//! a standard are given to the page ([`Interface`]); nothing else of FMI is known here.

mod canvas;
mod documentation;
mod drawing;
mod moving;
mod parts;
mod plan;
mod table;

pub use documentation::{Interface, documentation};
pub use drawing::{drawing, icon};
pub use moving::{motion, moving, moving_table};
