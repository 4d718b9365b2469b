"""The base of every package: checks of arguments, and tracking of changes."""
