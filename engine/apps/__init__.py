"""Programs: the commands, the viewer, the editor, sheets, batches, data sets, golden images."""
