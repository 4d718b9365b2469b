"""The version of engine3d, and of its pictures, stated here first.

The package's metadata reads the version from here, and tests compare the other papers of a release
with it. docs/versions.md says when each number grows.
"""

__version__ = "0.2.0"

RELEASED = "2026-12-01"

#: Grows with every release that draws a picture with other bytes than the release before.
PICTURES = 2
