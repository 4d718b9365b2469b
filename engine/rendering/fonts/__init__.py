"""The built-in fonts: outlines from TrueType files, sizes, and the lengths of texts."""
