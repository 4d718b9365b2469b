"""The record types of the tests are the structs of the C headers, as a C compiler lays them out."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from kernels import layouts
from kernels.harness import kernels_of
from kernels.kernels import Kernels

CORE = Path(__file__).resolve().parents[2] / "csrc"
STRUCTS = sorted(
    name
    for name, made in layouts.HEADERS.types.items()
    if isinstance(made, layouts.Struct) and made.members
)


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler")
def test_sizes(tmp_path):
    includes = "".join(f'#include "{name}"\n' for name in layouts.HEADERS.read)
    checks = [
        f"_Static_assert(sizeof({'' if made.is_typedef else made.kind} {name}) == "
        f'{layouts.layout(name).itemsize}, "{name}");\n'
        for name in STRUCTS
        for made in [layouts.HEADERS.types[name]]
    ]
    assert len(checks) > 90
    (tmp_path / "sizes.c").write_text(includes + "".join(checks), "utf-8")
    folders = [f"-I{CORE / folder}" for folder in ("", "include")]
    command = ["cc", "-std=gnu11", "-fsyntax-only", *folders, tmp_path / "sizes.c"]
    assert subprocess.run(command, capture_output=True, text=True).stderr == ""


def test_a_name_that_the_headers_lack():
    with pytest.raises(AttributeError, match="NOTHING"):
        _ = layouts.NOTHING


def test_the_scalar_reference_has_no_kernels():
    with pytest.raises(LookupError):
        Kernels(0)


def test_arguments_are_checked():
    kernels = kernels_of("portable")
    floats, view, out = np.zeros(4, np.float32), np.zeros(40, np.uint8), np.zeros(4608, np.uint8)
    with pytest.raises(ValueError, match="40 bytes"):
        kernels.take_clip(floats, 1, 0, view[:27], out)
    with pytest.raises(ValueError, match="float32"):
        kernels.take_clip(view, 1, 0, view, out)
    out.flags.writeable = False
    with pytest.raises(ValueError, match="writable"):
        kernels.take_clip(floats, 1, 0, view, out)
