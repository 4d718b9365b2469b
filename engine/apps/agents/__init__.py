"""What agents ask for by the Model Context Protocol: pictures, numbers, edits of a scene."""
