"""Rules of FMI 2.0 for modelDescription.xml and terminalsAndIcons.xml, written from the standard.

They read an FMU and nothing else of the project. Numbers in brackets are sections of FMI 2.0.5. A rule is a
function that takes a `Description` and yields what is wrong; its name is the name of the rule.
"""

import math
import re
from collections import Counter, defaultdict
from datetime import datetime

ORDER = """
    ModelExchange CoSimulation UnitDefinitions TypeDefinitions LogCategories DefaultExperiment
    VendorAnnotations ModelVariables ModelStructure
""".split()
# Exponents of kg, m, s, A, K, mol, cd, rad.
BASES = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
UNITS = {
    **{name: tuple(int(name == base) for base in BASES) for name in BASES},
    "1": (0, 0, 0, 0, 0, 0, 0, 0),
    "N": (1, 1, -2, 0, 0, 0, 0, 0),
    "Pa": (1, -1, -2, 0, 0, 0, 0, 0),
    "J": (1, 2, -2, 0, 0, 0, 0, 0),
    "W": (1, 2, -3, 0, 0, 0, 0, 0),
    "Hz": (0, 0, -1, 0, 0, 0, 0, 0),
}
SETTABLE, COMPUTED = {"exact", "approx"}, {"calculated", "approx"}
ANY = SETTABLE | COMPUTED
# Values that `initial` may have, and what it is where it is not given [2.2.7].
INITIAL = {
    **{("parameter", v): ({"exact"}, "exact") for v in ("fixed", "tunable")},
    **{("calculatedParameter", v): (COMPUTED, "calculated") for v in ("fixed", "tunable")},
    **{("input", v): (set(), None) for v in ("discrete", "continuous")},
    **{(c, "constant"): ({"exact"}, "exact") for c in ("output", "local")},
    **{(c, v): (ANY, "calculated") for c in ("output", "local") for v in ("discrete", "continuous")},
    **{("local", v): (COMPUTED, "calculated") for v in ("fixed", "tunable")},
    ("independent", "continuous"): (set(), None),
}
TYPES = ("Real", "Integer", "Boolean", "String", "Enumeration")
WORD = r"(?:[A-Za-z_]\w*|'(?:[^'\\]|\\.)+')"
IDENTIFIER = rf"{WORD}(?:\[\d+(?:,\d+)*\])?(?:\.{WORD}(?:\[\d+(?:,\d+)*\])?)*"
NAME = re.compile(rf"(?:{IDENTIFIER}|der\({IDENTIFIER}(?:,\d+)?\))", re.ASCII)


class Scalar:
    """A ScalarVariable with its defaults filled in; `index` counts from 1, as ModelStructure does."""

    def __init__(self, index, element):
        self.index = index
        self.name = element.get("name", "")
        kinds = [child for child in element if child.tag in TYPES]
        self.typed = kinds[0] if kinds else element
        self.type = self.typed.tag
        self.reference = element.get("valueReference")
        self.causality = element.get("causality", "local")
        self.variability = element.get("variability", "continuous" if self.type == "Real" else "discrete")
        self.given = element.get("initial")
        allowed = INITIAL.get((self.causality, self.variability))
        self.initial = self.given or (allowed and allowed[1])
        self.start = self.typed.get("start")
        self.derivative = self.typed.get("derivative")


class Description:
    """A parsed model description and, where there is one, the parsed terminals."""

    def __init__(self, root, terminals=None):
        self.root = root
        self.terminals = terminals
        self.slave = root.find("CoSimulation")
        elements = root.findall("ModelVariables/ScalarVariable")
        self.scalars = [Scalar(index, element) for index, element in enumerate(elements, start=1)]

    def unknowns(self, part):
        return self.root.findall(f"ModelStructure/{part}/Unknown")

    def listed(self, part):
        return [int(unknown.get("index")) for unknown in self.unknowns(part)]

    def scalar(self, index):
        return self.scalars[index - 1] if 1 <= index <= len(self.scalars) else None

    def states(self):
        """Indices of what the entries of Derivatives are derivatives of."""
        found = [self.scalar(index) for index in self.listed("Derivatives")]
        return {int(scalar.derivative) for scalar in found if scalar is not None and scalar.derivative}


def header(md):
    """Version, names, time stamp [2.2.1]."""
    for name, form in (
        ("fmiVersion", r"2\.0"),
        ("modelName", r".*\S.*"),
        ("guid", r"\S+"),
        ("generationDateAndTime", r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ"),
    ):
        found = md.root.get(name)
        if found is None and name == "generationDateAndTime":
            continue
        if not re.fullmatch(form, found or ""):
            yield f"{name} is {found!r}"
        elif name == "generationDateAndTime":
            try:
                datetime.strptime(found, "%Y-%m-%dT%H:%M:%SZ")
            except ValueError as error:
                yield f"{name}: {error}"


def order_of_elements(md):
    """[2.2.1]"""
    tags = [child.tag for child in md.root]
    places = [ORDER.index(tag) if tag in ORDER else -1 for tag in tags]
    if places != sorted(set(places)) or -1 in places:
        yield f"elements are {' '.join(tags)}"
    if "ModelVariables" not in tags or "ModelStructure" not in tags:
        yield "ModelVariables or ModelStructure is missing"


def flags(md):
    """Capabilities that contradict each other [4.3.1]."""
    if md.slave is None:
        yield "no CoSimulation"
        return
    if not re.fullmatch(r"[A-Za-z_]\w*", md.slave.get("modelIdentifier", ""), re.ASCII):
        yield f"modelIdentifier {md.slave.get('modelIdentifier')!r} is no C identifier"
    is_true = {name for name, value in md.slave.attrib.items() if value in ("true", "1")}
    if "canSerializeFMUstate" in is_true and "canGetAndSetFMUstate" not in is_true:
        yield "canSerializeFMUstate without canGetAndSetFMUstate"


def units(md):
    """Declared once, in base units that fit the name, and referred to [2.2.2]."""
    declared = md.root.findall("UnitDefinitions/Unit")
    names = [unit.get("name") for unit in declared]
    yield from (f"unit {name} is declared {n} times" for name, n in Counter(names).items() if n > 1)
    exponents = {}
    for unit in declared:
        name, base = unit.get("name"), unit.find("BaseUnit")
        if base is None:
            yield f"unit {name} has no BaseUnit"
            continue
        exponents[name] = tuple(int(base.get(b, "0")) for b in BASES)
        if exponents[name] != exponents_of(name):
            yield f"unit {name} is declared with {dict(base.attrib)}"
        if float(base.get("factor", "1")) != 1.0 or float(base.get("offset", "0")) != 0.0:
            yield f"unit {name} is not in SI"
        shown = [display.get("name") for display in unit.findall("DisplayUnit")]
        yield from (f"display unit {s} of {name} comes twice" for s, n in Counter(shown).items() if n > 1)
    displays = {unit.get("name"): {d.get("name") for d in unit.findall("DisplayUnit")} for unit in declared}
    for scalar in md.scalars:
        unit, display = scalar.typed.get("unit"), scalar.typed.get("displayUnit")
        if unit is not None and unit not in displays:
            yield f"{scalar.name}: unit {unit} is not declared"
        if display is not None and display not in displays.get(unit, ()):
            yield f"{scalar.name}: display unit {display} is not one of {unit}"
    yield from units_of_derivatives(md, exponents)


def units_of_derivatives(md, exponents):
    per_second = exponents_of("1/s")
    for scalar in md.scalars:
        state = md.scalar(int(scalar.derivative)) if scalar.derivative else None
        pair = [exponents.get(s.typed.get("unit")) for s in (state, scalar) if s is not None]
        if len(pair) == 2 and None not in pair:
            if tuple(a + b for a, b in zip(pair[0], per_second)) != pair[1]:
                yield f"{scalar.name} is not in the unit of {state.name} per second"


def exponents_of(name):
    """Exponents of a unit by its name, such as `N.m/rad` or `m/s2`; None where a part is not known."""
    total, sign = [0] * len(BASES), 1
    for separator, part in re.findall(r"([./]|^)([^./]+)", name):
        sign = -1 if separator == "/" else sign
        found = re.fullmatch(r"([A-Za-z]+|1)(-?\d+)?", part)
        if found is None or found[1] not in UNITS:
            return None
        total = [t + sign * int(found[2] or "1") * e for t, e in zip(total, UNITS[found[1]])]
    return tuple(total)


def names(md):
    """Unique, structured, arrays without gaps [2.2.9]."""
    counted = Counter(scalar.name for scalar in md.scalars)
    yield from (f"{name} comes {n} times" for name, n in counted.items() if n > 1)
    if md.root.get("variableNamingConvention") != "structured":
        return
    arrays = defaultdict(set)
    for name in counted:
        if not NAME.fullmatch(name):
            yield f"{name} is no structured name"
        indices = tuple(int(i) for group in re.findall(r"\[([\d,]+)\]", name) for i in group.split(","))
        arrays[re.sub(r"\[[\d,]+\]", "[]", name)].add(indices)
        if indices and name.split("[")[0] in counted:
            yield f"{name} and {name.split('[')[0]} are both there"
    for name, found in arrays.items():
        if len({len(indices) for indices in found}) > 1:
            yield f"{name} has different numbers of indices"
            continue
        sizes = [(min(column), max(column)) for column in zip(*found)]
        if any(low > 1 for low, _ in sizes):
            yield f"{name} starts at neither 0 nor 1"
        if len(found) != math.prod(high - low + 1 for low, high in sizes):
            yield f"{name} has gaps: {sorted(found)}"


def value_references(md):
    """Unique by type, or aliases of which at most one can be set [2.2.7]."""
    groups = defaultdict(list)
    for scalar in md.scalars:
        groups["Integer" if scalar.type == "Enumeration" else scalar.type, scalar.reference].append(scalar)
    for (kind, reference), aliases in groups.items():
        told = f"{kind} {reference}: {', '.join(scalar.name for scalar in aliases)}"
        if not (reference or "").isdigit() or int(reference) >= 2**32:
            yield f"{told}: no value reference"
        if len(aliases) == 1:
            continue
        if sum(scalar.start is not None for scalar in aliases) > 1:
            yield f"{told}: more than one has a start"
        if len({scalar.typed.get("unit") for scalar in aliases}) > 1:
            yield f"{told}: different units"
        if len({scalar.variability == "constant" for scalar in aliases}) > 1:
            yield f"{told}: only some are constant"
        if sum(scalar.causality in ("parameter", "input", "independent") for scalar in aliases) > 1:
            yield f"{told}: more than one can be set"


def causalities(md):
    """Combinations of causality, variability and initial, and the start that they ask for [2.2.7]."""
    for scalar in md.scalars:
        combination = (scalar.causality, scalar.variability)
        if combination not in INITIAL:
            yield f"{scalar.name}: {' '.join(combination)} is not allowed"
            continue
        allowed, _ = INITIAL[combination]
        if scalar.given is not None and scalar.given not in allowed:
            yield f"{scalar.name}: initial {scalar.given} is not allowed for {' '.join(combination)}"
        if scalar.variability == "continuous" and scalar.type != "Real":
            yield f"{scalar.name}: {scalar.type} cannot be continuous"
        wanted = scalar.initial in SETTABLE or scalar.causality == "input"
        if wanted != (scalar.start is not None):
            yield f"{scalar.name}: start {'is missing' if wanted else 'must not be given'}"
    independent = [scalar for scalar in md.scalars if scalar.causality == "independent"]
    if len(independent) > 1 or any(scalar.type != "Real" for scalar in independent):
        yield "more than one independent variable, or one that is not Real"


def numbers(md):
    """Start, min, max and nominal are numbers that fit each other [2.2.3, 2.2.7]."""
    for scalar in md.scalars:
        if scalar.type not in ("Real", "Integer", "Enumeration"):
            continue
        given = {}
        for name in ("min", "max", "start", "nominal"):
            text = scalar.typed.get(name)
            if text is None:
                continue
            try:
                given[name] = float(text) if scalar.type == "Real" else int(text)
            except ValueError:
                given[name] = math.nan
            if not math.isfinite(given[name]):
                yield f"{scalar.name}: {name} is {text}"
        low, high = given.get("min", -math.inf), given.get("max", math.inf)
        if low > high:
            yield f"{scalar.name}: min {low} is above max {high}"
        if "start" in given and (given["start"] < low or given["start"] > high):
            yield f"{scalar.name}: start {given['start']} is outside {low} to {high}"
        if given.get("nominal", 1.0) <= 0.0:
            yield f"{scalar.name}: nominal is {given['nominal']}"


def derivatives(md):
    """`derivative` names another continuous Real, and the variable is listed in Derivatives [2.2.7, 2.2.8]."""
    listed = md.listed("Derivatives")
    for scalar in md.scalars:
        if scalar.derivative is None:
            continue
        state = md.scalar(int(scalar.derivative))
        if state is None or state is scalar or (state.type, state.variability) != ("Real", "continuous"):
            yield f"{scalar.name}: derivative of {scalar.derivative}, which is no other continuous Real"
        if scalar.index not in listed:
            yield f"{scalar.name} is not listed in Derivatives"
    for index in listed:
        scalar = md.scalar(index)
        if scalar is None or scalar.derivative is None:
            yield f"Derivatives lists {index}, which is a derivative of nothing"


def outputs(md):
    """Every output, once, in order [2.2.8]."""
    expected = [scalar.index for scalar in md.scalars if scalar.causality == "output"]
    if md.listed("Outputs") != expected:
        yield f"Outputs lists {md.listed('Outputs')}, expected {expected}"


def initial_unknowns(md):
    """Everything that is computed at the start, in order [2.2.8]."""
    rates = set(md.listed("Derivatives")) | md.states()
    expected = [
        scalar.index
        for scalar in md.scalars
        if scalar.causality == "calculatedParameter"
        or (scalar.causality == "output" or scalar.index in rates)
        and scalar.initial in COMPUTED
    ]
    if md.listed("InitialUnknowns") != expected:
        yield f"InitialUnknowns lists {md.listed('InitialUnknowns')}, expected {expected}"


def dependencies(md):
    """Ascending indices of variables that may be known, with as many kinds [2.2.8]."""
    states = md.states()
    for part in ("Outputs", "Derivatives", "InitialUnknowns"):
        for unknown in md.unknowns(part):
            told = f"{part} {unknown.get('index')}"
            indices = [int(index) for index in unknown.get("dependencies", "").split()]
            if indices != sorted(set(indices)):
                yield f"{told}: dependencies are not ascending: {indices}"
            if int(unknown.get("index")) in indices:
                yield f"{told} depends on itself"
            for index in indices:
                known = md.scalar(index)
                if known is None:
                    yield f"{told}: there is no variable {index}"
                elif not is_known(known, part, states):
                    yield f"{told}: {known.name} is not known there"
            yield from kinds_of(unknown, part, told, len(indices))


def is_known(scalar, part, states):
    if scalar.causality in ("input", "independent"):
        return True
    if part == "InitialUnknowns":
        return scalar.initial == "exact"
    return scalar.index in states


def kinds_of(unknown, part, told, count):
    kinds = unknown.get("dependenciesKind")
    if kinds is None:
        return
    if unknown.get("dependencies") is None or len(kinds.split()) != count:
        yield f"{told}: as many kinds as dependencies are expected"
    allowed = {"dependent", "constant"}
    if part != "InitialUnknowns":
        allowed |= {"fixed", "tunable", "discrete"}
    if not set(kinds.split()) <= allowed:
        yield f"{told}: kinds are {kinds}"


def experiment(md):
    """A default experiment that can be run [2.2.5]."""
    found = md.root.find("DefaultExperiment")
    if found is None:
        return
    value = {name: float(text) for name, text in found.attrib.items()}
    if not all(map(math.isfinite, value.values())):
        yield f"DefaultExperiment {dict(found.attrib)}"
    if not value.get("startTime", 0.0) < value.get("stopTime", math.inf):
        yield "stopTime is not after startTime"
    yield from (f"{n} is {value[n]}" for n in ("tolerance", "stepSize") if value.get(n, 1.0) <= 0.0)


def log_categories(md):
    """Named once [2.2.4]."""
    found = Counter(item.get("name") for item in md.root.findall("LogCategories/Category"))
    yield from (f"log category {name} comes {n} times" for name, n in found.items() if n > 1)


def terminals(md):
    """Terminals name variables that exist, each member once (FMI 3.0 section 2.4.9, by FMI 2.0.4 [2.3])."""
    if md.terminals is None:
        return
    known = {scalar.name for scalar in md.scalars}
    groups = [md.terminals.findall("Terminals/Terminal")]
    while groups:
        group = groups.pop()
        counted = Counter(terminal.get("name") for terminal in group)
        yield from (f"terminal {name} comes {n} times" for name, n in counted.items() if n > 1)
        for terminal in group:
            told = f"terminal {terminal.get('name')}"
            groups.append(terminal.findall("Terminal"))
            members = terminal.findall("TerminalMemberVariable")
            for member in members:
                if member.get("variableName") not in known:
                    yield f"{told}: there is no variable {member.get('variableName')}"
            kinds = [member.get("memberName") for member in members]
            rule = terminal.get("matchingRule")
            if rule in ("plug", "bus") and (None in kinds or len(set(kinds)) != len(kinds)):
                yield f"{told}: members are {kinds}, which the rule {rule} cannot match"
            if rule not in ("plug", "bus", "sequence") and "." not in (rule or ""):
                yield f"{told}: matching rule {rule!r}"


RULES = (
    header,
    order_of_elements,
    flags,
    units,
    names,
    value_references,
    causalities,
    numbers,
    derivatives,
    outputs,
    initial_unknowns,
    dependencies,
    experiment,
    log_categories,
    terminals,
)


def problems(description):
    """What is wrong, each with the name of the rule that says so."""
    return [f"{rule.__name__}: {text}" for rule in RULES for text in rule(description)]
