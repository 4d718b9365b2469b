"""The only gateway to the C core: one compiled extension module for each part of its API.

Modules here check shapes and dtypes, release the GIL, make one C call and turn its status into an
exception. They hold no algorithm and no loop over pixels, vertices or triangles.
"""
