"""A window without a screen, for tests: it plays a script of events and keeps what it was shown."""


class ScriptedWindow:
    """Has the methods of `Window`; each call of ``events`` returns the script's next list.

    When the script is over it asks to close.
    """

    def __init__(self, script=(), size=(160, 120)):
        self._script = list(script)
        self.size = size
        self.minimised = False
        self.writes_text = False
        self.shown = []
        self.titles = []
        self.captured = False
        self.fullscreen = False
        self.scale = 1
        self.layout = {}

    def events(self, timeout=0.0):
        from engine3d.events import CloseRequested

        return self._script.pop(0) if self._script else [CloseRequested()]

    def present(self, pixels):
        self.shown.append(pixels.copy())

    @property
    def title(self):
        return self.titles[-1] if self.titles else ""

    @title.setter
    def title(self, title):
        self.titles.append(title)

    def key_at(self, position):
        return self.layout.get(position, position)

    def capture_mouse(self, captured):
        self.captured = captured

    def toggle_fullscreen(self):
        self.fullscreen = not self.fullscreen
