"""The options that ``run`` and ``render`` share, and what the viewer gets of them.

In: an argparse parser. Out: the same parser with options, each group from the file of its theme;
`settings` turns what was parsed into what the viewer takes. Spellings follow f3d where it has the
option.
"""

from __future__ import annotations

import argparse

from . import (
    ambient_options,
    appearance_options,
    backdrop_options,
    camera_options,
    config,
    environment_options,
    filter_options,
    light_options,
    picture_options,
    scalar_options,
    tone_options,
)
from .usage import UsageError


def add_shared(command) -> None:
    """Add what ``run`` and ``render`` both have besides what to show and where it goes."""
    config.add_config(command)
    picture_options.add_picture(command)
    appearance_options.add_appearance(command)
    light_options.add_light(command)
    ambient_options.add_ambient(command)
    environment_options.add_environment(command)
    backdrop_options.add_backdrop(command)
    tone_options.add_tone(command)
    scalar_options.add_scalars(command)
    camera_options.add_camera(command)


def settings(args: argparse.Namespace):
    """Return the `Settings` that the options name."""
    from ..stage.stage_settings import Settings

    if args.light_position is not None and args.light_direction is not None:
        raise UsageError("--light-position and --light-direction do not go together")
    if None not in (args.near, args.far) and args.near >= args.far:
        raise UsageError("--near must be less than --far")
    return Settings(
        look=args.look,
        appearance=appearance_options.appearance_of(args),
        up=args.up,
        background=backdrop_options.background(args),
        **backdrop_options.fog(args),
        light_position=args.light_position,
        light_direction=args.light_direction,
        light_intensity=args.light_intensity,
        light_clamp=args.light_clamp,
        shadow=None if args.shadows is None else light_options.SHADOWS[args.shadows],
        surroundings=environment_options.surroundings(args),
        exposure=args.exposure,
        textures=not args.no_texture,
        filtering=filter_options.filtering(args),
        near=args.near,
        far=args.far,
        grid=args.grid,
        axes=args.axis,
        **scalar_options.shown(args),
        metadata=args.metadata,
        ui_scale=args.ui_scale,
        **picture_options.theme(args),
    )
