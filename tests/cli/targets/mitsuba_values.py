"""f of a Mitsuba material [1/sr] at the direction pairs of a file: mitsuba_values.py MATERIAL.xml DIRECTIONS.txt

A line of DIRECTIONS is wi and wo, x y z each; a line of the answer is r g b."""
import sys

import mitsuba as mi

mi.set_variant("scalar_rgb")
bsdf = mi.load_file(sys.argv[1])
context = mi.BSDFContext()
at = mi.SurfaceInteraction3f()
at.n = [0, 0, 1]
at.sh_frame = mi.Frame3f([0, 0, 1])
for line in open(sys.argv[2]):
    x = [float(v) for v in line.split()]
    at.wi = mi.ScalarVector3f(x[3:])  # Mitsuba's is the viewer's
    f = bsdf.eval(context, at, mi.ScalarVector3f(x[:3]))
    print(*(float(v) / x[2] for v in f))
