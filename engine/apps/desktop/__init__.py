"""Shared by desktop programs: the user's folders, and the files that were opened lately."""
