"""EXR files as the program writes them: scanlines of 32-bit floats, without compression or by ZIP."""

import struct
import zlib

import numpy as np


def _header(data):
    """The attributes by name, and where they end."""
    assert data[:4] == b"\x76\x2f\x31\x01"
    attributes, at = {}, 8
    while data[at] != 0:
        name, kind, rest = data[at:].split(b"\0", 2)
        (size,) = struct.unpack_from("<i", rest)
        attributes[name.decode()] = rest[4 : 4 + size]
        at += len(name) + len(kind) + 2 + 4 + size
    return attributes, at + 1


def _channels(text):
    names = []
    while text[0] != 0:
        name, text = text.split(b"\0", 1)
        assert struct.unpack_from("<i", text) == (2,), "no 32-bit floats"
        names.append(name.decode())
        text = text[16:]
    return names


def _unzipped(block):
    """Undoes the differences of neighbours, and puts both halves of each word together."""
    raw = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    raw = (np.cumsum(raw) - 128 * np.arange(len(raw))).astype(np.uint8)
    mixed = np.empty_like(raw)
    half = (len(raw) + 1) // 2
    mixed[0::2], mixed[1::2] = raw[:half], raw[half:]
    return mixed.tobytes()


def read(path):
    """Channels by name, (height, width) each."""
    data = path.read_bytes()
    attributes, at = _header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height, names = right - left + 1, bottom - top + 1, _channels(attributes["channels"])
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    rows = np.empty((height, len(names), width), "<f4")
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        first, size = struct.unpack_from("<2i", data, offset)
        block, target = data[offset + 8 : offset + 8 + size], rows[first - top : first - top + lines]
        target[...] = np.frombuffer(block if size == target.nbytes else _unzipped(block), "<f4").reshape(target.shape)
    return {name: rows[:, i] for i, name in enumerate(names)}
