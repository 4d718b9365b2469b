"""The options shared by ``run`` and ``render``.

In: an argparse parser. Out: the same parser with options, each group from its theme's module;
`viewing` converts parsed options to drawing settings. Spellings follow f3d for options that it has.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, NamedTuple

from .. import config
from ..usage import UsageError
from . import (
    appearance_options,
    camera_options,
    environment_options,
    light_options,
    picture_options,
    scalar_options,
    scene_options,
)

if TYPE_CHECKING:
    from ....stage.stage_settings import Settings
    from ....stage.view_renderer import ViewRenderer
    from ....stage.viewed_scene import ViewedScene
    from ....stage.views.first_view import FirstView
    from ..verbose_report import Report


def add(command) -> None:
    """Add the options that ``run`` and ``render`` share, besides inputs and outputs."""
    config.add_config(command)
    picture_options.add_picture(command)
    appearance_options.add_appearance(command)
    light_options.add_light(command)
    light_options.add_ambient(command)
    environment_options.add_environment(command)
    environment_options.add_backdrop(command)
    light_options.add_tone(command)
    scalar_options.add_scalars(command)
    camera_options.add_camera(command)


class Viewing(NamedTuple):
    """The drawing settings of a model.

    Attributes
    ----------
    settings : Settings
    first_view : FirstView
    size : (int, int) or None
        Of the picture in pixels, if somebody asked for one.
    antialiasing : str or None
    samples : int or None
        As they were asked for.
    backend : str
    threads : int
    verbose : bool
        Whether each frame is told of.
    """

    settings: Settings
    first_view: FirstView
    size: tuple[int, int] | None
    antialiasing: str | None
    samples: int | None
    backend: str
    threads: int
    verbose: bool

    def renderer(
        self,
        viewed: ViewedScene,
        size: tuple[int, int],
        usual: tuple[str, int],
        report: Report,
        *,
        transparent: bool = False,
    ) -> ViewRenderer:
        """Return the renderer of a model.

        Parameters
        ----------
        viewed : ViewedScene
        size : (int, int)
            Unless somebody asked for another one.
        usual : (str, int)
            The method of antialiasing and the samples, likewise.
        report : Report
        transparent : bool
            Whether there is no background.
        """
        from ....stage.view_renderer import ViewRenderer

        method, samples = picture_options.antialiasing(self.antialiasing, self.samples, *usual)
        return ViewRenderer(
            viewed,
            self.settings,
            self.size or size,
            backend=self.backend,
            threads=self.threads,
            samples=samples,
            antialiasing=method,
            transparent=transparent,
            report=report.frame if self.verbose else None,
        )


def viewing(args: argparse.Namespace, **more) -> Viewing:
    """Return the settings of the options; ``more`` are further fields of `Settings`."""
    lens, size = camera_options.lens_of(args)
    return Viewing(
        settings(args, **more),
        camera_options.first_view(args, lens),
        args.size or size,
        args.antialiasing,
        args.samples,
        args.backend,
        args.threads,
        args.verbose,
    )


def settings(args: argparse.Namespace, **more) -> Settings:
    from ....stage.stage_settings import Settings

    if args.light_position is not None and args.light_direction is not None:
        raise UsageError("--light-position and --light-direction do not go together")
    if None not in (args.near, args.far) and args.near >= args.far:
        raise UsageError("--near must be less than --far")
    return Settings(
        look=picture_options.look(args),
        material=scene_options.paint(args),
        appearance=appearance_options.appearance_of(args),
        up=args.up,
        background=environment_options.background(args),
        **environment_options.fog(args),
        light_position=args.light_position,
        light_direction=args.light_direction,
        light_intensity=args.light_intensity,
        light_clamp=args.light_clamp,
        shadow=args.shadow,
        surroundings=environment_options.surroundings(args),
        exposure=args.exposure,
        textures=not args.no_texture,
        filtering=appearance_options.filtering(args),
        near=args.near,
        far=args.far,
        grid=args.grid,
        axes=args.axis,
        **scalar_options.shown(args),
        metadata=args.metadata,
        ui_scale=args.ui_scale,
        **picture_options.theme(args),
        **more,
    )
