"""Draws the charts and writes their page. Pictures, tables and the numbers in sentences come from the CSV files in docs/charts;
what is shown of them from charts.toml, what is said about them from <chart>.md, both beside this file."""

import argparse
import csv
import functools
import math
import tomllib
from pathlib import Path

import jinja2
import pictures
from values import FILTERS, NONE

HERE = Path(__file__).parent
DATA = HERE.parents[1] / "docs" / "charts"
CHARTS = tomllib.loads((HERE / "charts.toml").read_text(encoding="utf-8"))
ENGINE = jinja2.Environment(
    loader=jinja2.FileSystemLoader(HERE), undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
)
ENGINE.filters.update({function.__name__: function for function in FILTERS})


def number(text):
    """What a field of a CSV file is: a number, a text, nothing."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text or None


@functools.cache
def rows_of(name):
    """Rows of a CSV file, each by column."""
    with open(DATA / f"{name}.csv", encoding="utf-8", newline="") as file:
        return [{key: number(field) for key, field in row.items()} for row in csv.DictReader(file)]


@functools.cache
def compiled(expression):
    return ENGINE.compile_expression(expression, undefined_to_none=False)


class Chart:
    """One chart: what charts.toml and its text say, on its data."""

    def __init__(self, name):
        self.name, self.setting = name, CHARTS[name]
        lines = {line.get("is", line["name"]): line["name"] for line in self.setting.get("lines", [])}
        self.names = {**lines, **self.setting.get("names", {})}

    def value(self, expression, variables):
        try:
            return compiled(expression)({"names": self.names, **variables})
        except Exception as error:
            raise ValueError(f"charts.toml, {self.name}: {' '.join(expression.split())}: {error}") from error

    def text(self, template, variables):
        return ENGINE.from_string(template).render({"names": self.names, **variables})

    def rows(self, setting, **known):
        """Rows that a panel or a table is about."""
        rows = rows_of(setting.get("data", self.name))
        rows = [row for row in rows if "where" not in setting or self.value(setting["where"], {**row, **known})]
        return sorted(rows, key=lambda row: self.value(setting["sort"], row)) if "sort" in setting else rows

    def groups(self, rows, key):
        """Values of an expression with their rows, in the order in which they come first; each row by itself without one."""
        found = {}
        for index, row in enumerate(rows):
            found.setdefault(self.value(key, row) if key else index, []).append(row)
        return found

    def pictures(self):
        """Panels by file; a panel that is there for each value of a column is as many, shared out among its files."""
        found = {}
        for setting in self.setting.get("panels", []):
            setting = {"files": [self.name], "each": "none", "by": "none", **self.setting, **setting}
            parts = self.groups(self.rows(setting), setting["each"])
            for index, part in enumerate(parts.values()):
                file = setting["files"][index * len(setting["files"]) // len(parts)]
                titled = {**setting, "title": self.text(setting["title"], part[0])}
                found.setdefault(file, []).append((titled, self.lines(titled, part)))
        return found

    def lines(self, setting, rows):
        """Lines that have points, in the order in which they are listed, or else of the rows."""
        parts = self.groups(rows, setting["by"])
        found = []
        for index, line in enumerate(setting.get("lines") or [{"name": key} for key in parts]):
            own = parts.get(line.get("is", line["name"])) if setting["by"] != "none" else rows
            own = [row for row in own or [] if "where" not in line or self.value(line["where"], row)]
            points = self.points(setting, line, own)
            if points:
                style = {key: self.value(text, own[0]) for key, text in setting.get("style", {}).items()}
                found.append(({"colour": index, "mark": index, **style, **line}, points))
        return found

    def points(self, setting, line, rows):
        """Finite points of a line; those below the floor of an axis are drawn there."""
        thinned = line.get("rows", setting.get("rows"))
        found = []
        for row in self.value(thinned, {"rows": rows}) if thinned else rows:
            row = {**row, "value": self.value(line["value"], row)} if "value" in line else row
            point = [max(self.value(axis["value"], row), axis.get("floor", -math.inf)) for axis in (setting["x"], setting["y"])]
            if all(map(math.isfinite, point)):
                found.append(point)
        return found

    def table(self, name, **known):
        """A table of the page; its expressions know these values."""
        setting = self.setting["tables"][name]
        rows = self.rows(setting, **known)
        parts = self.groups(rows, setting.get("by"))
        columns = [column for listed in setting["columns"] for column in self.columns(listed, rows, known)]
        lines = [[header for header, *_ in columns], ["---"] * len(columns)]
        lines += [[str(cell(key, part)) for _, cell, _ in columns] for key, part in parts.items()]
        if columns[0][2]:
            lines.append([foot(None, rows) for *_, foot in columns])
        return "".join(f"| {' | '.join(line)} |\n" for line in lines)

    def columns(self, listed, rows, known):
        """A listed column as header, cell and foot; one that is there for several values is as many."""
        if isinstance(listed, list):
            listed = dict(zip(("header", "cell", "foot"), listed))
        across = listed.get("across")
        for value in self.groups(rows, across) if across else listed.get("of", [None]):
            extra = {**known, listed.get("as", across) or "_": value}

            def cell(key, part, what="cell", value=value, extra=extra):
                own = self.groups(part, across).get(value, []) if across else part
                return self.value(listed[what], {**own[0], "key": key, "own": own, "group": part, "all": rows, **extra}) if own else NONE

            foot = functools.partial(cell, what="foot") if "foot" in listed else None
            yield self.text(listed["header"], extra), cell, foot

    def section(self):
        """The section of the page."""
        known = {"names": self.names, "rows": rows_of(self.name), "csv": rows_of, "table": self.table}
        return ENGINE.get_template(f"{self.name}.md").render(known).strip() + "\n"


def page():
    """The page of all charts."""
    machines = {row["chart"]: row["machine"] for row in rows_of("machine")}
    for name in CHARTS.keys() - machines:
        raise ValueError(f"machine.csv knows nothing of {name}: measure it by `cargo xtask chart {name}`")
    sections = [(Chart(name).section(), machines[name]) for name in CHARTS]
    return ENGINE.get_template("page.md").render(sections=sections).strip() + "\n"


def draw(names, output):
    """Draws the named charts into a folder, and writes the page of all."""
    for name in names:
        for file, panels in Chart(name).pictures().items():
            pictures.picture(output / f"{file}.svg", panels)
    (output / "README.md").write_text(page(), encoding="utf-8", newline="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("charts", metavar="NAME", nargs="*", help="which to draw [default: all]")
    names = parser.parse_args().charts
    for unknown in set(names) - set(CHARTS):
        parser.error(f"expected a chart of charts.toml ({', '.join(CHARTS)}), found {unknown!r}")
    draw(names or CHARTS, DATA)


if __name__ == "__main__":
    main()
