#!/usr/bin/env python3
"""Hold pictures of rasray against those of Mitsuba 3 and of Cycles in Blender.

Each scene is a glTF file with one camera and one constant environment, for rasray and for Blender's importer. Of those
made here Mitsuba reads the same triangles as OBJ, with its own materials. Prints Markdown tables; writes pictures as
EXR, and side by side as PNG, to the output folder. Needs Python 3.11 with the packages mitsuba and numpy, and bpy for
Cycles.
"""

import argparse
import base64
import json
import logging
import math
import os
import subprocess
import sys
from collections import namedtuple
from dataclasses import dataclass
from pathlib import Path

import mitsuba as mi
import numpy as np

try:
    import bpy
    import mathutils
except ImportError:
    bpy = None

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
# Triangles with one material; without normals they are flat.
Mesh = namedtuple("Mesh", "points faces material normals uvs", defaults=[None, None])
# A glTF file, a view with its angle in degrees, the radiance of the sky, the meshes of what is made here, the diameter
# of the lens, in whose focus the target is, and what rasray is asked for in place of paths of so many bounces.
Scene = namedtuple(
    "Scene", "name path eye target fov sky bounces meshes aperture options", defaults=[0.0, 8, (), 0.0, ()]
)


# Trees of perfect reflections and refractions.
TREES = ("--integrator", "whitted", "--ray-depth", 8)
# Caustics by photons, all else by paths.
PHOTONS = ("--integrator", "photons", "--bounces", 4, "--photon-paths", 65536, "--radius", 0.03)


@dataclass(frozen=True)
class Material:
    """Metallic-roughness material of glTF; glass has the index 1.5 and an inside."""

    color: tuple = (1.0, 1.0, 1.0)
    metallic: float = 0.0
    roughness: float = 1.0
    specular: float = 0.0
    emission: tuple = (0.0, 0.0, 0.0)
    glass: bool = False
    alpha: float = 1.0
    anisotropy: float = 0.0

    def gltf(self):
        """As an entry of `materials`."""
        strength = max(*self.emission, 1.0e-9)
        extensions = {"specular": {"specularFactor": self.specular}}
        extensions |= {"emissive_strength": {"emissiveStrength": strength}}
        glass = {"transmission": {"transmissionFactor": 1.0}, "volume": {"thicknessFactor": 1.0}}
        extensions |= glass if self.glass else {}
        extensions |= {"anisotropy": {"anisotropyStrength": self.anisotropy}} if self.anisotropy else {}
        factors = {"baseColorFactor": [*self.color, self.alpha], "metallicFactor": self.metallic}
        return {
            "alphaMode": "BLEND" if self.alpha < 1.0 else "OPAQUE",
            "pbrMetallicRoughness": factors | {"roughnessFactor": self.roughness},
            "emissiveFactor": [value / strength for value in self.emission],
            "extensions": {"KHR_materials_" + key: value for key, value in extensions.items()},
        }

    def mitsuba(self):
        """The model of Mitsuba that comes nearest."""
        color = {"type": "rgb", "value": list(self.color)}
        rough = "rough" if self.roughness >= 0.03 else ""
        along = self.roughness**2 + (1.0 - self.roughness**2) * self.anisotropy**2
        facets = {"alpha_u": along, "alpha_v": self.roughness**2, "distribution": "ggx"} if rough else {}
        if self.glass:
            return {"type": rough + "dielectric", "int_ior": 1.5, "ext_ior": 1.0, **facets}
        inner = {"type": rough + "plastic", "diffuse_reflectance": color, "int_ior": 1.5, "ext_ior": 1.0, **facets}
        if self.metallic == 1.0:
            inner = {"type": rough + "conductor", "material": "none", "specular_reflectance": color, **facets}
        elif self.specular == 0.0:
            inner = {"type": "diffuse", "reflectance": color}
        both = {"type": "twosided", "inner": inner}
        return {"type": "mask", "opacity": self.alpha, "inner": both} if self.alpha < 1.0 else both


def quads(corners, material):
    """Quads with four corners each, counter-clockwise."""
    first = np.arange(0, len(corners), 4)[:, None]
    return Mesh(np.array(corners, np.float32), np.concatenate([first + [0, 1, 2], first + [0, 2, 3]]), material)


def ball(centre, radius, material, rows=64):
    """A smooth sphere of rows by twice as many columns; two rows make an octahedron."""
    polar, azimuth = np.mgrid[0:math.pi:(rows + 1) * 1j, 0:2 * math.pi:(2 * rows + 1) * 1j]
    normals = np.stack([np.sin(polar) * np.cos(azimuth), np.cos(polar), -np.sin(polar) * np.sin(azimuth)], -1)
    index = np.arange(polar.size).reshape(polar.shape)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    faces = np.concatenate([np.dstack([a, b, c])[:-1].reshape(-1, 3), np.dstack([a, c, d])[1:].reshape(-1, 3)])
    normals = normals.reshape(-1, 3).astype(np.float32)
    return Mesh((normals * radius + centre).astype(np.float32), faces, material, normals)


def slab(centre, half_sides, angle, material):
    """A box, turned around y."""
    turn = np.array([[math.cos(angle), 0, math.sin(angle)], [0, 1, 0], [-math.sin(angle), 0, math.cos(angle)]])
    signs = [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1), (-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]
    points = np.array(signs) * half_sides @ turn.T + centre
    sides = ((0, 1, 2, 3), (5, 4, 7, 6), (1, 5, 6, 2), (4, 0, 3, 7), (3, 2, 6, 7), (4, 5, 1, 0))
    return quads([points[corner] for side in sides for corner in side], material)


def write_scene(name, folder, meshes, **view):
    """Writes NAME.gltf, and one OBJ a mesh for Mitsuba."""
    blob, views, accessors, entries = b"", [], [], []

    def accessor(values, component, kind):
        nonlocal blob
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": values.nbytes})
        accessors.append({"bufferView": len(accessors), "componentType": component, "count": len(values), "type": kind})
        accessors[-1] |= {key: np.atleast_1d(getattr(values, key)(0)).tolist() for key in ("min", "max")}
        blob += values.tobytes()
        return len(accessors) - 1

    for number, mesh in enumerate(meshes):
        attributes = {"POSITION": accessor(mesh.points, 5126, "VEC3")}
        with open(folder / f"{name}-{number}.obj", "w", encoding="ascii") as obj:
            obj.writelines("v {:.9g} {:.9g} {:.9g}\n".format(*point) for point in mesh.points)
            if mesh.normals is not None:
                attributes["NORMAL"] = accessor(mesh.normals, 5126, "VEC3")
                obj.writelines("vn {:.9g} {:.9g} {:.9g}\n".format(*normal) for normal in mesh.normals)
            if mesh.uvs is not None:
                attributes["TEXCOORD_0"] = accessor(mesh.uvs, 5126, "VEC2")
                obj.writelines("vt {:.9g} {:.9g}\n".format(*uv) for uv in mesh.uvs)
            # Without any, nothing stands between the slashes, and none at the end.
            indices = ("{%d}", "{%d}" if mesh.uvs is not None else "", "{%d}" if mesh.normals is not None else "")
            corner = "/".join(indices).rstrip("/")
            form = "f " + " ".join(corner.replace("%d", str(place)) for place in range(3)) + "\n"
            obj.writelines(form.format(*(face + 1)) for face in mesh.faces)
        indices = accessor(mesh.faces.astype(np.uint32).reshape(-1), 5125, "SCALAR")
        entries.append({"primitives": [{"attributes": attributes, "indices": indices, "material": number}]})
    materials, numbers = [mesh.material.gltf() for mesh in meshes], range(len(meshes))
    uri = "data:application/octet-stream;base64," + base64.b64encode(blob).decode()
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(numbers)}]}
    document |= {"nodes": [{"mesh": number} for number in numbers], "meshes": entries, "materials": materials}
    document |= {"accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(blob), "uri": uri}]}
    document["extensionsUsed"] = sorted({key for material in materials for key in material["extensions"]})
    (folder / f"{name}.gltf").write_text(json.dumps(document), encoding="ascii")
    return Scene(name, folder / f"{name}.gltf", meshes=meshes, **view)


class Rasray:
    """The command of the project."""

    name, samplers, command = "rasray", ("sobol", "pcg"), "rasray"

    def render(self, scene, output, size, samples, seed=1, sampler="sobol"):
        """Linear RGB; this and its like of the other renderers."""
        command = [self.command, "render", scene.path, "--quiet", "--output", output, "--size", f"{size}x{size}"]
        command += ["--spp", samples, "--seed", seed, "--sampler", sampler]
        command += scene.options or ["--bounces", scene.bounces]
        command += ["--eye", "{},{},{}".format(*scene.eye), "--target", "{},{},{}".format(*scene.target)]
        command += ["--fov", scene.fov, "--environment", f"{scene.sky},{scene.sky},{scene.sky}"]
        command += ["--aperture", scene.aperture]
        # The others have both sides of every surface.
        command += ["--back-faces", "none"]
        subprocess.run([str(part) for part in command], check=True, stderr=subprocess.DEVNULL)
        return read_picture(output)


class Cycles:
    """Cycles on the processor, without what trades truth for less noise."""

    name, samplers = "Cycles", ("TABULATED_SOBOL",)

    def load(self, scene):
        """Blender's z is up: x, y, z become x, -z, y. The files have no lights."""
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.import_scene.gltf(filepath=str(scene.path))
        # Blender absorbs by exp(-density (1 - color) t), glTF by color^(t / distance).
        nodes = [node for item in bpy.data.materials for node in item.node_tree.nodes]
        for node in (node for node in nodes if node.type == "VOLUME_ABSORPTION"):
            color, density = node.inputs["Color"], node.inputs["Density"]
            wanted = -np.log(np.clip(color.default_value[:3], 1.0e-6, 1.0)) * density.default_value
            density.default_value = max(wanted.max(), 1.0e-9)
            color.default_value = [*(1.0 - wanted / density.default_value), 1.0]
        eye, target = (mathutils.Vector((p[0], -p[2], p[1])) for p in (scene.eye, scene.target))
        camera = bpy.data.objects.new("view", bpy.data.cameras.new("view"))
        bpy.context.scene.collection.objects.link(camera)
        camera.location = eye
        camera.rotation_euler = (target - eye).to_track_quat("-Z", "Y").to_euler()
        camera.data.angle, camera.data.clip_start, camera.data.clip_end = math.radians(scene.fov), 1.0e-3, 1.0e4
        world = bpy.data.worlds.new("sky")
        world.node_tree.nodes["Background"].inputs["Color"].default_value = [scene.sky] * 3 + [1.0]
        bpy.context.scene.camera, bpy.context.scene.world = camera, world

    def render(self, scene, output, size, samples, seed=1, sampler="TABULATED_SOBOL"):
        """Linear RGB."""
        self.load(scene)
        target = bpy.context.scene
        target.render.engine, target.render.filepath = "CYCLES", str(output)
        target.render.resolution_x = target.render.resolution_y = size
        target.render.image_settings.file_format, target.render.image_settings.color_depth = "OPEN_EXR", "32"
        # Bounces are counted after the first hit there, scatterings in rasray.
        depths = ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces")
        options = {"samples": samples, "seed": seed, "sampling_pattern": sampler, "pixel_filter_type": "BOX"}
        off = ("sample_clamp_direct", "sample_clamp_indirect", "blur_glossy", "light_sampling_threshold")
        options |= dict.fromkeys(depths, scene.bounces - 1) | dict.fromkeys(off, 0.0)
        options |= {"transparent_max_bounces": 16, "use_adaptive_sampling": False, "use_denoising": False}
        for key, value in options.items():
            setattr(target.cycles, key, value)
        bpy.ops.render.render(write_still=True)
        return read_picture(output)


class Mitsuba:
    """Path tracing of Mitsuba 3, for scenes that are made here."""

    name, samplers = "Mitsuba", ("multijitter", "independent")

    def render(self, scene, output, size, samples, seed=1, sampler="multijitter"):
        """Linear RGB; multijitter wants a square number of samples."""
        look = mi.ScalarTransform4f().look_at(origin=list(scene.eye), target=list(scene.target), up=[0, 1, 0])
        film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}}
        sensor = {"type": "perspective", "to_world": look, "fov": scene.fov, "film": film}
        if scene.aperture > 0.0:
            sensor["focus_distance"] = math.dist(scene.eye, scene.target)
            sensor |= {"type": "thinlens", "aperture_radius": scene.aperture / 2}
        sensor["sampler"] = {"type": sampler, "sample_count": samples}
        # Emission alone is depth 1 there and 0 scatterings in rasray. Going through sheets counts as well: no end then.
        blends = any(mesh.material.alpha < 1.0 for mesh in scene.meshes)
        depth = -1 if blends else scene.bounces + 1
        integrator = {"type": "path", "max_depth": depth, "rr_depth": 1000}
        world = {"type": "scene", "integrator": integrator, "sensor": sensor}
        if scene.sky > 0.0:
            world["sky"] = {"type": "constant", "radiance": scene.sky}
        for number, mesh in enumerate(scene.meshes):
            path = scene.path.with_name(f"{scene.path.stem}-{number}.obj")
            shape = {"type": "obj", "filename": str(path), "face_normals": mesh.normals is None}
            world[f"mesh{number}"] = shape | {"bsdf": mesh.material.mitsuba()}
            if max(mesh.material.emission) > 0.0:
                radiance = {"type": "rgb", "value": list(mesh.material.emission)}
                world[f"mesh{number}"]["emitter"] = {"type": "area", "radiance": radiance}
        mi.Bitmap(mi.render(mi.load_dict(world), seed=seed, spp=samples)).write(str(output))
        return read_picture(output)


def read_picture(path):
    """Red, green and blue of an EXR."""
    bitmap = mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
    return np.array(bitmap, dtype=np.float64)


def row(*cells):
    """Prints a row of a table."""
    print("|", " | ".join(map(str, cells)), "|", flush=True)


def cornell(folder):
    """The built-in scene of that name."""
    w, h, d = 0.278, 0.5488, 0.5592
    lamp = [(-0.065, -0.227), (-0.065, -0.332), (0.065, -0.332), (0.065, -0.227)]
    outer = [(-w, 0), (-w, -d), (w, -d), (w, 0)]
    white = [(-w, 0, 0), (w, 0, 0), (w, 0, -d), (-w, 0, -d), (-w, 0, -d), (w, 0, -d), (w, h, -d), (-w, h, -d)]
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        white += [(x, h, z) for x, z in (outer[a], outer[b], lamp[b], lamp[a])]
    short = (0.165, [(0.130, 0.065), (0.082, 0.225), (0.240, 0.272), (0.290, 0.114)])
    for top, foot in (short, (0.330, [(0.423, 0.247), (0.265, 0.296), (0.314, 0.456), (0.472, 0.406)])):
        white += [(w - x, top, -z) for x, z in foot]
        for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
            white += [(w - foot[i][0], y, -foot[i][1]) for i, y in ((b, 0), (a, 0), (a, top), (b, top))]
    meshes = [
        quads(white, Material((0.725, 0.71, 0.68))),
        quads([(-w, 0, 0), (-w, 0, -d), (-w, h, -d), (-w, h, 0)], Material((0.63, 0.065, 0.05))),
        quads([(w, 0, -d), (w, 0, 0), (w, h, 0), (w, h, -d)], Material((0.14, 0.45, 0.091))),
        quads([(x, h, z) for x, z in lamp], Material((0.78, 0.78, 0.78), emission=(17.0, 12.0, 4.0))),
    ]
    return write_scene("cornell", folder, meshes, eye=(0, 0.273, 0.8), target=(0, 0.273, -0.2), fov=39.3077)


def glass(folder):
    """A smooth and a rough ball of glass on a floor, under a lamp and a dim sky."""
    meshes = [
        quads([(-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)], Material((0.6, 0.5, 0.3))),
        quads([(-1, 4, -1), (1, 4, -1), (1, 4, 1), (-1, 4, 1)], Material(emission=(8.0, 8.0, 8.0))),
        ball((-1.1, 1.0, 0.0), 1.0, Material(roughness=0.0, specular=1.0, glass=True)),
        ball((1.1, 1.0, 0.0), 1.0, Material(roughness=0.3, specular=1.0, glass=True)),
    ]
    return write_scene("glass", folder, meshes, eye=(0, 2.2, 6), target=(0, 0.8, 0), fov=40, sky=0.3, bounces=12)


def lamps(folder):
    """A floor and a ball of metal among 225 lamps whose power covers two decades."""
    meshes = [quads([(-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)], Material((0.7, 0.7, 0.7)))]
    meshes.append(ball((0, 0.8, 0), 0.8, Material((0.9, 0.6, 0.3), metallic=1.0, roughness=0.4, specular=1.0)))
    random, lamp = np.random.default_rng(1), ball((0, 0, 0), 0.05, None, 2)
    for group in range(5):
        glow = 1.5 * 10 ** (group / 2) * np.array([(1, 1, 1), (1, 0.5, 0.3), (0.4, 0.6, 1)][group % 3])
        points = (random.uniform((-4, 0.6, -4), (4, 2.5, 4), (45, 1, 3)) + lamp.points).reshape(-1, 3)
        faces = (np.arange(45)[:, None, None] * len(lamp.points) + lamp.faces).reshape(-1, 3)
        meshes.append(Mesh(points.astype(np.float32), faces, Material((0.0, 0.0, 0.0), emission=tuple(glow))))
    return write_scene("lamps", folder, meshes, eye=(0, 2.6, 6), target=(0, 0.5, 0), fov=45, bounces=4)


def spheres(folder):
    """312 balls of 960 triangles each, anywhere in a cube, below the sky."""
    one = ball((0, 0, 0), 1.0, Material((0.7, 0.7, 0.7)), 16)
    random = np.random.default_rng(1)
    places, radii = random.uniform(-4, 4, (312, 1, 3)), random.uniform(0.1, 0.5, (312, 1, 1))
    points = (places + radii * one.points).reshape(-1, 3).astype(np.float32)
    faces = (np.arange(312)[:, None, None] * len(one.points) + one.faces).reshape(-1, 3)
    mesh = one._replace(points=points, faces=faces, normals=np.tile(one.normals, (312, 1)))
    return write_scene("spheres", folder, [mesh], eye=(0, 0, 12), target=(0, 0, 0), fov=45, sky=1.0, bounces=4)


def lens(folder):
    """Balls and small lamps before, in and behind the focus of a wide lens."""
    meshes = [quads([(-9, 0, 9), (9, 0, 9), (9, 0, -9), (-9, 0, -9)], Material((0.5, 0.5, 0.5)))]
    for place in range(5):
        x, z = 1.1 * (place - 2), 2.4 - 1.6 * place
        color = (0.8, 0.2 + 0.15 * place, 0.8 - 0.15 * place)
        meshes.append(ball((x, 0.5, z), 0.5, Material(color)))
        meshes.append(ball((x, 1.3, z), 0.06, Material((0.0, 0.0, 0.0), emission=(40.0, 30.0, 20.0))))
    view = {"eye": (0, 1.5, 6), "target": (0, 0.6, -0.8), "fov": 40, "sky": 0.3, "bounces": 4}
    return write_scene("lens", folder, meshes, aperture=0.4, **view)


def tree(folder):
    """A ball and a slab of glass before panels that send light and reflect none: trees hold all light there is."""
    glow = [Material((0.0, 0.0, 0.0), emission=color) for color in ((1.0, 0.8, 0.5), (0.1, 0.2, 0.4))]
    squares = [[], []]
    for column, line in ((x, y) for x in range(-6, 6) for y in range(-6, 6)):
        corners = [(column, line), (column + 1, line), (column + 1, line + 1), (column, line + 1)]
        squares[(column + line) % 2] += [(x, y, -3) for x, y in corners]
    meshes = [quads(corners, material) for corners, material in zip(squares, glow)]
    clear = Material(roughness=0.0, specular=1.0, glass=True)
    meshes.append(ball((-1.2, 0.0, 0.0), 1.0, clear, 128))
    meshes.append(slab((1.3, 0.0, 0.0), (1.0, 1.0, 0.15), 0.8, clear))
    view = {"eye": (0, 0.4, 6), "target": (0, 0, 0), "fov": 38, "sky": 0.3, "bounces": 8}
    return write_scene("tree", folder, meshes, options=TREES, **view)


def brushed(folder):
    """A plate of white brushed metal, three times as rough along x, under a row of small lamps."""
    metal = Material(metallic=1.0, roughness=0.2, specular=1.0, anisotropy=0.3)
    uvs = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)
    meshes = [quads([(-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)], metal)._replace(uvs=uvs)]
    lamp = Material((0.0, 0.0, 0.0), emission=(3.0, 2.5, 2.0))
    meshes += [ball((x, 1.2, -1.0), 0.4, lamp, 16) for x in (-2.0, 0.0, 2.0)]
    view = {"eye": (0, 2.2, 6), "target": (0, 0.3, 0), "fov": 40, "sky": 0.2, "bounces": 4}
    return write_scene("brushed", folder, meshes, options=("--bounces", 4), **view)


def caustic(folder, focus):
    """The floor before half a cylinder of mirror, or below a ball of clear glass, which gather the light of a lamp there."""
    lamp = Material((0.0, 0.0, 0.0), emission=(30.0, 24.0, 18.0))
    meshes = [quads([(-2, 0, 2), (2, 0, 2), (2, 0, -2), (-2, 0, -2)], Material((0.7, 0.7, 0.7)))]
    if focus == "mirror":
        angles = np.linspace(0.5 * math.pi, 1.5 * math.pi, 193)
        normals = np.repeat(np.stack([-np.cos(angles), 0 * angles, -np.sin(angles)], -1), 2, axis=0).astype(np.float32)
        points = np.float32((0, 0.25, 0)) - normals + np.tile(np.float32([(0, -0.25, 0), (0, 0.25, 0)]), (193, 1))
        low = np.arange(0, 2 * 192, 2)[:, None]
        faces = np.concatenate([low + [0, 1, 3], low + [0, 3, 2]])
        mirror = Material((0.9, 0.9, 0.9), metallic=1.0, roughness=0.0, specular=1.0)
        meshes += [Mesh(points, faces, mirror, normals)]
        meshes += [quads([(2, 1.2, -0.3), (2, 1.2, 0.3), (1.7, 1.6, 0.3), (1.7, 1.6, -0.3)], lamp)]
        view = {"eye": (1.2, 3, 0), "target": (-0.25, 0, 0), "fov": 15}
    else:
        meshes.append(ball((0, 0.9, 0), 0.5, Material(roughness=0.0, specular=1.0, glass=True), 128))
        meshes.append(quads([(-0.3, 3, -0.3), (0.3, 3, -0.3), (0.3, 3, 0.3), (-0.3, 3, 0.3)], lamp))
        view = {"eye": (2.6, 0.8, 0), "target": (0, 0, 0), "fov": 12}
    return write_scene(f"caustic-{focus}", folder, meshes, options=PHOTONS, bounces=4, **view)


def adapting(scene):
    """The same with samples by noise."""
    options = ("--bounces", scene.bounces, "--adaptive", 0.2)
    return scene._replace(name=scene.name + "-adaptive", options=options)


def sheets(folder, count, name, color):
    """A stack of sheets with the alpha 0.3 over a floor, under a sky; scatterings without end."""
    meshes = [quads([(-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)], Material((0.6, 0.5, 0.3)))]
    heights = 0.3 + 0.1 * np.arange(count)
    corners = [(x, y, z) for y in heights for x, z in ((-1.5, 1.5), (1.5, 1.5), (1.5, -1.5), (-1.5, -1.5))]
    meshes.append(quads(corners, Material(color, alpha=0.3)))
    view = {"eye": (0, 4, 6), "target": (0, 0.8, 0), "fov": 40, "sky": 1.0, "bounces": 64}
    return write_scene(f"sheets-{count}-{name}", folder, meshes, **view)


def measure(scene, renderers, folder, size, samples):
    """Two seeds of each renderer: means, differences from rasray, and what of them is noise."""
    pictures, noise = {}, {}
    for side in renderers:
        files = [folder / f"{scene.name}-{side.name}-{seed}.exr" for seed in (1, 2)]
        first, second = (side.render(scene, file, size, samples, seed) for seed, file in enumerate(files, 1))
        pictures[side.name], noise[side.name] = (first + second) / 2, np.std((first - second) @ LUMINANCE / 2)
    ours = pictures["rasray"] @ LUMINANCE
    for name, picture in pictures.items():
        light = picture @ LUMINANCE
        mean, apart = light.mean(), np.sqrt(np.mean((light - ours) ** 2))
        cells = ["{:.4f} {:.4f} {:.4f}".format(*picture.mean((0, 1))), f"{(ours.mean() / mean - 1) * 100:+.2f} %"]
        cells += [f"{apart / mean:.4f}", f"{math.hypot(noise[name], noise['rasray']) / mean:.4f}", f"{light.min():.3f}"]
        row(scene.name, name, *cells)
    beside = np.concatenate(list(pictures.values()), axis=1) / max(np.quantile(ours, 0.95), 1.0)
    beside = mi.Bitmap(np.clip(beside, 0.0, 1.0).astype(np.float32))
    beside = beside.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True)
    beside.write(str(folder / f"{scene.name}.png"))


def variance(scene, renderers, folder, seeds):
    """Variance of a pixel's luminance at 16 samples over seeds, mean over the pixels, for every sampler."""
    for side in renderers:
        for sampler in side.samplers:
            runs = [side.render(scene, folder / "v.exr", 96, 16, seed, sampler) for seed in range(1, seeds + 1)]
            value = np.var(np.array(runs) @ LUMINANCE, axis=0, ddof=1).mean()
            row(scene.name, side.name, sampler, f"{value:.6f}")


def speed(scene, renderers, folder, size, samples):
    """Processor time of a picture of 4 bounces, the least of five in turn: of the whole process of rasray, also for one ray;
    of Mitsuba loading the scene, rendering and writing. Compiled kernels are in the driver's cache after the first."""
    scene, times = scene._replace(bounces=4), {}
    for side in renderers * 5:
        for pixels, count in ((size, samples), (1, 1)):
            begun = os.times()
            side.render(scene, folder / "s.exr", pixels, count, sampler=side.samplers[0])
            ended = os.times()
            of_children = isinstance(side, Rasray)
            fields = (2, 3) if of_children else (0, 1)
            times.setdefault((side.name, pixels), []).append(sum(ended[i] - begun[i] for i in fields))
    ours = min(times["rasray", size])
    for side in renderers:
        least = min(times[side.name, size])
        row(scene.name, side.name, f"{least:.2f} s", f"{min(times[side.name, 1]):.2f} s", f"{ours / least:.2f}")


def furnace(renderers, folder, kinds):
    """Share of a white sky that a white ball sends to the camera, mean over its disk but for the edge."""
    disk = np.hypot(*np.mgrid[-31.5:32, -31.5:32]) * math.tan(math.radians(10)) / 32 < 0.97 / math.sqrt(63)
    materials = {"metal": {"metallic": 1.0}, "dielectric": {}, "glass": {"glass": True}}
    for kind, fields in ((kind, fields) for kind, fields in materials.items() if kind in (kinds or materials)):
        for roughness in (0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0):
            white = ball((0, 0, 0), 1.0, Material(roughness=roughness, specular=1.0, **fields), 128)
            scene = write_scene("ball", folder, [white], eye=(0, 0, 8), target=(0, 0, 0), fov=20, sky=1.0, bounces=32)
            means = [(side.render(scene, folder / "b.exr", 64, 64) @ LUMINANCE)[disk].mean() for side in renderers]
            row(kind, roughness, *(f"{mean:.4f}" for mean in means))


def leaning(renderers, folder, _):
    """Share of a white sky that a white, dull square shows whose normals lean away from the camera; (1 + cos) / 2."""
    for lean, view in ((30, 0), (30, 45), (30, 70), (50, 0), (50, 45), (50, 70)):
        across, up = math.sin(math.radians(lean)), math.cos(math.radians(lean))
        normals = np.array([(-across, up, 0)] * 4, np.float32)
        square = quads([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)], Material())._replace(normals=normals)
        eye = (3 * math.sin(math.radians(view)), 3 * math.cos(math.radians(view)), 0.001)
        scene = write_scene("lean", folder, [square], eye=eye, target=(0, 0, 0), fov=2, sky=1.0, bounces=1)
        means = [(side.render(scene, folder / "l.exr", 8, 256) @ LUMINANCE).mean() for side in renderers]
        row(lean, view, f"{(1 + up) / 2:.4f}", *(f"{mean:.4f}" for mean in means))


def slabs(renderers, folder, _):
    """Share of the light behind a slab of glass that goes through, (1 - R) / (1 + R) after all reflections inside."""
    for angle in (0, 30, 45, 60, 75):
        cosine, within = math.cos(math.radians(angle)), math.sqrt(1.0 - (math.sin(math.radians(angle)) / 1.5) ** 2)
        polarised = [(a - b) / (a + b) for a, b in ((cosine, 1.5 * within), (1.5 * cosine, within))]
        reflected = (0.04 + 0.96 * (1.0 - cosine) ** 5, sum(share**2 for share in polarised) / 2)
        panel = [(-2, -2, -9), (2, -2, -9), (2, 2, -9), (-2, 2, -9)]
        meshes = [quads(panel, Material((0.0, 0.0, 0.0), emission=(1.0, 1.0, 1.0)))]
        clear = Material(roughness=0.0, specular=1.0, glass=True)
        meshes.append(slab((0, 0, 0), (3.0, 3.0, 0.05), math.radians(angle), clear))
        view = {"eye": (0, 0, 6), "target": (0, 0, 0), "fov": 1, "bounces": 8}
        scene = write_scene("slab", folder, meshes, options=TREES, **view)
        means = [(side.render(scene, folder / "s.exr", 8, 1024) @ LUMINANCE).mean() for side in renderers]
        row(angle, *(f"{value:.4f}" for value in [(1 - share) / (1 + share) for share in reflected] + means))


def plates(renderers, folder, _):
    """Share of a white sky that white brushed metal of roughness 0.2 sends on, seen under 60 degrees; 1."""
    uvs = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)
    for strength, way in ((strength, way) for strength in (0.3, 0.6, 1.0) for way in ("rougher", "smoother")):
        metal = Material(metallic=1.0, roughness=0.2, specular=1.0, anisotropy=strength)
        square = quads([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)], metal)._replace(uvs=uvs)
        eye = (2.6, 1.5, 0.001) if way == "rougher" else (0.001, 1.5, 2.6)
        scene = write_scene("plate", folder, [square], eye=eye, target=(0, 0, 0), fov=2, sky=1.0, bounces=1)
        means = [(side.render(scene, folder / "p.exr", 8, 1024) @ LUMINANCE).mean() for side in renderers]
        row(strength, f"along the {way} direction", *(f"{mean:.4f}" for mean in means))


def main():
    """Makes scenes and prints tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rasray", required=True, help="the command")
    parser.add_argument("--scenes", required=True, type=Path, help="folder of the real scenes")
    parser.add_argument("--output", type=Path, default=Path("comparison"), help="folder for pictures [%(default)s]")
    tables = "measure,variance,furnace,leaning,slabs,plates"
    parser.add_argument("--tables", default=tables, help="which to make, also speed [%(default)s]")
    parser.add_argument("--against", default="cycles,mitsuba", help="which renderers [%(default)s]")
    parser.add_argument("--only", help="names of scenes and kinds of balls, with commas between them [all]")
    parser.add_argument("--size", type=int, default=128, help="pixels along each side [%(default)s]")
    parser.add_argument("--samples", type=int, default=64, help="of the converged pictures [%(default)s]")
    parser.add_argument("--seeds", type=int, default=8, help="for the variance [%(default)s]")
    options = parser.parse_args()
    mi.set_variant("scalar_rgb")
    logging.disable(logging.INFO)
    # Blender prints to the descriptor: the tables alone go where it led.
    sys.stdout = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    folder = options.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    Rasray.command = options.rasray
    against = options.against.split(",")
    if "cycles" in against and bpy is None:
        parser.error("Cycles needs the package bpy; without it --against mitsuba")
    sides = [Rasray()] + [side() for side in (Cycles, Mitsuba) if side.__name__.lower() in against]
    print(f"Mitsuba {mi.__version__}", f"Blender {bpy.app.version_string}" if bpy else "no Blender", sep=", ")
    scenes = [cornell(folder), glass(folder), lamps(folder), lens(folder), tree(folder), brushed(folder)]
    scenes += [adapting(scene) for scene in scenes[:2]]
    scenes += [caustic(folder, focus) for focus in ("mirror", "glass")]
    colors = {"white": (0.8, 0.8, 0.8), "red": (0.8, 0.1, 0.1)}
    scenes += [sheets(folder, count, name, color) for name, color in colors.items() for count in (1, 5, 20)]
    for name, path, eye, target, fov, sky in (
        ("normals", "conformance/NormalTangentMirrorTest", (-0.65, 0, 1), (-0.65, 0, 0), 60, 1.0),
        ("normals-aslant", "conformance/NormalTangentMirrorTest", (1.4, 0, 1.3), (0.65, 0, 0), 60, 1.0),
        ("helmet", "pbr/DamagedHelmet", (1.8, 0.6, 2.4), (0, 0, 0), 40, 1.0),
        ("attenuation", "transmissive/AttenuationTest", (0, 0, 28), (0, 0, 0), 42, 0.5),
        ("emissive", "emissive/EmissiveStrengthTest", (0, 0, 16), (0, 0, 0), 45, 0.0),
    ):
        file = options.scenes.resolve() / path / (Path(path).name + ".glb")
        scenes.append(Scene(name, file, eye, target, fov, sky, 16))
    if "speed" in options.tables:
        scenes.append(spheres(folder))
    only = options.only.split(",") if options.only else []
    for scene in [item for item in scenes if not only or item.name in only]:
        able = [side for side in sides if scene.meshes or not isinstance(side, Mitsuba)]
        # Lenses and what is not paths alone are compared with Mitsuba only.
        is_plain = scene.aperture == 0.0 and not scene.options
        able = [side for side in able if is_plain or not isinstance(side, Cycles)]
        if "measure" in options.tables:
            measure(scene, able, folder, options.size, options.samples)
        if "speed" in options.tables:
            speed(scene, [side for side in able if not isinstance(side, Cycles)], folder, options.size, options.samples)
        if "variance" in options.tables:
            variance(scene, able, folder, options.seeds)
    for make in [make for make in (furnace, leaning, slabs, plates) if make.__name__ in options.tables]:
        make(sides, folder, only)


if __name__ == "__main__":
    main()
