"""
A contact sheet
===============

This draws a model from several sides on one sheet, with its dimensions.

``sheet.save("ring.png", report="ring.json")`` also writes a report that programs can read.
"""

import engine3d as e3d

ring = e3d.torus(1.0, 0.3)
sheet = e3d.sheets.contact_sheet(ring, views="top,iso,front,right", unit="mm", size=(640, 480))
picture = sheet.picture
