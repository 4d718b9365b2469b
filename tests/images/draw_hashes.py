"""Draw pictures and print their hashes: a program for test_environment.py to run elsewhere.

    python draw_hashes.py [--flush] BACKEND THREADS NAME...

Out: one JSON object, name -> hashes. With --flush denormals become zero in the calling thread, and
so in the threads it starts, after the scenes are made and before anything is drawn.
"""

import json
import sys
from pathlib import Path


def main():
    arguments = sys.argv[1:]
    flush = arguments[0] == "--flush"
    backend, threads, *names = arguments[flush:]
    sys.path.insert(0, str(Path(__file__).parents[1]))
    from images.picture import digests
    from images.scenes import SCENES

    pictures = {name: SCENES[name]() for name in names}
    if flush:
        from engine3d._native import kernels_testing

        control = kernels_testing.float_control() | kernels_testing.FLUSH_DENORMALS
        kernels_testing.set_float_control(control)
    drawn = {name: digests(made.draw(backend, int(threads))) for name, made in pictures.items()}
    print(json.dumps(drawn))


if __name__ == "__main__":
    main()
