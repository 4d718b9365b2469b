"""What some systems lack: tests that use it skip, and say so."""

import contextlib
import os
import tempfile

import pytest


def skip_where_links_cannot_be_made():
    """Let `os.symlink` skip the test on Windows without the right, and under wine."""
    with tempfile.TemporaryDirectory() as folder:
        link = os.path.join(folder, "link")
        with contextlib.suppress(OSError):
            os.symlink(folder, link)
        if not os.path.islink(link):
            os.symlink = _skip


def _skip(*_arguments, **_options):
    pytest.skip("symbolic links cannot be made here")


def peak_memory():
    """Return the most bytes that this process has used, 0 on Windows, where none of it is asked."""
    try:
        import resource
    except ImportError:
        return 0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10
