"""RGL files of gonio convert and synth in Mitsuba 3, which renders them as `measured`.

rgl_in_mitsuba.py GONIO [--long]   exit 0: all holds, 1: it does not

f at 4,096 samples of the table that a file was made from: none is further off than the largest difference that gonio printed, and no
more than 1 in 70 further than what it printed for 99 of 100.  Mitsuba's draws follow the density that it tells (chi square, |z| < 4),
their weights are f cos over that density, and hardly vary, so that the file is drawn as it reflects.  Of spectra in place of r, g, b the
pure bands are the channels.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

SAMPLES, DRAWS = 4096, 20_000
ROWS, COLUMNS, PARTS = 16, 32, 12  # cells of cos θ × φ, and parts of each along both for its integral
failed = False


def expect(holds, words):
    global failed
    failed |= not holds
    print(("" if holds else "FAILED: ") + words, flush=True)


def direction(theta, phi):
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)


def surface(wi, wavelengths=None):
    si = mi.SurfaceInteraction3f()
    si.wi = mi.Vector3f(*wi)
    if wavelengths is not None:
        si.wavelengths = wavelengths
    return si


def measured(path, variant):
    mi.set_variant(variant)
    return mi.load_dict({"type": "measured", "filename": str(path)}), mi.BSDFContext()


def reflected(bsdf, wi, wo, wavelengths=None):
    """f of the channels, from what Mitsuba returns with the cosine."""
    b, context = bsdf
    return np.array(b.eval(context, surface(wi, wavelengths), mi.Vector3f(*wo))).ravel() / wo[2]


def compare_values(bsdf, table, printed):
    rows = np.genfromtxt(table, delimiter=",", skip_header=1, comments="#")
    wi, wo = (direction(*np.radians(rows[:, k:k + 2]).T) for k in (0, 2))
    up = np.flatnonzero(np.minimum(wi[:, 2], wo[:, 2]) >= 0.01)
    picked = np.random.default_rng(1).choice(up, min(SAMPLES, len(up)), replace=False)
    channels = rows.shape[1] - 4
    off = []
    for i in picked:
        f, known = reflected(bsdf, wi[i], wo[i])[:channels], rows[i, 4:]
        off.append(2 * np.abs(f - known) / (np.abs(f) + np.abs(known)))
    off = np.array(off)
    beyond = np.mean(off > printed["within_99_percent"] + 1e-4)
    expect(off.max() <= printed["largest"] + 1e-4 and beyond < 1 / 70,
           f"  f at {len(picked)} samples: {100 * off.max():.3g} % off at most (printed {100 * printed['largest']:.3g} %), "
           f"{100 * beyond:.2f} % of values beyond {100 * printed['within_99_percent']:.3g} %")


def look_at_draws(bsdf, theta_deg, most_spread):
    b, context = bsdf
    random = np.random.default_rng(theta_deg)
    wi = direction(np.radians(theta_deg), 0.3)
    si = surface(wi)
    counts, weights = np.zeros((ROWS, COLUMNS)), np.zeros(DRAWS)
    for i in range(DRAWS):
        sample, weight = b.sample(context, si, 0.5, mi.Point2f(*random.uniform(size=2)))
        x, y, z = np.array(sample.wo).ravel()
        if z > 0:
            weights[i] = np.array(weight).ravel()[1]
            counts[min(int(z * ROWS), ROWS - 1), int(np.arctan2(y, x) / (2 * np.pi) % 1 * COLUMNS) % COLUMNS] += 1
    expected, albedo = np.zeros((ROWS, COLUMNS)), 0
    z, phi = ((np.arange(n * PARTS) + 0.5) / (n * PARTS) for n in (ROWS, COLUMNS))
    area = 2 * np.pi / (ROWS * COLUMNS * PARTS**2)
    for j, c in enumerate(z):
        for k, angle in enumerate(2 * np.pi * phi):
            wo = mi.Vector3f(np.sqrt(1 - c * c) * np.cos(angle), np.sqrt(1 - c * c) * np.sin(angle), c)
            density = b.pdf(context, si, wo)
            expected[j // PARTS, k // PARTS] += density * area
            albedo += b.eval(context, si, wo)[1] * area
    cells = expected * DRAWS > 5
    chi = np.sum((counts - expected * DRAWS)[cells] ** 2 / (expected * DRAWS)[cells])
    n = cells.sum()
    z = ((chi / n) ** (1 / 3) - 1 + 2 / (9 * n)) / np.sqrt(2 / (9 * n))  # Wilson and Hilferty
    spread = weights.std() / weights.mean()
    expect(z < 4 and abs(expected.sum() - 1) < 0.005 and abs(weights.mean() / albedo - 1) < 0.005 and spread < most_spread,
           f"  draws from {theta_deg}°: chi square {chi:.0f} of {n} cells (z {z:+.1f}), density adds up to {expected.sum():.4f}, "
           f"weights {weights.mean():.4f} ± {weights.std():.4f} beside an albedo of {albedo:.4f}")


def look_at_spectra(folder, run, source):
    rgb = measured(folder / "a.bsdf", "scalar_rgb")
    wi, wo = direction(0.6, 0.2), direction(0.9, 2.5)
    known = reflected(rgb, wi, wo)[[2, 1, 0, 0]]
    run("convert", source, "spectra.bsdf", "--spectral")
    found = reflected(measured(folder / "spectra.bsdf", "scalar_spectral"), wi, wo, [460, 530, 640, 700])
    expect(np.allclose(found, known, rtol=1e-4), f"  as spectra: {found} at 460, 530, 640 and 700 nm, {known} of r, g, b")


def main(gonio, long):
    paint = ["lambert+ggx/smith_ggx.correlated/schlick", "--set", "alpha=0.25", "f0=0.05", "kd=0.2,0.1,0.05"]
    metal = ["ggx/smith_ggx.correlated/schlick", "--set", "alpha=0.12", "f0=0.9,0.6,0.3"]
    cases = {"a paint, from MBSDF": (paint, "mbsdf", "a.mbsdf", [30, 70], [])}
    if long:
        cases |= {"a metal, from MERL": (metal, "merl", "a.binary", [5, 45, 75], []),
                  "a paint, from a list": (paint, "hemisphere", "list.csv", [20, 60], ["--reach", "15"])}
    for name, (model, layout, file, angles, options) in cases.items():
        with tempfile.TemporaryDirectory() as at:
            folder = Path(at)

            def run(*words):
                return subprocess.run([gonio, *words], cwd=folder, check=True, stdout=subprocess.PIPE).stdout

            print(name, flush=True)
            run("synth", *model, "--layout", layout, "--quiet", "-o", file)
            printed = json.loads(run("convert", file, "a.bsdf", *options, "--json"))["there_and_back"]
            if layout == "hemisphere":
                (folder / "a.csv").write_text((folder / file).read_text())
            else:
                run("convert", file, "a.csv", "--quiet")
            bsdf = measured(folder / "a.bsdf", "scalar_rgb")
            compare_values(bsdf, folder / "a.csv", printed)
            for theta_deg in angles:
                look_at_draws(bsdf, theta_deg, 0.1)
            if layout == "mbsdf":
                look_at_spectra(folder, run, file)
    print("FAILED" if failed else "passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(str(Path(sys.argv[1]).resolve()), "--long" in sys.argv))
