"""Applications: command line, viewer, editor, sheets, batches, data sets, golden images."""
