"""The data set that docs/batches.md documents: its first pictures are those of everybody."""

import hashlib
from pathlib import Path

from engine3d.batch import read_manifest, run

FOLDER = Path(__file__).parents[2] / "benchmarks" / "data_set"
FIRST = {
    "000000.png": "82c6dce6e8ae1244",
    "000001.png": "30faa2b634e03095",
    "000002.png": "bb02e423d8ac9543",
    "000003.png": "af6bb30df5be839a",
}


def test_the_first_pictures(tmp_path):
    tasks, writer = read_manifest(FOLDER / "things.json")
    assert len(tasks) == 1000
    run(tasks[:4], tmp_path, writer=writer, jobs=1)
    found = {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()[:16]
        for path in sorted((tmp_path / "images").iterdir())
    }
    assert found == FIRST
