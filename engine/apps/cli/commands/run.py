"""``engine3d run``: opens a window, or without a screen writes an animation."""

from __future__ import annotations

import argparse
import math
import os
from pathlib import Path

from ....base.files.making_folders import make_folder_of
from ....base.language import ENGLISH, speaking, translated
from ....errors import DisplayError
from ....io.output.animation_files import numbered_path, save_animation
from ....io.output.frame_names import literal_name
from ....stage import headless
from ....stage.view_renderer import ViewRenderer
from ....stage.views.walking import GroundController, controller, walk
from ..one_by_one import draw_each
from ..options import scene_options
from ..options import shared_options as options
from ..options.input_options import STANDARD_INPUT, jobs
from ..options.language_options import language_of
from ..options.picture_options import WINDOW
from ..options.shared_options import Viewing
from ..outputs import check_animation, check_picture, remark_on_size, with_progress
from ..quietness import remark
from ..usage import UsageError
from ..verbose_report import Report, warn_of_nothing

WINDOW_SIZE = (1280, 720)
#: Default size of a turntable in place of a window: small, to be fast.
FILE_SIZE = (640, 360)
FILE_FRAMES = 48
FILE_SAMPLES = 4


def run(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    found = jobs(args)
    for job in found:
        _check(job)
    reason = None if args.headless or args.terminal else _missing_screen()
    if args.headless and len(found) > 1:
        return draw_each(lambda job: _run(job, found, reason), found)
    # What is written to a file says the same in every locale.
    has_window = not args.headless and reason is None
    with speaking(language_of(found[0]) if has_window else ENGLISH):
        return _run(found[0], found, reason)


def _run(args: argparse.Namespace, found: list[argparse.Namespace], reason: str | None) -> int:
    """Show the first of several models, or write one of them."""
    report = Report(args.verbose)
    viewed = scene_options.viewed_scene(args, default_scene="default")
    report.loaded(viewed)
    if not args.headless and reason is None:
        try:
            _show(args, found, viewed, report)
            return 0
        except DisplayError as error:
            if args.terminal:
                raise
            reason = str(error)
            with speaking(ENGLISH):  # as in files that no window was meant to be instead of
                viewed = scene_options.viewed_scene(args, default_scene="default")
                return _write(args, viewed, reason, report)
    return _write(args, viewed, reason, report)


def _check(args: argparse.Namespace) -> None:
    if args.terminal and (args.headless or args.size is not None):
        other = "--headless" if args.headless else "--size"
        raise UsageError(
            f"--terminal shows what the terminal has room for: {other} goes without it"
        )
    if args.output is not None:
        if not args.headless:
            raise UsageError("-o goes with --headless")
        if args.frames == 1:
            check_picture(args.output, series="--frames 2 or more")
        else:
            check_animation(args.output)
    for option, given in (("--watch", args.watch), ("--fps", args.fps)):
        if given and args.headless:
            raise UsageError(f"{option} needs a window: it does not go with --headless")
    if args.scene == "city" and (args.walkable is not None or args.slope is not None):
        raise UsageError("--walkable and --slope need a MODEL: the city knows its own ground")
    if args.watch and (not args.models or STANDARD_INPUT in args.models):
        raise UsageError("--watch needs a MODEL that is a file")


def _missing_screen() -> str | None:
    """Return why no window can open, without loading SDL, or None."""
    from ...viewer.sdl import find_screen

    try:
        find_screen()
    except DisplayError as error:
        return str(error)
    return None


def _viewing(args: argparse.Namespace) -> Viewing:
    """Return the drawing and walking settings from the options."""
    return options.viewing(
        args,
        walks=args.camera == "fps" or args.walkable is not None or args.slope is not None,
        walkable=args.walkable,
        slope=None if args.slope is None else math.radians(args.slope),
    )


def _show(
    args: argparse.Namespace, found: list[argparse.Namespace], viewed, report: Report
) -> None:
    """Open a window and run it until it closes."""
    from ....stage.views.walkable_ground import told
    from ...desktop.recent_files import RecentFiles
    from ...viewer.model_files import ModelFiles
    from ...viewer.sampling import AT_REST, Sampling
    from ...viewer.viewer import HINT, Viewer

    how = _viewing(args)
    with (
        _window(args, viewed) as window,
        how.renderer(viewed, window.size, (WINDOW, AT_REST), report) as view_renderer,
    ):
        viewer = Viewer(
            view_renderer,
            window,
            view=how.first_view.place(view_renderer),
            walking=args.camera == "fps",
            playing=args.animate,
            statistics=args.fps,
            files=ModelFiles(
                args.models,
                listed=[job.models[0] for job in found if len(found) > 1],
                watch=args.watch,
                remembered=True,
                **scene_options.opening(args),
            ),
            sampling=Sampling(1 if args.antialiasing == "none" else args.samples),
        )
        viewer.controls.shown = args.controls and not args.terminal
        viewer.time = (args.animation_time or 0.0) % viewed.period
        if STANDARD_INPUT not in args.models:
            RecentFiles().add(*args.models)
        still = viewed.update is not None and not viewer.playing
        if viewer.walker is None:
            viewer.say("H, F1 or /: all commands; Space: play" if still else HINT)
        elif isinstance(viewer.walker, GroundController):
            report.line(told(viewer.walker.grid))
        _run_viewer(viewer, args)


def _run_viewer(viewer, args: argparse.Namespace) -> None:
    """Run the viewer; print why the first frame is blank, if it is."""
    if args.frames == 0:
        return
    viewer.run(1)
    # In a terminal viewer, no other lines can be printed.
    ask = ViewRenderer.why_blank if args.terminal else warn_of_nothing
    reason = ask(viewer.view_renderer)
    if reason is not None:
        viewer.say("nothing shows: {reason}", reason=translated(reason.sentence))
    viewer.run(None if args.frames is None else args.frames - 1)


def _window(args: argparse.Namespace, viewed):
    """Return a window, or the terminal that replaces it."""
    if args.terminal:
        from ...terminal.terminal_window import TerminalWindow

        return TerminalWindow()
    from ...viewer.program_window import ProgramWindow

    title = f"{viewed.title} - engine3d"
    return ProgramWindow(args.size, WINDOW_SIZE, title, ui_scale=args.ui_scale, vsync=args.vsync)


def _write(args: argparse.Namespace, viewed, reason: str | None, report: Report) -> int:
    """Write an animation instead, and print its path; ``reason`` says why no window opened."""
    count = args.frames or FILE_FRAMES
    path = args.output or literal_name(_new_path(viewed, count))
    if reason is not None:
        remark(f"{reason}: rendering a turntable to {path} instead")
    how = _viewing(args)
    with how.renderer(viewed, FILE_SIZE, ("msaa", FILE_SAMPLES), report) as view_renderer:
        view = how.first_view.place(view_renderer)
        walks = args.camera == "fps"
        if count == 1:
            if walks:
                controller(view_renderer, view).place(view)
            make_folder_of(path)
            view_renderer.draw(view).save(path)
        else:
            start = () if walks else (args.animation_time or 0.0,)
            draw = walk if walks else headless.animation
            pictures = draw(view_renderer, view, count, *start)
            pictures = with_progress(pictures, count, "rendering")
            make_folder_of(path)
            save_animation(pictures, path, headless.seconds_a_frame(view_renderer, count))
            remark_on_size(os.fspath(path))
        warn_of_nothing(view_renderer)
    if reason is None and args.output is None:
        remark(f"wrote {path}")
    return 0


def _new_path(viewed, count: int) -> Path:
    """Return an unused file name in the current folder."""
    stem = f"{Path(viewed.title).stem}-turntable"
    return numbered_path(Path(), stem, ".png" if count == 1 else ".gif")
