"""``engine3d sheet``: draws models from several sides on one sheet, with a report."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterable
from typing import Any

from ....base.files.atomic_write import atomic_write
from ....base.files.making_folders import make_folder_of
from ....errors import InvalidArgumentError
from ....model.materials.material import Material
from ...drawings.units import SUFFIXES
from ...sheet.contact_sheet import Sheet, contact_sheet
from ...sheet.opening import open_sources
from ...sheet.views import DEFAULT_VIEWS, check_views
from ..options import inspection_options
from ..options.drawing_options import drawing_keywords, is_drawing, looks
from ..options.input_options import model_files, of_robot
from ..options.picture_options import look
from ..options.scalar_options import marks
from ..outputs import (
    STANDARD_OUTPUT,
    check_folder,
    check_output,
    check_standard_output,
    is_same_file,
    write_standard_output,
)
from ..usage import UsageError


def sheet(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    if is_drawing(args):
        return _draw_lines(args)
    report = _check(args)
    drawn = contact_sheet(
        _models(args),
        **_of_model(args),
        size=args.size,
        look=look(args),
        material=None if args.color is None else Material(color=args.color),
        **marks(args),
        backend=args.backend,
        threads=args.threads,
    )
    _write(args.output, report, drawn)
    return 0


def _models(args: argparse.Namespace) -> list[Any]:
    """Return the models, opened if they are taken apart or measured."""
    files: list[Any] = list(model_files(args.models))
    if args.explode is None and not args.measure:
        return files
    opened = open_sources(files, root=args.root, **of_robot(args))
    for viewed in opened:
        viewed.unit = args.unit or viewed.unit
        inspection_options.tell_measures(args, viewed)
    return [inspection_options.inspected(viewed, args.explode) for viewed in opened]


def _of_model(args: argparse.Namespace) -> dict[str, Any]:
    """Return what is drawn of the model, in pixels or in lines."""
    return {
        "views": _views(args),
        "sections": args.section or (),
        "up": args.up,
        "unit": args.unit,
        "root": args.root,
        **of_robot(args),
    }


def _draw_lines(args: argparse.Namespace) -> int:
    """Write the lines of a model."""
    from ...drawings.drawing_sheet import drawing_sheet

    _check_views(args)
    in_vain = [name for name in ("json", "report", "size", "color") if getattr(args, name)]
    if in_vain or marks(args):
        option = in_vain[0] if in_vain else "scalar-coloring"
        raise UsageError(f"--{option} goes with pictures: -o FILE.png")
    if len(args.models) != 1:
        raise UsageError("a page of lines shows one MODEL")
    if args.output == STANDARD_OUTPUT:
        check_standard_output()
    else:
        check_folder(args.output)
        _refuse_models(args, [args.output])
    page = {} if args.page is None else {"page": args.page}
    drawn = drawing_sheet(
        _models(args),
        **_of_model(args),
        title=args.title,
        **page,
        **drawing_keywords(args),
        **looks(args),
    )
    if args.output == STANDARD_OUTPUT:
        write_standard_output(drawn.svg().encode())
    else:
        make_folder_of(args.output)
        drawn.save(args.output)
    return 0


def _views(args: argparse.Namespace) -> str:
    return DEFAULT_VIEWS if args.views is None else args.views


def _check(args: argparse.Namespace) -> str | None:
    """Refuse impossible options before any work; return the report's path."""
    _check_views(args)
    if args.output is None and args.report is None:
        raise UsageError("say where to write with -o FILE or --report FILE")
    report = args.report
    if args.json:
        if args.report is not None:
            raise UsageError("--json does not go with --report")
        if args.output in (None, STANDARD_OUTPUT):
            raise UsageError("--json goes with -o FILE; --report - writes to standard output")
        report = os.path.splitext(args.output)[0] + ".json"
    if args.output == STANDARD_OUTPUT == report:
        raise UsageError("standard output takes the picture or the report, not both")
    if args.output == STANDARD_OUTPUT:
        check_standard_output()
    elif args.output is not None:
        check_output(args.output, (".png", *SUFFIXES), "a sheet")
    if report not in (None, STANDARD_OUTPUT):
        check_folder(report)
    _refuse_models(args, filter(None, (args.output, report)))
    return report


def _check_views(args: argparse.Namespace) -> None:
    try:
        check_views(_views(args), args.section or ())
    except InvalidArgumentError as error:
        raise UsageError(f"--{error}") from None


def _refuse_models(args: argparse.Namespace, outputs: Iterable[str]) -> None:
    """Refuse to write to a model."""
    for output in outputs:
        if any(is_same_file(path, output) for path in args.models):
            raise UsageError(f"{output!r} is the model: write to another file")


def _write(output: str | None, report: str | None, drawn: Sheet) -> None:
    for path in (output, report):
        if path not in (None, STANDARD_OUTPUT):
            make_folder_of(path)
    if output not in (None, STANDARD_OUTPUT):
        drawn.save(output, None if report == STANDARD_OUTPUT else report)
    elif output == STANDARD_OUTPUT:
        write_standard_output(drawn.encode())
    if report == STANDARD_OUTPUT:
        write_standard_output(drawn.json().encode("ascii"))
    elif report is not None and output in (None, STANDARD_OUTPUT):
        with atomic_write(report) as file:
            file.write(drawn.json().encode("ascii"))
