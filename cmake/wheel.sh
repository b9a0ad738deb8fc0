#!/usr/bin/env bash
# Builds the wheel for Linux, in build/wheel_made/TAG/repaired, and tries it in a fresh virtual environment.
#   cmake/wheel.sh [PYTHON]   the interpreter it is for (python3); from 3.12 on the wheel is of the stable ABI, for every later one
# Its Ceres is built here without SuiteSparse, LAPACK and glog, and its libtiff with zlib only; auditwheel brings in whatever else a bare machine lacks, and each of these
# libraries is named below with its licence, or the wheel is refused.
set -euo pipefail
cd "$(dirname "$0")/.."
source cmake/debian_source.sh

# library:licence:package of Debian whose copyright file goes into the wheel
bundled=(libfmt:MIT:libfmt9 libtbb:Apache-2.0:libtbb12 libOpenEXR:BSD-3-Clause:libopenexr-3-1-30
  libOpenEXRCore:BSD-3-Clause:libopenexr-3-1-30 libIex:BSD-3-Clause:libopenexr-3-1-30 libIlmThread:BSD-3-Clause:libopenexr-3-1-30
  libImath:BSD-3-Clause:libimath-3-1-29 libpugixml:MIT:libpugixml1v5 libembree3:Apache-2.0:libembree3-3 libpng16:libpng-2.0:libpng16-16
  libnettle:LGPL-3.0-or-later:libnettle8)
# package of Debian whose headers, or static library, are compiled in
compiled_in=(libeigen3-dev nlohmann-json3-dev libcli11-dev libxsimd-dev libboost-dev glslang-dev spirv-tools spirv-headers)

# Ceres as a static library, in build/ceres, from Debian's source.  Of Eigen, which is under the MPL 2.0, only what is under that.
build_ceres() {
  local ceres=$PWD/build/ceres
  [ ! -e "$ceres/installed" ] || return 0
  debian_source ceres-solver "$ceres" &&
    cmake -S "$ceres/source" -B "$ceres/build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-DEIGEN_MPL2_ONLY \
      -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF -DBUILD_EXAMPLES=OFF -DBUILD_BENCHMARKS=OFF \
      -DMINIGLOG=ON -DMINIGLOG_MAX_LOG_LEVEL=-3 -DGFLAGS=OFF -DLAPACK=OFF -DSUITESPARSE=OFF -DCXSPARSE=OFF -DEIGENSPARSE=OFF -DSCHUR_SPECIALIZATIONS=OFF &&
    cmake --build "$ceres/build" && cmake --install "$ceres/build" --prefix "$ceres/installed" >/dev/null
}

# libtiff as a static library, in build/tiff, from Debian's source with its patches: of packings only those that gonio reads, none of which needs more
# than zlib.  (Debian's own links JBIG-KIT, which is under the GPL.)
build_tiff() {
  local tiff=$PWD/build/tiff patch
  [ ! -e "$tiff/installed" ] || return 0
  debian_source tiff "$tiff" && tar -xf "$tiff"/tiff_*.debian.tar.* -C "$tiff/source" &&
    for patch in $(grep -v '^#' "$tiff/source/debian/patches/series"); do
      patch -s -p1 -d "$tiff/source" <"$tiff/source/debian/patches/$patch" || return 1
    done &&
    cmake -S "$tiff/source" -B "$tiff/build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
      -DBUILD_SHARED_LIBS=OFF -Dtiff-tools=OFF -Dtiff-tests=OFF -Dtiff-contrib=OFF -Dtiff-docs=OFF -Djpeg=OFF -Dold-jpeg=OFF -Djbig=OFF \
      -Dlerc=OFF -Dlzma=OFF -Dzstd=OFF -Dwebp=OFF -Dlibdeflate=OFF -Dpixarlog=OFF -Dcxx=OFF &&
    cmake --build "$tiff/build" && cmake --install "$tiff/build" --prefix "$tiff/installed" >/dev/null
}

# Licences of all that the wheel holds of others, in a folder.
gather_licences() {
  local to=$1 entry
  mkdir -p "$to"
  for entry in "${bundled[@]}"; do cp "/usr/share/doc/${entry##*:}/copyright" "$to/${entry##*:}.txt"; done
  for entry in "${compiled_in[@]}"; do cp "/usr/share/doc/$entry/copyright" "$to/$entry.txt"; done
  cp build/ceres/source/LICENSE "$to/ceres-solver.txt"
  cp build/tiff/source/LICENSE.md "$to/tiff.txt"
  cp "$("$python" -c 'import importlib.metadata as m; print(next(p.locate() for p in m.files("nanobind") if p.name == "LICENSE"))')" \
    "$to/nanobind.txt"
  # robin-map comes with nanobind, with its licence at the head of each file.
  sed '/\*\//q' "$("$python" -m nanobind --include_dir)/../ext/robin_map/include/tsl/robin_map.h" >"$to/robin-map.txt"
}

# The names of a wheel's libraries with their licences; one that is not among those above ends it.
look_at_libraries() {
  local wheel=$1 file name entry licence
  for file in $("$python" -m zipfile -l "$wheel" | grep -o 'gonio\.libs/[^ ]*'); do
    name=${file#gonio.libs/} licence=
    for entry in "${bundled[@]}"; do
      [[ $name =~ ^"${entry%%:*}"[-.] ]] && licence=$(cut -d: -f2 <<<"$entry")
    done
    [ -n "$licence" ] || { echo "$wheel: $name: found a library without a known licence, expected one of: ${bundled[*]%%:*}" >&2; return 1; }
    echo "   $name: $licence"
  done
}

asked=${1:-python3}
tag=$("$asked" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
build_ceres && build_tiff || { echo "Without Debian's sources of Ceres and libtiff: no wheel is built."; exit 0; }
at=build/wheel_tools/$tag
{ [ -x $at/bin/pip ] || "$asked" -m venv $at; } &&
  $at/bin/pip install -qq --disable-pip-version-check --require-hashes --only-binary :all: -r tests/python/wheel.txt ||
  { echo "Without scikit-build-core and auditwheel from PyPI: no wheel is built."; exit 0; }
python=$PWD/$at/bin/python
export PATH=$PWD/$at/bin:$PATH PYTHONDONTWRITEBYTECODE=1

out=build/wheel_made/$tag
rm -rf $out && mkdir -p $out
echo "-- building"
CXX=${CXX:-c++} CMAKE_ARGS="-DCMAKE_PREFIX_PATH=$PWD/build/ceres/installed;$PWD/build/tiff/installed -DGONIO_TIFF=ON" \
  pip wheel -q --disable-pip-version-check --no-build-isolation --no-deps -w $out/linux .
auditwheel repair -w $out/repaired $out/linux/*.whl >$out/auditwheel.txt 2>&1 || { cat $out/auditwheel.txt >&2; exit 1; }
wheel unpack -d $out/unpacked $out/repaired/*.whl >/dev/null
gather_licences "$(echo $out/unpacked/gonio-*/gonio-*.dist-info)/licenses/bundled"
wheel pack -d $out/repaired $out/unpacked/gonio-* >/dev/null
wheel=$(echo $out/repaired/*.whl)
echo "-- $(basename "$wheel"), $(($(stat -c %s "$wheel") / 1048576)) MiB, with"
look_at_libraries "$wheel"

echo "-- trying it where there is nothing else"
"$asked" -m venv $out/fresh
$out/fresh/bin/pip install -q --disable-pip-version-check --require-hashes --only-binary :all: -r tests/python/wheel.txt  # NumPy, matplotlib
$out/fresh/bin/pip install -q --disable-pip-version-check --no-deps "$wheel"
GONIO_PROGRAM=$PWD/$out/fresh/bin/gonio $out/fresh/bin/python -I tests/python/run.py
