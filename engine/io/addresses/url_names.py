"""Addresses of files, such as ``https://host/a.obj`` and ``s3://bucket/a.obj``: their parts.

In: a name as the caller gave it. Out: whether it is an address; its file name; names beside it.
Chains of fsspec count, too, such as ``simplecache::s3://bucket/a.obj``. Nothing is fetched here.
"""

from __future__ import annotations

import re

# A scheme has two letters at least: one is a drive of Windows.
_URL = re.compile(r"(?:[A-Za-z][\w+.-]+::)*[A-Za-z][\w+.-]+://")


def is_url(path: str) -> bool:
    """Return whether a name is an address."""
    return _URL.match(path) is not None


def file_part(path: str) -> str:
    """Return a path as it is; of an address, what comes before a query and the chain's rest."""
    return _parts(path)[0] if is_url(path) else path


def folder_of(url: str) -> str:
    """Return the address of the folder of a file, with a slash at its end."""
    return _parts(url)[0].rpartition("/")[0] + "/"


def beside(url: str, folder: str, name: str) -> str:
    """Return the address of a file in a folder of `folder_of`, reached as the file at ``url``."""
    return folder + name + _parts(url)[1]


def _parts(url: str) -> tuple[str, str]:
    """Return an address up to its file's name, and the rest of its chain; queries are dropped."""
    match = _URL.match(url)
    start = 0 if match is None else match.end()
    path, chain, rest = url[start:].partition("::")
    if url.startswith(("http://", "https://")):
        path = re.split(r"[?#]", path, maxsplit=1)[0]
    return url[:start] + path, chain + rest
