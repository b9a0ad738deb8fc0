"""Compares models on a table, judged by angles that no fit had seen: compare_models.py [FILE MODEL…]"""

import sys

import gonio

if len(sys.argv) > 2:
    table, models = gonio.read(sys.argv[1]), sys.argv[2:]
else:
    wax = "lambert+gtr/smith_ggx.correlated/schlick"
    table = gonio.synth(wax, "hemisphere", noise=0.02, alpha=0.2, gamma=1.3, f0=0.05, kd=0.3)
    models = ["lambert+ggx/smith_ggx.correlated/schlick", wax]

choice = gonio.fit(table, models=models)
print("take   ", choice["recommended"])
print("because", choice["reason"])
print(f"{'unseen':>8} {'ns':>6}  model")
for row in choice["models"]:
    unseen = "–" if row["cv_log_rms"] is None else f"{row['cv_log_rms']:.4f}"
    print(f"{unseen:>8} {row['ns'] or 0:>6.1f}  {row['model']}")
