"""Answers: closed forms, and bit for bit those of C++."""

import subprocess

import numpy as np
import pytest

import lkao
import meshes


def test_open_plane_blocks_nothing():
    V, F = meshes.wall()
    P, N = np.array([[1, 0, 3], [-2, 0, 4]], np.float32), (0, 1, 0)
    assert (lkao.occlusion(V, F, P, N, radius=1.0, samples=256) == 0).all()


def test_closed_box_blocks_everything():
    P, N = np.zeros((3, 3)), np.eye(3)
    assert (lkao.occlusion(*meshes.box(), P, N, radius=4.0) == 1).all()


def test_foot_of_a_wall_sees_half():
    V, F = meshes.wall()
    foot = lkao.occlusion(V, F, [[0, 0, 0.001]], [[0, 1, 0]], radius=2.0, samples=1024)
    assert foot == pytest.approx(0.5, abs=0.01)


def test_disk_blocks_its_share():
    for radius, height in ((1, 1), (2, 1), (1, 3)):
        V, F = meshes.disk(radius, height)
        seen = lkao.occlusion(V, F, np.zeros((1, 3)), (0, 0, 1), radius=float("inf"), samples=1024)
        assert seen == pytest.approx(radius**2 / (radius**2 + height**2), abs=0.01)


def test_bits_are_those_of_cpp(tmp_path):
    file = tmp_path / "answers.raw"
    subprocess.run([meshes.BUILD / "bin/lkao_raw_answers", file], check=True)
    raw, size = file.read_bytes(), 40 * 30
    floats = np.frombuffer(raw[: size * 13 * 4], np.float32)
    P, N, G = (floats[size * 3 * i : size * 3 * (i + 1)].reshape(30, 40, 3) for i in range(3))
    occlusion = floats[size * 9 : size * 10].reshape(30, 40)
    bent_normals = floats[size * 10 :].reshape(30, 40, 3)
    masks = np.frombuffer(raw[size * 13 * 4 :], np.uint64).reshape(30, 40, 2)

    V, F = lkao.load("builtin:atrium")
    view = lkao.View(V, F, eye=(0, 2, 6), target=(0, 2, 0), fov=70, width=40, height=30)
    for ours, theirs in ((view.P, P), (view.N, N), (view.geometric_normals, G)):
        assert ours.tobytes() == theirs.tobytes()

    ao = lkao.AmbientOcclusion(lkao.Scene(V, F), 100, radius=2.0, seed=5)
    answers = ao.query(P, N, geometric_normals=G, first_index=7, bent_normals=True, masks=True)
    assert answers.occlusion.tobytes() == occlusion.tobytes()
    assert answers.bent_normals.tobytes() == bent_normals.tobytes()
    assert answers.masks.tobytes() == masks.tobytes()
    assert 0.1 < np.nanmean(answers.occlusion) < 0.9


def query_of_wall(**options):
    return lkao.AmbientOcclusion(lkao.Scene(*meshes.wall()), 128, radius=2.0, **options)


def test_parts_have_the_bits_of_the_whole():
    ao, (P, N) = query_of_wall(), meshes.points(40000)
    whole = ao.query(P, N, masks=True)
    for first, last in ((0, 1), (1, 33000), (33000, 40000)):
        part = ao.query(P[first:last], N[first:last], first_index=first, masks=True, threads=1)
        assert part.masks.tobytes() == whole.masks[first:last].tobytes()
        assert part.occlusion.tobytes() == whole.occlusion[first:last].tobytes()
    assert whole.report.receiver_count == 40000
    assert whole.report.ray_count == 40000 * 128


def test_masks_count_what_occlusion_says():
    ao, (P, N) = query_of_wall(), meshes.points(500)
    answers = ao.query(P, N, masks=True)
    blocked = lkao.unpack(answers.masks, 128)
    assert blocked.shape == (500, 128) and blocked.dtype == bool
    assert np.allclose(blocked.mean(1), answers.occlusion, atol=1e-6)
    assert answers.report.blocked_ray_count == blocked.sum() > 0
    assert np.allclose(answers.visibility, 1 - answers.occlusion)


def test_rays_are_those_that_masks_tell_of():
    ao = query_of_wall(rotation=0.0)
    start, segments, cast = ao.rays((0, 1, 3), (0, 1, 0))
    assert cast.all() and segments.shape == (128, 3)
    assert np.allclose(np.linalg.norm(segments, axis=1), 2, rtol=1e-6)
    blocked = lkao.RayBundles(lkao.Scene(*meshes.wall())).blocked(start, segments)
    assert (blocked == ao.query((0, 1, 3), (0, 1, 0), masks=True).masks).all()


def test_invalid_receivers_are_nan_and_counted():
    P, N = np.array([[0, 1, 1], [np.nan, 0, 0], [0, 1, 1]]), np.array([[0, 1, 0], [0, 1, 0], [0, 0, 0]])
    answers = query_of_wall().query(P, N, bent_normals=True)
    assert np.isnan(answers.occlusion).tolist() == [False, True, True]
    assert np.isnan(answers.bent_normals[1:]).all()
    assert answers.report.invalid_receiver_count == 2


def test_excluded_triangle_does_not_block():
    V, F = np.array([[-9, 1, -9], [9, 1, -9], [0, 1, 9]]), np.array([[0, 1, 2]])
    ao = lkao.AmbientOcclusion(lkao.Scene(V, F), radius=float("inf"))
    P = np.zeros((2, 3))
    blocked = ao.query(P, (0, 1, 0), excluded=[-1, 0]).occlusion
    assert blocked[0] > 0.9 and blocked[1] == 0


def test_one_sided_triangles_block_only_what_is_in_front():
    V, F = meshes.disk(1, 1)
    below = {side: lkao.occlusion(V, F, [[0, 0, 0]], (0, 0, 1), radius=3.0, sided=side)[0] for side in ("one", "two")}
    above = lkao.occlusion(V, F, [[0, 0, 2]], (0, 0, -1), radius=3.0, sided="one")[0]
    assert below["one"] == below["two"] > 0.4 and above == 0


def test_kernels_and_tables_have_the_same_bits():
    P, N = meshes.points(300)
    scene = lkao.Scene(*meshes.wall())
    table = lkao.PlaneMaskTable(64, resolution=32)
    masks = [
        lkao.AmbientOcclusion(scene, samples, radius=2.0, kernel=kernel).query(P, N, masks=True).masks
        for samples, kernel in ((64, "simd"), (64, "scalar"), (table, "simd"))
    ]
    assert masks[0].any() and (masks[0] == masks[1]).all() and (masks[0] == masks[2]).all()
    assert table.cell_count > 32**2 and table.memory_bytes > 0 and table.build_seconds > 0
    must, may = table.masks_of(table.cell((0, 0, 1), 0.5))
    assert (must & ~may == 0).all() and may.any()


def test_falloff_darkens_less():
    P, N = meshes.points(200)
    scene = lkao.Scene(*meshes.wall())
    mean = {
        name: lkao.AmbientOcclusion(scene, lkao.Pattern(256, falloff=falloff), radius=2.0).query(P, N).occlusion.mean()
        for name, falloff in (("constant", "constant"), ("linear", "linear"), ("own", lambda x: 1 - x))
    }
    assert mean["linear"] == mean["own"] < mean["constant"]


def test_shape_is_that_of_points():
    ao = query_of_wall()
    one = ao.query((0, 0.5, 1), (0, 1, 0), masks=True, bent_normals=True)
    assert one.occlusion.shape == () and one.masks.shape == (2,) and one.bent_normals.shape == (3,)
    P, N = meshes.points(24)
    image = ao.query(P.reshape(2, 3, 4, 3), N.reshape(2, 3, 4, 3), masks=True)
    assert image.masks.shape == (2, 3, 4, 2)
    assert image.occlusion.tobytes() == ao.query(P, N).occlusion.tobytes()
    empty = ao.query(np.zeros((0, 3)), np.zeros((0, 3)), masks=True, bent_normals=True)
    assert empty.occlusion.shape == (0,) and empty.masks.shape == (0, 2) and empty.report.ray_count == 0
