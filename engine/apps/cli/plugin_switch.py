"""The option that leaves plug-ins out, wherever it stands: it decides what may be parsed at all."""

from __future__ import annotations

from contextlib import AbstractContextManager

from ...base.plugins.discovery import leaving_out

NO_PLUGINS = "--no-plugins"


def plugins_as_asked(arguments: list[str]) -> AbstractContextManager[None]:
    """Leave plug-ins out within the block if the arguments say so."""
    return leaving_out(NO_PLUGINS in arguments)
