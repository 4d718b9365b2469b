"""What Python's own modules lack on Windows and macOS, as mypy's copy of typeshed has it."""

from __future__ import annotations

import ast
import functools
import importlib.util
import sys
import types
from pathlib import Path

# Modules whose names differ, and those that are empty on Windows, or not there.
PARTLY = ("errno", "mmap", "os", "select", "signal", "socket", "time")
WHOLLY = ("crypt", "fcntl", "grp", "pty", "pwd", "readline", "resource", "syslog", "termios", "tty")


@functools.cache
def missing(module: str, platform: str = "win32") -> frozenset[str]:
    """The names that a module has on Linux, but not on another platform."""
    place = typeshed() / module
    stub = place / "__init__.pyi" if place.is_dir() else place.with_suffix(".pyi")
    body = ast.parse(stub.read_text("utf-8")).body
    return frozenset(_names(body, "linux") - _names(body, platform))


def typeshed() -> Path | None:
    """The folder of the standard library's stubs; None where there is no mypy."""
    found = importlib.util.find_spec("mypy")
    if found is None or not found.submodule_search_locations:
        return None
    return Path(found.submodule_search_locations[0]) / "typeshed" / "stdlib"


def _names(body: list[ast.stmt], platform: str) -> set[str]:
    found = set()
    for statement in body:
        if isinstance(statement, ast.If):
            chosen = statement.body if _holds(statement.test, platform) else statement.orelse
            found |= _names(chosen, platform)
        elif isinstance(statement, ast.FunctionDef | ast.ClassDef):
            found.add(statement.name)
        elif isinstance(statement, ast.AnnAssign):
            found.add(ast.unparse(statement.target))
        elif isinstance(statement, ast.Assign):
            found.update(map(ast.unparse, statement.targets))
        elif isinstance(statement, ast.ImportFrom):
            found.update(name.asname or name.name for name in statement.names)
    return found


def _holds(test: ast.expr, platform: str) -> bool:
    """Whether a condition of a stub is true: of sys.platform and sys.version_info."""
    system = types.SimpleNamespace(platform=platform, version_info=sys.version_info)
    return eval(compile(ast.Expression(test), "stub", "eval"), {"sys": system})
