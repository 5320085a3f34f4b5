"""Cameras, mesh files, and the OpenGL side."""

import threading

import numpy as np
import pytest

import lkao
import meshes

VIEW = dict(eye=(3, 2, 4), target=(0, 0.5, 0), width=48, height=36)


def test_view_sees_the_wall():
    V, F = meshes.wall()
    view = lkao.View(V, F, **VIEW)
    assert view.P.shape == view.N.shape == view.geometric_normals.shape == (36, 48, 3)
    seen = np.isfinite(view.depth)
    assert 0.3 < seen.mean() < 1 and np.isnan(view.P[~seen]).all()
    on_floor, on_wall = np.abs(view.P[..., 1]) < 1e-5, np.abs(view.P[..., 2]) < 1e-5
    assert (on_floor | on_wall)[seen].all() and on_floor.any() and on_wall.any()


def test_view_of_a_mesh_far_from_zero():
    V, F = meshes.wall()
    shift = np.array([5e6, 0, 0])
    view = lkao.View(V + shift, F, **{**VIEW, "eye": shift + VIEW["eye"], "target": shift + VIEW["target"]})
    near = lkao.View(V, F, **VIEW)
    both = np.isfinite(view.depth) & np.isfinite(near.depth)
    assert both.mean() > 0.3 and np.allclose((view.P - shift)[both], near.P[both], atol=1e-3)


def test_load_reads_files(tmp_path):
    path = tmp_path / "far.obj"
    path.write_text("v 5000000 0 0\nv 5000001 0 0\nv 5000000 1.25 0\nf 1 2 3\n")
    mesh = lkao.load(path)
    assert mesh.V.dtype == np.float64 and mesh.V.tolist()[2] == [5000000, 1.25, 0] and mesh.F.tolist() == [[0, 1, 2]]
    assert lkao.load("builtin:atrium").V.dtype == np.float32


@pytest.fixture(scope="module")
def rasterizer():
    try:
        return lkao.Rasterizer("software")
    except RuntimeError as error:
        pytest.skip(f"no OpenGL on the CPU: {error}")


def test_rasterizer_draws_the_bits_of_the_query(rasterizer):
    V, F = meshes.wall()
    view = lkao.View(V, F, **VIEW)
    table = lkao.PlaneMaskTable(64, resolution=32)
    drawn = rasterizer.draw(V, F, view, table, radius=1.5, bent_normals=True, precision="double")
    ao = lkao.AmbientOcclusion(lkao.Scene(V, F), table.pattern, radius=1.5)
    asked = ao.query(
        view.P, view.N, geometric_normals=view.geometric_normals, masks=True, bent_normals=True
    )
    assert (drawn.masks == asked.masks).all() and drawn.masks.any()
    assert np.allclose(drawn.occlusion, asked.occlusion, atol=1e-6, equal_nan=True)
    seen = np.isfinite(view.depth)
    assert np.allclose(drawn.bent_normals[seen], asked.bent_normals[seen], atol=1e-3)
    assert rasterizer.is_software and rasterizer.renderer


def test_rasterizer_refuses_in_one_line(rasterizer):
    V, F = meshes.wall()
    view = lkao.View(V, F, **VIEW)
    with pytest.raises(ValueError, match="radius"):
        rasterizer.draw(V, F, view, 16, radius=-1.0)
    with pytest.raises(ValueError, match="precision must be one of 'single', 'double', not 'half'"):
        rasterizer.draw(V, F, view, 16, radius=1.0, precision="half")
    with pytest.raises(ValueError, match="device must be one of 'automatic'"):
        lkao.Rasterizer("gpu")
    table = lkao.PlaneMaskTable(16, resolution=32)
    errors = []

    def draw():
        try:
            rasterizer.draw(V, F, view, table, radius=1.0)
        except RuntimeError as error:
            errors.append(str(error))

    thread = threading.Thread(target=draw)
    thread.start()
    thread.join()
    assert errors == ["a Rasterizer works only in the thread in which it was made"]
