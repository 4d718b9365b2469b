"""Captions: numbers and plurals in each language, and what holds French punctuation."""

import pytest

from engine3d.apps.learn.captions import Caption, fields
from engine3d.base.line_breaks import unbroken

DIFFER = "{count:no pixel differs|# pixel differs|# pixels differ}"
FRENCH = {
    DIFFER: "{count:aucun pixel ne diffère|# pixel diffère|# pixels diffèrent}",
    "by {way}": "par {way}",
    "hand": "la main",
    "at {x:.1f}": "en {x:.1f}",
}


@pytest.mark.parametrize(
    ("count", "english", "french"),
    [
        (0, "no pixel differs", "aucun pixel ne diffère"),
        (1, "1 pixel differs", "1 pixel diffère"),
        (2, "2 pixels differ", "2 pixels diffèrent"),
        (40188, "40,188 pixels differ", "40\u00a0188 pixels diffèrent"),
    ],
)
def test_a_number_chooses_its_words(count, english, french):
    caption = Caption(DIFFER, count=count)
    assert caption.text() == str(caption) == english
    assert caption.text("fr", FRENCH) == french


def test_numbers_have_the_signs_of_their_language():
    caption = Caption("at {x:.1f}", x=-2.5)
    assert (caption.text(), caption.text("fr", FRENCH)) == ("at −2.5", "en −2,5")


def test_values_that_are_words_are_translated():
    assert Caption("by {way}", way="hand").text("fr", FRENCH) == "par la main"
    assert Caption("by {way}", way="foot").text("fr", FRENCH) == "par foot"


def test_french_lines_begin_with_no_colon():
    assert unbroken("le moteur : 3 % de « lui » ; ici ?") == (
        "le moteur\u00a0: 3\u00a0% de «\u00a0lui\u00a0»\u00a0; ici\u00a0?"
    )
    assert unbroken("« lui », ici := là") == "«\u00a0lui\u00a0», ici := là"


def test_fields_are_found():
    assert fields("{a} of {b:g}; " + DIFFER) == {"a", "b", "count"}
