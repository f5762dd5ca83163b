"""A preprocessor of mdBook: equations in `$…$` and `$$…$$` become MathML; pictures from outside the
book are put into its pages; links that lead outside it become the paths of files in the repository."""

import base64
import json
import mimetypes
import re
import sys
from pathlib import Path
from urllib.parse import quote

SOURCE = Path(__file__).resolve().parent / "src"
ROOT = SOURCE.parents[2]
# What is code stays as it is.
CODE = re.compile(r"(^```.*?^```|`[^`\n]+`)", re.DOTALL | re.MULTILINE)
BLOCK = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
INLINE = re.compile(r"\$([^$\n]+)\$")
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")


def prepared(text, page):
    """The text of a page, with `page` its path below the sources."""
    parts = CODE.split(text)
    return "".join(part if number % 2 else formulas(links(part, page)) for number, part in enumerate(parts))


def formulas(text):
    from latex2mathml.converter import convert

    # A line of its own would end a paragraph of HTML.
    text = BLOCK.sub(lambda m: "\n\n" + convert(m[1].strip(), display="block") + "\n\n", text)
    return INLINE.sub(lambda m: convert(m[1]), text)


def links(text, page):
    folder = (SOURCE / page).parent

    def one(match):
        picture, words, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        file = (folder / target.split("#")[0]).resolve()
        if file.is_relative_to(SOURCE):
            return match[0]
        if picture:
            kind = mimetypes.guess_type(file.name)[0]
            return f'<img alt="{words}" src="data:{kind};base64,{quote(base64.b64encode(file.read_bytes()), safe="+/=")}">'
        path = file.relative_to(ROOT).as_posix()
        return f"`{path}`" if words == path else f"{words} (`{path}`)"

    return LINK.sub(one, text)


def chapters(items):
    for item in items:
        chapter = item.get("Chapter") if isinstance(item, dict) else None
        if chapter:
            yield chapter
            yield from chapters(chapter["sub_items"])


if __name__ == "__main__":
    if sys.argv[1:2] == ["supports"]:
        sys.exit(0 if sys.argv[2] == "html" else 1)
    _, book = json.load(sys.stdin)
    for chapter in chapters(book.get("items") or book.get("sections")):
        if chapter["path"]:
            chapter["content"] = prepared(chapter["content"], chapter["path"])
    json.dump(book, sys.stdout)
