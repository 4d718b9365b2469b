"""The options of the commands, a module for each theme."""
