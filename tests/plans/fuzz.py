"""Scenes of many seeds: `fuzz.py --program flexbody --seeds 0:500 --output table.csv`."""

import argparse
import csv
import sys
import tempfile
from pathlib import Path

from judge import Unsettled, judge
from scenes import case

HEADS = ["seed", "kind", "output", "wanted", "score", "told", "seconds", "note"]


def rows_of(seed, folder, program, seconds):
    """One row for each output that counts."""
    one = case(seed)
    try:
        verdicts, took = judge(one, folder, program, seconds)
    except Unsettled as trouble:
        return [[seed, one.kind, "", one.wanted, "", "unsettled reference", "", str(trouble)]]
    return [
        [seed, one.kind, v.name, v.wanted, f"{v.score:.3g}", v.told, f"{took:.1f}", v.note] for v in verdicts
    ]


def summary(rows):
    """Share of kept outputs, and those that are far off without a word."""
    scored = [row for row in rows if row[4] != ""]
    kept = sum(float(row[4]) <= 1 for row in scored)
    silent = [row for row in scored if float(row[4]) > 3 and row[5] in ("no", "plan", "held by plan")]
    return scored, kept, silent


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--seeds", default="0:500", help="first:last, or a list with commas")
    parser.add_argument("--output", default="-")
    parser.add_argument("--folder", help="where scenes are left")
    parser.add_argument("--seconds", type=int, default=60)
    options = parser.parse_args()
    first, _, last = options.seeds.partition(":")
    seeds = range(int(first), int(last)) if last else [int(part) for part in first.split(",")]
    folder = Path(options.folder or tempfile.mkdtemp(prefix="plans-"))
    rows = []
    with sys.stdout if options.output == "-" else open(options.output, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(HEADS)
        for seed in seeds:
            found = rows_of(seed, folder / str(seed), options.program, options.seconds)
            rows += found
            writer.writerows(found)
            file.flush()
        scored, kept, silent = summary(rows)
        print(f"{kept} of {len(scored)} outputs kept; {len(silent)} above 3 without a word", file=sys.stderr)


if __name__ == "__main__":
    main()
