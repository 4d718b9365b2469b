"""Each kernel is called by some test: by its name, or as the list COVERS of a file says."""

import re
from pathlib import Path

from kernels.layouts import HEADERS

KERNELS = [row.name for row in HEADERS.types["e3d_kernels"].members]
TEXTS = [path.read_text("utf-8") for path in sorted(Path(__file__).parent.glob("test_*.py"))]


def test_every_kernel_is_tested():
    covers = re.findall(r"^COVERS = \(([^)]*)\)$", "\n".join(TEXTS), re.M)
    listed = set(re.findall(r'"(\w+)"', " ".join(covers)))
    assert len(covers) == 4 and listed <= set(KERNELS)
    called = {name for text in TEXTS for name in re.findall(r"\bkernels\.(\w+)\(", text)}
    assert len(KERNELS) > 70
    assert [name for name in KERNELS if name not in called | listed] == []
