#!/usr/bin/env python3
"""Hold poses of animated glTF scenes against Blender's importer.

Each scene is shown at key times of each of its clips, because between keys of rotations Blender mixes quaternions where
the format asks for the arc. Prints a Markdown table: how far a corner or the centroid of a triangle of either is from the
nearest one of the other, over the longest side of the scene. Needs Python 3.11 with the packages bpy and numpy, and `cargo build --release -p
rasray-scene-files --example positions`.

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


def key_times(path, clip):
    """Times of the keys of the first channel of a clip, seconds."""
    root, buffer = document(path)
    accessor = root["accessors"][root["animations"][clip]["samplers"][0]["input"]]
    view = root["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return np.frombuffer(buffer(view["buffer"]), "<f4", accessor["count"], start).astype(float)


def marked(triangles):
    """Corners and centroids of triangles: where vertices are, and which of them triangles join."""
    points = np.concatenate([triangles.reshape(-1, 3), triangles.mean(axis=1)])
    return np.unique(points, axis=0)


def of_rasray(positions, path, seconds, clip):
    """All triangles, metres."""
    command = [positions, str(path), repr(seconds), str(clip)]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return np.array([line.split() for line in text.splitlines()], dtype=float).reshape(-1, 3, 3)


def play(name):
    """Makes Blender play one clip alone. The importer keeps each as a muted track of what it moves, and plays the first."""
    for item in bpy.data.objects:
        for animated in (item, getattr(item.data, "shape_keys", None)):
            data = getattr(animated, "animation_data", None)
            if data is None:
                continue
            strips = [track.strips[0] for track in data.nla_tracks if track.name == name]
            data.action = strips[0].action if strips else None
            if strips:
                data.action_slot = strips[0].action_slot


def of_blender(seconds):
    """All triangles of the imported meshes, metres, in axes of glTF."""
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
        mesh.calc_loop_triangles()
        local = np.empty(3 * len(mesh.vertices))
        mesh.vertices.foreach_get("co", local)
        corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
        mesh.loop_triangles.foreach_get("vertices", corners)
        matrix = np.array(evaluated.matrix_world)
        world = local.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
        turned = np.stack([world[:, 0], world[:, 2], -world[:, 1]], axis=1)
        found.append(turned[corners].reshape(-1, 3, 3))
        evaluated.to_mesh_clear()
    return np.concatenate(found)


def farthest(ours, theirs):
    """The largest distance from a point of either side to the nearest of the other."""

    def one_way(points, others):
        parts = np.array_split(points, len(points) // 256 + 1)
        distances = (((part[:, None] - others[None]) ** 2).sum(axis=2) for part in parts)
        return max(np.sqrt(squares).min(axis=1).max() for squares in distances)

    return max(one_way(ours, theirs), one_way(theirs, ours))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("positions", help="the example of rasray-scene-files")
    parser.add_argument("scenes", nargs="+", type=Path)
    given = parser.parse_args()
    print("| scene | clip | times, s | triangles | largest distance / size |")
    print("|---|---|---|---|---|")
    for path in given.scenes:
        clips = document(path)[0]["animations"]
        for clip, named in enumerate(clips):
            keys = key_times(path, clip)
            times = sorted({float(keys[min(len(keys) * part // 4, len(keys) - 1)]) for part in range(5)})
            bpy.ops.wm.read_factory_settings(use_empty=True)
            bpy.ops.import_scene.gltf(filepath=str(path))
            name = named.get("name") or f"Anim_{clip}"
            play(name)
            worst, count = 0.0, 0
            for seconds in times:
                ours, theirs = of_rasray(given.positions, path, seconds, clip), of_blender(seconds)
                count = len(ours)
                size = np.ptp(theirs.reshape(-1, 3), axis=0).max()
                worst = max(worst, farthest(marked(ours), marked(theirs)) / size)
                if len(ours) != len(theirs):
                    print(f"{path.name}: {len(ours)} triangles, {len(theirs)} in Blender")
            listed = ", ".join(f"{seconds:.3f}" for seconds in times)
            print(f"| {path.name} | {name} | {listed} | {count:,} | {worst:.1e} |", flush=True)


if __name__ == "__main__":
    main()
