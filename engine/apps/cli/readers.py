"""``engine3d --list-readers``: prints the readable formats."""

from __future__ import annotations

from ...io.loaders import formats


def list_readers() -> None:
    """Print the formats, one per line: name, kind, extensions, description."""
    rows = [
        (item.name, item.kind, " ".join(item.extensions), item.description) for item in formats()
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    for row in sorted(rows, key=lambda row: (row[1] != "mesh", row[0])):
        cells = [f"{cell:<{width}}" for cell, width in zip(row, widths, strict=False)]
        print("  ".join([*cells, row[3]]))
