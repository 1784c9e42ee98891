"""Packages used by the adapters; they are imported at their first use."""

from importlib import import_module
from typing import Any


def need(package: str, extra: str, provider: str = "") -> Any:
    """Import a module; if its package is missing, the error states how to install it.

    Args:
        package: Module to import.
        extra: Package that installs it, and the name of the extra of centrode.
        provider: The top-level module that must be installed; default: that of `package`.
    """
    top = provider or package.partition(".")[0]
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != top:
            raise
        raise ModuleNotFoundError(f"{top} is not installed: pip install {extra}", name=error.name) from error
