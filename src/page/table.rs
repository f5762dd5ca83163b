//! Tables of the page.

use super::canvas::escape;

/// A section with a table; nothing where there are no rows.
pub fn table(title: &str, note: &str, heads: &[&str], rows: Vec<String>) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let heads: String = heads
        .iter()
        .map(|head| format!("<th>{head}</th>"))
        .collect();
    let rows = rows.concat();
    format!("<h2>{title}</h2>\n{note}<table>\n<tr>{heads}</tr>\n{rows}</table>\n")
}

/// A row of a table.
pub fn row(cells: &[&str]) -> String {
    let cells: String = cells
        .iter()
        .map(|cell| format!("<td>{cell}</td>"))
        .collect();
    format!("<tr>{cells}</tr>\n")
}

/// A name as it stands in the scene or in the interface.
pub fn code(name: &str) -> String {
    format!("<code>{}</code>", escape(name))
}

/// A row of a table in words; what stands in the scene or in the interface is between backticks.
pub fn worded(cells: &[&str]) -> String {
    let marked = |cell: &&str| {
        let cell = escape(cell);
        let parts = cell.split('`').enumerate().map(|(k, part)| {
            if k % 2 == 1 {
                format!("<code>{part}</code>")
            } else {
                part.into()
            }
        });
        parts.collect()
    };
    let cells: Vec<String> = cells.iter().map(marked).collect();
    row(&cells.iter().map(String::as_str).collect::<Vec<_>>())
}
