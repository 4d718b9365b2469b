"""One small file of each format that uses much of it: what damaged files are made from.

In: nothing. Out: `FILES`, from a name to bytes; files that name others (a material, a texture) name
those here. The tests of damaged files and the fuzzers start from them.
"""

import struct

OBJ = b"""# a house
mtllib house.mtl
o walls
v 0 0 0 1 .5 0
v 1 0 0 1 .5 0
v 1 1 0 1 .5 0
v .5 1.5 0
v 0 1 0
vt 0 0
vt 1 0
vt .5 1
vn 0 0 1
g front a
usemtl brick
s 1
f 1/1/1 2/2/1 3/3/1 4/1/1 5/2/1
s off
f -1 -2 \\
 -3
l 1 2 3
p 1 -1
"""
MTL = b"""newmtl brick
Kd .8 .2 .1
Ks 1 1 1
Ns 20
d .5
map_Kd -s 2 2 1 -o .5 0 house.tga
map_Bump -bm 2 house.tga
"""
ASC = b"""Ambient light color: Red=0.3 Green=0.3 Blue=0.3

Named object: "Lamp"
Direct light
Position:  X:1 Y:2 Z:3
Light color: Red=1 Green=1 Blue=1

Named object: "Eye"
Camera (50.0mm)
Position:  X:0 Y:-5 Z:1
Target:  X:0 Y:0 Z:0

Named object: "Square"
Tri-mesh, Vertices: 4     Faces: 2
Mapped
Vertex list:
Vertex 0:  X:0     Y:0     Z:0     U:0     V:0
Vertex 1:  X:2     Y:0     Z:0     U:1     V:0
Vertex 2:  X:2     Y:2     Z:0     U:1     V:1
Vertex 3:  X:0     Y:2     Z:0     U:0     V:1
Face list:
Face 0:    A:0 B:1 C:2 AB:1 BC:1 CA:0
Material:"r255g128b0a0"
Smoothing:  1, 3
Face 1:    A:0 B:2 C:3 AB:0 BC:1 CA:1
Smoothing:  2
"""
TGA = bytes([2, 1, 9, 1, 0, 2, 0, 24, 0, 0, 0, 0, 4, 0, 2, 0, 8, 0x20]) + b"id"
TGA += bytes([1, 2, 3, 4, 5, 6, 0x82, 1, 0x04, 1, 2, 1, 2, 1])
PLY = b"""ply
format ascii 1.0
comment TextureFile house.tga
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
property list uchar float texcoord
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 255 0 0
1 0 0 255 0 0
1 1 0 255 0 9
0 1 0 255 0 9
3 0 1 2 6 0 0 1 0 1 1
4 0 1 2 3 8 0 0 1 0 1 1 0 1
0 2
"""
BINARY_PLY = PLY[: PLY.index(b"end_header")].replace(b"ascii", b"binary_big_endian")
BINARY_PLY += b"end_header\n" + b"".join(
    struct.pack(">3f3B", *row)
    for row in [(0, 0, 0, 9, 9, 9), (1, 0, 0, 9, 9, 9), (1, 1, 0, 9, 9, 9), (0, 1, 0, 9, 9, 9)]
)
BINARY_PLY += struct.pack(">B3iB6f", 3, 0, 1, 2, 6, 0, 0, 1, 0, 1, 1)
BINARY_PLY += struct.pack(">B4iB8f2i", 4, 0, 1, 2, 3, 8, 0, 0, 1, 0, 1, 1, 0, 1, 0, 2)

_FACET = b"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
_FACET += b"vertex 0 %d 0\nendloop\nendfacet\n"
STL = b"solid roof\n" + _FACET % 1 + _FACET % 2 + b"endsolid roof\n"
BINARY_STL = b"solid".ljust(80) + struct.pack("<I24fH", 1, *range(24), 0)[:54]
OFF = b"""COFF
4 2 0 # a roof
0 0 0 255 0 0
1 0 0 255 0 0
1 1 0 255 0 9
0 1 0 255 0 9
3 0 1 2 .5 1 0
4 0 1 2 3
"""

FILES = {
    "house.obj": OBJ,
    "house.mtl": MTL,
    "a.asc": ASC,
    "house.tga": TGA,
    "a.ply": PLY,
    "binary.ply": BINARY_PLY,
    "a.stl": STL,
    "binary.stl": BINARY_STL,
    "a.off": OFF,
}
