"""What breaks a rule of this folder's tests today. These lists only shrink.

Where a breach is to stay, a comment says why.
"""

# Keywords are what users and agents write. Those of compat are of the libraries that it stands for.
LONG_SIGNATURES = (
    "apps.agents.tools.render",
    "apps.batch.running.run",
    "apps.drawings.drawing_sheet.drawing_sheet",
    "apps.sheet.contact_sheet.contact_sheet",
    "compat.open3d.drawing_functions.draw",
    "compat.open3d.drawing_functions.draw_geometries",
    "compat.open3d.rendering.low_level_scene.add_spot_light",
    "compat.pybullet.camera_image.getCameraImage",
    "compat.pyrender.material.__init__",
    "compat.pyrender.node.__init__",
    "compat.pyrender.primitive.__init__",
    "compat.trimesh.windowed.__init__",
    "model.geometry.mesh.__init__",
    "model.navigation.grid.__init__",
    "model.scene.lights.__init__",
    "model.scene.scene.add",
    "stage.render.render",
)
# The attributes are those that users know; in compat, those of MuJoCo and pyrender.
LARGE_CLASSES = (
    "compat.mujoco.context.MjrContext",
    "compat.pyrender.viewer.Viewer",
    "model.geometry.mesh.Mesh",
)
# The core's public headers, which Cython reads as one list; and a module for each part of them.
FULL_FOLDERS = ("csrc/include", "engine/_native")
REPEATED_NAMES = ()
PRIVATE_READS = ()
REPEATED_LISTS = {
    "a row for each of a list that stands in a layer that knows nothing of the rows": (
        "apps.editor.console, apps.editor.ui.console_panel: action to warning",
        "apps.editor.ui.editor_window, apps.editor.ui.panel_layout, apps.editor.ui.workspace: "
        "Console to Timeline",
        "apps.viewer.actions, choices: all to tree",
        "apps.viewer.window, choices: arrow to working",
        "choices, rendering.frame: jpeg to webp",
        "choices, stage.lighting: headlight to two colours",
    ),
    "what is written, and the shape that is demanded of what is read": (
        "apps.batch.records: files to said",
        "apps.datasets.bop: bbox_obj to visib_fract",
        "apps.datasets.bop: cam_K to depth_scale",
        "apps.datasets.folders: camera to things",
        "io.formats.gltf.gltf_textures, io.formats.gltf.written_materials: magFilter to wrapT",
    ),
    "the same record of two kinds of things, each value found in another way": (
        "apps.cli.commands.info: animations to variants",
        "io.formats.stl, io.reading.posed_parts: faces to vertices",
    ),
}
