"""The scenes of `engine3d bench` beside Mesa's llvmpipe, which draws them on the CPU by OpenGL.

In:  the installed engine3d; moderngl, EGL and the llvmpipe driver of Mesa.
Out: a table, or with --json one object: milliseconds of a frame of both, how many times as fast
     engine3d is, coverage and mean colour of both pictures.

Both draw the plain picture and take turns in one process, in several rounds; the median of the
rounds' ratios counts. Glass and ambient occlusion have no plain picture, and so no row.
"""

import argparse
import json
import statistics
import sys

import llvmpipe
import numpy as np

import engine3d as e3d
from engine3d.apps.bench import figures, measuring
from engine3d.apps.scenes import PLAIN_NAMES, workloads
from engine3d.model.materials.colors import linear_color

ROUNDS = 5
#: Both drew the same picture if coverage and mean colour differ by no more.
SAME_COVERED, SAME_MEAN = 0.002, 1.0


def compare(workload, size, peer, threads=0, seconds=2.0):
    """Return the figures of a workload beside those of a peer.

    Parameters
    ----------
    workload : Workload
        Made with ``plain=True``.
    peer
        Has ``name``; ``draw(frame)``, which returns an array; ``as_output(array)``, which makes
        of it what the workload's output would be.

    Returns
    -------
    dict
        As of `measuring.measure`, with ``peer``: its ``name``, ``frames``, ``milliseconds``,
        ``picture``; ``times_as_fast``, the median over rounds; ``picture``: what `describe`
        returns.
    """
    drawing = measuring.Drawing(workload, size, threads=threads)
    try:
        ours, theirs = measuring.Timer(drawing), measuring.Timer(peer)
        slow = [timer.warm_up() for timer in (ours, theirs)]
        pictures = [ours.picture, peer.as_output(theirs.picture)]
        pictures = [describe(picture, workload) for picture in pictures]
        if any(slow):
            for timer in (ours, theirs):
                if not timer.milliseconds:
                    timer.run(0.0)
            ratios = [theirs.median / ours.median]
        else:
            share = seconds / ROUNDS / 2
            ratios = [theirs.run(share, 1) / ours.run(share, 1) for _ in range(ROUNDS)]
    finally:
        drawing.close()
    row = measuring.figures(workload, size, ours)
    row["picture"] = pictures[0]
    row["peer"] = {
        "name": peer.name,
        "frames": len(theirs.milliseconds),
        "milliseconds": theirs.median,
        "picture": pictures[1],
    }
    row["times_as_fast"] = statistics.median(ratios)
    return row


def describe(picture, workload):
    """Return the share of a picture that is covered, and the mean of its channels."""
    if picture.ndim == 3:
        background = 255 * linear_color(workload.scene.background, "linear") + 0.5
        colors = picture[:, :, :3].astype(np.int16)
        covered = (np.abs(colors - background.astype(np.int16)) > 1).any(axis=2)
        mean = colors.mean(axis=(0, 1))
    else:
        covered = np.isfinite(picture) if picture.dtype.kind == "f" else picture >= 0
        mean = picture[covered].mean(keepdims=True) if covered.any() else np.zeros(1)
    return {"covered": float(covered.mean()), "mean": [float(value) for value in mean]}


def same_picture(row):
    """Whether both drew the same, as far as coverage and mean tell."""
    ours, theirs = row["picture"], row["peer"]["picture"]
    covered = abs(ours["covered"] - theirs["covered"])
    means = zip(ours["mean"], theirs["mean"], strict=True)
    return covered <= SAME_COVERED and all(abs(a - b) <= SAME_MEAN for a, b in means)


def columns():
    """The line of the table that names its columns."""
    figures = f"{'workload':<15} {'threads':>7} {'ms':>8} {'peer ms':>9} {'times':>6}"
    return f"{figures}   covered, mean colour of both"


def line(row):
    """A row as a line of the table."""
    texts = []
    for picture in (row["picture"], row["peer"]["picture"]):
        mean = " ".join(f"{value:.4g}" for value in picture["mean"])
        texts.append(f"{picture['covered']:.4f} ({mean})")
    pictures = " ".join(texts) + ("" if same_picture(row) else "  the pictures differ")
    return (
        f"{row['workload']:<15} {row['threads']:>7} {row['milliseconds']:>8.2f} "
        f"{row['peer']['milliseconds']:>9.2f} {row['times_as_fast']:>6.2f}   {pictures}"
    )


def measure(arguments):
    """Yield a row for each workload."""
    for name in arguments.workload or PLAIN_NAMES:
        made = workloads.make(name, plain=True)
        peer = llvmpipe.Peer(made, arguments.size, arguments.threads)
        try:
            size, threads = arguments.size, arguments.threads
            yield compare(made, size, peer, threads, arguments.seconds)
        finally:
            peer.close()


def picture_size(text):
    width, height = text.lower().split("x")
    return int(width), int(height)


def main():
    parser = argparse.ArgumentParser(description="Measure engine3d beside Mesa's llvmpipe.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--workload", action="append", choices=PLAIN_NAMES, help="by default all")
    parser.add_argument("--threads", type=int, default=0, help="of both (default: all CPUs)")
    parser.add_argument("--size", type=picture_size, default=(1920, 1080), metavar="WxH")
    parser.add_argument("--seconds", type=float, default=2.0, help="a row (default: 2)")
    arguments = parser.parse_args()
    try:
        llvmpipe.open_context(arguments.threads).release()
    except e3d.Engine3DError as error:
        raise SystemExit(str(error)) from None
    rows = []
    if not arguments.json:
        print("\n".join(figures.heading(arguments.size, "plain")), end="\n\n")
        print(columns())
    for row in measure(arguments):
        rows.append(row)
        if not arguments.json:
            print(line(row), flush=True)
    if arguments.json:
        settings = {"size": arguments.size, "picture": "plain"}
        json.dump({**figures.machine(), **settings, "rows": rows}, sys.stdout)
        print()


if __name__ == "__main__":
    main()
