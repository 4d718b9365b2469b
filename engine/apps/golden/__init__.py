"""Golden images: reference pictures beside tests, compared by hash.

`plugin` is what pytest loads: it brings the fixture ``golden``. ``engine3d diff`` compares pictures
and folders of them with the same code. docs/golden.md is the guide. Nothing is imported here, nor
by the plugin before a test asks for the fixture, so that other tests start as fast as without it.
"""
