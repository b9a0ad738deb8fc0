"""f of a glTF material [1/sr] in Blender: as its importer reads it into a Principled node, and Cycles renders that.

    blender_values.py MATERIAL.gltf ANSWER

A line of the answer is wi and wo, x y z each in the frame of the surface, then r g b.  Facets of all tilts, a pixel each, are seen along one axis and lit
by one sun after another; nothing else sheds light."""
import base64
import json
import math
import os
import struct
import sys
import tempfile

import bpy
from mathutils import Vector

SIDE, SUNS = 8, 18  # facets along a picture's side, pictures
GOLDEN = math.pi * (3 - math.sqrt(5))


def direction(theta_deg, phi):
    theta = math.radians(theta_deg)
    return Vector((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)))


def facets():
    """Middle of each facet, and its frame: tangent, bitangent, normal."""
    for k in range(SIDE * SIDE):
        n = direction(65 * (k + 0.5) / SIDE**2, GOLDEN * k)
        t = (Vector((1, 0, 0)) - n * n.x).normalized()
        yield Vector((k % SIDE + 0.5, k // SIDE + 0.5, 0)), (t, n.cross(t), n)


def with_facets(document):
    """The material on facets.  Up is z for Blender and y in glTF."""
    position, normal, uv, index = [], [], [], []
    for k, (middle, (t, b, n)) in enumerate(facets()):
        for x, y in (-0.4, -0.4), (0.4, -0.4), (0.4, 0.4), (-0.4, 0.4):
            at = middle + x * t + y * b
            position += at.x, at.z, -at.y
            normal += n.x, n.z, -n.y
            uv += x + 0.5, 0.5 - y
        index += (4 * k + corner for corner in (0, 1, 2, 0, 2, 3))
    parts = [struct.pack(f"<{len(p)}f", *p) for p in (position, normal, uv)] + [struct.pack(f"<{len(index)}H", *index)]
    data = b"".join(parts)
    document["buffers"] = [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]
    document["bufferViews"] = [
        {"buffer": 0, "byteOffset": sum(map(len, parts[:k])), "byteLength": len(part)} for k, part in enumerate(parts)]
    corners = len(position) // 3
    document["accessors"] = [
        {"bufferView": k, "componentType": 5126, "count": corners, "type": kind} for k, kind in enumerate(("VEC3", "VEC3", "VEC2"))]
    document["accessors"].append({"bufferView": 3, "componentType": 5123, "count": len(index), "type": "SCALAR"})
    document["accessors"][0].update(min=[-1, -1, -SIDE - 1], max=[SIDE + 1, 1, 1])
    document["meshes"] = [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}]
    document["nodes"], document["scenes"], document["scene"] = [{"mesh": 0}], [{"nodes": [0]}], 0
    return document


def added(data, **values):
    thing = bpy.data.objects.new("it", data)
    for name, value in values.items():
        setattr(thing, name, value)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def prepare(path):
    """Scene of the file under one sun, which is returned."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    scene = bpy.context.scene
    for thing in scene.objects:
        thing.visible_shadow = False
    scene.world = None  # a black one is drawn from like a lamp
    scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
    scene.cycles.samples, scene.cycles.max_bounces = 1, 0  # of the middle of a pixel
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.resolution_percentage = 100
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    camera = bpy.data.cameras.new("camera")
    camera.type, camera.ortho_scale = "ORTHO", SIDE
    scene.camera = added(camera, location=(SIDE / 2, SIDE / 2, 10))
    light = bpy.data.lights.new("sun", "SUN")
    light.energy, light.angle = 1, 0
    return added(light)


def picture(path):
    bpy.context.scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path)
    pixels = list(image.pixels)
    bpy.data.images.remove(image)
    return [pixels[k:k + 3] for k in range(0, len(pixels), 4)]


def main(material, answer, folder):
    path = os.path.join(folder, "facets.gltf")
    with open(material) as given, open(path, "w") as made:
        json.dump(with_facets(json.load(given)), made)
    sun = prepare(path)
    seen = Vector((0, 0, 1))
    with open(answer, "w") as out:
        for k in range(SUNS):
            to = direction(80 * (k + 0.5) / SUNS, GOLDEN * k + 0.5)
            sun.rotation_euler = to.to_track_quat("Z", "Y").to_euler()
            for color, (_, frame) in zip(picture(os.path.join(folder, "seen.exr")), facets()):
                wi, wo = ([w.dot(axis) for axis in frame] for w in (to, seen))
                if wi[2] > 0.05:
                    print(*wi, *wo, *(x / wi[2] for x in color), file=out)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as at:
        main(sys.argv[1], sys.argv[2], at)
