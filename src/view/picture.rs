//! The picture as HTML.

use super::bundle::{LICENSE, STYLE, bundle};
use super::header::header;
use super::recording::Recording;
use super::table::OutputTable;
use crate::picture::{filled, palette};

/// The picture as an element of a page: style, still picture, data and program. The last script unpacks the program and starts it. It is no
/// module, so that a page does the same from a disk.
const ELEMENT: &str = include_str!("element.html");
/// A page that is nothing but a picture.
const DOCUMENT: &str = include_str!("document.html");

/// A picture that moves, as an element of HTML with all that it needs; a still one takes its place where a browser cannot show it.
pub fn picture(recording: &Recording, still: &str) -> String {
    let (header, numbers) = header(recording);
    element(&header, &numbers, still)
}

/// Writes a page of a table of outputs: markers as points, and curves.
pub fn picture_of_table(table: &OutputTable, title: &str) -> String {
    let (header, numbers) = table.header(title);
    element(&header, &numbers, "")
}

fn element(header: &str, numbers: &str, still: &str) -> String {
    let (_, program) = bundle();
    let values = [
        ("style", STYLE),
        ("license", LICENSE),
        ("still", still),
        ("header", header),
        ("numbers", numbers),
        ("program", program),
    ];
    filled(ELEMENT, &values.map(|(name, text)| (name, text.into())))
}

/// Writes a page that is nothing but a picture. Texts are HTML.
pub fn document(title: &str, note: &str, picture: &str) -> String {
    let values = [
        ("title", title.into()),
        ("palette", palette::style_sheet()),
        ("note", note.into()),
        ("picture", picture.into()),
    ];
    filled(DOCUMENT, &values)
}
