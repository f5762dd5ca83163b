"""The claims that a case may make, checked against an FMU. One function a kind.

A function raises `AssertionError` with what was expected and what was found. A key or a kind that
is not known here is an error as well: a claim that nobody checks must not pass.
"""

import csv
import json
import math

from instance import Instance

# Two times nearer than this, relative to the later, are the same communication point.
SAME_TIME = 1e-9
# Below this relative error the order of convergence drowns in roundoff.
ROUNDOFF = 1e-10
# Steps that a root search may take.
MOST_SECANTS = 40

CASE_KEYS = {"purpose", "source", "scene", "claims"}
COMMON_KEYS = {"kind", "scene", "set", "changes", "note", "no_reference"}


def check_case(case):
    """Refuses a case that says too little or too much."""
    for key in ("purpose", "source"):
        if not isinstance(case.get(key), str) or not case[key].strip():
            raise AssertionError(f"{key}: expected a sentence, found {case.get(key)!r}")
    refuse_unknown("the case", case, CASE_KEYS)
    if not case.get("claims"):
        raise AssertionError("claims: expected at least one, found none")


def check(claim, folder, fmu, case=None):
    """Checks one claim of the case in a folder; other claims of the case may share its run."""
    if claim.get("kind") not in KINDS:
        raise AssertionError(f"kind: expected one of {', '.join(KINDS)}, found {claim.get('kind')!r}")
    function, required, optional = KINDS[claim["kind"]]
    refuse_unknown("the claim", claim, required | optional | COMMON_KEYS)
    missing = required - claim.keys()
    if missing:
        raise AssertionError(f"the claim lacks {', '.join(sorted(missing))}")
    function(claim, folder, fmu, case or {"claims": [claim]})


def series(claim, folder, fmu, case):
    """Columns of a reference agree at every communication point that it has."""
    reference = read_reference(folder / claim["reference"])
    columns = claim["columns"]
    found = recorded(claim, fmu, case)
    allowed = [allowance(claim, [row[column] for row in reference]) for column in columns.values()]
    errors = []
    for row in reference:
        time = next((t for t in found if abs(t - row["t"]) <= SAME_TIME * max(1.0, t)), None)
        if time is None:
            continue
        differences = [value - row[column] for value, column in zip(found[time], columns.values(), strict=True)]
        if claim.get("distance", False):
            errors.append((math.hypot(*differences), max(allowed), time, " and ".join(columns)))
        else:
            errors += [(abs(d), most, time, name) for d, most, name in zip(differences, allowed, columns)]
    if len({time for _, _, time, _ in errors}) < 2:
        raise AssertionError(f"{claim['reference']}: expected at least two communication points of the run")
    for error, most, time, name in errors:
        if not error <= most:
            raise AssertionError(f"{name} at t = {time:g}: {error:.3e} from the reference, allowed {most:.3e}")


def allowance(claim, column):
    """What a column may be off: `relative` is of its largest entry, or of `scale` if that is more."""
    largest = max([claim.get("scale", 0.0), *map(abs, column)])
    return max(claim.get("absolute", 0.0), claim.get("relative", 0.0) * largest)


def values(claim, _folder, fmu, case):
    """Variables have given values at the start or at a time."""
    expected = claim["values"]
    found = list(recorded(claim, fmu, case).values())[-1]
    for (name, wanted), value in zip(expected.items(), found):
        allowed = claim["relative"] * max(claim.get("scale", 0.0), abs(wanted))
        if not abs(value - wanted) <= allowed:
            raise AssertionError(
                f"{name}: expected {wanted!r}, found {value!r}; {abs(value - wanted):.3e} apart, allowed {allowed:.3e}"
            )


def order(claim, _folder, fmu, _case):
    """The error of a variable falls with the order that theory gives."""
    numbers, exact = claim["over"], claim["value"]
    errors = []
    for number in numbers:
        start = {**claim.get("set", {}), claim["vary"]: number}
        (value,) = values_at(fmu, claim, start, [claim["variable"]])
        errors.append(abs(value - exact) / (abs(exact) or 1.0))
    listed = ", ".join(f"{number}: {error:.3e}" for number, error in zip(numbers, errors))
    pairs = [
        math.log(errors[i] / errors[i + 1]) / math.log(numbers[i + 1] / numbers[i])
        for i in range(len(numbers) - 1)
        if min(errors[i], errors[i + 1]) > ROUNDOFF
    ]
    if not pairs:
        raise AssertionError(f"no two errors above roundoff in a row; {listed}")
    low = claim["order"] - claim["within"]
    high = math.inf if claim.get("at_least", False) else claim["order"] + claim["within"]
    if not low <= pairs[-1] <= high:
        raise AssertionError(
            f"expected an order from {low:g} to {high:g}, found {pairs[-1]:.3f}; relative errors {listed}"
        )


def critical(claim, _folder, fmu, _case):
    """A frequency vanishes at a given start value: buckling."""

    def indicator(start):
        changed = {**claim.get("set", {}), claim["vary"]: start}
        (frequency,) = values_at(fmu, claim, changed, [claim["indicator"]])
        # The eigenvalue itself crosses zero smoothly; its signed root does not.
        return frequency * abs(frequency)

    found = vanishing(indicator, *claim["between"], 0.01 * claim["relative"] * abs(claim["value"]))
    if not abs(found - claim["value"]) <= claim["relative"] * abs(claim["value"]):
        raise AssertionError(
            f"{claim['indicator']} vanishes at {claim['vary']} = {found!r}, expected {claim['value']!r}"
            f" to {claim['relative']:g} relative"
        )


def drift(claim, _folder, fmu, case):
    """A sum of variables, less others, keeps the value it has at a time, by default the start."""
    plus, minus, after = claim["sum"], claim.get("less", []), claim.get("after", 0.0)
    if after >= claim["stop_time"]:
        raise AssertionError(f"after: expected a time before {claim['stop_time']:g}, found {after:g}")

    largest, when = 0.0, 0.0
    for time, found in recorded(claim, fmu, case).items():
        total = math.fsum([*found[: len(plus)], *(-value for value in found[len(plus) :])])
        if time <= after * (1.0 + SAME_TIME):
            start = total
            continue
        change = abs(total - start)
        if not change <= largest:
            largest, when = change, time
        if math.isnan(change):
            break  # no later number may hide it
    if not largest <= claim["absolute"]:
        what = " - ".join([" + ".join(plus), *minus])
        raise AssertionError(
            f"{what} drifts by {largest:.3e} (t = {when:g}), allowed {claim['absolute']:g};"
            f" {largest / claim['scale']:.3e} of the scale"
        )


# Kind: function, keys that it needs, keys that it may have.
KINDS = {
    "series": (
        series,
        {"stop_time", "step", "reference", "columns"},
        {"absolute", "relative", "scale", "distance"},
    ),
    "values": (values, {"values", "relative"}, {"time", "step", "scale"}),
    "order": (order, {"vary", "over", "variable", "value", "order", "within"}, {"time", "step", "at_least"}),
    "critical": (critical, {"vary", "between", "indicator", "value", "relative"}, set()),
    "drift": (drift, {"stop_time", "step", "sum", "scale", "absolute"}, {"less", "after"}),
}


def refuse_unknown(place, item, known):
    unknown = item.keys() - known
    if unknown:
        raise AssertionError(
            f"{place}: expected only {', '.join(sorted(known))}, found {', '.join(sorted(unknown))}"
        )


class started:
    """An instance with the claim's start values, ready for steps."""

    def __init__(self, fmu, claim, start=None):
        self.instance = Instance(fmu)
        self.start = claim.get("set", {}) if start is None else start

    def __enter__(self):
        try:
            return self.instance.initialize(self.start)
        except Exception as error:
            error.add_note("\n".join(["the FMU logged:", *self.instance.messages[-5:]]))
            self.instance.__exit__()
            raise

    def __exit__(self, *exception):
        self.instance.__exit__(*exception)


def asked(claim):
    """Names of the variables that a claim asks of its run, and until when."""
    if claim["kind"] == "series":
        return list(claim["columns"]), claim["stop_time"]
    if claim["kind"] == "values":
        return list(claim["values"]), claim.get("time", 0.0)
    return [*claim["sum"], *claim.get("less", [])], claim["stop_time"]


def sharing(claim, case):
    """The claims of a case that the same run decides."""

    def key(claim):
        _, stop_time = asked(claim)
        count = stop_time / claim.get("step", max(1.0, stop_time))
        ragged = abs(count - round(count)) > SAME_TIME * count
        common = [claim.get(name) for name in ("scene", "set", "changes", "step")]
        return json.dumps([case.get("purpose"), *common, stop_time if ragged else None], sort_keys=True)

    def takes_one_run(claim):
        kind = claim.get("kind")
        return kind in ("series", "values", "drift") and KINDS[kind][1] <= claim.keys()

    others = [other for other in case["claims"] if takes_one_run(other)]
    return key(claim), [other for other in others if key(other) == key(claim)]


def recorded(claim, fmu, case):
    """What a claim asks for by communication point, off a run that serves all claims that it can."""
    key, others = sharing(claim, case)
    names, stop_time = asked(claim)
    if key not in fmu.records:
        wanted = [asked(other) for other in others]
        record = Record([name for names, _ in wanted for name in names if name in fmu.variables])
        fmu.records[key] = record
        record.run(fmu, claim, max(stop for _, stop in wanted))
    return fmu.records[key].until(stop_time, [fmu.variable(name).name for name in names])


class Record:
    """Variables at every communication point of a run."""

    def __init__(self, names):
        self.names = list(dict.fromkeys(names))
        self.rows = {}
        self.failure = None

    def run(self, fmu, claim, stop_time):
        try:
            with started(fmu, claim) as instance:
                self.rows[0.0] = instance.get(self.names)
                if stop_time > 0.0:
                    for time in steps(instance, claim, stop_time):
                        self.rows[time] = instance.get(self.names)
        except Exception as error:
            self.failure = error

    def until(self, stop_time, names):
        places = [self.names.index(name) for name in names]
        end = stop_time * (1.0 + SAME_TIME)
        if self.failure is not None and max(self.rows, default=-1.0) < stop_time * (1.0 - SAME_TIME):
            raise self.failure
        return {time: [row[i] for i in places] for time, row in self.rows.items() if time <= end}


def values_at(fmu, claim, start, names):
    """Values of variables at the claim's time, by default the start."""
    with started(fmu, claim, start) as instance:
        if claim.get("time", 0.0) > 0.0:
            for _ in steps(instance, claim, claim["time"]):
                pass
        return instance.get(names)


def steps(instance, claim, stop_time):
    """Communication points up to `stop_time`; after each the claim's changes of inputs that are due."""
    changes = list(claim.get("changes", []))
    for time in instance.steps(stop_time, claim["step"]):
        yield time
        while changes and changes[0]["time"] <= time + SAME_TIME * max(1.0, time):
            instance.set(changes.pop(0)["set"])


def vanishing(function, start, end, tolerance):
    """Where a function that is positive from `start` on falls to zero, by secants through points short of it: beyond,
    what is found in equilibrium is another branch."""
    a, b = start, start + 0.1 * (end - start)
    at_a, at_b, before = function(a), function(b), math.inf
    for _ in range(MOST_SECANTS):
        found = b - at_b * (b - a) / (at_b - at_a)
        if not (at_b > 0.0 and (found - start) * (end - found) >= 0.0):
            raise AssertionError(f"expected a fall to zero, found {at_a:g} at {a:g} and {at_b:g} at {b:g}")
        if abs(found - before) <= tolerance:
            return found
        before, a, at_a = found, b, at_b
        b += 0.9 * (found - b)
        at_b = function(b)
    raise AssertionError(f"expected a fall to zero, found {at_b:g} at {b:g}")


def read_reference(path):
    with path.open(newline="", encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
