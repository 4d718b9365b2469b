"""Hashes of files: of their bytes; nobody waits for what is no file."""

import hashlib
import os

import pytest

from engine3d.apps.batch.file_digests import digest_of
from engine3d.base.files.hashing import hash_of_file
from engine3d.base.files.stamps import FileState


def test_it_is_the_hash_of_all_bytes(tmp_path):
    data = bytes(range(256)) * 9000  # more than a piece
    (tmp_path / "a").write_bytes(data)
    assert hash_of_file(tmp_path / "a", hashlib.sha256()) == hashlib.sha256(data).hexdigest()


def test_nobody_waits_for_a_fifo(tmp_path):
    path = str(tmp_path / "fifo")
    os.mkfifo(path)
    with pytest.raises(OSError, match="not a regular file"):
        hash_of_file(path, hashlib.sha256())
    assert digest_of(path) is None and not FileState(path).changed()
    with pytest.raises(OSError):
        hash_of_file(tmp_path, hashlib.sha256())
