"""``engine3d plugins``: lists what installed packages add, and whether it can be imported."""

from __future__ import annotations

import argparse
import json
import time
from collections import Counter

from ....base.plugins.groups import API, GROUPS
from ....base.plugins.plugin import Plugin
from ....base.plugins.registry import listed
from ....errors import PluginError, printable


def plugins(args: argparse.Namespace) -> int:
    """Run the command; return the exit status: 1 if a plug-in cannot be used."""
    reports = [describe(plugin) for plugin in listed()]
    if args.json:
        print(json.dumps({"contract": API, "plugins": reports}, indent=2))
    else:
        print("\n".join(map(printable, _lines(reports))))
    return 1 if any(report["problem"] for report in reports) else 0


def describe(plugin: Plugin) -> dict:
    """Return what is known of a plug-in, in JSON types; it is imported for that.

    ``problem`` is None for those that can be used, ``milliseconds`` None for those that cannot be
    imported.
    """
    start, problem, taken = time.perf_counter(), _unused(plugin), None
    try:
        plugin.load()
        taken = round(1000 * (time.perf_counter() - start), 1)
    except PluginError as error:
        problem = str(error)
    return {
        "group": GROUPS[plugin.group].entry_points,
        "name": plugin.name,
        "package": plugin.package,
        "version": plugin.version,
        "about": plugin.about,
        "milliseconds": taken,
        "problem": problem,
    }


def _unused(plugin: Plugin) -> str | None:
    """Return why a plug-in is not used, whatever it holds; None if it is."""
    if plugin.name in GROUPS[plugin.group].shipped_names():
        return f"{plugin} is never used: engine3d itself has {plugin.name!r}"
    if not GROUPS[plugin.group].allows(plugin.name):
        kind = GROUPS[plugin.group].names.rstrip(",")
        return f"{plugin} is never used: {plugin.name!r} is not {kind}"
    names = Counter((one.group, one.name) for one in listed())
    if names[plugin.group, plugin.name] > 1:
        return f"{plugin} is not used: another package adds {plugin.name!r}, too"
    return None


def _lines(reports: list[dict]) -> list[str]:
    """Return a line for each plug-in, and one more where there is a problem."""
    if not reports:
        return ["no plug-ins"]
    rows = [
        (each["group"], each["name"], f"{each['package']} {each['version']}") for each in reports
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    lines = []
    for row, report in zip(rows, reports, strict=True):
        taken = report["milliseconds"]
        state = "broken" if taken is None else f"imported in {taken:g} ms"
        cells = [f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)]
        lines.append("  ".join([*cells, state]))
        lines += [f"    {report['problem']}"] if report["problem"] else []
    return lines
