"""Makes the picture of the explorer that the README shows.

    explore_picture.py GONIO PICTURE.png

The table is synthetic and called so: a long-tailed lobe, which GGX misses and GTR meets.  The page has both fits, and says what GGX lacks.
"""

import pathlib
import subprocess
import sys
import tempfile

from devtools import Browser

gonio, picture = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
truth = "lambert+gtr/smith_ggx.correlated/schlick --set alpha=0.06 gamma=1.3 f0=0.06 kd=0.22,0.06,0.03 --layout merl --noise 0.02"

with tempfile.TemporaryDirectory() as folder, Browser(1400, 1180) as page:
    def run(words):
        subprocess.run([gonio, *words.split(), "--quiet"], cwd=folder, check=True, stdout=subprocess.DEVNULL)

    run(f"synth {truth} -o synthetic.binary")
    run("fit synthetic.binary -o ggx.json")
    run("fit synthetic.binary --model lambert+gtr/smith_ggx.correlated/schlick -o gtr.json")
    run("explore synthetic.binary ggx.json gtr.json -o page.html")
    page.open(f"file://{folder}/page.html", "typeof kept === 'string' && document.querySelector('#facts p') && dirty.waiting === 0")
    page.ask("document.querySelector('.terms').open = false; view.light = [0.3, 0.4, 0.86]; dirty.light = true; redraw()")
    page.wait("document.querySelector('#measured .dots') && dirty.waiting === 0 && !dirty.all")
    page.screenshot(picture)
