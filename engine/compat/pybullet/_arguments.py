"""The arguments of pybullet's functions by name, as its C source (pybullet.c) orders them.

In: a call's arguments. Out: a dict. Functions of C do not tell their signatures.
"""

from __future__ import annotations

from typing import Any

CLIENT = "physicsClientId"
_NAMES = {
    "setAdditionalSearchPath": "path",
    "loadTexture": "textureFilename",
    "changeVisualShape": """
        objectUniqueId linkIndex shapeIndex textureUniqueId rgbaColor specularColor flags""",
    "createVisualShape": """
        shapeType radius halfExtents length fileName meshScale planeNormal flags rgbaColor
        specularColor visualFramePosition visualFrameOrientation vertices indices normals uvs""",
    "createCollisionShape": """
        shapeType radius halfExtents height fileName meshScale planeNormal flags
        collisionFramePosition collisionFrameOrientation vertices indices
        heightfieldTextureScaling heightfieldData numHeightfieldRows numHeightfieldColumns
        replaceHeightfieldIndex""",
    "createMultiBody": """
        baseMass baseCollisionShapeIndex baseVisualShapeIndex basePosition baseOrientation
        baseInertialFramePosition baseInertialFrameOrientation linkMasses
        linkCollisionShapeIndices linkVisualShapeIndices linkPositions linkOrientations
        linkInertialFramePositions linkInertialFrameOrientations linkParentIndices
        linkJointTypes linkJointAxis useMaximalCoordinates flags batchPositions""",
    "resetSimulation": "flags",
    "removeBody": "bodyUniqueId",
    "disconnect": "",
}


def arguments(function: str, args: tuple[Any, ...], keywords: dict[str, Any]) -> dict[str, Any]:
    """Return what a call gives, and the number of its client."""
    names = *_NAMES[function].split(), CLIENT
    return {CLIENT: 0, **dict(zip(names, args, strict=False)), **keywords}
