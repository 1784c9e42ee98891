class Error(Exception):
    """Base class of all errors of this package."""

    __module__ = "centrode"


class DesignError(Error, ValueError):
    """A design that breaks a rule.

    >>> import centrode as ct
    >>> try:
    ...     ct.Rack(pressure_angle=1.5)
    ... except ct.DesignError as error:
    ...     print(error.key)
    tool.pressure_angle_deg
    """

    __module__ = "centrode"

    key: str
    """Key at fault as in a design file, with its tables; empty if the fault has no key."""
    line: int | None
    """Line of the key in the design file, from one; None if the design is not from a file."""
    column: int | None
    """Column of the key, in characters, from one."""

    def __init__(self, message: str, key: str = "", line: int | None = None, column: int | None = None) -> None:
        """Keep the message as the only argument."""
        super().__init__(message)
        self.key = key
        self.line = line
        self.column = column


class PitchError(DesignError):
    """A pitch curve that cannot exist."""

    __module__ = "centrode"


class GearPairError(DesignError):
    """A gear pair that cannot exist: the curves do not roll on each other, or the teeth have no contour."""

    __module__ = "centrode"


class CamError(DesignError):
    """A cam that cannot exist: the segments do not form a motion, or the follower cannot follow it."""

    __module__ = "centrode"


class LinkageError(DesignError):
    """A linkage that cannot exist or cannot turn.

    >>> import centrode as ct
    >>> try:
    ...     ct.SixBar(crank=77, coupler=147, rocker=127, frame=45, pivot=(100, 67), effector_length=200)
    ... except ct.LinkageError as error:
    ...     print(error)
    the four-bar must be a crank-rocker, but it is a double crank: the crank must be the shortest link, \
and Grashof's margin must be above 0: it is 12 mm (the two other lengths minus shortest and longest)
    """


class MechanismError(DesignError):
    """A mechanism that cannot exist, although its gears can exist."""

    __module__ = "centrode"


class ExportError(Error):
    """A file that cannot be created or written; an error of the system is its `__cause__`."""

    __module__ = "centrode"


class InternalError(Error, RuntimeError):
    """A fault of centrode, not of the input: please report it with the input. Standard error has the details."""

    __module__ = "centrode"
