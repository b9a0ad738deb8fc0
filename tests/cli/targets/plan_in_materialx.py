"""A planned material beside the same with all effects, in MaterialX's own GLSL: plan_in_materialx.py PLAN.mtlx NAME
DIRECTIONS.txt

Instructions of both as optimised SPIR-V on the first line, planned first; then per line of DIRECTIONS r g b of f [1/sr] of both."""
import io
import subprocess
import sys
import tempfile
from contextlib import redirect_stdout
from pathlib import Path

import MaterialX.PyMaterialXGenGlsl as gen_glsl

import materialx_values as values


def instructions(doc, name):
    _, pixel = values.sources(doc, name, gen_glsl.VkShaderGenerator)
    with tempfile.TemporaryDirectory() as at:
        source, made = Path(at, "it.frag"), str(Path(at, "it.spv"))
        source.write_text(pixel)
        subprocess.run(["glslangValidator", "-V", "--quiet", str(source), "-o", made], check=True, stdout=sys.stderr)
        subprocess.run(["spirv-opt", "-O", made, "-o", made], check=True)
        return len(subprocess.run(["spirv-dis", "--raw-id", "--no-header", made], check=True, stdout=subprocess.PIPE).stdout.splitlines())


def of(doc, name, directions):
    said = io.StringIO()
    with redirect_stdout(said):
        values.print_values(doc, directions, name)
    return said.getvalue().splitlines()


document = values.document(sys.argv[1])
names = sys.argv[2], sys.argv[2] + "_exact"
print(*(instructions(document, name) for name in names))
for pair in zip(*(of(document, name, sys.argv[3]) for name in names)):
    print(*pair)
