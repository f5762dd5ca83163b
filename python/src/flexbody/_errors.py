"""What goes wrong."""


class Error(Exception):
    """What the program says is wrong."""
