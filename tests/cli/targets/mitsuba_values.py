"""f of a Mitsuba material [1/sr] at the direction pairs of a file: mitsuba_values.py MATERIAL.xml DIRECTIONS.txt [VARIANT [X Y]]

With X and Y the file is a scene, and the material that of the surface below that place.
A line of DIRECTIONS is wi and wo, x y z each; a line of the answer is r g b.  Of spectral variants f by wavelength becomes linear sRGB under
D65, white being 1, 1, 1."""
import sys

import mitsuba as mi
import numpy as np

mi.set_variant(sys.argv[3] if len(sys.argv) > 3 else "scalar_rgb")
loaded = mi.load_file(sys.argv[1])
context = mi.BSDFContext()
if len(sys.argv) > 4:
    at = loaded.ray_intersect(mi.Ray3f([float(sys.argv[4]), float(sys.argv[5]), 1], [0, 0, -1]))
    bsdf = at.bsdf()
else:
    bsdf = loaded
    at = mi.SurfaceInteraction3f()
    at.n = [0, 0, 1]
    at.sh_frame = mi.Frame3f([0, 0, 1])
spectral = "spectral" in mi.variant()
if spectral:
    nm = np.linspace(362, 828, 120).reshape(-1, 4)
    to_srgb = np.array([[3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556], [0.055648, -0.204043, 1.057311]])
    weight = np.array([np.array(mi.cie1931_xyz(float(x))).ravel() * float(mi.cie_d65(float(x))) for x in nm.ravel()]) @ to_srgb.T
    weight /= weight.sum(0)


def value(wo):
    if not spectral:
        return list(bsdf.eval(context, at, wo))
    f = []
    for four in nm:
        at.wavelengths = [float(x) for x in four]
        f += list(bsdf.eval(context, at, wo))
    return np.array(f, dtype=float) @ weight


for line in open(sys.argv[2]):
    x = [float(v) for v in line.split()]
    at.wi = mi.ScalarVector3f(x[3:])  # Mitsuba's is the viewer's
    print(*(float(v) / x[2] for v in value(mi.ScalarVector3f(x[:3]))))
