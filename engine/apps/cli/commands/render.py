"""``engine3d render``: writes a picture, a turntable or a line drawing, or prints a picture."""

from __future__ import annotations

import argparse
import shlex
import time

from ....base.files.making_folders import make_folder_of
from ....base.files.watch import CHECK_SECONDS, FileWatch
from ....errors import printable
from ....io.output.animation_files import ANIMATION_SUFFIXES, PICTURE_SUFFIXES, save_animation
from ....stage import headless
from ....stage.view_renderer import ViewRenderer
from ....stage.viewed_scene import NotInModelError
from ....stage.views.viewpoint import Viewpoint
from ...drawings.units import SUFFIXES
from ..one_by_one import draw_each, tried
from ..options import inspection_options, scene_options
from ..options import shared_options as options
from ..options.drawing_options import drawing_keywords, is_drawing, looks
from ..options.input_options import STANDARD_INPUT, jobs
from ..options.picture_options import PICTURE
from ..outputs import (
    STANDARD_OUTPUT,
    TERMINAL,
    check_animation,
    check_folder,
    check_picture,
    check_standard_output,
    remark_on_size,
    with_progress,
    write_standard_output,
)
from ..quietness import remark
from ..said import say
from ..usage import UsageError
from ..verbose_report import Report, warn_of_nothing

DEFAULT_SIZE = (1280, 720)


def render(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    if args.watch and (not args.models or STANDARD_INPUT in args.models):
        raise UsageError("--watch needs a MODEL that is a file")
    found = jobs(args)
    for job in found:
        _check(job)
    if len(found) == 1 and not args.watch:
        return _render(found[0])
    # Watch files from before they are read: changes meanwhile cause a new drawing.
    files = [[FileWatch(name) for name in job.models] for job in found] if args.watch else None
    status = draw_each(_render, found)
    if files is not None:
        _watch(list(zip(found, files, strict=True)))
    return status


def _watch(watched: list[tuple[argparse.Namespace, list[FileWatch]]]) -> None:
    """Redraw the pictures of changed files until interrupted."""
    while True:
        time.sleep(CHECK_SECONDS)
        for job, files in watched:
            # check all, since each reports a change only once
            changed = [file.changed() for file in files]
            if any(changed) and not any(file.missing for file in files):
                if not tried(_render, job) and job.output is not None:
                    remark(f"wrote {job.output}")


def _render(args: argparse.Namespace) -> int:
    report = Report(args.verbose)
    viewed = scene_options.viewed_scene(args)
    report.loaded(viewed)
    if viewed.update is not None:
        viewed.update(0.0)  # as pictures show it
    inspection_options.tell_measures(args, viewed)
    viewed = inspection_options.inspected(viewed, args.explode, args.section)
    how = options.viewing(args, **inspection_options.sizes(args))
    with how.renderer(
        viewed, DEFAULT_SIZE, PICTURE, report, transparent=args.no_background
    ) as view_renderer:
        view = how.first_view.place(view_renderer, turns=args.turntable is not None)
        if is_drawing(args):
            _write_lines(args, view_renderer, view)
            return 0
        if _count(args) is not None:
            _write_pictures(args, view_renderer, view)
            warn_of_nothing(view_renderer)
            return 0
        if args.output == TERMINAL:
            _print_picture(view_renderer, view)
            warn_of_nothing(view_renderer)
            return 0
        frame = view_renderer.draw(view)
        report.drawn(view_renderer, frame)
        warn_of_nothing(view_renderer)
    _write_picture(args, frame)
    return _compare(args, frame.color)


def _check(args: argparse.Namespace) -> None:
    """Refuse impossible outputs before any work."""
    inspection_options.check(args)
    if args.reference_threshold is not None and args.reference is None:
        raise UsageError("--reference-threshold goes with --reference")
    if None not in (args.turntable, args.animation) and args.turntable != args.animation:
        raise UsageError("--turntable and --animation together need the same N")
    many = "--animation" if args.turntable is None else "--turntable"
    if args.output is None:
        if args.reference is None or _count(args) is not None:
            raise UsageError(f"say where to write with -o FILE{_meant(args.models)}")
        return
    if _count(args) is not None:
        if args.output in (STANDARD_OUTPUT, TERMINAL) or args.reference is not None:
            raise UsageError(f"{many} writes to a file, and compares with none")
        check_animation(args.output, transparent=args.no_background)
        return
    if is_drawing(args):
        if args.reference is not None:
            raise UsageError("--reference compares pictures, not line drawings")
        check_folder(args.output)
        return
    if args.output == STANDARD_OUTPUT:
        check_standard_output()
        return
    if args.output == TERMINAL:
        if args.reference is not None:
            raise UsageError(f"-o {TERMINAL} compares with nothing: its size is the terminal's")
        return
    check_picture(args.output, transparent=args.no_background, series="--turntable N")


def _meant(models: list[str]) -> str:
    """Return the corrected command, with ``-o``, if one of several models is plainly a picture."""
    suffixes = (*PICTURE_SUFFIXES, *ANIMATION_SUFFIXES, *SUFFIXES)
    pictures = [name for name in models if name.lower().endswith(suffixes)]
    others = [name for name in models if name not in pictures]
    if len(pictures) != 1 or not others:
        return ""
    return printable(f": engine3d render {shlex.join(others)} -o {shlex.join(pictures)}")


def _count(args: argparse.Namespace) -> int | None:
    """Return the number of pictures; None for a single one."""
    return args.animation if args.turntable is None else args.turntable


def _write_pictures(args: argparse.Namespace, view_renderer: ViewRenderer, view) -> None:
    count = _count(args)
    if args.turntable is not None:
        pictures = headless.turntable(view_renderer, view, count, args.animation_time or 0.0)
    elif view_renderer.viewed.update is None:
        raise NotInModelError(f"--animation: {view_renderer.viewed.title} has no animation")
    else:
        pictures = headless.animation(view_renderer, view, count, args.animation_time or 0.0)
    pictures = with_progress(pictures, count, "rendering")
    make_folder_of(args.output)
    save_animation(pictures, args.output, headless.seconds_a_frame(view_renderer, count))
    remark_on_size(args.output)


def _write_lines(args: argparse.Namespace, view_renderer: ViewRenderer, view: Viewpoint) -> None:
    """Write what a view shows as lines."""
    from ...drawings.line_drawing import draw_lines

    seen = view_renderer.camera(view), view.pose()
    drawn = draw_lines(view_renderer.viewed, seen, view_renderer.size, **drawing_keywords(args))
    make_folder_of(args.output)
    drawn.save(args.output, **looks(args))


def _print_picture(view_renderer: ViewRenderer, view) -> None:
    """Show a picture in the terminal, fitted to its size."""
    from ...terminal.printing import print_picture

    def draw(size):
        view_renderer.resize(size)
        return view_renderer.draw(view).color

    print_picture(draw, view_renderer.aspect)


def _write_picture(args: argparse.Namespace, frame) -> None:
    if args.output == STANDARD_OUTPUT:
        write_standard_output(frame.encode("png"))
    elif args.output is not None:
        make_folder_of(args.output)
        frame.save(args.output)


def _compare(args: argparse.Namespace, pixels) -> int:
    """Compare with the reference, if given; return the exit status."""
    if args.reference is None:
        return 0
    from ....io.loaders import load_texture
    from ...golden.comparison import compare, root_mean_square

    reference = load_texture(args.reference).pixels
    apart = root_mean_square(pixels, reference)
    if apart <= (args.reference_threshold or 0.0):
        return 0
    found = compare(pixels, reference)
    told = f"it differs by {apart:.6g} ({found.different} of {found.total} pixels)"
    say(f"error: {args.reference}: {found.kinds or told}")
    return 1
