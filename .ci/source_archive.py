"""A source distribution with the same bytes whoever packs it, wherever and when.

In:  a .tar.gz, and a time in seconds since 1970. Out: the same file, whose entries are in the order
     of their names, of that time, owned by nobody in particular, readable for all.
"""

import gzip
import io
import tarfile


def repack(path, seconds):
    """Write the archive `path` anew."""
    with tarfile.open(path) as archive:
        held = {entry.name: (entry, archive.extractfile(entry)) for entry in archive}
        written = io.BytesIO()
        with tarfile.open(fileobj=written, mode="w", format=tarfile.PAX_FORMAT) as repacked:
            for _, (entry, content) in sorted(held.items()):
                repacked.addfile(plain(entry, seconds), content)
    # A name or a time in the header of gzip would differ, too.
    path.write_bytes(gzip.compress(written.getvalue(), mtime=seconds))


def plain(entry, seconds):
    """Return what an entry says of itself, without what depends on who packed it."""
    kept = tarfile.TarInfo(entry.name)
    kept.type, kept.size, kept.linkname, kept.mtime = (
        entry.type,
        entry.size,
        entry.linkname,
        seconds,
    )
    kept.mode = 0o755 if entry.isdir() or entry.mode & 0o100 else 0o644
    return kept
