"""f of a glTF material [1/sr] at the direction pairs of a file, as MaterialX's glTF surface has it: gltf_values.py MATERIAL.gltf
DIRECTIONS.txt

That surface reads the same parameters under equations of its own: masking of both directions together and of a mean width, layers
by directional albedo, light between facets given back.  On smooth surfaces these are a few percent."""
import json
import sys

import MaterialX as mx

import materialx_values

material = json.load(open(sys.argv[1]))["materials"][0]
core, extensions = material["pbrMetallicRoughness"], material.get("extensions", {})
names = {
    "ior": "ior",
    "specularFactor": "specular",
    "specularColorFactor": "specular_color",
    "anisotropyStrength": "anisotropy_strength",
    "anisotropyRotation": "anisotropy_rotation",
    "clearcoatFactor": "clearcoat",
    "clearcoatRoughnessFactor": "clearcoat_roughness",
}
values = {"base_color": core["baseColorFactor"][:3], "metallic": core["metallicFactor"], "roughness": core["roughnessFactor"]}
for extension in extensions.values():
    values.update({names[key]: value for key, value in extension.items()})
doc = mx.createDocument()
node = doc.addNode("gltf_pbr", "shader", "surfaceshader")
for name, value in values.items():
    is_color = isinstance(value, list)
    node.setInputValue(name, ", ".join(map(str, value)) if is_color else str(value), "color3" if is_color else "float")
doc.addMaterialNode("fit", node)
materialx_values.print_values(materialx_values.validated(doc), sys.argv[2])
