"""Opens the sources of a sheet: whatever `engine3d.render` draws.

In: the caller's sources. Out: a `ViewedScene` for each.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ...base.foreign_arrays import is_foreign_array
from ...errors import InvalidArgumentError, printable
from ...stage.open_models import open_models
from ...stage.viewed_scene import ViewedScene
from ...stage.viewed_thing import is_file, viewed_of


def open_sources(sources: Any, **options: Any) -> list[ViewedScene]:
    """Return the viewed scene of one or several sources.

    Parameters
    ----------
    sources : what `engine3d.render` takes, or an iterable of these
        An array holds the points of one model.
    **options
        Of `open_models`, for files.

    Raises
    ------
    InvalidArgumentError
        There is none, or one is something else.
    FileFormatError, FileAccessError
    """
    is_array = isinstance(sources, np.ndarray) or is_foreign_array(sources)
    is_several = isinstance(sources, Iterable) and not is_array
    given = list(sources) if is_several and not is_file(sources) else [sources]
    if not given:
        raise InvalidArgumentError("a sheet needs a model")
    return [_open(source, options) for source in given]


def _open(source: Any, options: dict[str, Any]) -> ViewedScene:
    viewed = open_models([source], **options) if is_file(source) else viewed_of(source)
    if viewed is None:
        raise InvalidArgumentError(
            f"models must be paths, scenes, nodes, meshes or points, not {type(source).__name__}"
        )
    viewed.title = printable(viewed.title)
    return viewed
