"""Shared code of desktop programs: the user's folders and recent files."""
