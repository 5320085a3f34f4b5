"""Instances, motion, levels of detail, cut-outs."""

import concurrent.futures
import multiprocessing
import pickle

import numpy as np
import pytest

import lkao
import meshes

P, N = meshes.points(400)


def masks_of(scene, **options):
    return lkao.AmbientOcclusion(scene, 64, radius=2.0, **options).query(P, N, masks=True).masks


def placed(V, matrix):
    """Positions as instances have them: in double precision, rounded once."""
    return (V.astype("f8") @ np.float32(matrix)[:, :3].astype("f8").T + np.float32(matrix)[:, 3]).astype("f4")


TURNED = np.array([[0, 0, 1, 0.25], [0, 0.5, 0, 0], [-1, 0, 0, 0.5]])
STAYS = np.eye(4)[:3]


def test_instances_have_the_bits_of_one_mesh():
    V, F = meshes.wall()
    scene = lkao.Scene.of_instances([lkao.Scene(V, F)], [STAYS, TURNED])
    flat = lkao.Scene(np.vstack([V, placed(V, TURNED)]), np.vstack([F, F + len(V)]))
    assert scene.instance_count == 2 and scene.occluder_count == flat.occluder_count == 8
    assert (masks_of(scene, surface_offset=0) == masks_of(flat, surface_offset=0)).all()
    assert (masks_of(scene) != masks_of(lkao.Scene(V, F))).any()


def test_moved_instances_are_where_they_are_said_to_be():
    V, F = meshes.wall()
    scene = lkao.Scene.of_instances([lkao.Scene(V, F)], [STAYS])
    before = lkao.AmbientOcclusion(scene, 64, radius=2.0, surface_offset=0)
    there = before.query(P, N, masks=True).masks
    scene.move([0], [TURNED])
    moved = lkao.Scene.of_instances([lkao.Scene(V, F)], [TURNED])
    assert (masks_of(scene, surface_offset=0) == masks_of(moved, surface_offset=0)).all()
    assert (before.query(P, N, masks=True).masks == there).all()  # it keeps the scene as it was
    assert (masks_of(scene, surface_offset=0) != there).any()
    scene.set_groups(0, 0)
    assert not masks_of(scene).any()


def test_groups_say_what_blocks():
    scene = lkao.Scene.of_instances([lkao.Scene(*meshes.wall())], [STAYS], groups=[2])
    ao = lkao.AmbientOcclusion(scene, 64, radius=2.0)
    assert not ao.query(P, N, groups=1, masks=True).masks.any()
    assert ao.query(P, N, groups=3, masks=True).masks.any()


def test_set_mesh_replaces_one():
    V, F = meshes.wall()
    lower = V * np.float32([1, 0.25, 1])
    scene = lkao.Scene.of_instances([lkao.Scene(V, F)], [STAYS])
    scene.set_mesh(0, lkao.Scene(lower, F, copy=False))
    assert (masks_of(scene, surface_offset=0) == masks_of(lkao.Scene(lower, F), surface_offset=0)).all()
    alone = lkao.Scene(V, F, copy=False)
    alone.set_mesh(0, lkao.Scene(lower, F, copy=False))
    for same in (alone, pickle.loads(pickle.dumps(alone))):
        assert (masks_of(same, surface_offset=0) == masks_of(scene, surface_offset=0)).all()


def test_refitted_scene_has_the_bits_of_a_new_one():
    V, F = meshes.grid(20)
    moved = V + np.float32([0, 0.3, 0]) * np.cos(4 * V[:, :1])
    for copy in (True, False):
        scene = lkao.Scene(V, F, copy=copy, spatial_splits=False)
        refitted = scene.refitted(moved.astype("f8"))
        assert (masks_of(refitted) == masks_of(lkao.Scene(moved, F))).all()
        assert (masks_of(refitted) != masks_of(scene)).any()
        assert refitted.report().growth >= 1


def test_pickled_scene_has_the_bits_of_the_first():
    V, F = meshes.grid(20)
    half_open = np.linspace(0, 1, len(F))
    far = V + np.array([5e6, 0, 0])
    first = lkao.Scene(V, F, copy=False, opacities=half_open)
    moved = lkao.Scene(V, F, copy=False, spatial_splits=False).refitted(V[:, ::-1])
    for scene in (first, moved, lkao.Scene(far, F, copy=False)):
        other = pickle.loads(pickle.dumps(scene))
        assert other.origin == scene.origin and other.occluder_count == scene.occluder_count
        points = P + scene.origin
        masks = [lkao.AmbientOcclusion(s, 64, radius=2.0).query(points, N, masks=True).masks for s in (scene, other)]
        assert (masks[0] == masks[1]).all() and masks[0].any()
    half_open[:] = 0  # what was given is not what was kept
    assert (masks_of(pickle.loads(pickle.dumps(first))) == masks_of(first)).all()


def test_pickled_instances_stand_where_they_are_now():
    V, F = meshes.wall()
    parts = [lkao.Scene(V, F, copy=False), lkao.Scene(V * np.float32(0.5), F, copy=False)]
    scene = lkao.Scene.of_instances(parts, [STAYS, STAYS, STAYS], mesh=[0, 1, 1], groups=[1, 2, 4])
    scene.move([1], [TURNED])
    scene.set_groups(2, 0)
    scene.set_mesh(0, lkao.Scene(V * np.float32([1, 0.25, 1]), F, copy=False))
    other = pickle.loads(pickle.dumps(scene))
    assert (other.instance_count, other.occluder_count) == (3, 12)
    assert (masks_of(other) == masks_of(scene)).all() and masks_of(scene).any()
    scene.move([1], [STAYS])
    assert (masks_of(other) != masks_of(scene)).any()
    ao = lkao.AmbientOcclusion(other, 64, radius=2.0)
    assert [ao.query(P, N, groups=groups).occlusion.any() for groups in (1, 2, 4)] == [True, True, False]


def test_scene_goes_to_another_process():
    V, F = meshes.wall()
    scene = lkao.Scene(V, F, copy=False)
    with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as others:
        there = others.submit(masks_of, scene).result(timeout=60)
    assert (there == masks_of(scene)).all() and there.any()


def test_scene_without_its_arrays_is_not_pickled():
    V, F = meshes.wall()
    for scene in (lkao.Scene(V, F), lkao.Scene.of_instances([lkao.Scene(V, F)], [STAYS])):
        with pytest.raises(TypeError, match="cannot be pickled.* copy=False"):
            pickle.dumps(scene)


def test_one_instance_is_no_mesh():
    V, F = meshes.wall()
    scene = lkao.Scene.of_instances([lkao.Scene(V, F)], [TURNED])
    with pytest.raises(ValueError, match="refitted is for a scene of one mesh"):
        scene.refitted(V)
    with pytest.raises(TypeError, match="meshes must be Scenes of one mesh each"):
        lkao.Scene.of_instances([scene], [STAYS])
    with pytest.raises(TypeError, match="mesh must be a Scene of one mesh"):
        scene.set_mesh(0, scene)


def test_report_counts_triangles():
    V = np.vstack([meshes.wall()[0], [[np.nan, 0, 0]]])
    F = np.vstack([meshes.wall()[1], [[0, 0, 1], [0, 1, 8]]])
    report = lkao.Scene(V, F).report()
    assert (report.triangle_count, report.occluder_count) == (6, 4)
    assert (report.zero_area_count, report.non_finite_count) == (1, 1)
    assert report.memory_bytes > 0 and report.seconds > 0


def test_opacities_thin_rays():
    V, F = meshes.disk(50, 1)
    seen = [
        lkao.AmbientOcclusion(lkao.Scene(V, F, opacities=np.full(len(F), share)), 1024, radius=float("inf"))
        .query([[0, 0, 0]], (0, 0, 1))
        .occlusion[0]
        for share in (0, 0.25, 1)
    ]
    assert seen[0] == 0 and 0.2 < seen[1] < 0.3 and seen[2] > 0.99


def test_levels_that_are_all_the_scene_change_nothing():
    scene = lkao.Scene(*meshes.wall())
    assert (masks_of([(scene, 0, 1), (scene, 1, float("inf"))]) == masks_of(scene)).all()


def test_levels_are_coarser_and_tile_distances():
    V, F = meshes.grid(40)
    levels = lkao.simplify(V, F, radius=1.0, levels=3)
    assert len(levels) == 3 and levels[0].V.tobytes() == V.tobytes() and levels[0].epsilon == 0
    assert levels[0].r_min == 0 and levels[-1].r_max == float("inf")
    for near, far in zip(levels, levels[1:]):
        assert near.r_max == far.r_min and len(far.F) < len(near.F)
    simple = lkao.AmbientOcclusion([(level.scene(), level.r_min, level.r_max) for level in levels], 256, radius=1.0)
    exact = lkao.AmbientOcclusion(lkao.Scene(V, F), 256, radius=1.0)
    points = V[::7] + np.float32([0, 0.01, 0])
    error = simple.query(points, (0, 1, 0)).occlusion - exact.query(points, (0, 1, 0)).occlusion
    assert np.sqrt(np.mean(error**2)) < 0.02
    given = lkao.simplify(V, F, epsilon=levels[1].epsilon, levels=3)
    assert given[1].F.tobytes() == levels[1].F.tobytes()


def test_pattern_is_what_it_says():
    pattern = lkao.Pattern(200, falloff="linear", seed=3)
    assert pattern.ray_count == 200 and pattern.word_count == 4 and pattern.lowest_elevation > 0
    assert pattern.disk.shape == (200, 2) and pattern.lengths.shape == (200,)
    assert np.allclose(np.linalg.norm(pattern.directions, axis=1), 1, atol=1e-6)
    assert np.allclose(pattern.directions[:, :2], pattern.disk)
    assert pattern.directions[:, 2].mean() > 0.6  # 2/3, by the cosine
    assert lkao.Pattern(200, weighting="uniform").directions[:, 2].mean() < 0.55
    assert 0.4 < pattern.lengths.mean() < 0.6 and (pattern.with_falloff("constant").lengths == 1).all()
    assert (lkao.Pattern(200, seed=3).disk == pattern.disk).all()
    steep, flat = (lkao.Pattern(64, falloff=("exponential", rate)).lengths.mean() for rate in (20.0, 1.0))
    assert steep < flat
    own = lkao.Pattern.from_disk([[0, 0], [0.5, 0]], [1, 0.5])
    assert own.disk.tolist() == [[0, 0], [0.5, 0]] and own.lengths.tolist() == [1, 0.5]


def test_origin_is_zero_where_floats_are_fine():
    V, F = meshes.wall()
    for positions in (V, V.astype("f8"), V.astype(int)):
        assert lkao.Scene(positions, F).origin == (0.0, 0.0, 0.0)
    assert lkao.Baking(V, F).P.dtype == np.float32
