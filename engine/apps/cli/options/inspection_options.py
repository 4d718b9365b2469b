"""The options that inspect a model: a section, parts taken apart, dimensions, measures.

In: an argparse parser; parsed options and an opened model. Out: the same parser with options; the
model cut and spread; what is measured.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ....base.near_words import meant
from ....errors import InvalidArgumentError, warn
from .. import values
from ..quietness import remark
from ..usage import UsageError
from .drawing_options import is_drawing

if TYPE_CHECKING:
    from ....stage.overlays.measurements import Measurement
    from ....stage.viewed_scene import ViewedScene

#: What is measured of the whole model, without points.
_SURFACE = "surface"
#: Between the points of a measure.
_BETWEEN = "/"


def add_explode(group) -> None:
    """Add the option that takes a model apart."""
    group.add_argument(
        "--explode",
        type=values.not_negative,
        metavar="D",
        help="move the model's parts away from its middle: 1 doubles their distances. Parts are "
        "nodes; of a single mesh its named groups, else the pieces that hang together",
    )


def add(parser) -> None:
    """Add the options."""
    group = parser.add_argument_group("inspection")
    group.add_argument(
        "--section",
        metavar="AXIS=PLACE",
        help="cut the model: x=0.5 cuts off what has greater coordinates, -x=0.5 the rest, x=50%% "
        "is in the middle, as is x. The cut is closed and hatched",
    )
    add_explode(group)
    group.add_argument(
        "--dimensions", action="store_true", help="draw the box around the model and its lengths"
    )
    add_measure(group)


def add_measure(group) -> None:
    """Add the option that measures."""
    group.add_argument(
        "--measure",
        action="append",
        type=_measure,
        metavar="WHAT",
        help="distance=X,Y,Z/X,Y,Z; angle= with three points, at the second one; circle= with "
        "three points, its radius: printed, and drawn in pictures; surface: area and volume, "
        "printed. May be given several times",
    )


def _measure(text: str) -> tuple[str, list[tuple[float, float, float]]]:
    """Parse ``surface``, or ``distance=0,0,0/1,0,0``."""
    from ....stage.overlays.measurements import KINDS

    kind, _, rest = text.partition("=")
    if text == _SURFACE:
        return kind, []
    if kind not in KINDS:
        known = ", ".join((*KINDS, _SURFACE))
        raise argparse.ArgumentTypeError(
            f"{kind!r} is none of {known}" + meant(kind, (*KINDS, _SURFACE))
        )
    points = [values.vector(one) for one in rest.split(_BETWEEN)] if rest else []
    if len(points) != KINDS[kind]:
        raise argparse.ArgumentTypeError(
            f"{kind} takes {KINDS[kind]} points like 0,0,0/1,0,0, not {len(points)}"
        )
    return kind, points


def check(args: argparse.Namespace) -> None:
    """Refuse a text that is no section, and what does not go together."""
    if is_drawing(args):
        for option in ("dimensions", "measure"):
            if getattr(args, option):
                raise UsageError(f"--{option} is drawn in pictures, not in line drawings")
    for option in ("section", "explode"):
        if getattr(args, option) is not None and args.animation is not None:
            raise UsageError(f"--{option} shows the model as it stands: not with --animation")
    if args.section is not None:
        from ...sheet.views import parse_section

        try:
            parse_section(args.section)
        except InvalidArgumentError as error:
            raise UsageError(f"--{error}") from None


def inspected(
    viewed: ViewedScene, explode: float | None, section: str | None = None
) -> ViewedScene:
    """Return a model spread and cut as the options say; the model itself if they say nothing."""
    if section is None and explode is None:
        return viewed
    from ....stage.inspection.taken_apart import TakenApart

    apart = TakenApart(viewed)
    apart.spread(explode or 0.0)
    if section is not None:
        apart.cut(_plane(section, apart.viewed))
        for name in apart.open_cuts:
            warn(f"section: the cut of {name} is open: its mesh has no inside there")
        for name in apart.uncut:
            warn(f"section: {name} stays whole: it has too many instances")
    return apart.viewed


def _plane(text: str, viewed: ViewedScene) -> Any:
    import numpy as np

    from ....stage.scene_bounds import sphere_of_box
    from ...sheet.placing import section_plane, warn_of_misses
    from ...sheet.views import ViewSpec, parse_section

    section, bounds = parse_section(text), np.array(viewed.scene.bounds, np.float64)
    warn_of_misses([ViewSpec("", section=section)], bounds, viewed.origin)
    return section_plane(section, bounds, sphere_of_box(bounds).radius, viewed.origin)


def sizes(args: argparse.Namespace) -> dict[str, Any]:
    """Return the fields of `Settings` for what is drawn over pictures."""
    measured = tuple(_measurements(args))
    return {"dimensions": getattr(args, "dimensions", False), "measured": measured}


def _measurements(args: argparse.Namespace) -> list[Measurement]:
    given = [one for one in getattr(args, "measure", None) or () if one[1]]
    if not given:
        return []
    import numpy as np

    from ....stage.overlays.measurements import Measurement

    return [Measurement(kind, np.array(points)) for kind, points in given]


def tell_measures(args: argparse.Namespace, viewed: ViewedScene) -> None:
    """Print what is measured."""
    from ....stage.overlays.measurements import measurement_text

    for measured in _measurements(args):
        remark(measurement_text(measured, viewed.unit))
    if any(kind == _SURFACE for kind, _ in args.measure or ()):
        from ....measuring import measure
        from ....stage.overlays.measurements import surface_text

        remark(", ".join(surface_text(measure(viewed.scene), viewed.unit)))
