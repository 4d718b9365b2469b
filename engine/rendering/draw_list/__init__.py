"""What a scene shows, as the core draws it: kept from picture to picture."""
