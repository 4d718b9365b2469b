"""Animations and videos of frames."""
