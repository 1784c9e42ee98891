import json
from os import PathLike, fspath
from os.path import dirname
from typing import Any

from ._centrode import _LARGEST_DESIGN, Mechanism, _load, _schema
from ._error import DesignError


def load(path: str | PathLike[str]) -> Mechanism:
    """Read a design file and make its mechanism, an object of the class of its family.

    Files of samples that the design names (`file = "law.csv"`) are read from its folder.

    Raises:
        DesignError: The design breaks a rule; `key`, `line` and `column` are the position.
        OSError: The file cannot be read.
    """
    with open(path, "rb") as file:
        contents = file.read(_LARGEST_DESIGN)
    try:
        return _load(contents, dirname(fspath(path)))
    except DesignError as error:
        error.args = (f"{fspath(path)}: {error}",)
        raise


def schema(family: str | None = None) -> dict[str, Any]:
    """Return the JSON schema of the design files of a family, or of all families.

    >>> import centrode as ct
    >>> "$schema" in ct.schema()
    True
    """
    schema: dict[str, Any] = json.loads(_schema(family))
    return schema
