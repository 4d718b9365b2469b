"""What -O0 to -O3, -march=native and the intrinsics each bring to the kernels.

In:  the C files of this checkout, a compiler, this CPU; the flags are those of csrc/build_rules.py.
Out: two tables, or with --json one object: nanoseconds for each kernel and way to build it, and
     frames a second of a whole picture; how many times as fast each is as the plain C of -O3
     (backend portable).

The timers (kernel_timer.c, frame_timer.c) and the rest of the core are always built alike: only the
file that holds the kernels of an instruction set takes the flags of its row. The hash of all
outputs tells whether the bytes are those of the first row: they are, unless the compiler may fuse
a * b + c, as the row that says so lets it.
"""

import argparse
import json
import os
import platform
import runpy
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from progress import tracked

ROOT = Path(__file__).resolve().parents[1]
RULES = runpy.run_path(str(ROOT / "csrc" / "build_rules.py"), run_name="rules")
MACHINE = RULES["MACHINE"]
ISA_FLAGS = RULES["isa_flags"](MACHINE)
BACKENDS = ["portable", *ISA_FLAGS]
LEVELS = ["-O0", "-O1", "-O2", "-O3"]
BASELINE = ("portable", "-O3")
LEANS_ON = {"avx512": ["avx512", "avx2"]}  # narrow pieces are rastered by the other table
# What compilers call an instruction set.
CPU_FEATURES = {"sse41": "sse4.1", "avx2": "avx2", "avx512": "avx512bw"}
CPU_LACKS_IT = 3  # exit status of the timer
TIMERS = {"kernels": "benchmarks/kernel_timer.c", "frame": "benchmarks/frame_timer.c"}
# What frames need beside the kernels, and of that what the kernels do.
CORE = [f"csrc/{room}/**/*.c" for room in ("base", "data", "frame", "reference")]
CORE += ["csrc/light/area_table.c", "csrc/light/dfg_table.c", "csrc/light/handle.c"]
# What the kernels alone are linked with.
TABLES = [
    "data_encode_tables",
    "data_light_points",
    "data_srgb_tables",
    "light_area_table",
    "light_dfg_table",
    "light_handle",
]
# Kernel -> its heading, and the element that a time is given for.
KERNELS = {
    "transform": ("transform", "vertex"),
    "record": ("record", "triangle"),
    "visible_large": ("visible", "sample"),
    "visible_small": ("visible", "small tri"),
    "texture": ("texture", "sample"),
    "light": ("light", "sample"),
    "encode": ("encode", "pixel"),
}
FRAMES = ("frames", "a second")


def builds(backends, levels):
    """Yield (backend, name of the row, flags), the slowest first."""
    native = ["-O3", "-march=native"]
    for backend in backends:
        for level in levels:
            yield backend, level, [level]
        if backend == "portable":
            yield backend, " ".join(native), native
    if "portable" in backends:
        yield "portable", "... and fused a*b + c", [*native, "-ffp-contract=fast"]


def common_flags():
    """Of all that is compiled."""
    flags = [*RULES["EXACT"], *RULES["HYGIENE"], "-w", "-pthread"]
    flags += [f"-I{ROOT / path}" for path in RULES["INCLUDE_DIRS"]]
    flags += ["-march=x86-64", "-mtune=generic"] if MACHINE == "X86" else []
    return [*flags, f"-DE3D_HAVE_{MACHINE}=1"] if MACHINE else flags


def build_core(compiler, folder, pool):
    """Compile what is the same for all rows; return the object files."""

    def compile_one(source):
        name = "_".join(source.relative_to(ROOT / "csrc").with_suffix(".o").parts)
        target = Path(folder) / name
        subprocess.run([compiler, *common_flags(), "-O2", "-c", source, "-o", target], check=True)
        return target

    sources = sorted(path for p in CORE for path in ROOT.glob(p))
    return list(tracked(pool.map(compile_one, sources), len(sources), "compiling the core"))


def build_timers(compiler, backend, flags, core, folder):
    """Compile the kernels with `flags`, link them with each timer, return the programs' paths."""
    objects = []
    for name in LEANS_ON.get(backend, [backend]):
        isa = ISA_FLAGS.get(name, [])
        source = ROOT / "csrc" / "kernels" / f"isa_{name}.c"
        objects.append(Path(folder) / f"{name}.o")
        command = [compiler, *common_flags(), *isa, *flags, "-c", source]
        subprocess.run([*command, "-o", objects[-1]], check=True)

    macros = [f"-DE3D_TABLE=e3d_kernels_{backend}", f"-DE3D_TIMED=E3D_BACKEND_{backend.upper()}"]
    if backend in CPU_FEATURES:
        macros.append(f'-DCPU_FEATURE="{CPU_FEATURES[backend]}"')
    programs = [Path(folder) / name for name in TIMERS]
    for program in programs:
        needed = core if program.name == "frame" else [o for o in core if o.stem in TABLES]
        linked = [ROOT / TIMERS[program.name], *objects, *needed]
        command = [compiler, *common_flags(), "-O2", *macros, *linked]
        subprocess.run([*command, "-lm", "-o", program], check=True)
    return programs


def run_timers(programs):
    """Return ({kernel: seconds an element}, hash of all outputs), or None without the ISA."""
    fields = []
    for program in programs:
        done = subprocess.run([program], capture_output=True, text=True)
        if done.returncode == CPU_LACKS_IT:
            return None
        done.check_returncode()
        fields += [line.split() for line in done.stdout.splitlines()]
    times = {name: float(took) / int(count) for name, count, took, _ in fields}
    return times, "-".join(output_hash for *_, output_hash in fields)


def measure(compiler, backends, levels):
    """Build everything, two at a time; then run one after the other. Yield a row for each."""
    rows = list(builds(backends, levels))
    with (
        tempfile.TemporaryDirectory() as top,
        ThreadPoolExecutor(RULES["usable_processors"]()) as pool,
    ):
        core = build_core(compiler, top, pool)
        folders = [Path(top) / str(k) for k in range(len(rows))]
        for folder in folders:
            folder.mkdir()
        jobs = [
            pool.submit(build_timers, compiler, backend, flags, core, folder)
            for (backend, _, flags), folder in zip(rows, folders, strict=True)
        ]
        programs = [job.result() for job in tracked(jobs, len(jobs), "compiling the kernels")]
        first_hash = None
        timed = tracked(zip(rows, programs, strict=True), len(rows), "measuring")
        for (backend, name, _), timers in timed:
            outcome = run_timers(timers)
            if outcome is None:
                print(f"this CPU lacks {backend}", file=sys.stderr)
                continue
            times, output_hash = outcome
            first_hash = first_hash or output_hash
            yield {
                "backend": backend,
                "flags": name,
                "frames_a_second": 1.0 / times.pop("frame"),
                "nanoseconds": {kernel: 1e9 * took for kernel, took in times.items()},
                "same_bytes": output_hash == first_hash,
            }


def print_table(rows, title, cell, frames):
    """Print one line a row: `cell(row, kernel)`, `frames(row)`, whether the bytes are equal."""
    print(f"\n{title}")
    for part, last in [(0, ""), (1, "bytes")]:
        headings = "".join(f"{heading[part]:>11}" for heading in [*KERNELS.values(), FRAMES])
        print(f"{'':<9}{'':<22}{headings}  {last}")
    for row in rows:
        cells = "".join(f"{cell(row, kernel):>11}" for kernel in KERNELS) + f"{frames(row):>11}"
        same = "same" if row["same_bytes"] else "other"
        print(f"{row['backend']:<9}{row['flags']:<22}{cells}  {same}")


def print_tables(rows):
    print_table(
        rows,
        "Nanoseconds, and frames a second",
        lambda row, kernel: f"{row['nanoseconds'][kernel]:.2f}",
        lambda row: f"{row['frames_a_second']:.0f}",
    )
    chosen = [row for row in rows if (row["backend"], row["flags"]) == BASELINE]
    if chosen:
        base, frames = chosen[0]["nanoseconds"], chosen[0]["frames_a_second"]
        print_table(
            rows,
            "Times as fast as " + " ".join(BASELINE),
            lambda row, kernel: f"{base[kernel] / row['nanoseconds'][kernel]:.2f}",
            lambda row: f"{row['frames_a_second'] / frames:.2f}",
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--compiler", default=os.environ.get("CC", "cc"))
    parser.add_argument("--backend", action="append", choices=BACKENDS, help="only these")
    parser.add_argument("--level", action="append", choices=[level[1:] for level in LEVELS])
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    arguments = parser.parse_args()
    levels = [f"-{level}" for level in arguments.level] if arguments.level else LEVELS
    rows = list(measure(arguments.compiler, arguments.backend or BACKENDS, levels))
    version = subprocess.run([arguments.compiler, "--version"], capture_output=True, text=True)
    compiler = version.stdout.splitlines()[0]
    if arguments.json:
        json.dump({"compiler": compiler, "machine": platform.machine(), "rows": rows}, sys.stdout)
        print()
    else:
        print(compiler)
        print_tables(rows)


if __name__ == "__main__":
    try:
        main()
    except FileNotFoundError as error:
        sys.exit(f"compiler_flags: {error.filename} is not installed")
    except subprocess.CalledProcessError as error:
        sys.exit(f"compiler_flags: {error}")
