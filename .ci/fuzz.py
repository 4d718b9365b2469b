#!/usr/bin/env python3
"""Builds the targets of csrc/check/fuzz/ with clang's AddressSanitizer and UBSan, and runs them.

In:  --seconds N for each target (or --runs N), two side by side; --only NAMES; --max-len N;
     --corpus FOLDER keeps what the fuzzer finds, a folder a target. Seeds are the files of
     csrc/check/fuzz/seeds/ (past findings among them), those that the tests of damaged files start
     from, and the corpus ../shared/conformance (or in ENGINE3D_SHARED) where that is.
Out: a line a target: executions, coverage, files of the corpus. A finding ends it with status 1;
     what the target said, and the input that did it, stay in the folder that the last line names.
"""

import argparse
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SHARED = Path(os.environ.get("ENGINE3D_SHARED") or ROOT.parent / "shared")
LARGEST_SEED = 1 << 16
# How long inputs are by default: those of files longer, those that take long to draw shorter.
LENGTHS = {"obj": 4096, "rows": 384, "weld": 384, "draw": 4096, "canvas": 2048, "ui": 2048}
LENGTHS["meshopt"] = 1024
LENGTHS.update(dict.fromkeys(("forms", "numbers", "ply", "png", "polygons", "sums", "text"), 256))
SETTINGS = {
    # Little quarantine: fresh pages take most of the time otherwise.
    "ASAN_OPTIONS": "quarantine_size_mb=16",
    "UBSAN_OPTIONS": "print_stacktrace=1",
}


def build(folder):
    """Build the targets into a folder; return their names."""
    command = [sys.executable, ROOT / ".ci/build_driver.py", "--compiler", "clang", "--fuzz"]
    environment = {**os.environ, "ENGINE3D_BUILD": "asan"}
    subprocess.run([*command, "--output", folder], check=True, env=environment)
    return sorted(path.name for path in folder.iterdir())


def seed_files():
    """The files to start from, as (name, bytes)."""
    files = runpy.run_path(str(ROOT / "tests/loaders/seeds.py"))["FILES"]
    yield from files.items()
    for path in sorted((SHARED / "conformance").rglob("*")):
        if path.is_file() and path.stat().st_size <= LARGEST_SEED:
            yield path.name, path.read_bytes()


def as_targets(name, data):
    """What a file is to which targets: (target, bytes) of each. See the heads of their files."""
    suffix = Path(name).suffix.lower()
    if suffix == ".obj":
        yield "obj", data
    if suffix == ".tga" and len(data) > 18 and data[2] & 8:
        size = (data[16] + 7) // 8
        start = 18 + data[0] + int.from_bytes(data[5:7], "little") * ((data[7] + 7) // 8)
        count = int.from_bytes(data[12:14], "little") * int.from_bytes(data[14:16], "little")
        head = bytes([(size - 1) & 3]) + (count & 0xFFFF).to_bytes(2, "little")
        yield "tga", head + data[start:]
    if suffix == ".hdr" and (size := re.search(rb"\n\n[-+]Y (\d+) [-+]X (\d+)\n", data)):
        lines, width = (int(number) - 1 for number in size.groups())
        head = (width % 2048).to_bytes(2, "little") + bytes([lines % 16])
        yield "rgbe", head + data[size.end() :]
    if suffix in (".stl", ".ply"):
        columns, rows, gap, are_floats = 2, 2, 2, 1
        yield "rows", bytes([columns, rows, gap, are_floats]) + data[84:]
    if suffix == ".ply":
        order, lists, tail, rows = int(b"big_endian" in data), 1, 0, 2
        of_bytes_and_ints = bytes([0, 0, 3])
        _, _, body = data.partition(b"end_header\n")
        yield "ply", bytes([order, lists, tail, rows]) + 3 * of_bytes_and_ints + body
        of_comments, widths, all_rows, one_list = 2, 128, 255, 1
        yield "numbers", bytes([of_comments | widths, all_rows, one_list]) + body
    if suffix == ".off":
        of_hash, widths, all_rows, one_list = 1, 128, 255, 1
        yield "numbers", bytes([of_hash | widths, all_rows, one_list]) + data.partition(b"\n")[2]
    if suffix in (".stl", ".asc"):
        yield "forms", bytes([suffix == ".stl", 255]) + data


def write_seeds(corpus, targets):
    for target in targets:
        (corpus / target).mkdir(parents=True, exist_ok=True)
        # Drawings are made of numbers: any bytes do, but none at all say little.
        for k in range(4):
            noise = b"".join(bytes([(i * i * (2 * k + 3) >> 3) & 255]) for i in range(512))
            (corpus / target / f"noise-{k}").write_bytes(noise)
        for path in (ROOT / "csrc/check/fuzz/seeds" / target).glob("*"):
            (corpus / target / f"seed-{path.name}").write_bytes(path.read_bytes())
    for number, (name, data) in enumerate(seed_files()):
        for target, seed in as_targets(name, data):
            if target in targets:
                (corpus / target / f"seed-{number}").write_bytes(seed)


def run(target, arguments, work):
    """Run one target; return whether nothing was found, and a line about it."""
    length = arguments.max_len or LENGTHS.get(target, 1024)
    limits = [f"-max_len={length}", "-timeout=25", "-rss_limit_mb=2048", "-print_final_stats=1"]
    limits += [f"-max_total_time={arguments.seconds}"] if arguments.seconds else []
    limits += [f"-runs={arguments.runs}"] if arguments.runs else []
    findings = work / "findings"
    findings.mkdir(exist_ok=True)
    log = findings / f"{target}.txt"
    with log.open("wb") as output:
        status = subprocess.run(
            [work / "targets" / target, *limits, f"-artifact_prefix={findings}/{target}-",
             (arguments.corpus or work / "corpus") / target],
            stdout=output, stderr=subprocess.STDOUT, env={**os.environ, **SETTINGS},
        ).returncode  # fmt: skip
    said = log.read_text(errors="replace")
    if status != 0:
        return False, f"{target}: a finding\n{said[-6000:]}"
    executions = re.search(r"number_of_executed_units:\s*(\d+)", said)[1]
    coverage = re.findall(r"cov: (\d+) ft: (\d+) corp: (\d+)", said)[-1]
    log.unlink()
    return True, "{:11} {:>9} executions, {:>5} edges, {:>6} features, {:>5} files".format(
        target, executions, *coverage
    )


def main():
    parser = argparse.ArgumentParser(description="Fuzz the C core.")
    parser.add_argument("--seconds", type=int, default=0, help="for each target; 60 by default")
    parser.add_argument("--runs", type=int, default=0, help="executions of each target")
    parser.add_argument("--only", help="names of targets, with commas")
    parser.add_argument("--max-len", type=int, default=0, help="the longest input, in bytes")
    parser.add_argument("--corpus", type=Path, help="folder that the corpus is kept in")
    arguments = parser.parse_args()
    if not (arguments.seconds or arguments.runs):
        arguments.seconds = 60
    work = Path(tempfile.mkdtemp(prefix="engine3d-fuzz-"))
    targets = build(work / "targets")
    if arguments.only:
        targets = [target for target in targets if target in arguments.only.split(",")]
    write_seeds(arguments.corpus or work / "corpus", targets)
    fine = True
    with ThreadPoolExecutor(2) as pool:
        for passed, line in pool.map(lambda target: run(target, arguments, work), targets):
            fine &= passed
            print(line, flush=True)
    if fine:
        shutil.rmtree(work)
        return 0
    print(f"fuzz: findings are in {work / 'findings'}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
