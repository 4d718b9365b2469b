"""The options of ``engine3d diff``: reg-cli's names and letters."""

from __future__ import annotations

from .. import values


def add(command) -> None:
    """Add the options for inputs, tolerances and outputs."""
    command.add_argument(
        "pictures",
        metavar="PICTURES",
        nargs="*",
        help="what was drawn and what it should be, two pictures or two folders of them; and where "
        "pictures of the differences go, if they are to be kept",
    )
    _add_written(command.add_argument_group("what is written"))
    _add_allowed(command.add_argument_group("what may differ (nothing, unless it is said)"))
    group = command.add_argument_group("what is a failure")
    group.add_argument(
        "-I", "--ignoreChange", action="store_true", help="exit status 0 though pictures changed"
    )
    group.add_argument(
        "-E",
        "--extendedErrors",
        action="store_true",
        help="exit status 1 for new and deleted pictures, too",
    )
    group.add_argument(
        "-D", "--customDiffMessage", metavar="TEXT", help="a line to print where pictures changed"
    )
    group.add_argument(
        "-C",
        "--concurrency",
        type=values.thread_count,
        default=4,
        metavar="N",
        help="pictures that are compared at a time; 4 by default",
    )


def _add_written(group) -> None:
    group.add_argument(
        "-U",
        "--update",
        action="store_true",
        help="make what was drawn what is expected: copy, and remove what was deleted",
    )
    group.add_argument("-R", "--report", metavar="FILE", help="a report: one HTML file")
    group.add_argument("-J", "--json", metavar="FILE", help="the results as JSON")
    group.add_argument("--junit", metavar="FILE", help="the results as XML of JUnit")
    group.add_argument(
        "-F",
        "--from",
        dest="from_json",
        metavar="FILE",
        help="compare nothing, but write a report of the results in this JSON file",
    )


def _add_allowed(group) -> None:
    group.add_argument(
        "-M",
        "--matchingThreshold",
        type=values.fraction,
        metavar="D",
        help="distance of colours (YIQ), 0 to 1, that is no difference; antialiasing is none then",
    )
    group.add_argument(
        "-A",
        "--enableAntialias",
        action="store_true",
        help="count antialiasing with -M, too; without -M every pixel counts",
    )
    group.add_argument(
        "-T",
        "--thresholdRate",
        type=values.fraction,
        default=0.0,
        metavar="SHARE",
        help="share of the pixels that may differ, 0 to 1",
    )
    group.add_argument(
        "-S",
        "--thresholdPixel",
        type=values.whole,
        metavar="N",
        help="number of pixels that may differ; it takes precedence over -T",
    )
    group.add_argument(
        "--flip",
        type=values.fraction,
        metavar="D",
        help="mean FLIP error, 0 to 1, up to which pictures pass: pip install 'engine3d[flip]'",
    )
