"""Arrays of any dtype and layout, and what is refused."""

import re

import numpy as np
import pytest

import lkao
import meshes

V, F = meshes.wall()
P, N = meshes.points(50)
EXPECTED = lkao.occlusion(V, F, P, N, radius=2.0).tobytes()


def is_expected(*arrays):
    return lkao.occlusion(*arrays, radius=2.0).tobytes() == EXPECTED


def test_expected_is_not_trivial():
    answers = np.frombuffer(EXPECTED, np.float32)
    assert answers.max() > 0.3 and answers.min() < 0.1


@pytest.mark.parametrize("dtype", ["f8", "f4", ">f4", "f2", "i8", "i4", "i2", "i1", ">i4", "g"])
def test_positions_of_any_dtype(dtype):
    assert is_expected(V.astype(dtype), F, P, N)  # all of them whole numbers


@pytest.mark.parametrize("dtype", ["u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", ">u4", ">i8"])
def test_triangles_of_any_dtype(dtype):
    assert is_expected(V, F.astype(dtype), P, N)


def test_points_and_normals_of_any_dtype():
    assert is_expected(V, F, P.astype("f8"), N.astype("f8"))
    assert is_expected(V, F, P.astype(">f4"), N.astype("g"))
    assert (lkao.occlusion(V, F, np.ones((1, 3), int), [[0, 1, 0]], radius=9.0) > 0).all()


def interleaved(array):
    """Rows with other numbers between them."""
    wide = np.full((len(array), 7), 77, array.dtype)
    wide[:, 2:5] = array
    return wide[:, 2:5]


def misaligned(array):
    bytes_ = np.zeros(array.nbytes + 1, np.uint8)
    view = bytes_[1:].view(array.dtype).reshape(array.shape)
    view[...] = array
    return view


@pytest.mark.parametrize(
    "layout",
    [
        interleaved,
        misaligned,
        np.asfortranarray,
        lambda a: a[::-1].copy()[::-1],
        lambda a: a[:, ::-1].copy()[:, ::-1],
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: a.tolist(),
    ],
    ids=["interleaved", "misaligned", "fortran", "reversed rows", "reversed columns", "every second", "list"],
)
def test_any_layout(layout):
    assert is_expected(layout(V), layout(F), layout(P), layout(N))


def test_read_only_arrays():
    arrays = [a.copy() for a in (V, F, P, N)]
    for array in arrays:
        array.flags.writeable = False
    assert is_expected(*arrays)


def test_one_normal_for_all_points():
    up = lkao.occlusion(V, F, P, (0, 1, 0), radius=2.0)
    assert (up == lkao.occlusion(V, F, P, np.tile([0, 1, 0], (50, 1)), radius=2.0)).all()


def test_arrays_that_are_referred_to_are_not_copied_and_are_kept():
    wide = interleaved(V)
    scene = lkao.Scene(wide, F, copy=False)
    assert scene._kept[0].base is wide.base and scene._kept[1] is F
    ao = lkao.AmbientOcclusion(scene, radius=2.0)
    del scene, wide
    other = [np.zeros_like(V) for _ in range(100)]  # what would lie where the array was
    assert ao.query(P, N).occlusion.tobytes() == EXPECTED and len(other) == 100


def test_positions_far_from_zero():
    far = V.astype("f8") + (5_000_000, 300, -2_000_000)
    scene = lkao.Scene(far, F)
    assert scene.origin != (0, 0, 0)
    lower, upper = scene.bounds
    assert np.allclose(lower, far.min(0)) and np.allclose(upper, far.max(0))
    answers = lkao.AmbientOcclusion(scene, radius=2.0, rotation=0).query(P + far[0] - V[0], N).occlusion
    near = lkao.AmbientOcclusion(lkao.Scene(V, F), radius=2.0, rotation=0).query(P, N).occlusion
    assert np.allclose(answers, near, atol=0.02) and near.max() > 0.3


def test_empty_arrays():
    empty = lkao.Scene(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert empty.occluder_count == 0
    assert (lkao.AmbientOcclusion(empty, radius=1.0).query(P, N).occlusion == 0).all()
    assert (lkao.occlusion(V, np.zeros((0, 3), int), P, N, radius=1.0) == 0).all()


class Stub:
    """An object that is no number."""


SCENE = lkao.Scene(V, F)
AO = lkao.AmbientOcclusion(SCENE, radius=1.0)
BAD = {
    "V of complex": (lambda: lkao.Scene(V.astype(complex), F), TypeError, "V must be an array of floats or integers"),
    "V of str": (lambda: lkao.Scene(V.astype(str), F), TypeError, "V must be an array .* not of dtype <U"),
    "V of objects": (lambda: lkao.Scene(V.astype(object), F), TypeError, "V must be .* not of dtype object"),
    "V of bool": (lambda: lkao.Scene(V > 0, F), TypeError, "V must be .* not of dtype bool"),
    "V of two columns": (lambda: lkao.Scene(V[:, :2], F), ValueError, r"V must have the shape \(n, 3\), not \(8, 2\)"),
    "V of one dimension": (lambda: lkao.Scene(V[0], F), ValueError, r"V must have the shape \(n, 3\), not \(3,\)"),
    "V ragged": (lambda: lkao.Scene([[0, 0, 0], [1]], F), (TypeError, ValueError), "V "),
    "V is None": (lambda: lkao.Scene(None, F), TypeError, "V must be .* not of dtype object"),
    "F of floats": (lambda: lkao.Scene(V, F.astype(float)), TypeError, "F must be an array of integers, not of dtype"),
    "F of quads": (lambda: lkao.Scene(V, np.zeros((2, 4), int)), ValueError, r"F must have the shape \(n, 3\)"),
    "F too large": (lambda: lkao.Scene(V, F + 4), ValueError, r"F\[2, 0\] is 8, but must be one of the 8 rows of V"),
    "F negative": (lambda: lkao.Scene(V, F.astype("i8") - 1), ValueError, r"F\[0, 0\] is -1, but must be one of"),
    "F beyond 32 bits": (lambda: lkao.Scene(V, [[0, 1, 2**40]]), ValueError, r"F\[0, 2\] is 1099511627776, but"),
    "opacities": (lambda: lkao.Scene(V, F, opacities=[1.0]), ValueError, r"opacities must have the shape \(4,\)"),
    "opacities range": (lambda: lkao.Scene(V, F, opacities=[1, 1, 1, 2]), ValueError, "opacit.* 2"),
    "threads": (lambda: lkao.Scene(V, F, threads=-1), ValueError, "threads must be from 0 to 4096, not -1"),
    "threads type": (lambda: lkao.Scene(V, F, threads=1.5), TypeError, "threads must be an integer, not float"),
    "origin": (lambda: lkao.Scene(V, F, origin=(0, 0, np.inf)), ValueError, "origin must be finite"),
    "P of str": (lambda: AO.query(P.astype(str), N), TypeError, "P must be an array of floats or integers"),
    "P of two columns": (lambda: AO.query(P[:, :2], N), ValueError, r"P must have the shape \(n, 3\), not \(50, 2\)"),
    "N of other length": (lambda: AO.query(P, N[:9]), ValueError, r"N must have the shape of P, \(50, 3\), or"),
    "N of complex": (lambda: AO.query(P, N.astype(complex)), TypeError, "N must be an array of floats"),
    "geometric normals": (lambda: AO.query(P, N, geometric_normals=N[:2]), ValueError, "geometric_normals must have"),
    "excluded": (lambda: AO.query(P, N, excluded=[1, 2]), ValueError, r"excluded must have the shape \(50,\)"),
    "excluded of floats": (lambda: AO.query(P, N, excluded=1.0), TypeError, "excluded must be an array of integers"),
    "excluded range": (lambda: AO.query(P, N, excluded=-2), ValueError, "excluded must be from 0 to .* not -2"),
    "groups": (lambda: AO.query(P, N, groups=2**32), ValueError, "groups must be from 0 to 4294967295, not 4294967296"),
    "first_index": (lambda: AO.query(P, N, first_index=-1), ValueError, "first_index must be from 0 to"),
    "progress": (lambda: AO.query(P, N, progress=3), TypeError, "progress must be a function or None, not int"),
    "no radius": (lambda: lkao.AmbientOcclusion(SCENE), TypeError, "radius"),
    "radius of str": (lambda: lkao.occlusion(V, F, P, N, radius="2"), TypeError, "radius must be a number, not str"),
    "radius of None": (lambda: lkao.occlusion(V, F, P, N, radius=None), TypeError, "radius must be a number, not Non"),
    "radius zero": (lambda: lkao.occlusion(V, F, P, N, radius=0), ValueError, "radius.* 0"),
    "radius huge": (lambda: lkao.occlusion(V, F, P, N, radius=1e300), ValueError, "radius must be at most 3.4e"),
    "samples": (lambda: lkao.AmbientOcclusion(SCENE, 0, radius=1), ValueError, "samples must be from 1 to 1024, not 0"),
    "samples type": (lambda: lkao.AmbientOcclusion(SCENE, Stub(), radius=1), TypeError, "samples must be .* not Stub"),
    "sided": (lambda: lkao.AmbientOcclusion(SCENE, radius=1, sided="both"), ValueError, "sided must be one of 'two'"),
    "kernel": (lambda: lkao.AmbientOcclusion(SCENE, radius=1, kernel="gpu"), ValueError, "kernel must be one of"),
    "kernel type": (lambda: lkao.AmbientOcclusion(SCENE, radius=1, kernel=1), TypeError, "kernel must be a str"),
    "seed": (lambda: lkao.AmbientOcclusion(SCENE, radius=1, seed=-1), ValueError, "seed must be from 0 to"),
    "tilt": (lambda: lkao.AmbientOcclusion(SCENE, radius=1, tilt=3), ValueError, "tilt.* 3"),
    "offset": (lambda: lkao.AmbientOcclusion(SCENE, radius=1, surface_offset=-1), ValueError, "surface_offset must be"),
    "min_distance": (lambda: lkao.AmbientOcclusion(SCENE, radius=1, min_distance=2), ValueError, "min_distance.* 2"),
    "scene": (lambda: lkao.AmbientOcclusion(V, radius=1), TypeError, "scene must be a Scene, or levels"),
    "no levels": (lambda: lkao.AmbientOcclusion([], radius=1), ValueError, "scene must have a level"),
    "level": (lambda: lkao.AmbientOcclusion([(SCENE, 2, 1)], radius=1), ValueError, "r_min"),
    "kind": (lambda: lkao.Pattern(8, kind="hex"), ValueError, "hex"),
    "falloff": (lambda: lkao.Pattern(8, falloff="cubic"), ValueError, "unknown falloff cubic"),
    "falloff type": (lambda: lkao.Pattern(8, falloff=3), TypeError, "falloff must be a name"),
    "falloff rises": (lambda: lkao.Pattern(8, falloff=lambda x: x), ValueError, "must not rise"),
    "weighting": (lambda: lkao.Pattern(8, weighting="none"), ValueError, "weighting must be one of 'cosine'"),
    "points": (lambda: lkao.Pattern.from_disk([[2, 0]], [1]), ValueError, "2"),
    "lengths": (lambda: lkao.Pattern.from_disk([[0, 0]], [1, 1]), ValueError, r"lengths must have the shape \(1,\)"),
    "resolution": (lambda: lkao.PlaneMaskTable(8, resolution=3), ValueError, "resolution must be from 32 to 256"),
    "addressing": (lambda: lkao.PlaneMaskTable(8, addressing="x"), ValueError, "addressing must be one of 'slices'"),
    "to_world": (lambda: lkao.Scene.of_instances([SCENE], np.eye(4)), ValueError, r"to_world must have the shape"),
    "affine": (lambda: lkao.Scene.of_instances([SCENE], np.ones((1, 4, 4))), ValueError, "to_world must be affine"),
    "mesh": (lambda: lkao.Scene.of_instances([SCENE], np.eye(4)[None], mesh=[1]), ValueError, "mesh must be from 0"),
    "meshes": (lambda: lkao.Scene.of_instances([V], np.eye(4)[None]), TypeError, "meshes must be Scenes"),
    "singular": (lambda: lkao.Scene.of_instances([SCENE], np.zeros((1, 3, 4))), ValueError, "must be invertible"),
    "refit": (lambda: SCENE.refitted(V[:4]), ValueError, "4"),
    "bundle": (lambda: lkao.RayBundles(SCENE).blocked(P, N[0]), ValueError, "rays must have the shape"),
    "bundle of none": (lambda: lkao.RayBundles(SCENE).blocked(P, np.zeros((0, 3))), ValueError, "number of rays must"),
    "bundle nan": (lambda: lkao.RayBundles(SCENE).blocked(P, np.full((4, 3), np.nan)), ValueError, "nan"),
    "light": (lambda: lkao.SoftShadows(SCENE, (0, 1, 0)), TypeError, "light must be a DiscLight or a SphereLight"),
    "light radius": (lambda: lkao.SoftShadows(SCENE, lkao.SphereLight((0, 1, 0), 0)), ValueError, "radius"),
    "light position": (lambda: lkao.SoftShadows(SCENE, lkao.SphereLight((0, 1), 1)), ValueError, "position must have"),
    "sky": (lambda: lkao.SkyVisibility(SCENE, 1), ValueError, "samples must be from 2 to 2048, not 1"),
    "simplify": (lambda: lkao.simplify(V, F), TypeError, "either radius or epsilon"),
    "simplify k": (lambda: lkao.simplify(V, F, radius=1, k=-1), ValueError, "k: .* -1"),
    "epsilon": (lambda: lkao.simplify(V, F, epsilon=0), ValueError, "epsilon must be above 0"),
    "per": (lambda: lkao.bake(V, F, radius=1, per="edge"), ValueError, "per must be one of 'vertex', 'corner', 'face'"),
    "filter": (lambda: lkao.bake(V, F, radius=1, filter="x"), ValueError, "filter must be one of"),
    "filter of faces": (lambda: lkao.Baking(V, F, per="face", filter="least-squares"), ValueError, "per 'vertex' and"),
    "normals": (lambda: lkao.Baking(V, F, normals="file"), ValueError, "normals must be one of 'facet', 'smooth'"),
    "values": (lambda: lkao.Baking(V, F).values([1.0]), ValueError, r"occlusion must have the shape \(12,\)"),
    "camera": (lambda: lkao.View(V, F, eye=(1, 1, 1), target=(1, 1, 1), width=4, height=4), ValueError, "eye|target"),
    "width": (lambda: lkao.View(V, F, eye=(1, 1, 1), target=V[0], width=0, height=4), ValueError, "width must be"),
    "unpack": (lambda: lkao.unpack(np.zeros((4, 1), np.uint64), 65), ValueError, "masks must be uint64 of the shape"),
    "file": (lambda: lkao.load("no_such.obj"), RuntimeError, "no_such.obj"),
    "built-in": (lambda: lkao.load("builtin:nothing"), RuntimeError, "nothing"),
}


@pytest.mark.parametrize("what", BAD)
def test_bad_argument_is_named_in_one_line(what):
    call, error, pattern = BAD[what]
    with pytest.raises(error) as caught:
        call()
    message = str(caught.value)
    assert re.search(pattern, message), message
    assert "\n" not in message and len(message) < 200
