#!/usr/bin/env python3
"""Builds csrc/check/driver/ and the C core into one program, without Python's own flags.

In:  --output FILE, --compiler CC (a cross compiler too; words, as setuptools reads CC), --static,
     and ENGINE3D_BUILD as in build_rules.py, which also gives the libraries and the flags. With
     --fuzz, by clang only, the core goes with each target of csrc/check/fuzz/ instead, and --output
     is their folder.
Out: the program, or the targets. Nothing is kept between runs.
"""

import argparse
import os
import runpy
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FUZZ_FLAGS = ["-fsanitize=fuzzer-no-link,float-cast-overflow"]
FUZZ_FLAGS += ["-fno-sanitize-recover=float-cast-overflow"]
# Tables that are large for speed alone are small for the fuzzers: csrc/io/images/deflate.h.
FUZZ_FLAGS += ["-DFUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION"]
# What compares bytes of a file. Elsewhere most comparisons are of pixels and coordinates, and the
# tracing would take most of the time.
TRACED = (
    *("csrc/io/loaders/", "csrc/check/fuzz/decimal"),
    *("csrc/io/images/tga", "csrc/io/images/rgbe"),
)
UNTRACED_FLAGS = ["-fno-sanitize-coverage=trace-cmp"]
# What a target that lets memory run out calls in their place.
WRAPPED = ("malloc", "calloc", "realloc", "posix_memalign")
# What the driver fills with a pattern: csrc/check/driver/poison.c.
POISONED = ("malloc", "realloc", "posix_memalign")


def rules_for(compiler):
    """The globals of build_rules.py, as if run on the processor that `compiler` compiles for.

    compiler: the words of its command.
    """
    rules = runpy.run_path(str(ROOT / "csrc" / "build_rules.py"), run_name="rules")
    asked = [*compiler, "-dumpmachine"]
    machine = subprocess.run(asked, capture_output=True, text=True, check=True)
    rules["IS_LINUX"] = "linux" in machine.stdout
    # The functions of build_rules.py read these names from their own globals.
    for name, tell in (("MACHINE", "machine_of"), ("IS_WINDOWS", "is_windows")):
        rules["static_libraries"].__globals__[name] = rules[tell](machine.stdout)
    return rules


def compile_all(compiler, rules, fuzz, folder, more=(), told=lambda made, total: made):
    """Compile the core and the driver, or the targets; return the object of each source.

    more: flags for all of them. told: what goes through that which is made, to say how far it is.
    """
    driver = [str(path) for path in Path("csrc/check/driver").rglob("*.c")]
    if fuzz:
        driver.remove("csrc/check/driver/driver.c")
        driver += [str(path) for path in Path("csrc/check/fuzz").glob("*.c")]
    jobs = [(source, [*rules["WARNINGS"], *rules["common_flags"]()], []) for source in driver]
    for _, info in rules["static_libraries"]():
        macros = [f"-D{name}={value}" for name, value in info["macros"]]
        jobs += [(source, info["cflags"], macros) for source in info["sources"]]
    includes = [f"-I{folder}" for folder in rules["INCLUDE_DIRS"]]
    poison = [f"-D{name}=poison_{name}" for name in POISONED if rules["IS_LINUX"]]

    def compile_one(job):
        source, flags, macros = job
        target = str(Path(folder) / (source.replace("/", "_") + ".o"))
        extra = [*more, *(FUZZ_FLAGS if fuzz else poison)]
        if fuzz and not source.startswith(TRACED):
            extra = [*extra, *UNTRACED_FLAGS]
        command = [*compiler, *macros, *includes, *flags, *extra, "-c", source, "-o", target]
        subprocess.run(command, check=True)
        return source, target

    with ThreadPoolExecutor(rules["usable_processors"]()) as pool:
        return dict(told(pool.map(compile_one, jobs), len(jobs)))


def link(compiler, rules, objects, extra, output):
    command = [*compiler, *rules["common_flags"](), *extra, *objects, "-lm"]
    subprocess.run([*command, "-o", str(output)], check=True)


def link_targets(compiler, rules, objects, folder):
    """Link each file of csrc/check/fuzz/ that has libFuzzer's entry with all that have none."""
    entry = "LLVMFuzzerTestOneInput("
    targets = [
        s for s in objects if s.startswith("csrc/check/fuzz/") and entry in Path(s).read_text()
    ]
    common = [target for source, target in objects.items() if source not in targets]
    folder.mkdir(parents=True, exist_ok=True)
    for source in targets:
        extra = ["-fsanitize=fuzzer,float-cast-overflow"]
        if "__wrap_malloc" in Path(source).read_text():
            extra += [f"-Wl,--wrap={name}" for name in WRAPPED]
        link(compiler, rules, [*common, objects[source]], extra, folder / Path(source).stem)


def main():
    parser = argparse.ArgumentParser(description="Build the C driver.")
    parser.add_argument("--output", required=True, type=Path)
    parser.add_argument("--compiler", default=os.environ.get("CC", "cc"))
    parser.add_argument("--fuzz", action="store_true")
    parser.add_argument("--static", action="store_true")
    arguments = parser.parse_args()
    output, compiler = arguments.output.resolve(), shlex.split(arguments.compiler)
    os.chdir(ROOT)
    rules = rules_for(compiler)
    with tempfile.TemporaryDirectory() as folder:
        objects = compile_all(compiler, rules, arguments.fuzz, folder)
        if arguments.fuzz:
            link_targets(compiler, rules, objects, output)
        else:
            static = ["-static"] if arguments.static else []
            link(compiler, rules, objects.values(), static, output)


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"build_driver: failed: {' '.join(error.cmd)}")
