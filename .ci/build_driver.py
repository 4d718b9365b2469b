#!/usr/bin/env python3
"""Builds csrc/driver/ and the C core into one program, without Python's own flags.

In:  --output FILE, --compiler CC (a cross compiler too), --static, --fuzz (libFuzzer's entry, with
     clang only), and ENGINE3D_BUILD as in setup.py, which also gives the libraries and the flags.
Out: the program. Nothing is kept between runs.
"""

import argparse
import os
import runpy
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# Comparisons aren't traced: nearly all are of pixels, and the tracing takes most of the time.
FUZZ_FLAGS = ["-fsanitize=fuzzer-no-link", "-fno-sanitize-coverage=trace-cmp"]


def rules_for(compiler):
    """The globals of setup.py, as if it were run on the processor that `compiler` compiles for."""
    rules = runpy.run_path(str(ROOT / "setup.py"), run_name="rules")
    machine = subprocess.run([compiler, "-dumpmachine"], capture_output=True, text=True, check=True)
    # The functions of setup.py read this name from their own globals.
    rules["static_libraries"].__globals__["IS_X86_64"] = machine.stdout.startswith("x86_64")
    return rules


def compile_all(compiler, rules, extra, folder):
    """Compile the core and the driver; return the objects."""
    other = "driver.c" if extra == FUZZ_FLAGS else "fuzz.c"
    driver = [str(path) for path in Path("csrc/driver").glob("*.c") if path.name != other]
    jobs = [(source, [*rules["WARNINGS"], *rules["common_flags"]()], []) for source in driver]
    for _, info in rules["static_libraries"]():
        macros = [f"-D{name}={value}" for name, value in info["macros"]]
        jobs += [(source, info["cflags"], macros) for source in info["sources"]]
    includes = [f"-I{folder}" for folder in rules["INCLUDE_DIRS"]]

    def compile_one(job):
        source, flags, macros = job
        target = str(Path(folder) / (source.replace("/", "_") + ".o"))
        command = [compiler, *macros, *includes, *flags, *extra, "-c", source, "-o", target]
        subprocess.run(command, check=True)
        return target

    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        return list(pool.map(compile_one, jobs))


def main():
    parser = argparse.ArgumentParser(description="Build the C driver.")
    parser.add_argument("--output", required=True, type=Path)
    parser.add_argument("--compiler", default=os.environ.get("CC", "cc"))
    parser.add_argument("--fuzz", action="store_true")
    parser.add_argument("--static", action="store_true")
    arguments = parser.parse_args()
    output = arguments.output.resolve()
    os.chdir(ROOT)
    rules = rules_for(arguments.compiler)
    extra = FUZZ_FLAGS if arguments.fuzz else []
    link = ["-fsanitize=fuzzer"] if arguments.fuzz else []
    link += ["-static"] if arguments.static else []
    with tempfile.TemporaryDirectory() as folder:
        objects = compile_all(arguments.compiler, rules, extra, folder)
        command = [arguments.compiler, *rules["common_flags"](), *link, *objects, "-lm"]
        subprocess.run([*command, "-o", str(output)], check=True)


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"build_driver: failed: {' '.join(error.cmd)}")
