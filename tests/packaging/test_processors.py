"""Which backends the core offers on processors that have more or fewer instruction sets."""

import platform
import shutil
import subprocess
from pathlib import Path

import pytest

import engine3d as e3d

PROGRAM = """
#include <stdio.h>
#include "e3d.h"
int main(void)
{
    for (int b = 0; b < E3D_BACKEND_COUNT; b++)
        if (e3d_backend_available((e3d_backend)b))
            printf("%s ", e3d_backend_name((e3d_backend)b));
    return 0;
}
"""
# The Linux kernel's names of what each backend takes.
FLAGS = {
    "sse41": {"sse4_1"},
    "avx2": {"avx2"},
    "avx512": {"avx512f", "avx512cd", "avx512bw", "avx512dq", "avx512vl"},
}
PARTS = ("cpu", "options", "system")
ALWAYS = ["scalar", "portable"]

pytestmark = [
    pytest.mark.skipif(platform.machine() != "x86_64", reason="needs x86-64"),
    pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler"),
]


@pytest.fixture(scope="module")
def program(source_tree, tmp_path_factory):
    """A program that prints the backends it may use; it holds no kernels."""
    folder = tmp_path_factory.mktemp("processors")
    (folder / "main.c").write_text(PROGRAM, "utf-8")
    core = Path(source_tree, "csrc")
    sources = [folder / "main.c", *(next(core.glob(f"*/{name}.c")) for name in PARTS)]
    flags = ["-std=gnu11", "-DE3D_HAVE_X86=1", f"-I{core}", f"-I{core / 'include'}"]
    command = ["cc", *flags, *sources, "-static", "-o", folder / "backends"]
    subprocess.run(command, check=True)
    return folder / "backends"


def printed(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def test_those_of_this_processor(program):
    assert printed(program) == e3d.backends()
    has = set()
    for line in Path("/proc/cpuinfo").read_text("utf-8").splitlines():
        if line.startswith("flags"):
            has.update(line.split())
    assert e3d.backends() == ALWAYS + [name for name, needs in FLAGS.items() if needs <= has]


@pytest.mark.skipif(shutil.which("qemu-x86_64-static") is None, reason="needs qemu-x86_64-static")
@pytest.mark.parametrize(
    "processor, more",
    [
        ("core2duo", []),
        ("Nehalem", ["sse41"]),
        ("Haswell", ["sse41", "avx2"]),
        # Without OSXSAVE the registers of AVX are not saved; the last has them, and no AVX2.
        ("Haswell,-xsave", ["sse41"]),
        ("Haswell,-avx2", ["sse41"]),
    ],
)
def test_those_of_others(program, processor, more):
    assert printed("qemu-x86_64-static", "-cpu", processor, program) == ALWAYS + more
