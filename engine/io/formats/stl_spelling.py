"""Normalises text STL in unusual spellings, as other programs also read it.

In: a text that fails to parse line by line. Out: the same in lines of the usual form. Programs
write ``end solid`` with a blank, an underscore or none, a facet or the whole file on one line, a
keyword and its number without a blank, and lines of their own.
"""

from __future__ import annotations

import re
from typing import NamedTuple

_NUMBER = rb"(?=[ \t]*[-+.\d]|[ \t]+(?:nan|inf))"
_KEYWORD = re.compile(
    rb"(?<![A-Za-z_])(?:"
    rb"(?P<facet>facet[ \t_]*normal" + _NUMBER + rb")|(?P<outer>outer[ \t_]*loop)|"
    rb"(?P<begin>(?<![^\n])[ \t]*solid(?=[^\sA-Za-z]))|"
    rb"(?P<vertex>vertex" + _NUMBER + rb")|(?P<loop>end[ \t_]*loop)|"
    rb"(?P<end>end[ \t_]*facet)|(?P<solid>end[ \t_]*solid))",
    re.IGNORECASE,
)
# Lines that programs add, to be ignored.
_OTHER = re.compile(
    rb"^[ \t]*(?:#|;|//|(?:colou?r|comment|material|attribute|author|unit)s?\b)[^\n]*|"
    rb"^[ \t]*end[ \t]*$",
    re.IGNORECASE | re.MULTILINE,
)


class Spelling(NamedTuple):
    """A text in lines of the usual form.

    Attributes
    ----------
    text : bytes
    left_out : int
        The number of ignored lines.
    """

    text: bytes
    left_out: int


def usual_spelling(text: bytes) -> Spelling:
    """Return a text with each keyword at the start of a line, in its usual spelling."""
    text, left_out = _OTHER.subn(b"", text)
    kinds = [match.lastgroup for match in _KEYWORD.finditer(text)]
    # If ends of loops are missing, ends of facets are missing too.
    closing = "loop" if kinds.count("loop") >= kinds.count("end") else "end"
    words: dict[str | None, bytes] = {
        "facet": b"\nfacet normal ",
        "begin": b"\nsolid ",
        "outer": b"\nouter loop\n",
        "vertex": b"\nvertex ",
        "loop": b"\n",
        "end": b"\n",
        "solid": b"\nendsolid ",
        closing: b"\nendloop\n",
    }
    return Spelling(_KEYWORD.sub(lambda match: words[match.lastgroup], text), left_out)
