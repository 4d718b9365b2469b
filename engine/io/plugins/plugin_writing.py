"""Writes files with the writers of other packages.

In: a plug-in of the group ``engine3d.writers``, and a scene. Out: one file, whole or not at all,
and a line for each loss. Errors name the plug-in.
"""

from __future__ import annotations

import inspect
import io
from typing import Any

from ...base.numbers import shown
from ...base.plugins.plugin import Plugin, fault
from ...model.scene.scene import Scene


def options_of(plugin: Plugin) -> tuple[str, ...]:
    """Return the options of a writer: its keyword-only parameters; it is imported for that.

    Raises
    ------
    PluginError
        The plug-in cannot be imported, or is no writer.
    """
    write = plugin.load()
    try:
        parameters = inspect.signature(write).parameters.values()
    except ValueError:  # functions of C need not tell
        return ()
    return tuple(each.name for each in parameters if each.kind is each.KEYWORD_ONLY)


def write_with_plugin(
    plugin: Plugin, scene: Scene, path: str, files: Any, /, **options: Any
) -> list[str]:
    """Write a scene with a plug-in, as `Writer.write`."""
    content = io.BytesIO()  # writers may go back in it, and close it
    content.close = lambda: None  # type: ignore[method-assign]
    with plugin.named_in_errors():
        told = plugin.use()(scene, content, **options)
    lines = [] if told is None else told
    if not (isinstance(lines, (list, tuple)) and all(isinstance(line, str) for line in lines)):
        raise fault(plugin, f"returned {shown(told)}, not None or a list of warnings")
    files.create(path).write(content.getbuffer())
    return list(lines)
