"""The rendering passes of a frame."""
