"""placeholder"""
class Viewer: pass
