"""One thread against several while other programs use the CPUs.

In:  the installed engine3d; so many processes beside that count in a loop.
Out: a table, or with --json one object: the median milliseconds of a frame of each workload with
     one thread and with several, and how many times as fast these are. Both take turns, since what
     a scheduler gives a program changes from second to second; the medians of the rounds count.
"""

import argparse
import contextlib
import json
import statistics
import subprocess
import sys

from engine3d.apps.bench import figures, measuring
from engine3d.apps.scenes import WORKLOAD_NAMES, workloads
from engine3d.base.system import usable_processors

SIZE = (1280, 720)
WORKLOADS = ("textured", "mesh", "city-street")
#: Counts until the process that started it is gone.
LOOP = "import os\nparent = os.getppid()\nwhile os.getppid() == parent: sum(range(10**6))"


@contextlib.contextmanager
def others(count, apart):
    """So many busy processes; apart: a session each, which some schedulers give a share as such."""
    command = [sys.executable, "-c", LOOP]
    started = [subprocess.Popen(command, start_new_session=apart) for _ in range(count)]
    try:
        yield
    finally:
        for process in started:
            process.kill()
            process.wait()


def measure(name, threads, rounds, seconds):
    """A row of figures."""
    made = workloads.make(name)
    drawings = [measuring.Drawing(made, SIZE, threads=count) for count in (1, threads)]
    timers = [measuring.Timer(drawing) for drawing in drawings]
    taken = [[], []]
    for timer in timers:
        timer.warm_up()
    for _ in range(rounds):
        for timer, medians in zip(timers, taken, strict=True):
            medians.append(timer.run(seconds))
    for drawing in drawings:
        drawing.close()
    one, several = map(statistics.median, taken)
    row = {"workload": name, "threads": threads, "one_milliseconds": one}
    return row | {"several_milliseconds": several, "times_as_fast": one / several}


def line(row):
    return (
        f"{row['workload']:<15} {row['threads']:>7} {row['one_milliseconds']:>11.2f} "
        f"{row['several_milliseconds']:>11.2f} {row['times_as_fast']:>13.2f}"
    )


def main():
    cpus = usable_processors()
    parser = argparse.ArgumentParser(description="Measure threads while other programs run.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument(
        "--workload", action="append", choices=WORKLOAD_NAMES, help="by default three"
    )
    parser.add_argument("--busy", type=int, default=cpus, help="processes (default: one a CPU)")
    parser.add_argument("--apart", action="store_true", help="each of them in a session of its own")
    parser.add_argument("--threads", type=int, default=max(cpus, 2), help="by default all CPUs")
    parser.add_argument("--rounds", type=int, default=5, help="by default 5")
    parser.add_argument("--seconds", type=float, default=1.0, help="a round (default: 1)")
    arguments = parser.parse_args()
    rows = []
    if not arguments.json:
        print(f"{arguments.busy} others beside")
        print(
            f"{'':<15} {'threads':>7} {'1 thread ms':>11} {'several ms':>11} {'times as fast':>13}"
        )
    with others(arguments.busy, arguments.apart):
        for name in arguments.workload or WORKLOADS:
            rows.append(measure(name, arguments.threads, arguments.rounds, arguments.seconds))
            if not arguments.json:
                print(line(rows[-1]), flush=True)
    if arguments.json:
        json.dump({**figures.machine(), "busy": arguments.busy, "rows": rows}, sys.stdout)
        print()


if __name__ == "__main__":
    main()
