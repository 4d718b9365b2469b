"""A module for each format, or a folder where it takes several: how it is read, and written.

What defines ``READERS`` or, in a module ``NAME_writer``, ``WRITERS`` is a format; `reader_registry`
and `writer_registry` list them.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator
from types import ModuleType


def modules(*, writing: bool) -> Iterator[ModuleType]:
    """Import the modules here and in folders below that write files, or all others; yield each."""
    for module in pkgutil.walk_packages(__path__, __name__ + "."):
        name = module.name.rpartition(".")[2]
        if (name.endswith("_writer") or name.startswith("written_")) == writing:
            yield importlib.import_module(module.name)


def named(name: str) -> ModuleType | None:
    """Import the module that a format's name names, without importing the others."""
    try:
        module = importlib.import_module(f".{name}", __name__)
        is_folder = hasattr(module, "__path__")
        return importlib.import_module(f".{name}", module.__name__) if is_folder else module
    except ModuleNotFoundError:
        return None
