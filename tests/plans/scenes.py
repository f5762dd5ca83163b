"""Random small scenes, each with the values of its outputs by a reference that the program has no part in."""

from drawing import Random
from equilibria import bent, hung
from lines import input_at_rest, loaded_line
from linkages import elbow, motor, moved_support

KINDS = [loaded_line, loaded_line, loaded_line, input_at_rest, motor, moved_support, elbow, bent, bent, hung]


def case(seed):
    """The case of a seed."""
    random = Random(seed)
    return KINDS[seed % len(KINDS)](random)
