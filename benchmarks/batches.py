"""What a batch costs beside its pictures: handing them out, by processes and by Dask.

In:  the installed engine3d, with engine3d[dask] for the second.
Out: a table, or with --json one object: user time a picture of a plain loop, of two processes of a
     batch, and of two workers of Dask with their scheduler; what they take more than the loop.

The ways take turns, a batch each, and the fastest round of each counts. Processes are warm: what
their start takes is told apart. Dask's processes also take time while they wait, which grows with
how long a batch lasts, and so with what else the machine does: it is measured, and counted for as
long as the pictures take two processors that do nothing else.
"""

import argparse
import json
import os
import tempfile
import time
from pathlib import Path

from progress import tracked

from engine3d.apps.batch.drawing import How, draw_chunk
from engine3d.apps.batch.processes import ProcessPool
from engine3d.batch import Task, run
from engine3d.version import __version__

SCRIPT = Path(__file__).parent / "data_set" / "things.py"
SIZE = (320, 240)  # about 20 ms
WAIT = 2.0  # seconds
TICK = os.sysconf("SC_CLK_TCK")


def tasks(count):
    return [
        Task(name=f"p{seed}", script=str(SCRIPT), seed=seed, size=SIZE, index=seed)
        for seed in range(count)
    ]


def cpu_of(processes):
    """Seconds of user and system time that running processes have taken."""
    ticks = 0
    for process in processes:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / TICK


class Loop:
    """Pictures drawn one after the other by a process that does nothing else."""

    name = "loop"

    def __init__(self):
        self._pool = ProcessPool(1)

    def processes(self):
        return self._pool.process_ids()

    def draw(self, pictures, folder):
        how = How(folder, None, 1, "auto", False, __version__)
        outcomes = self._pool.submit(draw_chunk, pictures, how).result()
        assert all(outcome.drawn for outcome in outcomes)

    def stop(self):
        self._pool.stop()


class Batch:
    """Two processes of the batch's own."""

    name = "processes"

    def __init__(self):
        self._pool = ProcessPool(2)

    def processes(self):
        return [os.getpid(), *self._pool.process_ids()]

    def draw(self, pictures, folder):
        summary = run(pictures, folder, executor=self._pool, threads=1)
        assert summary.drawn == len(pictures)

    def stop(self):
        self._pool.stop()


class Dask:
    """Two workers of Dask, and its scheduler in this process."""

    name = "dask"

    def __init__(self):
        from distributed import Client, LocalCluster

        self._cluster = LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
        )
        self._client = Client(self._cluster, set_as_default=False)

    def processes(self):
        return [os.getpid(), *self._client.run(os.getpid).values()]

    def draw(self, pictures, folder):
        summary = run(pictures, folder, executor=self._client, threads=1)
        assert summary.drawn == len(pictures)

    def stop(self):
        self._client.close()
        self._cluster.close()


def measured(way, pictures, waiting, alone):
    """Milliseconds of processor time a picture; ``alone``: what a picture takes by itself."""
    with tempfile.TemporaryDirectory() as folder:
        processes = way.processes()
        before, start = cpu_of(processes), time.perf_counter()
        way.draw(pictures, folder)
        taken, lasted = cpu_of(processes) - before, time.perf_counter() - start
    shortest = 0.0 if alone is None else alone * len(pictures) / 1000.0 / 2
    return 1000.0 * (taken - waiting * (lasted - shortest)) / len(pictures)


def waiting_of(way):
    """Seconds of processor time that the processes of a way take in a second of waiting."""
    processes = way.processes()
    before, start = cpu_of(processes), time.perf_counter()
    time.sleep(WAIT)
    return (cpu_of(processes) - before) / (time.perf_counter() - start)


def one_round(ways, waits, count):
    """What a picture takes by each way, the loop first."""
    alone = measured(ways[0], tasks(count), 0.0, None)
    others = zip(ways[1:], waits[1:], strict=True)
    return [alone, *(measured(way, tasks(count), waiting, alone) for way, waiting in others)]


def started(make):
    """A way that has drawn some pictures, and the seconds of processor time that its start took."""
    start = cpu_of([os.getpid()])
    way = make()
    with tempfile.TemporaryDirectory() as folder:
        way.draw(tasks(8), folder)
    own = cpu_of([os.getpid()]) - start
    others = [process for process in way.processes() if process != os.getpid()]
    return way, own + (cpu_of(others) if others else 0.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--pictures", type=int, default=50)
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--without-dask", action="store_true")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    makes, report = [Loop, Batch], {"when": time.strftime("%Y-%m-%d"), "rows": []}
    if not arguments.without_dask:
        makes.append(Dask)
    ways, starts = zip(*map(started, makes), strict=True)
    waits = [waiting_of(way) for way in ways]
    turns = tracked(range(arguments.rounds), arguments.rounds, "drawing round by round")
    rounds = [one_round(ways, waits, arguments.pictures) for _ in turns]
    for number, way in enumerate(ways):
        fastest = min(times[number] for times in rounds)
        more = fastest / min(times[0] for times in rounds) - 1.0
        row = {"way": way.name, "ms_per_picture": fastest}
        row |= {"overhead": more, "start_seconds": starts[number]}
        row["waiting"] = waits[number]
        report["rows"].append(row)
        way.stop()
    if arguments.json:
        print(json.dumps(report, indent=2))
        return
    print(f"{'way':<12}{'ms a picture':>14}{'overhead':>10}{'waiting':>10}{'start, s':>10}")
    for row in report["rows"]:
        shares = f"{row['overhead']:>10.1%}{row['waiting']:>10.1%}"
        times = f"{row['ms_per_picture']:>14.1f}{shares}{row['start_seconds']:>10.2f}"
        print(f"{row['way']:<12}{times}")


if __name__ == "__main__":
    main()
