"""A lack of memory is told as such, wherever it is noticed."""

from __future__ import annotations

import errno
import io
import subprocess
import sys
import time

import pytest

import engine3d as e3d
from engine3d.base.calls import checks_types

LACKS = [MemoryError(), OSError(errno.ENOMEM, "none"), ImportError("x.so: failed to map segment")]


@pytest.mark.parametrize("lack", LACKS, ids=repr)
def test_a_decoder_without_memory_finds_no_damage(lack, monkeypatch):
    from PIL import Image

    def decode(*_args, **_keywords):
        raise lack

    data = io.BytesIO()
    Image.new("RGB", (2, 2)).save(data, "BMP")
    monkeypatch.setattr(Image, "open", decode)
    with pytest.raises(e3d.FileFormatError, match="needs more memory than there is"):
        e3d.load_texture(data.getvalue())


@pytest.mark.parametrize("lack", LACKS[1:], ids=repr)
def test_a_module_that_has_no_memory_to_be_imported(lack):
    @checks_types
    def draws_late():
        raise lack

    with pytest.raises(e3d.errors.OutOfMemoryError, match="draws_late"):
        draws_late()


@pytest.mark.parametrize("other", [OSError(errno.ENOENT, "none"), ImportError("no module")])
def test_other_errors_pass(other):
    @checks_types
    def fails():
        raise other

    with pytest.raises(type(other)) as caught:
        fails()
    assert caught.value is other


LITTLE = """
import resource, sys, warnings, numpy as np, engine3d as e3d
from PIL import Image
size = [int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmSize")][0]
e3d.Scene(), e3d.load_scene(b"v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n", format="obj")
hard = resource.getrlimit(resource.RLIMIT_AS)[1]
failed = None
try:
    resource.setrlimit(resource.RLIMIT_AS, ((size << 10) + int(sys.argv[2]), hard))
    with warnings.catch_warnings(record=True) as said:
        e3d.load_scene(sys.argv[1])
except e3d.Engine3DError as error:
    failed = error
except MemoryError:
    pass  # Python's own, where there is no room for one more call
resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
assert failed is None or "memory" in str(failed), failed
assert not any("damaged" in str(each.message) for each in said), said
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs Linux's limits")
def test_a_model_is_loaded_or_refused_when_memory_is_nearly_gone(tmp_path):
    import numpy as np

    scene, box = e3d.Scene(), e3d.icosphere(subdivisions=3)
    images = [np.full((64, 64, 3), n, np.uint8) for n in range(2)]
    box.materials = [e3d.Material(texture=e3d.Texture(images[0]))]
    scene.add(box)
    other = e3d.box()
    other.materials = [e3d.Material(texture=e3d.Texture(images[1]))]
    scene.add(other)
    path = tmp_path / "a.glb"
    e3d.save_scene(scene, path)
    for extra in (0, 300_000, 2_000_000):
        begun = time.monotonic()
        done = subprocess.run(
            [sys.executable, "-c", LITTLE, str(path), str(extra)],
            capture_output=True,
            text=True,
            timeout=100,
        )
        assert done.returncode == 0, done.stderr
        assert time.monotonic() - begun < 50
