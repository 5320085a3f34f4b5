"""Small meshes with known answers, and what the tests are told by CTest."""

import os
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
