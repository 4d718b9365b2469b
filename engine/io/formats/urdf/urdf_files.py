"""Finds the meshes and images that a robot names.

In: a name: relative, ``file://``, ``package://NAME/…``, ``model://NAME/…`` or ``$(find NAME)/…``.
Out: an open file, or the reason why there is none. Files are read from the robot's own package,
from packages of ROS_PACKAGE_PATH, GAZEBO_MODEL_PATH and GZ_SIM_RESOURCE_PATH, and from the
caller's root; nothing else is read, whatever a name says. Where reading is confined to a folder,
nothing around that is even looked for.
"""

from __future__ import annotations

import itertools
import os
import re
from collections.abc import Iterator

from ....base.files.confined_reading import why_not_at
from ....base.files.folders_above import folders_above
from ...addresses.linked_urls import linked_files
from ...addresses.url_names import is_url
from ...reading.linked_files import LinkedFileError, LinkedFiles
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList

_PACKAGE = re.compile(r"(?:package|model)://([^/\\]+)[/\\]+(.*)|\$\(find ([^)]+)\)[/\\]*(.*)", re.S)
#: Environment variables with folders of packages.
PATHS = (
    "ROS_PACKAGE_PATH",
    "GAZEBO_MODEL_PATH",
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
)
#: The files by which a folder is a package of ROS, or a model of Gazebo.
_MARKS = ("package.xml", "manifest.xml", "model.config")
#: Folders of a package that hold its robots: it is the folder around them.
_OF_ROBOTS = ("urdf", "urdfs", "robot", "robots", "xacro", "models", "sdf")
# A package lies at most this many folders above its robots.
_MOST_ABOVE = 8


class RobotFiles:
    """The files that a robot may name.

    Parameters
    ----------
    source : Source
        The robot's file.
    warnings : WarningList
        Gets notes about files that are taken instead of those named.
    """

    def __init__(self, source: Source, warnings: WarningList) -> None:
        self._source, self._warnings = source, warnings
        self._folder = None if is_url(source.path) else source.folder
        self._own = None if self._folder is None else package_of(self._folder)
        if self._own is None:
            self._near = linked_files(source, warnings)
        else:
            self._near = LinkedFiles(self._own, source.root, warnings)

    def open(self, name: str) -> Source:
        """Open a file that the robot names.

        Raises
        ------
        LinkedFileError, FileAccessError, FileFormatError
        """
        found = _PACKAGE.fullmatch(name.strip())
        if found is None:
            path, note = self._near.find_near(name, self._folder)
            if note:
                self._warnings.add(f"{shown(name)}: {note}")
            return self._opened(self._near, path)
        package, inner = found[1] or found[3], found[2] or found[4]
        for folder in self._packages(package):
            files = LinkedFiles(folder, self._source.root)
            try:
                return self._opened(files, files.find(inner))
            except LinkedFileError:
                continue
        path, _ = self._near.find_near(f"{package}/{inner}", self._folder)
        self._warnings.add_once(
            f"there is no package {shown(package)} around the file or in {PATHS[0]}: files of "
            "these names in the robot's own package are taken"
        )
        return self._opened(self._near, path)

    def _opened(self, files: LinkedFiles, path: str) -> Source:
        """Open a found file, whose own textures may lie anywhere in its package."""
        root = self._source.root if is_url(path) else package_of(os.path.dirname(path))
        return files.read(path)._replace(
            root=root, crease_angle=self._source.crease_angle, values=self._source.values
        )

    def _packages(self, name: str) -> Iterator[str]:
        """Yield the folders that may be a package, nearest first."""
        if name in ("", ".", "..") or os.path.sep in name:
            return
        if self._folder is not None:
            yield from _around(self._folder, name)
        listed = [part for path in PATHS for part in os.environ.get(path, "").split(os.pathsep)]
        for place in [*filter(None, listed), *filter(None, [self._source.root])]:
            if why_not_at(place):
                continue
            if os.path.basename(os.path.normpath(place)) == name:
                yield place
            if os.path.isdir(inner := os.path.join(place, name)):
                yield inner


def package_of(folder: str) -> str:
    """Return the folder of the package around a file: the one with its mark, else the nearest."""
    for above in _above(folder):
        if any(os.path.exists(os.path.join(above, mark)) for mark in _MARKS):
            return above
    around, name = os.path.split(os.path.abspath(folder))
    return around if name.lower() in _OF_ROBOTS and not why_not_at(around) else folder


def _around(folder: str, name: str) -> Iterator[str]:
    """Yield a package around a file, or beside what is around it.

    A folder beside counts only with the mark of packages: names must not lead anywhere.
    """
    for above in _above(folder):
        if os.path.basename(above) == name:
            yield above
        inner = os.path.join(above, name)
        if any(os.path.exists(os.path.join(inner, mark)) for mark in _MARKS):
            yield inner


def _above(folder: str) -> list[str]:
    """Return a folder and those around it that may be read; absolute, without the top one."""
    nearest = itertools.islice(folders_above(os.path.abspath(folder)), _MOST_ABOVE)
    inside = itertools.takewhile(lambda above: not why_not_at(above), nearest)
    return [above for above in inside if os.path.dirname(above) != above]
