"""The viewer's tools that inspect a model: section, explosion, measuring."""
