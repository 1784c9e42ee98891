"""Packages that the adapters speak to, imported when they are first needed."""

from importlib import import_module
from typing import Any


def need(package: str, extra: str, provider: str = "") -> Any:
    """Import a module; where its package is missing, say how to install it.

    Args:
        package: Module to import.
        extra: Package that installs it, and the name of the extra of centrode.
        provider: The top-level module that is looked for; that of the package if left out.
    """
    top = provider or package.partition(".")[0]
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != top:
            raise
        raise ModuleNotFoundError(f"{top} is not installed: pip install {extra}", name=error.name) from error
