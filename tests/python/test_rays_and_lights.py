"""Bundles, soft shadows and the sky, by closed forms."""

import numpy as np
import pytest

import lkao
import meshes


def test_bundles_say_which_rays_are_blocked():
    bundles = lkao.RayBundles(lkao.Scene(*meshes.box()))
    rays = np.array([[0.5, 0, 0], [1.5, 0, 0], [0, -2, 0], [0, 0, 0]])
    blocked = lkao.unpack(bundles.blocked(np.zeros((2, 3)), rays), 4)
    assert blocked.tolist() == [[False, True, True, False]] * 2
    each = lkao.unpack(bundles.blocked([[0, 0, 0], [0.75, 0, 0]], [rays, -rays]), 4)
    assert each.tolist() == [[False, True, True, False], [False, False, True, False]]
    one = lkao.unpack(bundles.blocked((0, 0, 0), rays), 4)
    assert one.tolist() == blocked[0].tolist()


def test_bundles_of_many_origins_and_rays():
    rays = np.random.default_rng(3).normal(size=(100, 3))
    origins = np.zeros((40000, 3), np.float32)
    masks = lkao.RayBundles(lkao.Scene(*meshes.box())).blocked(origins, rays)
    inside = np.abs(rays).max(1) < 1
    assert masks.shape == (40000, 2) and 0 < inside.sum() < 100
    assert (lkao.unpack(masks[[0, -1]], 100) == ~inside).all() and (masks == masks[0]).all()


def test_one_sided_bundles_and_excluded_triangles():
    V, F = np.array([[-9, 1, -9], [9, 1, -9], [0, 1, 9]]), np.array([[0, 1, 2]])
    scene = lkao.Scene(V, F)
    sides = [lkao.RayBundles(scene, sided="one").blocked((0, y, 0), [[0, 2 - 2 * y, 0]])[0] for y in (0, 2)]
    assert sorted(map(int, sides)) == [0, 1]
    assert lkao.RayBundles(scene).blocked((0, 0, 0), [[0, 2, 0]], excluded=0) == 0


def test_half_a_light_is_hidden():
    # A half plane at x < 0 between the receiver and a light straight above it.
    V, F = np.array([[0, 1, -9], [0, 1, 9], [-9, 1, 9], [-9, 1, -9]]), np.array([[0, 1, 2], [0, 2, 3]])
    scene = lkao.Scene(V, F)
    for light in (lkao.DiscLight((0, 2, 0), (0, -1, 0), 0.5), lkao.SphereLight((0, 2, 0), 0.5)):
        answers = lkao.SoftShadows(scene, light, 1024).query([[0, 0, 0], [5, 0, 0], [-5, 0, 0]], (0, 1, 0), masks=True)
        assert answers.visibility == pytest.approx([0.5, 1, 0], abs=0.02)
        assert answers.above_horizon == pytest.approx([1, 1, 1])
        assert lkao.unpack(answers.masks, 1024).mean(1) == pytest.approx(1 - answers.visibility, abs=1e-6)


def test_sky_over_a_plane_is_half():
    V, F = np.array([[-1e4, 0, -1e4], [1e4, 0, -1e4], [0, 0, 2e4]]), np.array([[0, 2, 1]])
    answers = lkao.SkyVisibility(lkao.Scene(V, F), 1024).query([[0, 1, 0]], (0, 1, 0))
    assert answers.above == pytest.approx(1) and answers.below < 0.01
    assert answers.visibility == pytest.approx(0.5, abs=0.005)
    assert answers.report.ray_count == 1024


def test_lights_of_scenes_far_from_zero():
    far = np.array([5e6, 0, 0])
    V, F = meshes.wall()
    P, N = meshes.points(100)
    answers = []
    for shift in (np.zeros(3), far):
        scene = lkao.Scene(V.astype("f8") + shift, F)
        light = lkao.SphereLight(np.array([0, 1, -3]) + shift, 0.5)
        answers.append(lkao.SoftShadows(scene, light, rotation=0).query(P.astype("f8") + shift, N).visibility)
    assert np.allclose(*answers, atol=0.03) and 0.1 < answers[0].mean() < 0.9
