"""Guard against regressions: today's ratios beside those of benchmarks/baseline.json.

In:  the stored ratios, each with its noise margin; the installed engine3d.
Out: a table, or with --json one object; exit status 1 if a ratio fell below the stored one by more
     than its margin, measured twice. Times are never compared; what this machine cannot measure is
     named and passed over. --update stores today's ratios instead.
"""

import argparse
import json
import sys
from pathlib import Path

from ratios import RATIOS, measure, peer_is_there, possible

import engine3d as e3d
from engine3d.apps.bench import figures
from engine3d.base.files.atomic_write import atomic_write

BASELINE = Path(__file__).with_name("baseline.json")
#: A margin is the spread of the rounds, but within these: parts of the stored ratio.
LEAST_MARGIN, MOST_MARGIN = 0.15, 0.40
LOST, KEPT, GAINED, NEW, MISSING = "slower", "", "faster", "new", "not measured"
SECONDS, QUICK_SECONDS = 3.0, 1.0


def verdict(stored, measured):
    """What became of a ratio.

    Parameters
    ----------
    stored : dict or None
        ``ratio`` and ``margin``.
    measured : dict or None
        ``ratio``.
    """
    if stored is None:
        return NEW
    if measured is None:
        return MISSING
    change = measured["ratio"] / stored["ratio"] - 1.0
    if change < -stored["margin"]:
        return LOST
    return GAINED if change > stored["margin"] else KEPT


def entry(measured):
    """What the baseline stores of a measured ratio."""
    margin = min(max(measured["spread"], LEAST_MARGIN), MOST_MARGIN)
    return {"ratio": round(measured["ratio"], 3), "margin": round(margin, 2)}


def compare(stored, measured, names):
    """Return a row for each name: the stored ratio, the measured one, the verdict."""
    return [
        {
            "name": name,
            "stored": stored.get(name),
            "measured": measured.get(name),
            "verdict": verdict(stored.get(name), measured.get(name)),
        }
        for name in names
    ]


def line(row):
    """A row as a line of the table."""
    stored, measured = row["stored"], row["measured"]
    before = f"{stored['ratio']:>8.2f} {stored['margin']:>6.0%}" if stored else " " * 15
    now = f"{measured['ratio']:>8.2f}" if measured else " " * 8
    change = f"{measured['ratio'] / stored['ratio'] - 1:>+7.0%}" if stored and measured else " " * 7
    return f"{row['name']:<46} {before} {now} {change}  {row['verdict']}".rstrip()


def updated(baseline, measured):
    """The baseline with today's ratios; those that were not measured stay as they were."""
    ratios = {**baseline.get("ratios", {}), **{k: entry(v) for k, v in measured.items()}}
    known = [ratio.name for ratio in RATIOS]
    kept = {name: ratios[name] for name in known if name in ratios}
    return {"measured on": figures.machine(), "ratios": kept}


def run(ratios, stored, seconds, show, measure=measure):
    """Measure and compare; what fell is measured once more, for longer, before it counts."""
    rows = []
    for ratio, can in ratios:
        measured = measure(ratio, seconds) if can else None
        if verdict(stored.get(ratio.name), measured) == LOST:
            measured = measure(ratio, 3 * seconds)
        rows += compare(stored, {ratio.name: measured}, [ratio.name])
        show(rows[-1])
    return rows


def parse():
    parser = argparse.ArgumentParser(description="Compare ratios of speed with stored ones.")
    parser.add_argument("--baseline", type=Path, default=BASELINE, metavar="FILE")
    parser.add_argument("--update", action="store_true", help="store what is measured")
    parser.add_argument("--quick", action="store_true", help="a few ratios, briefly")
    parser.add_argument("--seconds", type=float, help=f"a ratio (default: {SECONDS:g})")
    parser.add_argument("--only", metavar="TEXT", help="ratios whose names hold this")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser.parse_args()


def main():
    arguments = parse()
    baseline = json.loads(arguments.baseline.read_text()) if arguments.baseline.exists() else {}
    stored = {} if arguments.update else baseline.get("ratios", {})
    available, peer = e3d.backends(), peer_is_there()
    chosen = [
        (ratio, possible(ratio, available, peer))
        for ratio in RATIOS
        if (ratio.quick or not arguments.quick) and (arguments.only or "") in ratio.name
    ]

    def show(row):
        if not arguments.json:
            print(line(row), flush=True)

    if not arguments.json:
        about = baseline.get("measured on", {})
        print(
            f"stored: {about.get('processor', 'nothing')}; here: {figures.machine()['processor']}"
        )
        print(f"{'times as fast':<46} {'stored':>8} {'margin':>6} {'now':>8} {'change':>7}")
    rows = run(
        chosen, stored, arguments.seconds or (QUICK_SECONDS if arguments.quick else SECONDS), show
    )
    measured = {row["name"]: row["measured"] for row in rows if row["measured"]}
    if arguments.update:
        text = json.dumps(updated(baseline, measured), indent=2)
        with atomic_write(arguments.baseline) as file:
            file.write(text.encode() + b"\n")
    lost = [row["name"] for row in rows if row["verdict"] == LOST]
    if arguments.json:
        print(json.dumps({**figures.machine(), "rows": rows, "slower": lost}))
    elif lost:
        print(f"{len(lost)} slower than stored", file=sys.stderr)
    raise SystemExit(1 if lost else 0)


if __name__ == "__main__":
    main()
