"""Lines on standard error that say how far work is which takes long.

In:  what is gone through. Out: the same; a line now and then once some seconds have passed, so that
     quick runs print none, and nothing on standard output, where the results go.
"""

import sys
import time

PATIENCE = 5.0  # seconds without a line


def tracked(items, total, what):
    """Yield the items; say how many of `total` are done, at most every PATIENCE seconds.

    total: a number, or None where it is not known.
    """
    start = said = time.monotonic()
    for done, item in enumerate(items, start=1):
        yield item
        now = time.monotonic()
        if now - said >= PATIENCE and done != total:
            said = now
            count = f"{done} of {total}" if total else f"{done} done"
            print(f"{what}: {count}, {now - start:.0f} s", file=sys.stderr, flush=True)
