//! The picture as HTML.

use super::bundle::{LICENSE, STYLE, bundle};
use super::header::header;
use super::recording::Recording;
use super::table::OutputTable;
use crate::picture::palette;

/// Unpacks the program and starts it: no module, so that a page does the same from a disk.
const START: &str = "(async () => {\n\
    const view = document.querySelector('.flexbody-view');\n\
    try {\n\
    const packed = Uint8Array.from(atob(view.querySelector('script.program').textContent), (c) => c.charCodeAt(0));\n\
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));\n\
    const script = document.createElement('script');\n\
    script.textContent = await new Response(stream).text();\n\
    document.body.append(script);\n\
    } catch (error) {\n\
    view.querySelector('.fallback p').textContent = 'This browser cannot show the moving picture: ' + error;\n\
    }\n\
    })();\n";

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
    format!(
        "<div class=\"flexbody-view\">\n<style>\n{STYLE}</style>\n<!-- The program holds parts of three.js.\n{LICENSE}-->\n\
         <div class=\"fallback\"><p>The picture moves where scripts may run.</p>\n{still}</div>\n\
         <script type=\"application/json\" class=\"header\">{header}</script>\n\
         <script type=\"text/plain\" class=\"numbers\">{numbers}</script>\n\
         <script type=\"text/plain\" class=\"program\">\n{program}</script>\n\
         <script>\n{START}</script>\n</div>\n"
    )
}

/// A page that is nothing but a picture; texts are HTML.
pub fn document(title: &str, note: &str, picture: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n<style>\n{}\
         html, body {{ height: 100%; margin: 0; background: var(--paper); color: var(--ink); font: 14px/1.45 system-ui, sans-serif; }}\n\
         body {{ display: flex; flex-direction: column; }}\n\
         header {{ display: flex; align-items: baseline; flex-wrap: wrap; gap: 0 1rem; padding: .5rem .8rem; border-bottom: 1px solid var(--rule); }}\n\
         h1 {{ font-size: 1.1rem; font-weight: 600; margin: 0; }}\n\
         header p {{ margin: 0; color: var(--number); }}\n\
         .flexbody-view {{ flex: 1; min-height: 0; }}\n\
         </style>\n</head>\n<body>\n<header><h1>{title}</h1><p>{note}</p></header>\n{picture}</body>\n</html>\n",
        palette::style_sheet()
    )
}
