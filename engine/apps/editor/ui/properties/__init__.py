"""The fields of the properties panel: a module for each kind of thing that a node holds."""
