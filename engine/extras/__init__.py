"""Extras that few programs need: worlds, levels of detail."""
