"""A catalogue that notes which texts it was asked for in vain."""

from engine3d.base.catalogue import Catalogue
from engine3d.base.language import _folder


class Recorder(Catalogue):
    """French, with a list of what it lacks.

    Attributes
    ----------
    missing : set of (str, str)
        Contexts and texts.
    """

    def __init__(self):
        path = _folder() / "fr.po"
        super().__init__(path.read_text("utf-8"), str(path))
        self.missing = set()

    def text(self, text, context=""):
        if (context, text) not in self._translations and _has_words(text):
            self.missing.add((context, text))
        return super().text(text, context)

    def counted(self, one, many, count):
        if ("", one) not in self._translations:
            self.missing.add(("", one))
        return super().counted(one, many, count)


def _has_words(text):
    return any(len(word) > 1 and word.isalpha() for word in text.split())
