"""A chart of what `engine3d bench --json` or `against_llvmpipe.py --json` measured.

In:  a file with their JSON object, or - for standard input.
Out: a file; its suffix says whether it is SVG text or an image. Each workload is a group of bars:
     how many times as fast as the peer where there is one, else frames per second.
"""

import argparse
import json

import bar_chart


def bars(rows):
    """Return the title, the bars and their series, for `bar_chart.save`."""
    peers = [row["peer"]["name"] for row in rows if "peer" in row]
    series = list(dict.fromkeys(_series(row) for row in rows))
    groups = {}
    for row in rows:
        value = row["times_as_fast"] if peers else 1e3 / row["milliseconds"]
        groups.setdefault(row["workload"], {})[_series(row)] = value
    title = f"times as fast as {peers[0]}" if peers else "frames per second"
    return title, [(name, [g.get(one) for one in series]) for name, g in groups.items()], series


def _series(row):
    return f"{row['backend']} x{row['threads']}"


def main():
    parser = argparse.ArgumentParser(description="Draw a chart of what was measured.")
    parser.add_argument("figures", type=argparse.FileType(), help="JSON; - for standard input")
    parser.add_argument("chart", help=".svg, or an image: .png, .jpg, .webp")
    arguments = parser.parse_args()
    bar_chart.save(arguments.chart, *bars(json.load(arguments.figures)["rows"]))


if __name__ == "__main__":
    main()
