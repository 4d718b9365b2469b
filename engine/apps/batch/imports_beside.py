"""The modules of its own folder that a Python file imports, and those that they import in turn.

They are found in the source, so that the answer is the same whatever the process has imported yet.
In: the path of a file. Out: the modules' names and files.
"""

from __future__ import annotations

import ast
import os
import sys
from collections.abc import Iterator


def imports_beside(path: str) -> dict[str, str]:
    """Return the files of the modules of ``path``'s folder that it imports, by their names."""
    folder = os.path.dirname(path)
    found: dict[str, str] = {}
    waiting = [(path, "")]
    while waiting:
        for name in _imported(*waiting.pop()):
            file = None if name in found else _file_of(folder, name)
            if file is not None:
                found[name] = file
                is_package = os.path.basename(file) == "__init__.py"
                waiting.append((file, name if is_package else name.rpartition(".")[0]))
    return found


def _imported(path: str, package: str) -> Iterator[str]:
    """Yield the names that a file of a package imports, each after the packages that hold it.

    A name may be that of a function, of which there is no file.
    """
    try:
        with open(path, "rb") as file:
            tree = ast.parse(file.read())
    except (OSError, SyntaxError, ValueError):
        return  # the import says so, if it is made
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            outer = package.split(".")[: len(package.split(".")) + 1 - node.level]
            parts = [*(outer if node.level else []), *filter(None, [node.module])]
            names = [".".join([*parts, alias.name]) for alias in node.names]
        else:
            continue
        for name in names:
            parts = name.split(".")
            yield from (".".join(parts[: count + 1]) for count in range(len(parts)))


def _file_of(folder: str, name: str) -> str | None:
    """Return a module's file in a folder, unless another of its name has been imported."""
    base = os.path.join(folder, *name.split("."))
    file = next(filter(os.path.isfile, (os.path.join(base, "__init__.py"), f"{base}.py")), None)
    here = getattr(sys.modules.get(name), "__file__", None) if name in sys.modules else file
    return file if file and here and os.path.realpath(here) == os.path.realpath(file) else None
