"""A module for each format, or a folder where it takes several: how it is read, and written.

What defines ``READERS`` or ``WRITERS`` is a format; `reader_registry` and `writer_registry` list
them.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator
from types import ModuleType


def modules() -> Iterator[ModuleType]:
    """Import the modules of this folder and of those within it; yield each."""
    for module in pkgutil.walk_packages(__path__, __name__ + "."):
        yield importlib.import_module(module.name)


def named(name: str) -> ModuleType | None:
    """Import the module that a format's name names, without importing the others."""
    try:
        module = importlib.import_module(f".{name}", __name__)
        return (
            importlib.import_module(f".{name}", module.__name__) if _is_folder(module) else module
        )
    except ModuleNotFoundError:
        return None


def _is_folder(module: ModuleType) -> bool:
    return hasattr(module, "__path__")
