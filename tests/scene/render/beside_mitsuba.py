"""Pictures of gonio render beside Mitsuba 3's, pixel by pixel.

beside_mitsuba.py GONIO   exit 0: they agree, 1: they do not

Where models coincide, the difference of two pictures is noise: of the pixels of all pictures, |z| > 3.5 in luminance in at most
1/1000 (0.5/1000 are expected), of those of each in at most 2/1000.  Mitsuba tells the variance of its samples itself; gonio's
is that of pictures from many seeds.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")

SIZE, FOV = 128, 28
SEEDS, SAMPLES = 192, 4  # gonio's pictures, and the samples of each
MOST, MOST_OF_ONE = 1e-3, 2e-3  # share of pixels beyond 3.5: of all pictures, and of each

GOLD = {"eta": [0.18, 0.42, 1.37], "k": [3.42, 2.35, 1.77]}
SUN = {"direction": [0.5, 0.7, 1], "irradiance": [3, 2, 1]}
PANEL = {"center": [-2, 2, 3], "u": [0.5, 0, 0.5], "v": [0.3, -0.6, -0.3], "radiance": [20, 16, 12]}


def sky(d):
    """Radiance from a direction: bright above, and towards +x, where a patch glows."""
    x, y, z = d
    patch = 6 * np.exp(-8 * ((x - 0.8) ** 2 + y**2 + (z - 0.6) ** 2))
    return np.stack([0.3 + patch, 0.3 + 0.2 * y, 0.4 + 0.2 * y + 0.1 * z], -1)


def directions(width, height, at_poles):
    """Directions of a map's texels in gonio's way; rows of Mitsuba's map reach from pole to pole."""
    i, j = np.meshgrid(np.arange(width) + 0.5, np.arange(height))
    theta = np.pi * (j / (height - 1) if at_poles else (j + 0.5) / height)
    phi = np.pi * (1 - 2 * i / width)  # from the map's middle, +z, towards +x at its left
    return np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)


def write_map(path, at_poles):
    mi.Bitmap(sky(directions(512, 256, at_poles)).astype(np.float32)).write(str(path))


def gonio_scene(lights, diffuse, alpha, folder):
    spec = "ggx/smith_ggx.correlated/conductor"
    parameters = {"alpha": alpha, **GOLD}
    if diffuse:
        spec, parameters["kd"] = "lambert+" + spec, diffuse
    listed = []
    for kind, value in lights:
        if kind == "environment":
            write_map(folder / "sky.exr", False)
            value = {"path": "sky.exr"}
        if kind == "constant":
            mi.Bitmap(np.full((1, 2, 3), value, np.float32)).write(str(folder / "even.exr"))
            kind, value = "environment", {"path": "even.exr"}
        listed.append({"type": kind, **value})
    return {
        "schema": "gonio.scene/1",
        "materials": {"m": {"model": spec, "parameters": parameters}},
        "objects": [{"shape": "sphere", "material": "m"}],
        "lights": listed,
        "view": {"position": [0, 0, 5], "target": [0, 0, 0], "fov_deg": FOV},
        "tolerance": {"metric": "delta_e_2000", "quantile": 0.9, "limit": 5, "max": 100, "confidence": 0.9},
    }


def gonio_pictures(gonio, lights, diffuse, alpha):
    """Mean of the planned pictures in XYZ, and its variance: masking separable, one bounce, all else exact."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def run(*words):
            subprocess.run([gonio, *words], cwd=folder, check=True, stdout=subprocess.DEVNULL)

        (folder / "scene.json").write_text(json.dumps(gonio_scene(lights, diffuse, alpha, folder)))
        run("plan", "scene.json", "--samples", "512", "--cost", "operations", "--quiet", "-o", "plan.json")
        plan = json.loads((folder / "plan.json").read_text())
        chosen = {"fresnel": "exact", "masking": "separable", "compensation": "none", "precision": "double",
                  "diffuse": "lambert" if diffuse else "none"}
        material = plan["materials"]["m"]
        for effect in material["effects"]:
            effect["form"] = chosen.get(effect["effect"], effect["form"])
            effect["keep"] = effect["form"] not in ("none", "off", "ggx", "float")
        material["spec"] = ("lambert+" if diffuse else "") + "ggx/smith_ggx.separable/conductor"
        (folder / "plan.json").write_text(json.dumps(plan))
        pictures = []
        for seed in range(SEEDS):
            run("render", "scene.json", "--plan", "plan.json", "--width", str(SIZE), "--height", str(SIZE),
                "--samples", str(SAMPLES), "--seed", str(seed), "--quiet", "-o", "a.exr")
            layers = dict(mi.Bitmap(str(folder / "a.exr")).split())
            pictures.append(np.array(layers["planned"], dtype=np.float64))
        pictures = np.array(pictures) @ to_xyz()
        return pictures.mean(0), pictures.var(0, ddof=1) / SEEDS


def to_xyz():
    return np.array([mi.srgb_to_xyz(mi.Color3f(*c)) for c in np.eye(3)])


def mitsuba_picture(lights, diffuse, alpha, samples):
    """Mean of the samples of a picture in XYZ, and its variance."""
    def rgb(value):
        return {"type": "rgb", "value": value}

    def unbounded(value):
        return {"type": "srgb", "color": value, "unbounded": True}

    metal = {"type": "roughconductor", "distribution": "ggx", "alpha": alpha,
             "eta": unbounded(GOLD["eta"]), "k": unbounded(GOLD["k"])}
    if diffuse:  # the blend's halves are doubled
        metal["specular_reflectance"] = 2.0
        metal = {"type": "blendbsdf", "weight": 0.5, "metal_0": {"type": "diffuse", "reflectance": rgb([2 * v for v in diffuse])},
                 "metal_1": metal}
    scene = {
        "type": "scene",
        # A blend tells the density of the part that it drew alone, which is wrong beside light drawn from emitters.
        "integrator": {"type": "moment",
                       "direct": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0 if diffuse else 1}},
        "sphere": {"type": "sphere", "bsdf": metal},
        "sensor": {
            "type": "perspective", "fov": FOV, "fov_axis": "y",
            "to_world": mi.ScalarTransform4f().look_at([0, 0, 5], [0, 0, 0], [0, 1, 0]),
            "film": {"type": "hdrfilm", "width": SIZE, "height": SIZE, "rfilter": {"type": "box"},
                     "component_format": "float32"},
            "sampler": {"type": "independent", "sample_count": samples},
        },
    }
    for kind, value in lights:
        if kind == "directional":
            d = np.array(value["direction"], float)
            light = {"type": "directional", "direction": list(-d / np.linalg.norm(d)), "irradiance": rgb(value["irradiance"])}
        elif kind == "rectangle":
            c, u, v = (np.array(value[key], float) for key in ("center", "u", "v"))
            n = np.cross(u, v)
            to_world = np.eye(4)
            to_world[:3, :] = np.stack([u, v, n / np.linalg.norm(n), c], -1)
            light = {"type": "rectangle", "to_world": mi.ScalarTransform4f(to_world),
                     "emitter": {"type": "area", "radiance": rgb(value["radiance"])}}
        elif kind == "constant":
            light = {"type": "constant", "radiance": rgb(value)}
        else:
            with tempfile.TemporaryDirectory() as name:
                write_map(Path(name) / "sky.exr", True)
                light = {"type": "envmap", "bitmap": mi.Bitmap(name + "/sky.exr")}
        scene[kind] = light
    picture = np.array(mi.render(mi.load_dict(scene)), dtype=np.float64)
    mean, square = picture[..., -6:-3], picture[..., -3:]  # in XYZ, after the picture itself
    return mean, np.maximum(square - mean**2, 0) / samples


def covered():
    """True of pixels that the sphere fills: behind it the two read maps differently, by texels and between them."""
    edge = (np.arange(SIZE + 1) / SIZE * 2 - 1) * np.tan(np.radians(FOV / 2))
    squares = edge[:, None] ** 2 + edge[None, :] ** 2  # tan² of the angle from the middle
    inside = squares / (1 + squares) < 1 / 25
    return inside[1:, 1:] & inside[1:, :-1] & inside[:-1, 1:] & inside[:-1, :-1]


def compare(a, b):
    """|z| of the luminance of each pixel that the sphere fills, and the mean difference, relative."""
    (x, vx), (y, vy) = [(mean[covered(), 1], variance[covered(), 1]) for mean, variance in (a, b)]
    noise = np.sqrt(vx + vy)
    return np.abs(x - y) / np.where(noise > 0, noise, 1), np.sum(x - y) / np.sum(y)


def main(gonio):
    cases = {
        "a metal in the sun": ([("directional", SUN)], None, 0.2),
        "a metal under a panel": ([("rectangle", PANEL)], None, 0.3),
        "a metal in an even sky": ([("constant", [1, 0.8, 0.6])], None, 0.5),
        "a metal in a sky": ([("environment", None)], None, 0.3),
        "a metal on a diffuse ground, in the sun": ([("directional", SUN)], [0.3, 0.1, 0.05], 0.3),
        "a metal on a diffuse ground, in a sky": ([("environment", None)], [0.3, 0.1, 0.05], 0.3),
    }
    every, failed = [], False
    for name, (lights, diffuse, alpha) in cases.items():
        z, difference = compare(gonio_pictures(gonio, lights, diffuse, alpha),
                                mitsuba_picture(lights, diffuse, alpha, SEEDS * SAMPLES))
        every.append(z)
        off = np.mean(z > 3.5)
        failed |= off > MOST_OF_ONE
        print(f"{name}: |z| > 3.5 in {100 * off:.3f} % of {z.size} pixels, {z.max():.1f} at most; on average {100 * difference:+.3f} %",
              flush=True)
    off = np.mean(np.concatenate(every) > 3.5)
    failed |= off > MOST
    print(f"{'FAILED' if failed else 'passed'}: |z| > 3.5 in {100 * off:.3f} % of all pixels")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(str(Path(sys.argv[1]).resolve())))
