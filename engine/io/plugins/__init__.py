"""Files that readers and writers of other packages take."""
