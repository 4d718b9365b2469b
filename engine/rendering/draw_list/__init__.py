"""The draw list: what a scene shows, as the core draws it; kept from picture to picture."""
