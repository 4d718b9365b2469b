"""Hills for engine3d: its parts are imported when engine3d asks for them, one by one."""
