"""Extras for few programs: procedural worlds, levels of detail."""
