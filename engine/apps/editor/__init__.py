"""Editing scenes: what an editor knows and does, without a window.

A `SceneDocument` holds a scene with its history, selection and console; whoever draws panels asks
it and gives it commands.
"""
