# Sourced by ./quickstart and ./check: installs what the build needs and this machine lacks.
# On Debian and its relatives by apt, with sudo when not root, asking nothing; elsewhere it names it.

gonio_tools=(g++:g++ cmake:cmake ninja:ninja-build ccache:ccache
  pkg-config:pkg-config)  # command:package
gonio_libraries=(libceres-dev libeigen3-dev libopenexr-dev libtbb-dev libfmt-dev
  nlohmann-json3-dev libcli11-dev libxsimd-dev libgtest-dev
  librapidcheck-dev libboost-dev nettle-dev libpugixml-dev libembree-dev libpng-dev libtiff-dev
  glslang-dev spirv-tools spirv-headers)

install_missing() {
  local missing=() entry
  for entry in "${gonio_tools[@]}"; do
    command -v "${entry%%:*}" >/dev/null || missing+=("${entry##*:}")
  done
  if ! command -v apt-get >/dev/null; then
    echo "Needed: ${gonio_tools[*]%%:*}, and the libraries Ceres, Eigen 3, OpenEXR 3, oneTBB, Nettle, pugixml, fmt," \
      "nlohmann-json, CLI11, xsimd 8, GoogleTest, rapidcheck, Embree 3, libpng, libtiff 4.5, glslang and SPIRV-Tools, Boost.Math and Boost.Multiprecision where CMake finds them" \
      "(Debian's names: ${gonio_libraries[*]})."
    [ ${#missing[@]} -eq 0 ] || { echo "Not found here: ${missing[*]}" >&2; return 1; }
    return 0
  fi
  for entry in "${gonio_libraries[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Abbrev}' "$entry" 2>/dev/null)" = "ii " ] || missing+=("$entry")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "Install as root: apt-get install ${missing[*]}" >&2; return 1; }
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    "${missing[@]}" >/dev/null
}

# A browser, which the test of the pages looks at them with; without one it is skipped.
install_browser() {
  local name
  for name in chromium chromium-browser google-chrome; do
    command -v "$name" >/dev/null && return 0
  done
  if command -v apt-get >/dev/null; then (gonio_tools=(chromium:chromium) gonio_libraries=(); install_missing) && return 0; fi
  echo "Without Chromium: the pages are not looked at in a browser."
}

# A compiler for WebAssembly, which the explorer's modules are built anew with; without it that is left out.
install_module() {
  if command -v apt-get >/dev/null; then
    (gonio_tools=(clang++-22:clang-22 wasm-ld-22:lld-22 llvm-ar-22:llvm-22 zopfli:zopfli)
      gonio_libraries=(libc++-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc); install_missing) && return 0
  fi
  echo "Without clang-22 for WebAssembly: the explorer's modules are not built anew."
}

# valijson, which the tests hold documents against the schemas with; without it these are left out.  Debian's package of
# the headers asks for seven other JSON libraries, Qt among them: whoever only builds is spared these.
install_validator() {
  [ ! -e /usr/include/valijson ] || return 0
  if command -v apt-get >/dev/null; then (gonio_tools=() gonio_libraries=(libvalijson-dev); install_missing) && return 0; fi
  echo "Without valijson: documents are not held against their schemas."
}

# Gappa, which proves bounds of relative errors; without it these proofs are left out and say so.
install_prover() {
  command -v gappa >/dev/null && return 0
  if command -v apt-get >/dev/null; then (gonio_tools=(gappa:gappa) gonio_libraries=(); install_missing) && return 0; fi
  echo "Without Gappa: no bound of a relative error is proved."
}

# Valgrind, which counts instructions where work is to grow as its input; without it that is left out.
install_counter() {
  command -v valgrind >/dev/null && return 0
  if command -v apt-get >/dev/null; then (gonio_tools=(valgrind:valgrind) gonio_libraries=(); install_missing) && return 0; fi
  echo "Without Valgrind: how work grows is not counted."
}

# glslang, SPIRV-Tools and a software Vulkan, which emitted shaders are compiled, looked at and run with; without them those tests
# are skipped.
install_vulkan() {
  if command -v apt-get >/dev/null; then
    (gonio_tools=(glslangValidator:glslang-tools spirv-val:spirv-tools)
      gonio_libraries=(libvulkan-dev mesa-vulkan-drivers); install_missing) && return 0
  fi
  echo "Without glslang, SPIRV-Tools and a driver of Vulkan: emitted shaders are not run."
}

# from_pypi FOLDER LIST [PYTHON]: the packages of a list, which has their digests, in a virtual environment in that folder.
from_pypi() {
  local at=$1 list=$2 python=${3-python3}
  { [ -x "$at/bin/pip" ] || "$python" -m venv "$at" >/dev/null 2>&1; } &&
    "$at/bin/pip" install -qq --disable-pip-version-check --retries 1 --timeout 20 --require-hashes --only-binary :all: -r "$list" 2>/dev/null
}

# Compilers of WGSL and Slang, which emitted shaders are held against, in build/shading; without them that is left out.
install_shading() {
  local at=build/shading
  if [ -e "$at/whole" ] || { from_pypi $at tests/shader/languages.txt && touch "$at/whole"; }; then return 0; fi
  echo "Without wgpu and slangpy: emitted WGSL and Slang are not compiled."
}

# Khronos' validator of glTF, which exported files are held against, in build/gltf; without it that test is skipped.
install_gltf_validator() {
  local at=build/gltf
  [ ! -d "$at/node_modules/gltf-validator" ] || return 0
  if command -v apt-get >/dev/null; then (gonio_tools=(npm:npm) gonio_libraries=(); install_missing) || true; fi
  if mkdir -p "$at" && cp tests/cli/gltf/package.json tests/cli/gltf/package-lock.json "$at" &&
    npm ci --prefix "$at" --silent --no-audit --no-fund >/dev/null 2>&1; then
    return 0
  fi
  echo "Without gltf-validator: exported glTF is not held against its specification."
}

# Programs that exported materials and RGL files are held against, and pictures compared with, in build/targets: Mitsuba, MaterialX with OpenGL
# without a window, USD; without them that is left out.
install_targets() {
  local at=build/targets
  if command -v apt-get >/dev/null; then
    (gonio_tools=(python3:python3) gonio_libraries=(python3-venv libegl1 libgl1-mesa-dri); install_missing) || true
  fi
  if from_pypi $at tests/cli/targets/requirements.txt; then return 0; fi
  echo "Without Mitsuba, MaterialX and USD from PyPI: exported materials, RGL files and pictures are not compared with theirs."
  return 1
}

# Slurm and GNU parallel, which run written jobs in their tests, on loopback; without them these are skipped.
install_farm() {
  if command -v apt-get >/dev/null; then (gonio_tools=() gonio_libraries=(slurm-wlm munge parallel); install_missing) && return 0; fi
  echo "Without Slurm, munge and GNU parallel: written jobs are not run by them."
}

# Open Job Description's own program, which written templates are checked with and run by, in build/openjd; without it that is left out.
install_openjd() {
  local at=build/openjd
  if [ -e "$at/whole" ] || { from_pypi $at tests/cli/openjd/requirements.txt && touch "$at/whole"; }; then return 0; fi
  echo "Without openjd-cli from PyPI: written templates are not held against their specification."
}

# nanobind, which the module for Python is built with, and NumPy, which it is tested with, in build/python; without them there is no
# module.
install_python() {
  local at=build/python
  if command -v apt-get >/dev/null; then
    (gonio_tools=(python3:python3) gonio_libraries=(python3-dev python3-venv); install_missing) || true
  fi
  if from_pypi $at tests/python/requirements.txt; then return 0; fi
  echo "Without nanobind and NumPy from PyPI: the module for Python is not built."
}

# mypy, which the package for Python is checked with, in build/mypy; without it that test is skipped.
install_mypy() {
  local at=build/mypy
  if [ -e "$at/whole" ] || { from_pypi $at tests/python/mypy.txt python3.11 && touch "$at/whole"; }; then return 0; fi
  echo "Without mypy from PyPI, for Python 3.11 on x86-64: the types of the package for Python are not checked."
}

# nbclient, which executes the notebooks, in build/notebooks; without it that test is skipped.
install_notebooks() {
  local at=build/notebooks
  if [ -e "$at/whole" ] || { from_pypi $at tests/python/notebooks.txt python3.11 && touch "$at/whole"; }; then return 0; fi
  echo "Without nbclient and ipykernel from PyPI, for Python 3.11 on x86-64: the notebooks are not executed."
}

# Blender as a module of Python 3.11, which exported glTF is looked at with, in build/blender: a gigabyte, so for ./check --long alone.
install_blender() {
  local at=build/blender
  if [ -d "$at/lib/python3.11/site-packages/bpy" ]; then return 0; fi
  if command -v apt-get >/dev/null; then
    (gonio_tools=() gonio_libraries=(python3-venv libgl1 libice6 libsm6 libxfixes3 libxi6 libxkbcommon0 libxrender1); install_missing) || true
  fi
  if from_pypi $at tests/cli/targets/blender.txt python3.11; then return 0; fi
  echo "Without Blender from PyPI, for Python 3.11 on x86-64: exported glTF is not looked at in it."
}

# build PRESET [OPTIONS of cmake --build]: with the time left on a terminal
build() {
  cmake --preset "$1" --log-level=WARNING
  if [ ! -t 1 ]; then
    cmake --build --preset "$@"
    return
  fi
  local line
  NINJA_STATUS='step %f %t %e ' cmake --build --preset "$@" | while IFS= read -r line; do
    if [[ $line =~ ^step\ ([0-9]+)\ ([0-9]+)\ ([0-9]+) ]]; then
      local done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]} seconds=${BASH_REMATCH[3]}
      printf '\r\033[K%d of %d files are built, %d min left' "$done" "$all" $((seconds * (all - done) / (done ? done : 1) / 60 + 1))
      [ "$done" != "$all" ] || echo
    else
      printf '\r\033[K%s\n' "$line"
    fi
  done
}
