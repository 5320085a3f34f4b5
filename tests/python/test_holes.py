"""Triangles with holes: from files as the program reads them, and from arrays."""

import pickle
import subprocess
import sys

import numpy as np
import pytest

import exr
import lkao
import meshes

MASK = {"alphaMode": "MASK", "alphaCutoff": 0.4}
BLEND = {"alphaMode": "BLEND"}
RAYS = {"radius": 0.8, "samples": 64}


def leaves():
    """A wavy floor on the opaque left of an image, and leaves above it that show the image 2.3 times; its alpha."""
    random = np.random.default_rng(7)
    V, F = meshes.grid(8)
    UV = [0.2, 0.5] + 0.1 * V[:, [0, 2]]
    for _ in range(4):
        first = len(V)
        sides = random.uniform(-0.9, 0.9, (2, 3)) * [1, 0.2, 1]
        corner = random.uniform([-0.6, 0.25, -0.6], [0.2, 0.5, 0.2])
        V = np.vstack([V, corner, corner + sides[0], corner + sides.sum(0), corner + sides[1]])
        UV = np.vstack([UV, 2.3 * np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) + random.uniform(-1, 1, 2)])
        F = np.vstack([F, [[first, first + 1, first + 2], [first, first + 2, first + 3]]])
    alpha = random.integers(0, 256, (12, 16), np.uint8)
    alpha[:, :8] = 255
    alpha[:, 10:12] = 0
    return (V + 0.0).astype(np.float32), F.astype(np.uint32), UV.astype(np.float32), alpha


def write_obj(folder, V, F, UV, alpha):
    """The same by `map_d`, in two ways, on a floor of glass."""
    (folder / "leaf.png").write_bytes(meshes.png(alpha[..., None]))
    (folder / "leaf.mtl").write_text(
        "newmtl glass\nd 0.75\nnewmtl leaf\nmap_d leaf.png\nnewmtl fine\nmap_d -s 2 2 -o 0.1 -clamp on leaf.png\n"
    )
    lines = ["mtllib leaf.mtl"]
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in V.astype("f8").tolist()]
    lines += [f"vt {u!r} {v!r}" for u, v in UV.astype("f8").tolist()]
    for name, faces in (("glass", F[:-8]), ("fine", F[-8:-4]), ("leaf", F[-4:])):
        lines.append(f"usemtl {name}")
        lines += ["f " + " ".join(f"{i + 1}/{i + 1}" for i in corners) for corners in faces]
    (folder / "leaves.obj").write_text("\n".join(lines) + "\n")
    return folder / "leaves.obj"


def write(folder, material, **sampler):
    path = folder / "leaves.gltf"
    meshes.write_gltf(path, *leaves(), material, sampler)
    return path


def program_bakes(path, *arguments):
    arguments = ["--radius", "0.8", "--samples", "64", "--quiet", *map(str, arguments)]
    subprocess.run([meshes.BUILD / "bin/lkao", "bake", path, *arguments], check=True)


def write_kind(folder, kind):
    if kind == "OBJ":
        return write_obj(folder, *leaves())
    return write(folder, MASK) if kind == "MASK" else write(folder, BLEND, magFilter=9728, wrapS=33648)


KINDS = ["MASK", "BLEND", "OBJ"]


@pytest.mark.parametrize("kind", KINDS)
def test_holes_of_files_are_those_of_the_program(tmp_path, kind):
    path = write_kind(tmp_path, kind)
    program_bakes(path, "-o", tmp_path / "holes.ply")
    theirs = meshes.values_in_ply(tmp_path / "holes.ply")
    file = lkao.MeshFile(path)
    assert file.holes.triangle_count == len(file.F) and file.holes.triangles[-8:].all()
    assert (kind == "OBJ") == file.holes.triangles[0] and any("half-" in s for s in file.remarks) == (kind != "MASK")
    assert lkao.bake(file.V, file.F, holes=file.holes, **RAYS).tobytes() == theirs.tobytes()
    scene = lkao.Scene(file.V, file.F, holes=file.holes)
    assert lkao.bake(file.V, file.F, scene=scene, **RAYS).tobytes() == theirs.tobytes()
    whole = lkao.bake(file.V, file.F, **RAYS)
    assert theirs.max() > 0.2 and (whole[:81] - theirs[:81]).max() > 0.1


def test_opaque_is_that_of_the_program(tmp_path):
    path = write(tmp_path, MASK)
    program_bakes(path, "-o", tmp_path / "whole.ply", "--opaque")
    file = lkao.MeshFile(path, opaque=True)
    assert file.holes is None and len(file.remarks) == 1 and "block as if whole" in file.remarks[0]
    ours = lkao.bake(file.V, file.F, holes=file.holes, **RAYS)
    assert ours.tobytes() == meshes.values_in_ply(tmp_path / "whole.ply").tobytes()


def test_textures_are_those_of_the_program(tmp_path):
    path, fine = write(tmp_path, MASK), tmp_path / "fine.gltf"
    V, F, UV, alpha = leaves()
    meshes.write_gltf(fine, V + np.float32([0, 0.02, 0]), F, UV, alpha, MASK)
    file, detailed = lkao.MeshFile(path), lkao.MeshFile(fine)
    settings = {"normals": "facet", "width": 24, **RAYS}
    maps = []
    for options, arguments in (
        ({"holes": file.holes}, []),
        ({"detailed": (detailed.V, detailed.F), "detailed_holes": detailed.holes}, ["--detailed", fine]),
        ({"detailed": (detailed.V, detailed.F)}, []),
    ):
        maps.append(lkao.bake_texture(file.V, file.F, file.UV, **settings, **options).visibility)
        if "detailed" in options and not arguments:
            continue
        picture = tmp_path / "map.exr"
        program_bakes(path, "-o", picture, "--texture", "24", "--normals", "facet", *arguments)
        assert maps[-1].tobytes() == exr.read(picture)["visibility"].tobytes()
    assert (maps[1] != maps[2]).any()


SAMPLERS = {
    "usual": ({}, {}),
    "clamped": ({"wrapS": 33071, "wrapT": 33648}, {"wrap": ("clamp", "mirror")}),
    "nearest": ({"magFilter": 9728}, {"smooth": False}),
}


@pytest.mark.parametrize("material", [MASK, BLEND], ids=["mask", "blend"])
@pytest.mark.parametrize("name", SAMPLERS)
def test_arrays_have_the_bits_of_a_file(tmp_path, material, name):
    sampler, options = SAMPLERS[name]
    V, F, UV, alpha = leaves()
    file = lkao.MeshFile(write(tmp_path, material, **sampler))
    theirs = lkao.occlusion(V, F, V, (0, 1, 0), holes=file.holes, **RAYS)
    holes = lkao.Holes(alpha, UV[F], cutoff=material.get("alphaCutoff"), uv_origin="upper", **options)
    assert lkao.occlusion(V, F, V, (0, 1, 0), holes=holes, **RAYS).tobytes() == theirs.tobytes()
    assert (lkao.occlusion(V, F, V, (0, 1, 0), **RAYS) > theirs + 0.1).any()
    # What is whole in the file may be said to be so, and texture coordinates be from below.
    UV = UV[F].astype("f8") * [1, -1] + [0, 1]
    UV[: len(F) - 8] = np.nan
    same = lkao.Holes(alpha / 255, UV, cutoff=material.get("alphaCutoff"), **options)
    assert same.triangles.tolist() == [False] * (len(F) - 8) + [True] * 8
    assert (file.holes.triangles == same.triangles).all()
    difference = lkao.occlusion(V, F, V, (0, 1, 0), holes=same, **RAYS) - theirs
    assert abs(difference).max() < 0.05


def test_alpha_of_any_dtype_and_layout_is_the_same():
    V, F, UV, alpha = leaves()
    forms = [alpha, alpha.astype(np.uint16) * np.uint16(257), alpha / 255, np.asfortranarray(alpha)]
    forms += [(alpha / np.float32(255)).astype(np.float32), alpha[::-1, ::-1].copy()[::-1, ::-1]]
    values = [lkao.bake(V, F, holes=lkao.Holes(form, UV[F]), **RAYS).tobytes() for form in forms]
    assert values == values[:1] * len(forms)
    assert lkao.bake(V, F, holes=lkao.Holes(np.full((1, 1), 0.5), UV[F]), **RAYS).tobytes() not in values


def test_clear_triangles_block_nothing():
    V, F = meshes.wall()
    foot = {"V": V, "F": F, "P": [0, 0, 0.001], "N": (0, 1, 0), "radius": 3.0}
    UV = np.zeros((len(F), 3, 2))
    assert lkao.occlusion(**foot, holes=lkao.Holes(np.zeros((1, 1)), UV)) == 0
    UV[2:] = np.nan  # the wall is whole
    assert lkao.occlusion(**foot, holes=lkao.Holes(np.zeros((1, 1)), UV)) == lkao.occlusion(**foot) > 0.4


@pytest.mark.parametrize("kind", KINDS)
def test_pickled_holes_have_the_bits_of_the_first(tmp_path, kind):
    file = lkao.MeshFile(write_kind(tmp_path, kind))
    other = pickle.loads(pickle.dumps(file.holes))
    assert (other.triangles == file.holes.triangles).all() and repr(other) == repr(file.holes)
    scene = lkao.Scene(file.V, file.F, holes=file.holes, copy=False)
    values = [
        lkao.bake(file.V, file.F, scene=s, **RAYS).tobytes()
        for s in (scene, lkao.Scene(file.V, file.F, holes=other), pickle.loads(pickle.dumps(scene)))
    ]
    assert values == values[:1] * 3 and values[0] != lkao.bake(file.V, file.F, **RAYS).tobytes()
    moved = scene.refitted(file.V * np.float32(1.1))
    again = lkao.Scene(file.V * np.float32(1.1), file.F, holes=file.holes)
    values = [lkao.bake(file.V * np.float32(1.1), file.F, scene=s, **RAYS).tobytes() for s in (moved, again)]
    assert values[0] == values[1]


def test_image_that_cannot_be_read_is_a_remark(tmp_path):
    path = write_obj(tmp_path, *leaves())
    (tmp_path / "leaf.png").write_bytes(b"no picture")
    file = lkao.MeshFile(path)
    assert "leaf.png" in file.remarks[0] and "counts as opaque" in file.remarks[0]
    assert file.holes is not None  # what "d" says is left
    (tmp_path / "leaf.mtl").write_text("newmtl leaf\nmap_d leaf.png\n")
    assert lkao.MeshFile(path).holes is None


def test_library_of_images_is_loaded_with_the_first(tmp_path):
    program = "import lkao; maps = lambda: 'libOpenImageIO' in open('/proc/self/maps').read(); before = maps(); "
    program += "lkao.MeshFile('leaves.gltf', opaque=True); opaque = maps(); lkao.MeshFile('leaves.gltf'); "
    program += "print(before, opaque, maps())"
    write(tmp_path, MASK)
    said = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True, stdout=subprocess.PIPE, text=True)
    assert said.stdout.split() == ["False", "False", "True"]


def test_cameras_see_what_is_behind_holes(tmp_path):
    V, F, UV, alpha = leaves()
    holes = lkao.Holes(alpha, UV[F])
    camera = {"eye": (0, 3, 0.1), "target": (0, 0, 0), "width": 32, "height": 32, "fov": 40.0}
    through, whole = lkao.View(V, F, holes=holes, **camera), lkao.View(V, F, **camera)
    assert ((through.depth > whole.depth + 0.1) & np.isfinite(through.depth)).sum() > 10
    assert (through.depth >= whole.depth).all()


V, F = meshes.wall()
UV = np.zeros((len(F), 3, 2))
ALPHA = np.zeros((2, 2), np.uint8)
HOLES = lkao.Holes(ALPHA, UV)
SCENE = lkao.Scene(V, F)
BAD = {
    "UV shape": (lambda: lkao.Holes(ALPHA, UV[:, 0]), ValueError, r"UV must have the shape \(m, 3, 2\), not \(4, 2\)"),
    "UV of str": (lambda: lkao.Holes(ALPHA, UV.astype(str)), TypeError, "UV must be an array of floats or integers"),
    "alpha shape": (lambda: lkao.Holes(UV, UV), ValueError, r"alpha must have the shape \(height, width\).* not "),
    "alpha empty": (lambda: lkao.Holes(ALPHA[:0], UV), ValueError, r"alpha must have the shape .* not \(0, 2\)"),
    "alpha dtype": (lambda: lkao.Holes(ALPHA.astype(int), UV), TypeError, "alpha must be of uint8, uint16 or floats, "),
    "alpha range": (lambda: lkao.Holes(ALPHA + 1.5, UV), ValueError, "alpha must be from 0 to 1, not 1.5"),
    "alpha nan": (lambda: lkao.Holes(ALPHA * np.nan, UV), ValueError, "alpha must be from 0 to 1, not nan"),
    "cutoff": (lambda: lkao.Holes(ALPHA, UV, cutoff="x"), TypeError, "cutoff must be a number, not str"),
    "cutoff nan": (lambda: lkao.Holes(ALPHA, UV, cutoff=np.nan), ValueError, "cutoff must be a number, not nan"),
    "uv_origin": (lambda: lkao.Holes(ALPHA, UV, uv_origin="left"), ValueError, "uv_origin must be one of 'lower', 'up"),
    "wrap": (lambda: lkao.Holes(ALPHA, UV, wrap="tile"), ValueError, "wrap must be one of 'repeat', .* not 'tile'"),
    "wraps": (lambda: lkao.Holes(ALPHA, UV, wrap=("clamp",)), ValueError, "wrap must be a word, or one for u and one"),
    "holes": (lambda: lkao.Scene(V, F, holes=ALPHA), TypeError, "holes must be Holes or None, not ndarray"),
    "holes of others": (lambda: lkao.Scene(V, F[:3], holes=HOLES), ValueError, "holes must be of 3 triangles.* of 4"),
    "both": (lambda: lkao.Scene(V, F, holes=HOLES, opacities=np.ones(4)), ValueError, "opacities and holes exclude"),
    "scene": (lambda: lkao.bake(V, F, radius=1, holes=HOLES, scene=SCENE), ValueError, "holes are of V and F, which "),
    "detailed": (
        lambda: lkao.bake_texture(V, F, UV, radius=1, holes=HOLES, detailed=(V, F)),
        ValueError,
        "holes are of V and F, which do not block .*: see detailed_holes",
    ),
    "detailed_holes": (
        lambda: lkao.bake_texture(V, F, UV, radius=1, detailed=(V, F), detailed_holes=1),
        TypeError,
        "detailed_holes must be Holes or None, not int",
    ),
    "detailed_holes alone": (
        lambda: lkao.bake_texture(V, F, UV, radius=1, detailed_holes=HOLES),
        ValueError,
        "detailed_holes are for a detailed mesh, which must be given with them",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_argument_is_named_in_one_line(name):
    call, kind, message = BAD[name]
    with pytest.raises(kind, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)
