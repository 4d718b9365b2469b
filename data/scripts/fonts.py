"""Makes data/fonts/ of the faces Noto Sans and Noto Sans Mono.

In:  NotoSans-Regular.ttf and NotoSansMono-Regular.ttf, as the Noto project publishes them.
Out: sans.ttf and mono.ttf: Latin, Greek, Cyrillic, signs and arrows, with kerning, without hints
     and whatever else the canvas doesn't read. This needs fontTools.

Usage: python data/scripts/fonts.py NotoSans-Regular.ttf NotoSansMono-Regular.ttf
"""

import sys
from pathlib import Path

from font_kerning import kerning_table
from fontTools import subset
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont
from fontTools.ttLib.tables.DefaultTable import DefaultTable

FOLDER = Path(__file__).parents[1] / "fonts"
#: First and last characters.
CHARACTERS = [
    (0x20, 0x7E),
    (0xA0, 0x17F),
    (0x370, 0x3FF),
    (0x400, 0x45F),
    (0x490, 0x491),
    (0x2010, 0x2026),
    (0x2030, 0x203A),
    (0x2070, 0x208E),
    (0x20AC, 0x20AC),
    (0x2122, 0x2126),
    (0x2190, 0x2195),
    (0x2202, 0x2265),
    (0x25A0, 0x25CF),
    (0xFFFD, 0xFFFD),
]
UNREAD = ["GDEF", "GSUB", "DSIG", "gasp"]
#: Copyright, family, style, licence and its address.
NAMES = [0, 1, 2, 4, 6, 13, 14]


def draw_turned(font):
    """Give glyphs that are others turned or scaled their own outlines: the reader only moves."""
    glyphs = font.getGlyphSet()
    for name in font.getGlyphOrder():
        glyph = font["glyf"][name]
        if glyph.isComposite() and any(hasattr(part, "transform") for part in glyph.components):
            drawn, pen = DecomposingRecordingPen(glyphs), TTGlyphPen(None)
            glyphs[name].draw(drawn)
            drawn.replay(pen)
            font["glyf"][name] = pen.glyph()


def take_kerning(font):
    """Give a font its pairs as a `kern` table, which is easily read, instead of as GPOS."""
    pairs = kerning_table(font)
    if "GPOS" in font:
        del font["GPOS"]
    if pairs:
        font["kern"] = DefaultTable("kern")
        font["kern"].data = pairs


def make(source, target):
    font = TTFont(source, recalcTimestamp=False)
    options = subset.Options(
        hinting=False,
        layout_features=["kern"],
        notdef_outline=True,
        name_IDs=NAMES,
        name_languages=[0x409],
    )
    options.drop_tables += UNREAD
    maker = subset.Subsetter(options)
    maker.populate(unicodes=[code for low, high in CHARACTERS for code in range(low, high + 1)])
    maker.subset(font)
    draw_turned(font)
    take_kerning(font)
    font.save(target)
    print(f"{target.name}: {len(font.getGlyphOrder())} glyphs, {target.stat().st_size:,} bytes")


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for path, name in zip(sys.argv[1:3], ("sans.ttf", "mono.ttf"), strict=True):
        make(path, FOLDER / name)
