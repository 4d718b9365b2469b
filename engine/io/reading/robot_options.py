"""The options of loading robots, which no other file has.

In: what a caller gives beside a file. Out: fields of a `Source`, for the reader.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypedDict, get_args

from ...base.calls import refuse_unknown
from ...base.numbers import shown
from ...base.validation import choose
from ...choices import ShapesOf
from ...errors import InvalidArgumentError
from .documents import Document
from .sources import Source

SHAPES_OF: tuple[ShapesOf, ...] = get_args(ShapesOf)


class RobotOptionError(InvalidArgumentError):
    """An option that does not fit the file: the caller's fault, not the file's."""


class RobotOptions(TypedDict, total=False):
    """Keywords for robots (URDF).

    Attributes
    ----------
    joints : mapping of str to value
        Where the joints stand, by name: radians of turning, metres of sliding ones, others as in
        `Robot.set_joint`. 0 by default.
    shapes : {"visual", "collision", "both"}
        What shows the links; visual shapes by default.
    """

    joints: Mapping[str, Any] | None
    shapes: ShapesOf


def robot_options(caller: str, known: tuple[str, ...], options: RobotOptions) -> dict[str, Any]:
    """Return the options of a robot as fields of a `Source`.

    Parameters
    ----------
    caller : str
        The function that took the options, for messages.
    known : tuple of str
        Its other keywords.
    options : RobotOptions

    Raises
    ------
    TypeError
        A keyword is unknown.
    InvalidArgumentError
        An option has a wrong value.
    """
    refuse_unknown(caller, options, (*known, *RobotOptions.__annotations__))
    joints, shapes = options.get("joints"), options.get("shapes", "visual")
    if joints is not None and not isinstance(joints, Mapping):
        raise InvalidArgumentError(
            f"joints must be a dict of names and values, not {shown(joints)}"
        )
    return {"joints": joints or {}, "shapes": choose(shapes, SHAPES_OF, "shapes")}


def check_robot(source: Source, document: Document) -> None:
    """Raise if a file without joints was given options of a robot."""
    if not document.has_joints and (source.joints or source.shapes != "visual"):
        what = "joints" if source.joints else "shapes"
        raise RobotOptionError(
            f"{source.path}: {what} are options of robots, and this is a file of format "
            f"{document.format}"
        )
