"""Compiles the emitted Slang and runs the emitted WGSL of a folder, each by its own compiler.

    languages.py FOLDER

NAME.slang, a compute program whose entry is main, becomes NAME.comp, GLSL.  NAME.wgsl is run over NAME.in, as many floats as it
reads, by wgpu; its NAME.json says how many invocations and results there are, and NAME.out gets the results.  What a
compiler says of a mistake goes to NAME.said, and the exit code is 1.
"""

import ctypes
import json
import pathlib
import sys


class Slang:
    """The compiler's own library, which comes with slangpy, by its C interface."""

    glsl = 2
    compute = 6

    def __init__(self):
        import importlib.util

        home = pathlib.Path(importlib.util.find_spec("slangpy").origin).parent
        self.library = ctypes.CDLL(str(next(home.glob("libslang-compiler.so*"))))
        self.session = self.call("spCreateSession", ctypes.c_void_p, (ctypes.c_char_p, None))

    def call(self, name, result, *arguments):
        function = getattr(self.library, name)
        function.restype = result
        function.argtypes = [kind for kind, _ in arguments]
        return function(*[value for _, value in arguments])

    def compile(self, source):
        """GLSL of a program, and what the compiler said.  Its own SPIR-V leaves out the word precise."""
        pointer, integer, text = ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p
        request = (pointer, self.call("spCreateCompileRequest", pointer, (pointer, self.session)))
        self.call("spSetCodeGenTarget", None, request, (integer, self.glsl))
        unit = self.call("spAddTranslationUnit", integer, request, (integer, 1), (text, b"emitted"))
        self.call("spAddTranslationUnitSourceString", None, request, (integer, unit), (text, b"emitted.slang"), (text, source))
        entry = self.call("spAddEntryPoint", integer, request, (integer, unit), (text, b"main"), (integer, self.compute))
        failed = self.call("spCompile", integer, request)
        said = (self.call("spGetDiagnosticOutput", text, request) or b"").decode()
        if failed:
            return b"", said
        size = ctypes.c_size_t()
        code = self.call("spGetEntryPointCode", pointer, request, (integer, entry), (ctypes.POINTER(ctypes.c_size_t), ctypes.byref(size)))
        return ctypes.string_at(code, size.value), said


def run_wgsl(device, path):
    import wgpu

    shape = json.loads(path.with_suffix(".json").read_text())
    module = device.create_shader_module(code=path.read_text())
    size = shape["results"] * 4
    given = device.create_buffer_with_data(data=path.with_suffix(".in").read_bytes(), usage=wgpu.BufferUsage.STORAGE)
    made = device.create_buffer(size=size, usage=wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_SRC)
    pipeline = device.create_compute_pipeline(layout="auto", compute={"module": module, "entry_point": "main"})
    group = device.create_bind_group(
        layout=pipeline.get_bind_group_layout(0),
        entries=[{"binding": k, "resource": {"buffer": b, "offset": 0, "size": b.size}} for k, b in enumerate((given, made))],
    )
    encoder = device.create_command_encoder()
    work = encoder.begin_compute_pass()
    work.set_pipeline(pipeline)
    work.set_bind_group(0, group)
    work.dispatch_workgroups(shape["invocations"] // 64)
    work.end()
    device.queue.submit([encoder.finish()])
    path.with_suffix(".out").write_bytes(device.queue.read_buffer(made))


def main(folder):
    mistakes = 0
    slang = sorted(folder.glob("*.slang"))
    compiler = Slang() if slang else None
    for path in slang:
        code, said = compiler.compile(path.read_bytes())
        if not code:
            mistakes += 1
            path.with_suffix(".said").write_text(said)
        else:
            path.with_suffix(".comp").write_bytes(code)
    wgsl = sorted(folder.glob("*.wgsl"))
    if wgsl:
        import wgpu

        adapter = wgpu.gpu.request_adapter_sync()
        device = adapter.request_device_sync(required_features=["shader-f16"])
    for path in wgsl:
        try:
            run_wgsl(device, path)
        except Exception as problem:  # whatever its compiler raises
            mistakes += 1
            path.with_suffix(".said").write_text(str(problem))
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
