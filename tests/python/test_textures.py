"""Textures: as the program bakes them, and what is said of them."""

import json
import pickle
import subprocess

import numpy as np
import pytest

import exr
import lkao
import meshes


def curtain():
    """Two wavy squares over each other, of two materials, side by side in the texture and partly beyond its edge, each
    cut in two there; normals of any length, one of them zero; a triangle without area, and one without texture
    coordinates."""
    V, F = meshes.grid(8)
    V += np.float32(0)  # no -0, whose sign files of text lose
    UV = np.float32([0.55, 0.9]) * (V[:, [0, 2]] + 1) / 2 + np.float32([0.05, 0.2])
    is_right = V[F, 0].mean(1, keepdims=True) > 0
    V = np.vstack([V, V + np.float32([0, 0.3, 0]), [[-1, 0, -1], [-1, 0, 1], [-1, 1, 0]]]).astype(np.float32)
    UV = np.vstack([UV, UV + np.float32([0.6, 0])])
    UV = np.vstack([UV, UV * np.float32([1, 0.9]) + np.float32([0.03, 0.02])]).astype(np.float32)
    F_UV = np.vstack([F, F + 81]) + np.where(np.vstack([is_right, is_right]), 162, 0)
    F_UV = np.vstack([F_UV, [[0, 0, 1], [-1, -1, -1]]])
    F = np.vstack([F, F + 81, [[0, 0, 1], [162, 163, 164]]])
    normals = np.random.default_rng(5).uniform([-0.5, 1, -0.5], [0.5, 3, 0.5], V.shape).astype(np.float32)[F]
    normals[9, 1] = 0
    materials = np.repeat([0, 1], [len(F) // 2, len(F) - len(F) // 2])
    return V, F, UV, F_UV, normals, materials


def write_obj(path, V, F, UV, F_UV, normals, materials):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in V.astype("f8").tolist()]
    lines += [f"vt {u!r} {v!r}" for u, v in UV.astype("f8").tolist()]
    lines += [f"vn {x!r} {y!r} {z!r}" for x, y, z in normals.reshape(-1, 3).astype("f8").tolist()]
    for t, (corners, uvs) in enumerate(zip(F, F_UV)):
        lines.append(f"usemtl {'ab'[materials[t]]}")
        words = [f"{v + 1}/{'' if uv < 0 else uv + 1}/{3 * t + i + 1}" for i, (v, uv) in enumerate(zip(corners, uvs))]
        lines.append("f " + " ".join(words))
    path.write_text("\n".join(lines) + "\n")


def program_bakes(folder, *arguments):
    """What the program writes, and says in JSON."""
    command = [meshes.BUILD / "bin/lkao", "bake", folder / "mesh.obj", "-o", folder / "ao.exr", "--radius", "0.7"]
    command += ["--samples", "32", "--texture", "48x40", "--json", folder / "ao.json", "--quiet", *arguments]
    subprocess.run(command, check=True)
    return sorted(folder.glob("ao*.exr")), json.loads((folder / "ao.json").read_text())["materials"][0]


def expect_same(map_of_ours, path):
    theirs = exr.read(path)
    assert map_of_ours.visibility.tobytes() == theirs["visibility"].tobytes()
    assert (map_of_ours.coverage == np.rint(255 * theirs["coverage"])).all()
    if map_of_ours.bent_normals is not None:
        for axis, name in enumerate("XYZ"):
            assert (map_of_ours.bent_normals[..., axis] == theirs[f"bent.{name}"]).all()
    assert ("bent.X" in theirs) == (map_of_ours.bent_normals is not None)


def expect_same_report(report, material, dropped):
    words = {
        "triangle_count": "triangles",
        "bare_triangle_count": "triangles_without_uvs",
        "flat_triangle_count": "flat_triangles",
        "mirrored_triangle_count": "mirrored_triangles",
        "outside_triangle_count": "triangles_outside",
        "wide_triangle_count": "wide_triangles",
        "texel_count": "texels",
        "covered_texel_count": "covered_texels",
        "overlapping_texel_count": "overlapping_texels",
        "empty_texel_count": "empty_texels",
        "missed_receiver_count": "missed_points",
        "seam_count": "seams",
        "worst_seam_before": "worst_seam_before",
        "worst_seam_after": "worst_seam",
    }
    theirs = {ours: material[word] for ours, word in words.items()}
    theirs["triangle_count"] += dropped  # of which the program speaks elsewhere
    theirs["flat_triangle_count"] += dropped
    assert {name: getattr(report, name) for name in words} == theirs


CASES = {
    "plain": ({}, ["--shared-map", "--normals", "facet"]),
    "one material": (
        {"material": 1, "normals": "smooth", "wrap": "clamp", "grid": 2, "margin": 3, "seed": 4},
        ["--material", "b", "--normals", "smooth", "--wrap", "clamp", "--grid", "2", "--margin", "3", "--seed", "4"],
    ),
    "bent": (
        {"normals": "given", "bent_normals": "tangent", "wrap": "mirror", "sided": "one"},
        ["--shared-map", "--normals", "file", "--bent-normals", "tangent", "--wrap", "mirror", "--sided", "one"],
    ),
    "thickness": (
        {"normals": "given", "bent_normals": "object", "thickness": True, "level_seams": False, "min_distance": 0.01},
        ["--shared-map", "--bent-normals", "object", "--thickness", "--keep-seams", "--min-distance", "0.01"],
    ),
    "udim": ({"udim": True}, ["--shared-map", "--udim", "--normals", "facet"]),
}


@pytest.mark.parametrize("name", CASES)
def test_maps_are_those_of_the_program(tmp_path, name):
    options, arguments = CASES[name]
    V, F, UV, F_UV, normals, materials = curtain()
    write_obj(tmp_path / "mesh.obj", V, F, UV, F_UV, normals, materials)
    paths, material = program_bakes(tmp_path, *arguments)
    if options.get("normals") == "given":
        options = {**options, "normals": normals}
    ours = lkao.bake_texture(
        V, F, UV, F_UV, radius=0.7, samples=32, width=48, height=40, materials=materials, **options
    )
    assert len(paths) == len(ours.maps) == (4 if options.get("udim") else 1)
    for map_of_ours, path in zip(ours.maps, paths):
        expect_same(map_of_ours, path)
        assert map_of_ours.udim == 0 or f".{map_of_ours.udim}." in path.name
    assert ours.maps[0].visibility.min() < 0.9 < ours.maps[0].visibility.max()
    expect_same_report(ours.report, material, dropped=1)
    assert ours.report.seam_count == 0 or ours.report.worst_seam_before > 2 * ours.report.worst_seam_after > 0
    assert (ours.report.seam_count > 0) == options.get("level_seams", True)


def test_map_of_a_detailed_mesh_is_that_of_the_program(tmp_path):
    V, F, UV, F_UV, normals, materials = curtain()
    write_obj(tmp_path / "fine.obj", V, F, UV, F_UV, normals, materials)
    corners = np.float32([[-1, 0.1, -1], [-1, 0.1, 1], [1, 0.1, 1], [1, 0.1, -1]])
    quad, uvs = np.array([[0, 1, 2], [0, 2, 3]]), (corners[:, [0, 2]] + 1) / 2
    write_obj(tmp_path / "mesh.obj", corners, quad, uvs, quad, np.float32([0, 1, 0]) + np.zeros((2, 3, 3)), [0, 0])
    (path,), material = program_bakes(
        tmp_path, "--detailed", tmp_path / "fine.obj", "--extrusion", "0.08", "--normals", "facet"
    )
    options = {"radius": 0.7, "samples": 32, "width": 48, "height": 40, "detailed": (V, F)}
    ours = lkao.bake_texture(corners, quad, uvs, extrusion=0.08, detailed_normals=normals, **options)
    expect_same(ours.map, path)
    expect_same_report(ours.report, material, dropped=0)
    assert 0 < ours.report.missed_receiver_count < ours.report.receiver_count
    (path,), _ = program_bakes(tmp_path, "--detailed", tmp_path / "fine.obj", "--normals", "facet")
    expect_same(lkao.bake_texture(corners, quad, uvs, detailed_normals=normals, **options).map, path)


def test_file_has_what_is_baked(tmp_path):
    V, F, UV, F_UV, normals, materials = curtain()
    write_obj(tmp_path / "mesh.obj", V, F, UV, F_UV, normals, materials)
    file = lkao.MeshFile(tmp_path / "mesh.obj")
    assert file.V.tobytes() == V.tobytes() and (file.F == F).all() and file.origin == (0, 0, 0)
    assert file.material_names == ["a", "b"] and (file.materials == materials).all()
    assert np.isnan(file.UV[-1]).all() and np.allclose(file.UV[:-1], UV[F_UV[:-1]], atol=1e-6)
    lengths = np.linalg.norm(normals, axis=-1, keepdims=True)
    assert np.allclose(file.normals, normals / np.where(lengths > 0, lengths, np.nan), atol=1e-6, equal_nan=True)
    (path,), _ = program_bakes(tmp_path, "--shared-map")
    ours = lkao.bake_texture(
        file.V, file.F, file.UV, radius=0.7, samples=32, width=48, height=40, normals=file.normals
    )
    expect_same(ours.map, path)


def test_file_without_more_says_none(tmp_path):
    (tmp_path / "bare.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    bare = lkao.MeshFile(tmp_path / "bare.obj")
    assert bare.normals is None and bare.UV is None and bare.wraps == [] and bare.remarks == []
    assert lkao.bake(bare.V, bare.F, radius=1.0, normals=bare.normals).tolist() == [0, 0, 0]
    with pytest.raises(RuntimeError, match="nothing.obj"):
        lkao.MeshFile(tmp_path / "nothing.obj")


# A floor of 2 x 2 that shows the whole texture, with a wall on its edge x = -1 that shows none.
FLOOR = np.array([[-1, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 1, -1], [-1, 1, 1]], np.float32)
QUADS = np.array([[0, 1, 2], [0, 2, 3], [0, 4, 5], [0, 5, 1]])
CORNERS = np.array([[0, 1, 2], [0, 2, 3], [-1, -1, -1], [-1, -1, -1]])
# u with x, v against z: the first row of the map is at z = -1.
PLACES = np.array([[0, 1], [0, 0], [1, 0], [1, 1]], np.float32)
SETTINGS = {"radius": float("inf"), "width": 16, "samples": 64}


def test_floor_is_dark_at_its_wall():
    bake = lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, **{**SETTINGS, "samples": 1024})
    assert bake.occlusion.shape == bake.coverage.shape == (16, 16) and (bake.coverage == 255).all()
    for x in (0, 2, 5):
        d = (x + 0.5) / 8  # as if the wall had no end
        expected = 0.5 * (1 - d / np.hypot(d, 1.0))
        assert np.allclose(bake.occlusion[6:10, x], expected, atol=0.02 if x == 0 else 0.08)
    assert (np.diff(bake.occlusion[6:10], axis=1) <= 0.02).all()
    assert bake.report.bare_triangle_count == 2 and bake.report.mirrored_triangle_count == 0
    assert bake.map.bent_normals is None and (bake.visibility == 1 - bake.occlusion).all()


def test_bent_normals_point_away_from_the_wall():
    bent = lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, bent_normals="object", **SETTINGS).bent_normals
    tangent = lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, bent_normals="tangent", **SETTINGS).bent_normals
    assert bent.shape == (16, 16, 3) and np.allclose(np.linalg.norm(bent, axis=-1), 1, atol=1e-5)
    assert (bent[8, 0, :2] > 0.2).all()
    # The tangent is x, the bitangent -z, the normal y.
    assert np.allclose(tangent, bent[..., [0, 2, 1]] * (1, -1, 1), atol=1e-5)


def test_texture_coordinates_of_any_form_are_the_same():
    def baked(V, F, *uvs, **options):
        return lkao.bake_texture(V, F, *uvs, **SETTINGS, **options)

    expected = baked(FLOOR, QUADS, PLACES, CORNERS)
    of_corners = np.where(CORNERS[..., None] < 0, np.nan, PLACES[CORNERS])
    of_vertices = np.vstack([PLACES, [[np.nan, 0], [0, np.nan]]])
    upper = PLACES * (1, -1) + (0, 1)
    for same in (
        baked(FLOOR, QUADS, of_corners),
        baked(FLOOR, QUADS, of_vertices),
        baked(FLOOR.tolist(), QUADS.tolist(), PLACES.tolist(), CORNERS.tolist()),
        baked(FLOOR, QUADS, upper, CORNERS, uv_origin="upper"),
    ):
        assert same.occlusion.tobytes() == expected.occlusion.tobytes() and same.report == expected.report
    turned = baked(FLOOR, QUADS, upper, CORNERS)
    assert turned.report.mirrored_triangle_count == 2
    assert np.allclose(turned.occlusion[::-1], expected.occlusion, atol=0.15) and expected.occlusion.max() > 0.3


def test_room_is_black_and_threads_change_nothing():
    V, F = meshes.box()
    UV = np.array([[0, 0], [0.9, 0], [0, 0.9]])[None] * (0.3, 0.2) + np.stack(
        np.divmod(np.arange(12), 4), -1
    )[:, None] * (0.33, 0.25)
    settings = {"radius": 9.0, "width": 64, "samples": 32, "normals": "smooth"}
    bakes = [lkao.bake_texture(V, F[:, ::-1], UV, threads=threads, **settings) for threads in (1, 2)]
    assert (bakes[0].occlusion == 1).all() and bakes[0].report.overlapping_texel_count == 0
    grid = meshes.grid(6)
    of_grid = [
        lkao.bake_texture(*grid, (grid[0][:, [0, 2]] + 1) / 2, threads=threads, radius=1.0, width=130, samples=16)
        for threads in (1, 2)
    ]
    assert of_grid[0].occlusion.tobytes() == of_grid[1].occlusion.tobytes() and of_grid[0].occlusion.max() > 0.1


def test_only_what_has_the_material_is_baked_and_all_blocks():
    materials = [7, 7, -1, -1]
    whole = lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, **SETTINGS)
    floor = lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, materials=materials, material=7, **SETTINGS)
    assert floor.occlusion.tobytes() == whole.occlusion.tobytes() and floor.report.triangle_count == 2
    with pytest.raises(ValueError, match="no triangle to bake has texture coordinates"):
        lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, materials=materials, material=-1, **SETTINGS)


def test_another_scene_may_block():
    roof = lkao.Scene(np.vstack([FLOOR, FLOOR[:4] + np.float32([0, 0.5, 0])]), np.vstack([QUADS, QUADS[:2] + 6]))
    darker = lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, scene=roof, **SETTINGS).occlusion
    assert (darker > lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, **SETTINGS).occlusion + 0.1).all()


def test_mesh_far_from_zero_is_baked_in_doubles():
    far = FLOOR + np.array([5e6, 0, 3e6])
    bakes = [lkao.bake_texture(V, QUADS, PLACES, CORNERS, **{**SETTINGS, "samples": 512}) for V in (FLOOR, far)]
    assert np.allclose(bakes[0].occlusion, bakes[1].occlusion, atol=0.05)


def test_udim_maps_are_asked_for_by_number():
    UV = np.float32([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]])[None] + np.float32([[[0, 0]], [[1, 2]]])
    V = np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 5], [1, 0, 5], [0, 1, 5]])
    bake = lkao.bake_texture(V, [[0, 1, 2], [3, 4, 5]], UV, udim=True, **SETTINGS)
    assert [of_tile.udim for of_tile in bake.maps] == [1001, 1022]
    with pytest.raises(ValueError, match="2 maps"):
        bake.occlusion


def test_progress_counts_texels_and_stops_the_bake():
    told = []
    V, F = meshes.grid(4)
    UV = (V[:, [0, 2]] + 1) / 2
    lkao.bake_texture(V, F, UV, radius=1.0, width=256, height=130, samples=4, progress=lambda *now: told.append(now))
    assert told == sorted(told) and told[0] == (0, 33280) and told[-1] == (33280, 33280)
    with pytest.raises(lkao.Cancelled):
        lkao.bake_texture(V, F, UV, radius=1.0, samples=4, width=256, progress=lambda done, total: False)


def test_progress_is_asked_while_a_tile_takes_long():
    told = []

    def stop(done, total):
        told.append(done)
        if len(told) > 1:
            raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        lkao.bake_texture(FLOOR, QUADS, PLACES, CORNERS, radius=9.0, samples=1024, width=64, grid=16, progress=stop)
    assert told == [0, 0]


@pytest.mark.parametrize("options", [{"bent_normals": "object"}, {"udim": True}, {"level_seams": False, "margin": 0}])
def test_parts_have_the_bits_of_the_whole(options):
    V, F, UV, F_UV, normals, materials = curtain()
    mesh, settings = (V, F, UV, F_UV), {"radius": 0.7, "samples": 8, "width": 260, "height": 130, **options}
    whole = lkao.bake_texture(*mesh, **settings)
    parts = [lkao.bake_texture(*mesh, part=(k, 3), **settings) for k in (2, 0, 1)]
    assert [part.part for part in parts] == [(2, 3), (0, 3), (1, 3)]
    for part in parts:
        assert 0 < part.report.receiver_count < whole.report.receiver_count and np.isnan(part.maps[0].occlusion).any()
    merged = lkao.bake_texture(*mesh, merge=[pickle.loads(pickle.dumps(part)) for part in parts], **settings)
    assert merged.report == whole.report and merged.part is None and len(merged.maps) == len(whole.maps)
    for ours, expected in zip(merged.maps, whole.maps):
        assert ours.udim == expected.udim and ours.occlusion.tobytes() == expected.occlusion.tobytes()
        assert (ours.coverage == expected.coverage).all()
        assert (ours.bent_normals is None) == ("bent_normals" not in options)
        assert ours.bent_normals is None or ours.bent_normals.tobytes() == expected.bent_normals.tobytes()
    assert np.isnan(parts[0].maps[0].occlusion).any()  # these stay as they were
    for wrong in (parts[:2], [*parts[:2], parts[1]], []):
        with pytest.raises(ValueError, match="merge must be all parts of a bake, each once"):
            lkao.bake_texture(*mesh, merge=wrong, **settings)
    other_normals = None if "bent_normals" in options else "object"
    for change in ({"width": 130, "height": 260}, {"udim": not options.get("udim")}, {"bent_normals": other_normals}):
        with pytest.raises(ValueError, match="merge must be parts of a bake with the same mesh, size, udim and bent"):
            lkao.bake_texture(*mesh, merge=parts, **{**settings, **change})
    other = lkao.bake_texture(*mesh, part=(1, 3), **{**settings, "height": 65})
    with pytest.raises(ValueError, match="merge must be parts of one bake"):
        lkao.bake_texture(*mesh, merge=[*parts[:2], other], **settings)
    with pytest.raises(TypeError, match="merge must be what bake_texture has returned for parts"):
        lkao.bake_texture(*mesh, merge=[whole], **settings)


FLAT = {"V": FLOOR, "F": QUADS, "UV": PLACES, "F_UV": CORNERS, **SETTINGS}
BAD = {
    "UV rows": ({"UV": PLACES, "F_UV": None}, ValueError, r"UV must have the shape \(6, 2\) or \(4, 3, 2\), not"),
    "UV columns": ({"UV": FLOOR[:4]}, ValueError, r"UV must have the shape \(k, 2\)"),
    "UV of str": ({"UV": PLACES.astype(str)}, TypeError, "UV must be an array of floats or integers, not of dtype <U"),
    "F_UV rows": ({"F_UV": CORNERS[:3]}, ValueError, r"F_UV must have the shape of F, \(4, 3\), not \(3, 3\)"),
    "F_UV range": ({"F_UV": CORNERS + 1}, ValueError, "F_UV must be from 0 to 3, the rows of UV, or -1, not 4"),
    "no UV": ({"F_UV": np.full((4, 3), -1)}, ValueError, "no triangle to bake has texture coordinates"),
    "uv_origin": ({"uv_origin": "left"}, ValueError, "uv_origin must be one of 'lower', 'upper', not 'left'"),
    "width": ({"width": 0}, ValueError, "width must be from 1 to 32768, not 0"),
    "height": ({"height": 10**6}, ValueError, "height must be from 1 to 32768, not 1000000"),
    "wrap": ({"wrap": "tile"}, ValueError, "wrap must be one of 'repeat', 'mirror', 'clamp', not 'tile'"),
    "wraps": ({"wrap": ("clamp",) * 3}, ValueError, "wrap must be a word, or one for u and one for v"),
    "grid": ({"grid": 17}, ValueError, "grid must be from 1 to 16, not 17"),
    "margin": ({"margin": -1}, ValueError, "margin must be from 0 to 32768, not -1"),
    "bent": ({"bent_normals": "world"}, ValueError, "bent_normals must be one of 'object', 'tangent', not 'world'"),
    "normals": ({"normals": "flat"}, ValueError, "normals must be one of 'facet', 'smooth' or an array, not 'flat'"),
    "normals shape": ({"normals": FLOOR[:5]}, ValueError, r"normals must have the shape \(6, 3\) or \(4, 3, 3\), not"),
    "materials": ({"materials": [0, 1]}, ValueError, r"materials must have the shape \(4,\), not \(2,\)"),
    "material": ({"material": 1}, ValueError, "material is one of materials, which must be given"),
    "detailed": ({"detailed": FLOOR}, TypeError, r"detailed must be a tuple .*\(V, F\)"),
    "detailed F": ({"detailed": (FLOOR, QUADS + 3)}, ValueError, r"F of detailed\[\d, \d\] is \d"),
    "extrusion": ({"detailed": (FLOOR, QUADS), "extrusion": 0}, ValueError, "extrusion must be above 0 and finite"),
    "extrusion alone": ({"extrusion": 1.0}, ValueError, "extrusion is for a detailed mesh"),
    "part": ({"part": 1}, TypeError, r"part must be a tuple .*\(k, n\)"),
    "part and merge": ({"part": (0, 1), "merge": []}, ValueError, "part and merge exclude each other"),
    "part range": ({"part": (3, 3)}, ValueError, "k of part must be from 0 to 2, not 3"),
    "radius": ({"radius": 0.0}, ValueError, "radius.* 0"),
}


@pytest.mark.parametrize("name", BAD)
def test_wrong_arguments_are_named_in_one_line(name):
    changes, kind, message = BAD[name]
    lkao.bake_texture(**FLAT)
    with pytest.raises(kind, match=message) as caught:
        lkao.bake_texture(**{**FLAT, **changes})
    assert "\n" not in str(caught.value)
