#!/usr/bin/env python3
"""Hold what the camera sees, found by drawing, against traces: times, and pixels that differ.

Each scene is rendered through each system, with `--primary trace` and `--primary raster`. Prints a Markdown table:
milliseconds per sample of all pixels, and how many pixels differ in triangle and in distance at their centres, and in
colour (ray casting, a random place in the pixel for each sample).

With `--processor` times are the processor's: what a run takes beyond one of a single sample, per sample more, each the
least of two. They hold everything that a sample does, and are the ones to use where a software driver shares its cores
with other programs; 65 samples make up for what starting takes now more, now less.

  tools/compare_primary.py --program target/release/rasray --systems bricks,mmrt,hu cornell SCENE.glb ...
"""

import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

LINES = 16


def header(data):
    """Attributes of an OpenEXR file with one part, and where its table of chunks begins."""
    attributes, at = {}, 8
    while data[at]:
        name, kind = data[at:].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name.decode()] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def unpacked(packed, size):
    """The bytes of a chunk: zlib, differences of bytes, and two halves that alternate."""
    if len(packed) == size:
        return packed
    coded = bytearray(zlib.decompress(packed))
    for i in range(1, size):
        coded[i] = (coded[i - 1] + coded[i] - 128) & 255
    result = bytearray(size)
    half = (size + 1) // 2
    result[0::2], result[1::2] = coded[:half], coded[half:]
    return bytes(result)


def words(path):
    """The 32-bit words of every channel of a file that rasray wrote, row by row."""
    data = path.read_bytes()
    attributes, table = header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels, at = [], 0
    while attributes["channels"][at]:
        name = attributes["channels"][at:].split(b"\0", 1)[0]
        channels.append(name.decode())
        at += len(name) + 1 + 16
    image = {name: [] for name in channels}
    for chunk in range(-(-height // LINES)):
        place = struct.unpack_from("<Q", data, table + 8 * chunk)[0]
        _, size = struct.unpack_from("<2i", data, place)
        rows = min(LINES, height - LINES * chunk)
        raw = unpacked(data[place + 8 : place + 8 + size], 4 * width * len(channels) * rows)
        for row in range(rows):
            for number, name in enumerate(channels):
                first = 4 * width * (row * len(channels) + number)
                image[name].extend(struct.unpack_from(f"<{width}I", raw, first))
    return image


def render(options, scene, system, primary, samples, folder):
    """Channels, number of triangles, the run of the report and processor time in ms; nothing where it is refused."""
    image, report = folder / "image.exr", folder / "report.json"
    command = [options.program, "render", scene, "--system", system, "--primary", primary, "--integrator", "raycast"]
    command += ["--size", options.size, "--spp", str(samples), "--aov", "depth,primitive"]
    command += ["--output", str(image), "--report", str(report), "--quiet"]
    before = os.times()
    done = subprocess.run(command, capture_output=True, text=True)
    after = os.times()
    if done.returncode != 0:
        print(f"{scene}: {done.stderr.strip()}", file=sys.stderr)
        return None
    found = json.loads(report.read_text())
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    return words(image), found["scene"]["triangles"], found["runs"][0], 1000.0 * spent


def measure(options, scene, system, folder):
    """Of both ways: channels, and milliseconds per sample; and the number of triangles. Nothing where it is refused."""
    images, times = [], []
    for way, key in (("trace", "trace_ms"), ("raster", "visible_ms")):
        whole = [render(options, scene, system, way, options.samples, folder) for _ in range(1 + options.processor)]
        if None in whole:
            return None
        image, triangles, run, _ = whole[0]
        time = run[key] / options.samples
        if options.processor:
            single = [render(options, scene, system, way, 1, folder) for _ in whole]
            least, least_single = (min(spent for *_, spent in runs) for runs in (whole, single))
            time = (least - least_single) / (options.samples - 1)
        images.append(image)
        times.append(time)
    return images, times, triangles


def different(first, second, names):
    return sum(a != b for a, b in zip(zip(*(first[n] for n in names)), zip(*(second[n] for n in names))))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", help="files and built-in scenes")
    parser.add_argument("--program", default="target/release/rasray", help="[%(default)s]")
    parser.add_argument("--systems", default="bricks,mmrt,hu", help="[%(default)s]")
    parser.add_argument("--size", default="160x90", help="pixels [%(default)s]")
    parser.add_argument("--samples", type=int, default=4, help="per pixel, 2 or more [%(default)s]")
    parser.add_argument("--processor", action="store_true", help="times are processor time, not that of passes")
    options = parser.parse_args()
    print("| scene | triangles | system | traced, ms | drawn, ms | | other triangle | other distance | other colour |")
    print("|---|---|---|---|---|---|---|---|---|")
    for scene in options.scenes:
        for system in options.systems.split(","):
            with tempfile.TemporaryDirectory() as folder:
                measured = measure(options, scene, system, Path(folder))
            if measured is None:
                continue
            (traced, drawn), times, triangles = measured
            cells = [Path(scene).name, f"{triangles:,}", f"`{system}`", *(f"{time:.2f}" for time in times)]
            cells += [f"{times[1] / times[0]:.2f}", different(traced, drawn, ["id"]), different(traced, drawn, ["Z"])]
            cells.append(different(traced, drawn, ["R", "G", "B"]))
            print("| " + " | ".join(map(str, cells)) + " |", flush=True)


if __name__ == "__main__":
    main()
