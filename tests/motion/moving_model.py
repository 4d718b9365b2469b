"""A small glTF file: a flag of two joints, two clips and two cameras."""

import base64
import json

import numpy as np

TURN = np.sqrt(0.5)


class Buffer:
    """Accessors over one buffer."""

    def __init__(self):
        self.data = b""
        self.views = []
        self.accessors = []

    def add(self, array, kind, component=5126, **more):
        array = np.ascontiguousarray(array)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": array.nbytes}
        self.views.append(view)
        self.data += array.tobytes() + bytes(-array.nbytes % 4)
        accessor = {"bufferView": len(self.views) - 1, "componentType": component, "type": kind}
        self.accessors.append({**accessor, "count": len(array), **more})
        return len(self.accessors) - 1


def flag(path):
    """Write the file; at the end of the clip "turn" its upper half points along -X."""
    buffer = Buffer()
    x, y = np.meshgrid([-0.25, 0.25], [0.0, 1.0, 2.0])
    positions = np.stack([x.ravel(), y.ravel(), np.zeros(6)], axis=1).astype(np.float32)
    faces = np.uint16([(0, 1, 2), (1, 3, 2), (2, 3, 4), (3, 5, 4)]).ravel()
    weights = np.float32([(1, 0), (1, 0), (0.5, 0.5), (0.5, 0.5), (0, 1), (0, 1)])
    weights = np.pad(weights, ((0, 0), (0, 2)))
    binds = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
    binds[1, 3, 1] = -1.0  # column after column
    joints = np.tile(np.uint8([0, 1, 0, 0]), (6, 1))
    times = buffer.add(np.float32([0, 2]), "SCALAR", min=[0], max=[2])
    attributes = {
        "POSITION": buffer.add(positions, "VEC3", min=[-0.25, 0, 0], max=[0.25, 2, 0]),
        "JOINTS_0": buffer.add(joints, "VEC4", 5121),
        "WEIGHTS_0": buffer.add(weights, "VEC4"),
    }
    primitive = {"attributes": attributes, "indices": buffer.add(faces, "SCALAR", 5123)}
    primitive["material"] = 0
    turned = buffer.add(np.float32([(0, 0, 0, 1), (0, 0, TURN, TURN)]), "VEC4")
    raised = buffer.add(np.float32([(0, 0, 0), (0, 3, 0)]), "VEC3")
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 3, 4]}],
        "nodes": [
            {"mesh": 0, "skin": 0, "name": "flag", "translation": [50, 0, 0]},
            {"name": "pole", "children": [2]},
            {"name": "top", "translation": [0, 1, 0]},
            {"camera": 0, "translation": [0, 1, 5], "name": "front"},
            {"camera": 1, "translation": [0, 1, 5], "rotation": [0, 0, TURN, TURN]},
        ],
        "meshes": [{"primitives": [primitive]}],
        "materials": [{"doubleSided": True, "extensions": {"KHR_materials_unlit": {}}}],
        "extensionsUsed": ["KHR_materials_unlit"],
        "cameras": [
            {"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}},
            {
                "type": "orthographic",
                "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 10},
            },
        ],
        "skins": [
            {"joints": [1, 2], "inverseBindMatrices": buffer.add(binds.reshape(2, 16), "MAT4")}
        ],
        "animations": [
            clip("turn", times, turned, 2, "rotation"),
            clip("rise", times, raised, 1, "translation"),
        ],
    }
    data = base64.b64encode(buffer.data).decode()
    uri = "data:application/octet-stream;base64," + data
    tree |= {
        "buffers": [{"byteLength": len(buffer.data), "uri": uri}],
        "bufferViews": buffer.views,
        "accessors": buffer.accessors,
    }
    path.write_text(json.dumps(tree))
    return path


def clip(name, times, values, node, path):
    return {
        "name": name,
        "samplers": [{"input": times, "output": values}],
        "channels": [{"sampler": 0, "target": {"node": node, "path": path}}],
    }
