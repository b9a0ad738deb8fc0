"""Plots a table and its fit in the plane of incidence: plot_with_matplotlib.py [PICTURE]"""

import sys

import gonio
import matplotlib
import numpy as np

matplotlib.use("Agg")  # into a file, where there is no screen
import matplotlib.pyplot as plt

MODEL = "lambert+ggx/smith_ggx.correlated/schlick"
table = gonio.synth(MODEL, "in_plane", noise=0.05, alpha=0.15, f0=0.05, kd=0.2)
fit = gonio.fit(table, MODEL)

# The mirror's side is that of phi_o = phi_i + 180.
side = np.where(np.cos(np.radians(table.phi_o - table.phi_i)) < 0, 1, -1)
figure, axes = plt.subplots(figsize=(8, 4.5))
for theta_i in np.unique(table.theta_i):
    one = table.theta_i == theta_i
    at = np.linspace(-85, 85, 341)
    (line,) = axes.semilogy(at, gonio.eval(fit, theta_i, 0, np.abs(at), np.where(at > 0, 180, 0))[:, 0])
    axes.semilogy((side * table.theta_o)[one], table[table.channels[0]][one], ".", color=line.get_color(), markersize=3, label=f"{theta_i:g}°")
axes.set_xlabel("θ_o [degrees], the mirror's side to the right")
axes.set_ylabel("f [1/sr]")
axes.legend(title="θ_i")
figure.tight_layout()
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1])
