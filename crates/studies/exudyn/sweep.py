"""Finds the best settings of Exudyn for each scene of settings.json and writes them there: the points that no
other tried point beats in both error and CPU time. `sweep.py [--levels] [SCENE ...]`; run from any directory; takes
about half an hour. The chart times what is found anew.

First every family of solvers on every mesh with steps that halve; then, for each point on the frontier, every
other choice of each setting, as long as one helps; then the same around the errors that the chart compares at, with
meshes and steps between: nothing is to be lost because no point lies just below. `--levels` does the last part alone,
from the points of settings.json on, in a quarter of an hour."""

import argparse
import itertools
import json
import math
import pathlib
import sys

import run as peer

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parent.parent
SETTINGS = HERE / "settings.json"
# A run longer than this is not tried, s.
LONGEST = 5.0
# Points slower than this get fewer variations, s.
SLOW = 0.6
# Points of a scene that are kept.
KEPT = 12
# Errors that the chart compares at, how many points above and below each are varied, and how often.
LEVELS = [1e-2, 1e-3, 1e-4]
AROUND, TURNS = 2, 4
# Multiples of steps and of elements.
STEPS, MESHES = (0.7, 0.8, 0.9, 1.1, 1.2, 1.4), (0.7, 0.85, 1.2)
IMPLICIT = [{"solver": "alpha"}, {"solver": "newmark"}]
EXPLICIT = [{"solver": "verlet"}, {"solver": "rk4"}]
# Pins of explicit runs as heavy nodes: see `Model.joint`.
HEAVY = [{**family, "heavy": 1e9} for family in EXPLICIT]
# Rigid bodies in the place of cables.
RIGID = [{**family, "rigid": True, "elements": 0, "linear": "dense"} for family in IMPLICIT]
# What makes models of their own, compared apart; without are cables held by joints.
APART = (None, "heavy", "rigid")
CHOICES = {
    "newton": ["modified", "full"],
    "newton_tolerance": [1e-2, 1e-3, 1e-4, 1e-6, 1e-8],
    "newton_absolute": [1e-10, 1e-7, 1e-4],
    "contractivity": [0.2, 0.5, 0.8],
    "restart": [4, 7, 15],
    "every_step": [False, True],
    "loads_jacobian": [0, 1],
    "linear": ["sparse", "dense"],
    "integration": [0, 1, 2],
    "rho": [1.0, 0.9, 0.7, 0.5],
    "solver": ["alpha", "newmark"],
}
# What explicit solvers have of these, and what slow runs are tried with.
FEW = {"integration": [0, 1, 2]}
SOME = {name: CHOICES[name] for name in ("newton", "newton_tolerance", "integration", "rho", "solver")}


def apart(choice):
    """The model of its own that a choice has."""
    return next((key for key in APART if key in choice), None)


class Sweep:
    """All runs of a scene."""

    def __init__(self, name, case):
        self.name, self.case = name, case
        # Kept among the products, so that a sweep goes on where it was stopped.
        self.cache = ROOT / "target" / "exudyn" / f"{name}.json"
        self.cache.parent.mkdir(parents=True, exist_ok=True)
        self.tried = json.loads(self.cache.read_text(encoding="utf-8")) if self.cache.exists() else {}
        reference = (ROOT / case["reference"]).read_text(encoding="utf-8").split()
        rows = [[float(cell) for cell in row.split(",")] for row in reference[1:]]
        self.reference = {round(row[0], 6): row[1:] for row in rows}

    def run(self, choice):
        """Error divided by the length, and CPU time; None where the run failed."""
        key = json.dumps(choice, sort_keys=True)
        if key not in self.tried:
            self.tried[key] = self.measure(choice)
            self.cache.write_text(json.dumps(self.tried), encoding="utf-8")
        return self.tried[key]

    def measure(self, choice):
        options = {key: self.case[key] for key in ("marker", "stop_time", "every", "shares") if key in self.case}
        options = {**options, **self.case.get("options", {}), **choice, "scene": str(ROOT / self.case["scene"])}
        try:
            answer = peer.run(options)
        except Exception:
            return None
        if not answer["good"] or len(answer["path"]) != round(options["stop_time"] / options["every"]) + 1:
            return None
        error = 0.0
        for at_time, *place in answer["path"]:
            at = self.reference[round(at_time, 6)]
            distance = math.dist(place, at[: len(place)]) / self.case["length"]
            # An unstable run ends in what is no number, which no comparison sees.
            error = max(error, distance if math.isfinite(distance) else 1e9)
        if not error < 0.3:
            return None
        return error, answer["cpu_time"]

    def families(self):
        """Every family on every mesh, steps halving until the mesh's error is reached or others are far ahead."""
        for elements in self.case["meshes"]:
            for family in IMPLICIT:
                self.halve({**family, "elements": elements}, self.case["largest_step"], 2.0)
            explicit = EXPLICIT if "wave" in self.case else []
            for family in explicit + (HEAVY if explicit and self.case.get("pinned") else []):
                # The limit of velocity Verlet with a consistent mass; of RK4 it is 1.41 times that.
                axial, bending = self.case["wave"]
                cell = self.case["length"] / elements
                limit = min(0.2095 * cell / axial, 0.0334 * cell**2 / bending if bending else 1e9)
                self.halve({**family, "elements": elements}, limit * (1.5 if family["solver"] == "rk4" else 1.05), 1.4)
            print(self.name, elements, "elements,", len(self.tried), "runs", flush=True)

    def halve(self, family, step, factor):
        """Runs with ever smaller steps."""
        multiple = round(self.case["stop_time"] / self.case["every"])
        steps, last, idle, failed = self.case["stop_time"] / step, None, 0, 0
        for _ in range(16):
            steps = multiple * math.ceil(steps / multiple)
            found = self.run({**family, "step": self.case["stop_time"] / steps})
            steps *= factor
            if not found:
                # Newton fails at large steps, an explicit method beyond its limit; small ones are not better then.
                failed += 1
                if failed > (6 if family["solver"] in ("alpha", "newmark") else 2):
                    return
            elif last and found[0] > 0.8 * last:
                idle += 1
            # Only an explicit method, which starts at its limit, is given up where others are far ahead.
            explicit = family["solver"] not in ("alpha", "newmark")
            points = self.frontier(apart(family)) if found and explicit else []
            ahead = any(point[1] < found[0] and point[0] < 0.2 * found[1] for point in points)
            if idle > 2 or ahead or (found and found[1] * factor > LONGEST):
                return
            last = found[0] if found else None

    def frontier(self, model=None):
        """What nothing beats, from loose to tight, of cables held by joints and of this model."""
        good = [(value[1], value[0], json.loads(key)) for key, value in self.tried.items() if value]
        best = []
        for cpu, error, choice in sorted(good, key=lambda point: point[:2]):
            last = best[-1][1] if best else math.inf
            is_better = error < 0.9 * last or any(error <= level < last for level in LEVELS)
            if apart(choice) in (None, model) and is_better:
                best.append((cpu, error, choice))
        return best

    def refine(self):
        """Other settings for each point of the frontier, and steps between."""
        known = set()
        for _ in range(3):
            all_points = [point for model in APART for point in self.frontier(model)]
            points = [point for point in all_points if json.dumps(point[2], sort_keys=True) not in known]
            for cpu, _, choice in points:
                known.add(json.dumps(choice, sort_keys=True))
                self.vary(cpu, choice)
            print(self.name, "frontier of", len(self.frontier()), "points,", len(self.tried), "runs", flush=True)

    def vary(self, cpu, choice):
        """Every other choice of each setting, and steps between."""
        explicit = choice["solver"] not in ("alpha", "newmark")
        for setting, values in (FEW if explicit else SOME if cpu > SLOW else CHOICES).items():
            for value in values:
                if setting == "linear" and value == "dense" and choice["elements"] > 16:
                    continue
                self.run({**choice, setting: value})
        multiple = round(self.case["stop_time"] / self.case["every"])
        for factor in STEPS:
            steps = multiple * round(self.case["stop_time"] / choice["step"] * factor / multiple)
            if steps:
                self.run({**choice, "step": self.case["stop_time"] / steps})

    def levels(self):
        """Varies what is nearest to each error that the chart compares at, meshes too."""
        for point in self.case.get("points", []):
            self.run({key: value for key, value in point.items() if key not in ("error", "cpu_time")})
        for family in RIGID if self.case.get("rigid") else []:
            self.halve(family, self.case["largest_step"], 1.4)
        known = set()
        for level, model, _ in itertools.product(LEVELS, APART, range(TURNS)):
            points = self.frontier(model)
            loose = [point for point in points if point[1] > level][-AROUND:]
            for cpu, _, choice in loose + [point for point in points if point[1] <= level][:AROUND]:
                key = json.dumps(choice, sort_keys=True)
                if key in known or apart(choice) != model:
                    continue
                known.add(key)
                self.vary(cpu, choice)
                count = choice["elements"]
                for other in [max(round(count * factor), 1) for factor in MESHES] + [count + 1] if count else []:
                    self.run({**choice, "elements": other})
            print(self.name, "at", level, len(self.tried), "runs", flush=True)

    def kept(self):
        """All frontiers, thinned where points lie close and are not the cheapest that keep one of the levels."""
        rows = []
        for model in APART:
            points = [point for point in self.frontier(model) if point[1] < 0.05]
            while len(points) > KEPT:
                best = [next((point for point in points if point[1] <= level), None) for level in LEVELS]
                inner = zip(points, points[1:], points[2:])
                gaps = [math.inf if b in best else math.log(a[1] / c[1]) for a, b, c in inner]
                points.pop(1 + gaps.index(min(gaps)))
            rows += [point for point in points if apart(point[2]) == model]
        digits = lambda value: float(f"{value:.3g}")
        return [{**choice, "error": digits(error), "cpu_time": digits(cpu)} for cpu, error, choice in rows]


def main():
    peer.exu.config.printToConsole = False
    cases = json.loads(SETTINGS.read_text(encoding="utf-8"))
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", metavar="SCENE", nargs="*")
    parser.add_argument("--levels", action="store_true", help="around the errors of the chart alone")
    arguments = parser.parse_args()
    for name in arguments.scenes or list(cases):
        sweep = Sweep(name, cases[name])
        before = cases[name]["runs"] - len(sweep.tried) if arguments.levels else 0
        if not arguments.levels:
            sweep.families()
            sweep.refine()
        sweep.levels()
        # Other scenes may have been swept meanwhile.
        cases = json.loads(SETTINGS.read_text(encoding="utf-8"))
        cases[name]["points"] = sweep.kept()
        cases[name]["runs"] = before + len(sweep.tried)
        SETTINGS.write_text(dump(cases), encoding="utf-8")
        for point in sweep.kept():
            print(json.dumps(point))


def dump(cases):
    """JSON with a line a point."""
    blocks = []
    for name, case in cases.items():
        lines = [f"    {json.dumps(key)}: {json.dumps(value)}" for key, value in case.items() if key != "points"]
        points = ",\n".join(f"      {json.dumps(point)}" for point in case.get("points", []))
        lines.append(f'    "points": [\n{points}\n    ]')
        blocks.append(f"  {json.dumps(name)}: {{\n" + ",\n".join(lines) + "\n  }")
    return "{\n" + ",\n".join(blocks) + "\n}\n"


if __name__ == "__main__":
    main()
