#!/usr/bin/env python3
"""Hold poses of animated glTF scenes against Blender's importer.

Each scene is shown at key times of its first clip, because between keys of rotations Blender mixes quaternions where the
format asks for the arc. Prints a Markdown table: how far a vertex of rasray's is from the nearest one of Blender's, over
the longest side of the scene. Needs Python 3.11 with the packages bpy and numpy, and `cargo build --release -p
rasray-scene --example positions`.

  tools/compare_poses.py target/release/examples/positions SCENE.glb ...
"""

import argparse
import base64
import json
import math
import struct
import subprocess
from pathlib import Path

import bpy
import numpy as np


def document(path):
    """The JSON of a glTF or GLB file, and what reads one of its buffers."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        length = struct.unpack_from("<I", data, 12)[0]
        return json.loads(data[20 : 20 + length]), lambda _: data[28 + length :]
    root = json.loads(data)

    def buffer(number):
        uri = root["buffers"][number]["uri"]
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (path.parent / uri).read_bytes()

    return root, buffer


def key_times(path):
    """Times of the keys of the first channel of the first clip, seconds."""
    root, buffer = document(path)
    accessor = root["accessors"][root["animations"][0]["samplers"][0]["input"]]
    view = root["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return np.frombuffer(buffer(view["buffer"]), "<f4", accessor["count"], start).astype(float)


def of_rasray(positions, path, seconds):
    """Corners of all triangles, metres."""
    command = [positions, str(path), repr(seconds), "0"]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return np.unique(np.array([line.split() for line in text.splitlines()], dtype=float), axis=0)


def of_blender(seconds):
    """Vertices of the imported meshes, metres, in axes of glTF."""
    scene = bpy.context.scene
    frame = seconds * scene.render.fps / scene.render.fps_base
    scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for item in scene.objects:
        # The importer draws joints as a sphere.
        if item.type != "MESH" or item.name.startswith("Icosphere"):
            continue
        evaluated = item.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        local = np.empty(3 * len(mesh.vertices))
        mesh.vertices.foreach_get("co", local)
        matrix = np.array(evaluated.matrix_world)
        world = local.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
        found.append(np.stack([world[:, 0], world[:, 2], -world[:, 1]], axis=1))
        evaluated.to_mesh_clear()
    return np.concatenate(found)


def farthest(ours, theirs):
    """The largest distance from a point to the nearest of others."""
    parts = np.array_split(ours, len(ours) // 256 + 1)
    return max(np.sqrt(((part[:, None] - theirs[None]) ** 2).sum(axis=2)).min(axis=1).max() for part in parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("positions", help="the example of rasray-scene")
    parser.add_argument("scenes", nargs="+", type=Path)
    given = parser.parse_args()
    print("| scene | times, s | corners | largest distance / size |")
    print("|---|---|---|---|")
    for path in given.scenes:
        keys = key_times(path)
        times = sorted({float(keys[len(keys) * part // 4]) for part in (1, 2, 3)})
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.import_scene.gltf(filepath=str(path))
        worst, count = 0.0, 0
        for seconds in times:
            ours, theirs = of_rasray(given.positions, path, seconds), of_blender(seconds)
            size = (theirs.max(axis=0) - theirs.min(axis=0)).max()
            worst, count = max(worst, farthest(ours, theirs) / size), len(ours)
        listed = ", ".join(f"{seconds:.3f}" for seconds in times)
        print(f"| {path.name} | {listed} | {count:,} | {worst:.1e} |", flush=True)


if __name__ == "__main__":
    main()
