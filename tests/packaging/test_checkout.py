"""A checkout has the bytes of the repository, whatever git would make of them by default."""

import os
import shutil
import subprocess

import pytest

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="needs git")


def git(folder, *words):
    """Run git where no settings of the user or the system count."""
    nothing = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    command = ["git", "-C", folder, "-c", "user.name=n", "-c", "user.email=e", *words]
    subprocess.run(command, env={**os.environ, **nothing}, check=True, capture_output=True)


def test_line_ends_stay_where_git_for_windows_would_change_them(source_tree, tmp_path):
    texts = {"script.sh": b"#!/bin/sh\n", "model.obj": b"v 0 0 0\r\nv 1 0 0\n", "a.json": b"{}\n"}
    made, cloned = tmp_path / "made", tmp_path / "cloned"
    git(tmp_path, "init", "-q", str(made))
    shutil.copy(source_tree / ".gitattributes", made)
    for name, text in texts.items():
        (made / name).write_bytes(text)
    git(made, "-c", "core.autocrlf=true", "add", "-A")
    git(made, "commit", "-q", "-m", "m")
    git(tmp_path, "clone", "-q", "-c", "core.autocrlf=true", str(made), str(cloned))
    assert {name: (cloned / name).read_bytes() for name in texts} == texts
