"""Plotters of PyVista for tests, whose windows have no OpenGL."""

import os

SIZE = (120, 90)


def without_opengl():
    """Let VTK make windows that need no display; before the first plotter."""
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")


def plotter(**options):
    import pyvista

    return pyvista.Plotter(**({"off_screen": True, "window_size": SIZE} | options))


def plane_plotter(**options):
    """A plotter of a square that fills the middle, seen from the front, without perspective."""
    import pyvista

    pl = plotter(lighting="none")
    pl.add_mesh(pyvista.Plane(i_resolution=1, j_resolution=1), lighting=False, **options)
    pl.enable_parallel_projection()
    pl.view_xy()
    return pl
