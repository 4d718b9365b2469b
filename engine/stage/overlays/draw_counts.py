"""The counters of a frame: nodes, clusters and triangles at each stage.

In: `Frame.stats`. Out: a table and a sentence for the overlay, and a line for the log.
"""

from __future__ import annotations

from typing import Any

from ...base.language import translated, translated_choice, translated_count, translated_number

#: What `--verbose` counts at each stage of culling.
COUNTED = ("nodes", "clusters", "triangles")
STAGES = {
    "total": "",
    "in frustum": "_in_frustum",
    "unoccluded": "_unoccluded",
    "drawn": "_drawn",
}
#: The columns of the table, and of each row the counters in them. A draw call draws a node with all
#: of its instances; then batching joins the nodes of a mesh.
COLUMNS = ("of all", "in view", "drawn")
ROWS = {
    "objects": ("objects", "nodes_in_frustum", "nodes_drawn"),
    "instances": ("instances", "instances_in_frustum", "instances_drawn"),
    "triangles": ("triangles", "triangles_in_frustum", "triangles_drawn"),
    "clusters": ("clusters", "clusters_in_frustum", "clusters_drawn"),
    "draw calls": ("objects", "draws_unbatched", "draws"),
}

#: What tests found the nodes in view, by the culling method; that of the others is the last.
TESTS = {
    "none": "nothing is left out: no box was tested",
    "frustum": "{tested}, one by one",
    "tree": "{tested}, by the tree",
}
EVERY_TEST = "{tested}, by the tree; then parts of meshes, and what is hidden"


def count_names() -> set[str]:
    """Return the names of all counters of the table."""
    return {name for row in ROWS.values() for name in row}


def count_table(stats: dict[str, Any]) -> list[str]:
    """Return the table: a header line, and a line for each kind of things."""
    rows = [f"{'':<10}" + "".join(f"{translated(column):>12}" for column in COLUMNS)]
    for what, names in ROWS.items():
        numbers = (translated_number(stats[name], ">12,") for name in names)
        rows.append(f"{translated(what):<10}" + "".join(numbers))
    return rows


def told_tests(stats: dict[str, Any], culling: str) -> str:
    """Return a sentence on how many tests found the nodes in view."""
    tested = translated_count(
        "{count:,} box tested", "{count:,} boxes tested", stats["boxes_tested"]
    )
    return translated(
        "culling {method}: {effect}",
        method=translated_choice("culling", culling),
        effect=translated(TESTS.get(culling, EVERY_TEST), tested=tested),
    )


def count_line(stats: dict[str, Any]) -> str:
    """Return the counts in one line, with tests, materials and lights."""
    parts = []
    for what in COUNTED:
        stages = (f"{stats[what + ending]} {stage}" for stage, ending in STAGES.items())
        parts.append(f"{what} {', '.join(stages)}")
    parts.append(f"boxes tested {stats['boxes_tested']}")
    parts += [f"{what} {stats[what]}" for what in ("materials", "lights")]
    return "; ".join(parts)
