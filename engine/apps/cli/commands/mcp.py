"""``engine3d mcp``: serves agents by the Model Context Protocol on standard input and output."""

from __future__ import annotations

import argparse

from ....base.optional_packages import needed
from ....errors import Engine3DError
from ...agents.server_limits import Limits
from ...agents.usual_limits import MEGABYTE


def mcp(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    limits = Limits(
        root=args.root,
        allow_scripts=args.allow_scripts,
        seconds=args.timeout,
        most_bytes=args.max_megabytes * MEGABYTE,
        most_triangles=args.max_triangles,
        most_side=args.max_side,
    )
    try:
        from ...agents.server import serve
    except ImportError as error:
        if (error.name or "").partition(".")[0] not in ("mcp", "pydantic", "typing_extensions"):
            raise
        raise Engine3DError(needed("the server needs version 2 of", "mcp", "mcp")) from None
    serve(limits)
    return 0
