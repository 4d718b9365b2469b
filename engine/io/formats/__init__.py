"""The file formats, one module or subpackage each, for reading and writing.

A module with ``READERS`` is a readable format, and a module ``NAME_writer`` with ``WRITERS`` a
writable one; `reader_registry` and `writer_registry` list them.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from types import ModuleType


def modules(*, writing: bool) -> Iterator[ModuleType]:
    """Import and yield the modules here and in subpackages: the writers, or all others."""
    from pkgutil import walk_packages

    for module in walk_packages(__path__, __name__ + "."):
        name = module.name.rpartition(".")[2]
        if (name.endswith("_writer") or name.startswith("written_")) == writing:
            yield importlib.import_module(module.name)


def named(name: str) -> ModuleType | None:
    """Import only the module with a format's name."""
    try:
        module = importlib.import_module(f".{name}", __name__)
        is_folder = hasattr(module, "__path__")
        return importlib.import_module(f".{name}", module.__name__) if is_folder else module
    except ModuleNotFoundError:
        return None
