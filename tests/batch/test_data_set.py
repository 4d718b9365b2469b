"""The data set that docs/batches.md documents: its first pictures are those of everybody."""

import hashlib
from pathlib import Path

from engine3d.batch import read_manifest, run

FOLDER = Path(__file__).parents[2] / "benchmarks" / "data_set"
FIRST = {
    "000000.png": "33c9384eb25306e1",
    "000001.png": "a92651144553785e",
    "000002.png": "b78dc58d67bdee2d",
    "000003.png": "5621c529c25322b7",
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
