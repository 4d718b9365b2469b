"""Catalogues of texts: what the reader takes of gettext's PO files, and what it refuses."""

import pytest

from engine3d import FileFormatError
from engine3d.base.catalogue import Catalogue, read_entries

HEAD = """msgid ""
msgstr ""
"Plural-Forms: nplurals=2; plural=(n > 1);\\n"
"X-Thousands-Mark: \u00a0\\n"
"X-Decimal-Mark: ,\\n"

"""


def catalogue(text, head=HEAD):
    return Catalogue(head + text, "fr.po")


def test_a_text_has_its_translation():
    french = catalogue('#: a.py\nmsgid "a \\"box\\""\nmsgstr "une "\n"boîte\\n"\n')
    assert french.text('a "box"') == "une boîte\n"
    assert french.text("a ball") == "a ball"


def test_contexts_tell_equal_texts_apart():
    french = catalogue(
        'msgctxt "cull"\nmsgid "none"\nmsgstr "aucune"\n'
        'msgctxt "fog"\nmsgid "none"\nmsgstr "aucun"\n'
    )
    assert french.text("none", "cull") == "aucune" and french.text("none", "fog") == "aucun"
    assert french.text("none") == "none"


@pytest.mark.parametrize(("count", "text"), [(0, "{n} pixel"), (1, "{n} pixel"), (2, "{n} px")])
def test_plurals_follow_the_rule_of_the_header(count, text):
    french = catalogue(
        'msgid "{n} dot"\nmsgid_plural "{n} dots"\nmsgstr[0] "{n} pixel"\nmsgstr[1] "{n} px"\n'
    )
    assert french.counted("{n} dot", "{n} dots", count) == text


def test_without_a_translation_plurals_are_those_of_english():
    french = catalogue("")
    assert [french.counted("one", "many", count) for count in range(3)] == ["many", "one", "many"]


def test_fuzzy_and_empty_entries_are_left_out():
    french = catalogue(
        '#, fuzzy\nmsgid "a"\nmsgstr "b"\n\nmsgid "c"\nmsgstr ""\n\n'
        'msgid "d"\nmsgstr "e"\n\n#~ msgid "f"\n#~ msgstr "g"\n'
    )
    assert [french.text(text) for text in "acdf"] == ["a", "c", "e", "f"]


def test_marks_of_numbers_are_in_the_header():
    assert "1,234.5".translate(catalogue("").number_marks) == "1\u00a0234,5"
    assert "1,234.5".translate(catalogue("", "").number_marks) == "1,234.5"


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ('msgid "a"\nmsgstr b\n', 8, "not a line"),
        ('"a"\n', 1, "not a line"),
        ('msgid "a"\nmsgid "b"\nmsgstr "c"\n', 8, "a second msgid"),
        ('msgid "a"\nmsgstr "b"\nmsgid "a"\nmsgstr "c"\n', 9, "there already"),
        ('msgid "a"\nmsgid_plural "b"\nmsgstr[0] "c"\n', 7, "2 plurals"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(text, line, reason):
    head = "" if text.startswith('"') else HEAD
    with pytest.raises(FileFormatError, match=reason) as caught:
        catalogue(text, head)
    assert caught.value.line == line and "fr.po" in str(caught.value)


@pytest.mark.parametrize(
    "rule", ["nplurals=2", "nplurals=2; plural=(n > ;", "nplurals=x; plural=n;"]
)
def test_a_rule_that_is_none_is_refused(rule):
    with pytest.raises(FileFormatError, match="Plural-Forms"):
        catalogue("", f'msgid ""\nmsgstr "Plural-Forms: {rule}\\n"\n')


def test_entries_tell_where_they_are():
    (entry,) = read_entries('# said\n\nmsgid "a"\nmsgstr "b"\n', "fr.po")
    assert (entry.line, entry.text, entry.translations) == (3, "a", ("b",))
