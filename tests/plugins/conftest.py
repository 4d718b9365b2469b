"""Packages with plug-ins: made of a few lines, or the example of docs/, installed by pip."""

import itertools
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from engine3d.base.plugins import discovery

EXAMPLE = Path(__file__).resolve().parents[2] / "docs" / "examples" / "package"


@pytest.fixture(autouse=True)
def fresh_metadata(monkeypatch):
    """Read the metadata of packages anew, before and after."""
    monkeypatch.delenv("ENGINE3D_PLUGINS", raising=False)
    discovery._found.cache_clear()
    yield
    discovery._found.cache_clear()


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Return a function that makes a package: entry points by group, and a module's code."""
    numbers = itertools.count()

    def make(code="", name=None, version="1.2", **groups):
        number = next(numbers)
        name = name or f"demo-{number}"
        folder = tmp_path / f"site{number}"
        module = f"demo_{number}_{tmp_path.name.replace('-', '_')}"
        folder.mkdir()
        (folder / f"{module}.py").write_text(code)
        metadata = folder / f"{name.replace('-', '_')}-{version}.dist-info"
        metadata.mkdir()
        (metadata / "METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nSummary: A demo\n"
        )
        lines = []
        for group, points in groups.items():
            lines.append(f"[engine3d.{group}]")
            lines += [f"{point} = {where.format(module)}" for point, where in points.items()]
        (metadata / "entry_points.txt").write_text("\n".join(lines))
        monkeypatch.syspath_prepend(folder)
        discovery._found.cache_clear()
        return folder

    return make


@pytest.fixture(scope="session")
def example_site(tmp_path_factory):
    """Return the folder into which pip installed the example package."""
    source = tmp_path_factory.mktemp("package") / "source"
    site = tmp_path_factory.mktemp("site")
    shutil.copytree(EXAMPLE, source)
    offline = ("--no-deps", "--no-build-isolation", "--no-index", "--quiet")
    command = [sys.executable, "-m", "pip", "install", *offline, "--target", site, source]
    run = subprocess.run(command, capture_output=True, text=True)
    if "No module named pip" in run.stderr:
        pytest.skip("there is no pip")
    assert run.returncode == 0, run.stderr
    return site


@pytest.fixture
def example(example_site, monkeypatch):
    """Put the example package on the path, of other processes, too."""
    monkeypatch.syspath_prepend(example_site)
    paths = [str(example_site), *filter(None, [os.environ.get("PYTHONPATH")])]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(paths))
    discovery._found.cache_clear()
    return example_site
