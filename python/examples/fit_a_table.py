"""Fits a table and says how far to trust the result: fit_a_table.py [FILE]

Without a file it fits a table of its own, as an instrument with two percent of noise would have measured it.
"""

import sys

import gonio

MODEL = "lambert+ggx/smith_ggx.correlated/schlick"

if len(sys.argv) > 1:
    table = gonio.read(sys.argv[1])
else:
    table = gonio.synth(MODEL, "hemisphere", noise=0.02, alpha=0.15, f0=0.05, kd=(0.2, 0.1, 0.05))

fit = gonio.fit(table, MODEL)
print(table)
for name, p in fit["parameters"].items():
    values = p["value"] if isinstance(p["value"], list) else [p["value"]]
    errors = p["std_error"] if isinstance(p["std_error"], list) else [p["std_error"]]
    for value, error in zip(values, errors):
        known = "not known" if value is None else f"{value:.4g}" + ("" if error is None else f" ± {error:.2g}")
        print(f"{name:<10} {known}")
print(f"log RMS    {fit['residuals']['log_rms']:.3g}")
for warning in fit["warnings"]:
    print("beware    ", warning)
