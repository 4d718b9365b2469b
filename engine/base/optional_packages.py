"""Packages that only parts of engine3d need: what an error says where one is missing.

In: what needs a package, its name, the extra that brings it. Out: one line, or an error.
"""

from __future__ import annotations

import sys
from importlib.util import find_spec


def needed(by: str, package: str, extra: str = "") -> str:
    """Return a line that tells how to install a package.

    Parameters
    ----------
    by : str
        What needs it, with the verb.
    package : str
    extra : str
        Of engine3d; without one, the package is installed by its name.

    Examples
    --------
    >>> needed("MP4 needs", "imageio-ffmpeg", "video")
    "MP4 needs the package imageio-ffmpeg: pip install 'engine3d[video]'"
    """
    command = f"'engine3d[{extra}]'" if extra else package
    return f"{by} the package {package}: pip install {command}"


def require(package: str, by: str, extra: str = "") -> None:
    """Raise an error that tells how to install a package unless it is there.

    Raises
    ------
    ModuleNotFoundError
        With the package's name.
    """
    is_there = sys.modules[package] if package in sys.modules else find_spec(package)
    if is_there is None:
        raise ModuleNotFoundError(needed(f"{by} needs", package, extra), name=package)
