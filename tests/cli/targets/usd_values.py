"""f of a UsdPreviewSurface [1/sr] at the direction pairs of a file, as materialx_values.py has it of MaterialX's graph of that
surface: usd_values.py MATERIAL.usda DIRECTIONS.txt

Before that USD's validators look at the stage, and inputs are held against the shader's definition and the ranges of its
specification, which they do not look at."""
import sys

import MaterialX as mx
from pxr import Sdr, Usd, UsdShade, UsdValidation

import materialx_values

stage = Usd.Stage.Open(sys.argv[1])
found = [e.GetErrorAsString() for e in
         UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators()).Validate(stage)]

shaders = [UsdShade.Shader(p) for p in stage.Traverse() if p.IsA(UsdShade.Shader)]
textures = {"UsdUVTexture", "UsdPrimvarReader_float2"}  # of a map
ranges = {"ior": (0, 20), "displacement": (-1e9, 1e9), "normal": (-1, 1), "emissiveColor": (0, 1e9)}  # others [0, 1]
doc = mx.createDocument()
node = doc.addNode("UsdPreviewSurface", "shader", "surfaceshader")
for shader in shaders:
    identifier = shader.GetIdAttr().Get()
    if identifier != "UsdPreviewSurface" and identifier not in textures:
        found.append("a shader that is no UsdPreviewSurface: %s" % shader.GetPath())
        continue
    definition = Sdr.Registry().GetShaderNodeByIdentifier(identifier)
    for one in shader.GetInputs():
        name, value = one.GetBaseName(), one.Get()
        if name not in definition.GetShaderInputNames():
            found.append("an input that %s has not: %s" % (identifier, name))
            continue
        kind = definition.GetShaderInput(name).GetTypeAsSdfType().GetSdfType()
        if one.GetTypeName() != kind:
            found.append("%s is a %s, and a %s in the definition" % (name, one.GetTypeName(), kind))
        if one.HasConnectedSource() or identifier in textures:
            continue
        numbers = list(value) if hasattr(value, "__len__") else [value]
        low, high = ranges.get(name, (0, 1))
        if not all(low <= x <= high for x in numbers):
            found.append("%s = %s is outside [%s, %s]" % (name, numbers, low, high))
        text = ", ".join(str(x) for x in numbers)
        node.setInputValue(name, text, {1: "float", 3: "color3"}[len(numbers)] if name != "useSpecularWorkflow" else "integer")
if not shaders:
    found.append("no shader")
if found:
    sys.exit("\n".join(found))

material = doc.addMaterialNode("fit", node)
materialx_values.print_values(materialx_values.validated(doc), sys.argv[2])
