"""The plug-ins of installed packages, from their metadata; none of their code is imported.

``ENGINE3D_PLUGINS=0`` and `leaving_out` leave them out: results then depend on nothing else that
is installed.
"""

from __future__ import annotations

import functools
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

from ...errors import warn
from .groups import group_of
from .plugin import Plugin, told

if TYPE_CHECKING:
    from importlib.metadata import Distribution

_left_out: ContextVar[bool] = ContextVar("_left_out", default=False)


def are_on() -> bool:
    """Return whether plug-ins of installed packages count."""
    return not _left_out.get() and os.environ.get("ENGINE3D_PLUGINS", "") != "0"


@contextmanager
def leaving_out(leaves_out: bool = True) -> Iterator[None]:
    """Leave out the plug-ins of installed packages within the block, in this thread."""
    token = _left_out.set(leaves_out or _left_out.get())
    try:
        yield
    finally:
        _left_out.reset(token)


def installed_plugins() -> tuple[Plugin, ...]:
    """Return the plug-ins of all installed packages, sorted by group, name and package."""
    return _found() if are_on() else ()


@functools.cache
def _found() -> tuple[Plugin, ...]:
    from importlib.metadata import distributions  # here, because it takes milliseconds

    found: list[Plugin] = []
    seen: set[str] = set()
    for distribution in distributions():
        try:
            text = distribution.read_text("entry_points.txt") or ""
            plugins = list(_of(distribution)) if "engine3d." in text else []
        # Whatever is wrong with the metadata of a package, the others stay.
        except Exception as error:
            warn(f"a package's metadata cannot be read, its plug-ins are left out: {told(error)}")
            continue
        # Of two versions on the path, Python imports the first.
        key = _normalized(plugins[0].package) if plugins else ""
        if key not in seen:
            found += plugins
        seen.update(filter(None, [key]))
    return tuple(sorted(found, key=lambda plugin: plugin.stamp))


def _of(distribution: Distribution) -> Iterator[Plugin]:
    metadata: Any = distribution.metadata
    # Python is to raise errors of names that are not there, and warns of that: `get` does neither.
    about = " ".join(metadata.get("Summary", "").split())
    for point in distribution.entry_points:
        group = group_of(point.group)
        if group is not None:
            name = metadata.get("Name") or "a package without a name"
            version = metadata.get("Version") or "?"
            yield Plugin(group.name, point.name, point.load, name, version, about)


def _normalized(name: str) -> str:
    """Return a package's name as PEP 503 compares it."""
    return re.sub(r"[-_.]+", "-", name).lower()
