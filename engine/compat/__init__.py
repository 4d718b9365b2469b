"""Modules with the names and the meaning of other packages, drawn by this engine."""
