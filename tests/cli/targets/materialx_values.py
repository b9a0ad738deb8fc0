"""f of a MaterialX material [1/sr] at the direction pairs of a file, by the GLSL that MaterialX generates for it:
materialx_values.py MATERIAL.mtlx DIRECTIONS.txt

A line of DIRECTIONS is wi and wo, x y z each; a line of the answer is r g b.  The shader runs without a window (OpenGL by EGL),
with one directional light and an environment of intensity 0."""
import struct
import sys

import MaterialX as mx
import MaterialX.PyMaterialXGenGlsl as gen_glsl
import MaterialX.PyMaterialXGenShader as gen_shader
import moderngl


search = mx.getDefaultDataSearchPath()
library = mx.createDocument()
mx.loadLibraries(mx.getDefaultDataLibraryFolders(), search, library)


def validated(doc):
    doc.setDataLibrary(library)
    fine, message = doc.validate()
    if not fine:
        sys.exit("MaterialX finds fault: " + message)
    return doc


def document(path):
    doc = mx.createDocument()
    mx.readFromXmlFile(doc, path)
    return validated(doc)


def sources(doc, name=None, kind=gen_glsl.GlslShaderGenerator):
    """GLSL of a material, the first where none is named, for a vertex and a pixel."""
    generator = kind.create()
    context = gen_shader.GenContext(generator)
    context.registerSourceCodeSearchPath(search)
    options = context.getOptions()
    options.hwSpecularEnvironmentMethod = gen_shader.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_FIS
    options.hwMaxActiveLightSources = 1
    options.shaderInterfaceType = gen_shader.ShaderInterfaceType.SHADER_INTERFACE_REDUCED  # half the time to compile
    gen_shader.HwShaderGenerator.bindLightShader(library.getNodeDef("ND_directional_light"), 1, context)
    material = doc.getNode(name) if name else doc.getMaterialNodes()[0]
    shader = generator.generate("fit", material, context)
    return shader.getSourceCode(gen_shader.VERTEX_STAGE), shader.getSourceCode(gen_shader.PIXEL_STAGE)


def print_values(doc, directions, name=None):
    vertex, pixel = sources(doc, name)
    gl = moderngl.create_standalone_context(backend="egl")
    program = gl.program(vertex_shader=vertex, fragment_shader=pixel)

    def put(name, value):
        if name in program:
            program[name].value = value

    one = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    for name in ("u_worldMatrix", "u_viewProjectionMatrix", "u_worldInverseTransposeMatrix", "u_envMatrix"):
        put(name, one)
    put("u_numActiveLightSources", 1)
    put("u_lightData[0].type", 1)
    put("u_lightData[0].color", (1, 1, 1))
    put("u_lightData[0].intensity", 1)
    put("u_envLightIntensity", 0)
    put("u_envRadianceSamples", 1)
    put("u_envRadianceMips", 1)
    black = gl.texture((1, 1), 4, struct.pack("4f", 0, 0, 0, 1), dtype="f4")
    black.use(0)
    attributes = {"i_position": (0, 0, 0), "i_normal": (0, 0, 1), "i_tangent": (1, 0, 0), "i_bitangent": (0, 1, 0)}
    used = [name for name in attributes if name in program]
    point = gl.buffer(b"".join(struct.pack("3f", *attributes[name]) for name in used))
    drawn = gl.vertex_array(program, [(point, " ".join("3f" for _ in used), *used)])
    pixels = gl.framebuffer([gl.texture((1, 1), 4, dtype="f4")])
    pixels.use()
    for line in open(directions):
        x = [float(v) for v in line.split()]
        put("u_lightData[0].direction", tuple(-v for v in x[:3]))
        put("u_viewPosition", tuple(x[3:]))
        pixels.clear()
        drawn.render(moderngl.POINTS, vertices=1)
        r, g, b, _ = struct.unpack("4f", pixels.read(components=4, dtype="f4"))
        print(*(v / x[2] for v in (r, g, b)))


if __name__ == "__main__":
    print_values(document(sys.argv[1]), sys.argv[2])
