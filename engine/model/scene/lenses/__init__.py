"""Cameras whose pictures are no pinhole's: fisheyes, distorted lenses, panoramas."""
