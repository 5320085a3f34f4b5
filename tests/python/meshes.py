"""Small meshes with known answers, and what the tests are told by CTest."""

import base64
import json
import os
import struct
import zlib
from pathlib import Path

import numpy as np

BUILD = Path(os.environ["LKAO_TEST_BUILD"])
SOURCE = Path(os.environ["LKAO_TEST_SOURCE"])
CONFIG = os.environ["LKAO_TEST_CONFIG"]


def wall():
    """A floor at y = 0 and a wall on it at z = 0: half of what is around its foot is blocked."""
    V = [[-5, 0, -5], [5, 0, -5], [5, 0, 5], [-5, 0, 5], [-5, 0, 0], [5, 0, 0], [5, 5, 0], [-5, 5, 0]]
    F = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]]
    return np.array(V, np.float32), np.array(F, np.uint32)


def box():
    """From -1 to 1, closed."""
    V = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float32)
    F = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4]]
    return V, np.array(F + [[1, 5, 7], [1, 7, 3]], np.uint32)


def disk(radius, height, count=512):
    """A disk above the origin, facing down."""
    angles = 2 * np.pi * np.arange(count) / count
    rim = np.stack([radius * np.cos(angles), radius * np.sin(angles), np.full(count, height)], 1)
    F = [[count, (i + 1) % count, i] for i in range(count)]
    return np.vstack([rim, [0, 0, height]]).astype(np.float32), np.array(F, np.uint32)


def grid(count):
    """A wavy square of 2 count^2 triangles over [-1, 1]^2."""
    x, z = np.meshgrid(np.linspace(-1, 1, count + 1), np.linspace(-1, 1, count + 1), indexing="ij")
    V = np.stack([x, 0.2 * np.sin(5 * x) * np.cos(7 * z), z], -1).reshape(-1, 3).astype(np.float32)
    i = (np.arange(count)[:, None] * (count + 1) + np.arange(count)[None, :]).reshape(-1)
    quads = np.stack([i, i + 1, i + count + 2, i + count + 1], 1)
    F = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return V, F.astype(np.uint32)


def points(count, seed=1):
    """Receivers around the wall, above the floor."""
    random = np.random.default_rng(seed)
    P = random.uniform([-2, 0.01, -2], [2, 2, 2], (count, 3)).astype(np.float32)
    N = random.normal(size=(count, 3)).astype(np.float32)
    return P, N


def values_in_ply(path):
    """The property occlusion of the vertices or faces of a PLY of lkao."""
    header, _, data = path.read_bytes().partition(b"end_header\n")
    sizes = {b"float": "<f4", b"uchar": "u1", b"int": "<i4", b"uint": "<u4"}
    values, elements = None, []
    for line in header.split(b"\n"):
        words = line.split()
        if words[:1] == [b"element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == [b"property"] and words[1] == b"list":
            elements[-1][2].extend([("count", sizes[words[2]]), ("corners", sizes[words[3]], 3)])
        elif words[:1] == [b"property"]:
            elements[-1][2].append((words[2].decode(), sizes[words[1]]))
    offset = 0
    for _, count, fields in elements:
        table = np.frombuffer(data, np.dtype(fields), count, offset)
        offset += table.nbytes
        if "occlusion" in table.dtype.names:
            values = table["occlusion"]
    return values


def png(pixels):
    """A PNG of (height, width, channels) of uint8: 1 channel is grey, 4 are red, green, blue and alpha."""
    height, width, channels = pixels.shape

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 4: 6}[channels], 0, 0, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    parts = (chunk(b"IHDR", head), chunk(b"IDAT", zlib.compress(rows)), chunk(b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def write_gltf(path, V, F, UV, alpha, material, sampler=None):
    """A mesh of one material, whose colour is an image of that alpha, (height, width). UV is from the upper left."""
    parts = [np.ascontiguousarray(V, "<f4"), np.ascontiguousarray(UV, "<f4"), np.ascontiguousarray(F, "<u4")]
    image = png(np.dstack([np.zeros((*alpha.shape, 3), np.uint8), alpha]))
    blobs = [*(part.tobytes() for part in parts), image]
    offsets = np.cumsum([0, *map(len, blobs)])
    data = base64.b64encode(b"".join(blobs)).decode()
    views = [{"buffer": 0, "byteOffset": int(o), "byteLength": len(b)} for o, b in zip(offsets, blobs)]
    kinds = [(5126, len(V), "VEC3"), (5126, len(V), "VEC2"), (5125, 3 * len(F), "SCALAR")]
    accessors = [
        {"bufferView": i, "componentType": number, "count": count, "type": kind}
        for i, (number, count, kind) in enumerate(kinds)
    ]
    accessors[0].update(min=V.min(0).astype(float).tolist(), max=V.max(0).astype(float).tolist())
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}
    looks = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, **material}
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": int(offsets[-1]), "uri": "data:application/octet-stream;base64," + data}],
        "bufferViews": views,
        "accessors": accessors,
        "images": [{"bufferView": 3, "mimeType": "image/png"}],
        "samplers": [sampler or {}],
        "textures": [{"source": 0, "sampler": 0}],
        "materials": [looks],
        "meshes": [{"primitives": [primitive]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }
    path.write_text(json.dumps(document))
