"""The editor's logic, without a window.

A `SceneDocument` holds a scene with its history, selection and console; panels query it and give it
commands.
"""
