"""The options for choosing models or a built-in scene, and opening them."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from ...scenes import DEMO_CHOICES, DEMO_NAMES, SCENES
from .. import values
from ..loading_bar import LoadingBar
from ..outputs import not_the_output
from ..usage import UsageError
from . import scalar_options
from .input_options import add_inputs, check_inputs, model_files, of_robot

if TYPE_CHECKING:
    from ....model.materials.material import Material

#: Options about reading or dressing models, which built-in scenes do not have.
OF_MODELS = (
    *("texture", "variant", "animation_index", "animation_time", "crease_angle"),
    *("force_reader", "max_size", "root", "joint", "shapes", *scalar_options.COLORING),
)


def add_color(group) -> None:
    """Add the option for the colour of models."""
    group.add_argument(
        "--color",
        type=values.color,
        metavar="COLOR",
        help="colour of the whole model, instead of its materials and colours; with --texture, of "
        "what has no materials; of a built-in scene that is no model, of what has no texture and "
        "does not glow",
    )


def add(parser) -> None:
    """Add the options for models and scenes."""
    group = parser.add_argument_group("what to show")
    group.add_argument(
        "models",
        metavar="MODEL",
        nargs="*",
        help="model files, or folders of them; - for standard input. Several are shown together, "
        "each where it places itself, or one by one: see --multi-file-mode",
    )
    add_inputs(group)
    group.add_argument(
        "--side-by-side",
        action="store_true",
        help="stand several models in a row, upright and in their own sizes",
    )
    _add_built_in(group)
    group.add_argument(
        "--texture",
        metavar="FILE",
        help="texture for a model without materials; by default an image of the same name "
        "beside the model",
    )
    add_color(group)
    _add_animation(group)
    group.add_argument(
        "--variant",
        metavar="NAME",
        help="which of the sets of materials that the model offers, by name or number",
    )
    group.add_argument(
        "--crease-angle",
        type=values.crease_angle,
        metavar="DEGREES",
        help="where a model has no normals, draw edges sharp whose faces meet at more than this; "
        "35 by default, 180 makes all smooth, 0 all flat",
    )
    group.add_argument(
        "--no-texture", action="store_true", help="leave textures out; light and colours stay"
    )
    group.add_argument(
        "--verbose",
        action="store_true",
        help="print what is loaded and how long loading and each frame take",
    )


def _add_built_in(group) -> None:
    """Add the options of built-in scenes."""
    group.add_argument(
        "--scene",
        choices=DEMO_CHOICES,
        metavar="NAME",
        help=f"a scene: {', '.join(DEMO_NAMES)}; or one that a plug-in adds",
    )
    group.add_argument(
        "--triangles",
        type=values.city_triangles,
        metavar="N",
        help="with --scene city: about how many triangles, 20,000 to 50,000,000",
    )
    group.add_argument(
        "--dusk",
        action="store_true",
        help="with --scene city: let the sun set, and lamps and windows shine",
    )
    group.add_argument(
        "--subdivisions",
        type=values.subdivisions,
        metavar="N",
        help="with --scene shapes: cut the edges of its sphere, box and floor into N parts",
    )


def _add_animation(group) -> None:
    """Add which of the model's animations shows, and when."""
    group.add_argument(
        "--animation-index",
        type=values.index,
        metavar="N",
        help="which animation of the model plays, from 0 on; -1 for all of them together",
    )
    group.add_argument(
        "--animation-time",
        type=values.number,
        metavar="T",
        help="seconds of the animation at which the model stands, or begins to play; 0 by default",
    )


def viewed_scene(args: argparse.Namespace, default_scene: str | None = None):
    """Return the chosen `ViewedScene`; ``default_scene`` if none is chosen."""
    if args.models and args.scene is not None:
        raise UsageError("give a MODEL or --scene, not both")
    if args.side_by_side and len(args.models) < 2:
        raise UsageError("--side-by-side needs several MODELs")
    of_scene = _of_scene(args)
    if not args.models:
        for option in OF_MODELS:
            given = getattr(args, option, None)
            if given is not None and given is not False:  # 0 counts as given
                raise UsageError(f"--{option.replace('_', '-')} needs a MODEL")
        if args.scene is None and default_scene is None:
            raise UsageError("give a MODEL or --scene NAME")
        from ...scenes import load_demo

        viewed = load_demo(args.scene or default_scene, **of_scene)
        if args.color is not None:
            from ....stage.open_model import dress_scene

            dress_scene(viewed, args.color)
        return viewed
    from ....stage.open_models import open_models

    check_inputs(args)
    with LoadingBar() as progress:
        return open_models(model_files(args.models), **opening(args), progress=progress)


def _of_scene(args: argparse.Namespace) -> dict:
    """Return the given options that apply only to some scenes."""
    given = {}
    for name, scene in SCENES.items():
        for option in scene.options:
            if getattr(args, option) not in (None, False):
                if args.scene != name:
                    raise UsageError(f"--{option} goes with --scene {name}")
                given[option] = getattr(args, option)
    return given


def opening(args: argparse.Namespace) -> dict:
    """Return the arguments for opening models."""
    creases = {} if args.crease_angle is None else {"crease_angle": args.crease_angle}
    return {
        **creases,
        **of_robot(args),
        "format": args.force_reader,
        "root": args.root,
        "numbers": scalar_options.coloring(args),
        "side_by_side": args.side_by_side,
        "up": args.up,
        "texture": args.texture,
        "color": args.color,
        "companion": not_the_output(args.output),
        "variant": _variant(args.variant),
        "animation": _animation(args),
    }


def paint(args: argparse.Namespace) -> Material | None:
    """Return the material that replaces all of a model's own; None keeps them."""
    is_dressed = args.texture is not None or scalar_options.coloring(args) is not None
    if args.color is None or not args.models or is_dressed:
        return None
    from ....model.materials.material import Material

    return Material(color=args.color)


def _variant(given: str | None) -> str | int | None:
    """Return a name, or a number if the text is one."""
    return int(given) if given is not None and given.isdecimal() else given


def _animation(args: argparse.Namespace):
    """Return a function that plays an opened model's animations, or holds them at a time."""
    from ....stage.played_clips import play_clips, stand_at

    plays = getattr(args, "animation", None) is not None or args.command == "run"
    asked = args.animation_index is not None or args.animation_time is not None
    if plays:
        return lambda viewed: play_clips(viewed, args.animation_index)
    if asked and getattr(args, "turntable", None) is None:
        return lambda viewed: stand_at(viewed, args.animation_index, args.animation_time or 0.0)
    return (lambda viewed: play_clips(viewed, args.animation_index)) if asked else None
