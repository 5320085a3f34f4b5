"""Baking: in parts, and as the program does it."""

import subprocess

import numpy as np
import pytest

import lkao
import meshes


@pytest.mark.parametrize(
    "options, arguments",
    [
        ({}, []),
        ({"per": "face"}, ["--per", "face"]),
        ({"filter": "least-squares", "seed": 3}, ["--filter", "least-squares", "--seed", "3"]),
        ({"normals": "smooth", "sided": "one"}, ["--normals", "smooth", "--sided", "one"]),
    ],
    ids=["vertex", "face", "least-squares", "smooth"],
)
def test_values_are_those_of_the_program(tmp_path, options, arguments):
    V, F = meshes.grid(12)
    F = np.vstack([F, F + len(V), [[0, 0, 1]]])
    V = np.vstack([V, V * np.float32([1, 1, -1]) + np.float32([0, 0.3, 0.1])])
    V += 0.0  # no -0, whose sign files of text lose
    obj = tmp_path / "mesh.obj"
    obj.write_text(
        "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in V.astype("f8").tolist())
        + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in F)
    )
    ply = tmp_path / "baked.ply"
    program = meshes.BUILD / "bin/lkao"
    arguments = ["--radius", "0.5", "--samples", "64", "--quiet", *arguments]
    subprocess.run([program, "bake", obj, "-o", ply, *arguments], check=True)
    ours = lkao.bake(V, F, radius=0.5, samples=64, **options)
    if options.get("per") == "face":
        assert np.isnan(ours[-1])  # the program has dropped the triangle without area
        ours = ours[:-1]
    theirs = meshes.values_in_ply(ply)
    assert theirs.max() > 0.2 and np.nan_to_num(ours).tobytes() == theirs.tobytes()


@pytest.mark.parametrize("filter", ["none", "least-squares"])
def test_values_with_given_normals_are_those_of_the_program(tmp_path, filter):
    V, F = meshes.grid(6)
    V += 0.0
    normals = np.random.default_rng(2).uniform([-1, 1, -1], [1, 3, 1], V.shape).astype(np.float32)
    obj, ply = tmp_path / "mesh.obj", tmp_path / "baked.ply"
    obj.write_text(
        "".join(f"{word} {x!r} {y!r} {z!r}\n" for word, a in (("v", V), ("vn", normals)) for x, y, z in a.tolist())
        + "".join("f " + " ".join(f"{i + 1}//{i + 1}" for i in corners) + "\n" for corners in F)
    )
    arguments = ["--radius", "0.5", "--samples", "64", "--filter", filter, "--quiet"]
    subprocess.run([meshes.BUILD / "bin/lkao", "bake", obj, "-o", ply, *arguments], check=True)
    theirs = meshes.values_in_ply(ply)
    file = lkao.MeshFile(obj)
    for given in (normals, normals[F], file.normals):
        ours = lkao.bake(V, F, radius=0.5, samples=64, filter=filter, normals=given)
        assert ours.tobytes() == theirs.tobytes()
    assert (lkao.bake(V, F, radius=0.5, samples=64, filter=filter) != theirs).any() and theirs.max() > 0.1


def test_corners_without_a_normal_are_smooth():
    V, F = meshes.grid(6)
    none = np.zeros((len(F), 3, 3))
    none[::2] = np.nan
    smooth = lkao.bake(V, F, radius=0.5, normals="smooth")
    assert lkao.bake(V, F, radius=0.5, normals=none).tobytes() == smooth.tobytes()
    assert (lkao.bake(V, F, radius=0.5) != smooth).any()


def test_parts_have_the_bits_of_the_whole():
    V, F = meshes.wall()
    whole = lkao.bake(V, F, radius=3.0, samples=256, seed=9)
    baking = lkao.Baking(V, F)
    ao = lkao.AmbientOcclusion(lkao.Scene(V, F), 256, radius=3.0, seed=9)
    parts = []
    for first, last in ((0, 5), (5, 6), (6, len(baking.P))):
        rows = slice(first, last)
        geometric = baking.geometric_normals[rows]
        parts.append(
            ao.query(baking.P[rows], baking.N[rows], geometric_normals=geometric, first_index=first).occlusion
        )
    assert baking.values(np.concatenate(parts)).tobytes() == whole.tobytes()
    assert 0.2 < whole[4] < 0.9  # at the foot of the wall


def test_corners_differ_along_a_crease():
    V, F = meshes.box()
    V = V.astype("f8")
    outside = lkao.bake(V, F, radius=1.0, per="corner")
    assert outside.shape == (12, 3) and (outside == 0).all()
    inside = lkao.bake(V, F[:, ::-1], radius=9.0, per="corner", normals="smooth")
    assert inside.shape == (12, 3) and (inside == 1).all()


def test_vertices_without_a_triangle_are_nan():
    V, F = meshes.wall()
    values = lkao.bake(np.vstack([V, [[9, 9, 9]]]), F, radius=1.0)
    assert np.isnan(values).tolist() == [False] * 8 + [True]


def test_another_scene_may_block():
    V, F = meshes.wall()
    roof = lkao.Scene(np.vstack([V, V[:4] + np.float32([0, 0.5, 0])]), np.vstack([F, F[:2] + 8]))
    darker, own = lkao.bake(V, F, radius=3.0, scene=roof), lkao.bake(V, F, radius=3.0)
    assert (darker[:4] > own[:4] + 0.1).all()


def test_mesh_far_from_zero():
    V, F = meshes.wall()
    shift = np.array([5e6, 0, 3e6])
    far = lkao.bake(V + shift, F, radius=3.0, samples=1024)
    assert np.allclose(far, lkao.bake(V, F, radius=3.0, samples=1024), atol=0.03)
