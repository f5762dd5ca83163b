"""Numbers as the page shows them, and small statistics over rows: the filters of charts.toml and of the texts."""

import math
import statistics

NONE = "–"


def short(value):
    """Two digits: 3.1e-5, 0.31, 31; zero is 0."""
    size = abs(value) if value is not None else 0.0
    if size == 0.0:
        return NONE if value is None else "0"
    if not 0.01 <= size < 99.5:
        return power(value, 1)
    return f"{value:.{(size < 9.95) + (size < 0.995) + (size < 0.0995)}f}"


def three(value):
    """Three digits without an exponent."""
    if value is None:
        return NONE
    before = math.floor(math.log10(abs(value))) if value else -3
    return f"{value:.{2 - min(max(before, -3), 2)}f}"


def fixed(value, digits):
    """So many digits behind the point."""
    return f"{value:.{digits}f}"


def power(value, digits=0, sign=""):
    """With an exponent: 1e-4."""
    mantissa, exponent = f"{value:{sign}.{digits}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def bold(text, is_bold):
    return f"**{text}**" if is_bold else text


def over(value, other):
    """The ratio of two numbers; nothing where one is nothing."""
    return None if None in (value, other) else value / other


def where(rows, **equal):
    """Rows with these values."""
    return [row for row in rows if all(row[key] == value for key, value in equal.items())]


def pick(rows, column, **equal):
    """The value of a column in the one row with these values."""
    found = where(rows, **equal)
    if len(found) != 1:
        raise ValueError(f"expected one row with {equal}, found {len(found)}")
    return found[0][column]


def column(rows, *names):
    """Values of columns, without empty ones."""
    return [row[name] for name in names for row in rows if row[name] is not None]


def groups(rows, key):
    """Keys, a column each or a list of columns, with their rows, in the order in which they come first."""
    found = {}
    for row in rows:
        found.setdefault(row[key] if isinstance(key, str) else tuple(row[name] for name in key), []).append(row)
    return list(found.items())


def ranked(rows, name):
    """Rows with a value in a column from small to large, each with its `share`: the part of them up to it, percent."""
    known = sorted((row for row in rows if row[name] is not None), key=lambda row: row[name])
    return [{**row, "share": 100 * (index + 1) / len(known)} for index, row in enumerate(known)]


def share(values, most):
    """The part of values that are at most that, percent."""
    return f"{100 * sum(value <= most for value in values) / len(values):.3g}"


def middle(values):
    """The median."""
    return statistics.median(values)


def points(rows, x, y):
    """Pairs of finite numbers."""
    pairs = [(row[x], row[y]) for row in rows]
    return [pair for pair in pairs if all(value is not None and math.isfinite(value) for value in pair)]


def between(a, b, part):
    """A value on the straight line between two on a logarithmic axis."""
    return a * (b / a) ** part


def peaks(rows, x, y):
    """The row with the largest y at every x."""
    return [max(group, key=lambda row: row[y]) for _, group in groups(rows, x)]


def frontier(rows, cost="cpu_time_s", error="error"):
    """The rows that none of the others beats in both cost and error, from loose to tight."""
    best = []
    for row in sorted(rows, key=lambda row: row[cost]):
        if not best or row[error] < best[-1][error]:
            best.append(row)
    return best


def best(rows, goal, cost="cpu_time_s", error="error"):
    """The cheapest row with an error of at most that; nothing where there is none."""
    return min((row for row in rows if row[error] <= goal), key=lambda row: row[cost], default=None)


def needed(rows, goal, cost="cpu_time_s", error="error", scale=1.0):
    """The least cost of an error, over the rows that are at least as good and the straight lines between neighbours
    on logarithmic axes; nothing where no row is as good."""
    known = points(rows, cost, error)
    found = [time for time, reached in known if reached <= goal]
    for (a, loose), (b, tight) in zip(known, known[1:]):
        if tight <= goal < loose:
            found.append(between(a, b, math.log(goal / loose) / math.log(tight / loose)))
    return scale * min(found) if found else None


def cheapest(rows, by, goal, **how):
    """Which of the groups needs the least for an error, and how much; nothing where none is as good."""
    costs = [(needed(group, goal, **how), key) for key, group in groups(rows, by)]
    return min((pair for pair in costs if pair[0] is not None), key=lambda pair: pair[0], default=(None, None))


def reach(rows, limit, x, y, scale=1.0):
    """The largest x up to which y stays within a limit; nothing where its first value does not."""
    known = sorted(points(rows, x, y))
    beyond = next((index for index, (_, value) in enumerate(known) if value > limit), None)
    if not beyond:
        return None if beyond == 0 else scale * known[-1][0]
    (a, below), (b, above) = known[beyond - 1 : beyond + 1]
    return scale * between(a, b, math.log(limit / below) / math.log(above / below))


def at(rows, place, x, y):
    """The value of y at a place, on straight lines between neighbours on logarithmic axes."""
    known = sorted(points(rows, x, y))
    (a, first), (b, last) = next(pair for pair in zip(known, known[1:]) if pair[0][0] <= place <= pair[1][0])
    return between(first, last, math.log(place / a) / math.log(b / a))


def slope(rows, x, y):
    """Slope of the line of least squares on logarithmic axes."""
    logs = [(math.log(a), math.log(b)) for a, b in points(rows, x, y)]
    return statistics.linear_regression(*zip(*logs)).slope


FILTERS = [short, three, fixed, power, bold, over, where, pick, column, groups, peaks, frontier, best, needed, cheapest, reach, at, slope, ranked, share, middle]
