"""Spreads a bake over the workers of a Dask cluster.

usage: dask_bake.py SCENE -o OCCLUSION.npy --radius R [--samples N] [--parts K] [--scheduler HOST:PORT | --workers N]

SCENE is a mesh file or builtin:NAME. The scheduler and its workers (dask-scheduler, dask-worker) run anywhere that has
the package lkao; without --scheduler, workers are started on this machine. Each makes its own hierarchy, once, and
answers parts of the receivers; a receiver's answer hangs on the mesh, the seed and its own index alone, so that the
parts together are, bit for bit, what one machine bakes, whichever workers answer them, and whichever are lost.
"""

import argparse
import functools
import hashlib

import numpy as np
from distributed import Client, LocalCluster, get_worker

import lkao


def settings_key(V, F, settings):
    """What a question hangs on: workers keep what they have made for it."""
    return hashlib.sha256(V.tobytes() + F.tobytes() + repr(sorted(settings.items())).encode()).hexdigest()


@functools.lru_cache(maxsize=1)
def prepared(key):
    """The receivers and the query of a worker's last question; filled by answer()."""
    return {}


def answer(mesh, key, settings, first, last):
    """Occlusion of the receivers from first to last."""
    made = prepared(key)
    if not made:
        V, F = mesh
        made["baking"] = lkao.Baking(V, F)
        made["query"] = lkao.AmbientOcclusion(lkao.Scene(V, F), **settings)
    rows = slice(first, last)
    baking = made["baking"]
    return made["query"].query(
        baking.P[rows],
        baking.N[rows],
        geometric_normals=baking.geometric_normals[rows],
        first_index=first,
        threads=get_worker().state.nthreads,
    ).occlusion


def bake(client, V, F, *, parts=64, on_part=None, **settings):
    """Occlusion of the vertices, as lkao.bake(V, F, **settings) has it. on_part: called with each part's number."""
    baking = lkao.Baking(V, F)
    bounds = np.linspace(0, len(baking.P), parts + 1).astype(int)
    mesh = client.scatter((V, F), broadcast=True)
    key = settings_key(V, F, settings)
    futures = [client.submit(answer, mesh, key, settings, int(a), int(b)) for a, b in zip(bounds, bounds[1:])]
    occlusion = []
    for number, future in enumerate(futures):
        occlusion.append(future.result())
        if on_part is not None:
            on_part(number)
    return baking.values(np.concatenate(occlusion))


def main():
    parser = argparse.ArgumentParser(description="Bakes a scene on a Dask cluster.")
    parser.add_argument("scene")
    parser.add_argument("-o", "--output", required=True, help="occlusion of the vertices, .npy")
    parser.add_argument("--radius", type=float, required=True)
    parser.add_argument("--samples", type=int, default=128)
    parser.add_argument("--parts", type=int, default=64)
    parser.add_argument("--scheduler", help="HOST:PORT; without it workers are started here")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()

    V, F = lkao.load(options.scene)
    address = options.scheduler or LocalCluster(
        n_workers=options.workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
    )
    with Client(address) as client:
        occlusion = bake(client, V, F, parts=options.parts, radius=options.radius, samples=options.samples)
    if options.scheduler is None:
        address.close()
    np.save(options.output, occlusion)
    print(f"{options.output}: {len(occlusion)} vertices, mean occlusion {np.nanmean(occlusion):.4f}")


if __name__ == "__main__":
    main()
