"""Writes what the program is made of, as CycloneDX 1.5: parts.py VERSION COMMIT TARBALL

The parts are those whose licences lie in the tarball. Each has its version, its licence by SPDX and its package. A library of the tarball that none of
these names is an error, and so is a licence without a name here.
"""

import importlib.metadata
import json
import re
import subprocess
import sys
import tarfile
import uuid
from pathlib import Path

version, commit, tarball = sys.argv[1:]

# Debian's package, or a source that is compiled in: licence, and the libraries that are in the tarball as files.
parts = {
    "libfmt9": ("MIT", ["libfmt"]),
    "libtbb12": ("Apache-2.0", ["libtbb"]),
    "libopenexr-3-1-30": ("BSD-3-Clause", ["libOpenEXR", "libOpenEXRCore", "libIex", "libIlmThread"]),
    "libimath-3-1-29": ("BSD-3-Clause", ["libImath"]),
    "libpugixml1v5": ("MIT", ["libpugixml"]),
    "libembree3-3": ("Apache-2.0", ["libembree3"]),
    "libpng16-16": ("libpng-2.0", ["libpng16"]),
    "libnettle8": ("LGPL-3.0-or-later", ["libnettle"]),
    "libeigen3-dev": ("MPL-2.0", []),
    "nlohmann-json3-dev": ("MIT", []),
    "libcli11-dev": ("BSD-3-Clause", []),
    "libxsimd-dev": ("BSD-3-Clause", []),
    "libboost-dev": ("BSL-1.0", []),
    "glslang-dev": ("BSD-3-Clause", []),
    "spirv-tools": ("Apache-2.0", []),
    "spirv-headers": ("MIT", []),
    "ceres-solver": ("BSD-3-Clause", []),
    "tiff": ("libtiff", []),
    "nanobind": ("BSD-3-Clause", []),
    "robin-map": ("MIT", []),
}


def version_of(part):
    """The version of a part, and where it is from."""
    if part == "ceres-solver":
        text = Path("build/ceres/source/include/ceres/version.h").read_text()
        number = ".".join(re.search(rf"CERES_VERSION_{n} (\d+)", text)[1] for n in ("MAJOR", "MINOR", "REVISION"))
        return number, f"pkg:deb/debian/ceres-solver@{number}?arch=source"
    if part == "tiff":
        number = next(Path("build/tiff").glob("tiff_*.dsc")).stem.removeprefix("tiff_")
        return number, f"pkg:deb/debian/tiff@{number.replace('+', '%2B')}?arch=source"
    if part in ("nanobind", "robin-map"):  # the second comes with the first
        number = importlib.metadata.version("nanobind")
        return number, f"pkg:pypi/nanobind@{number}" + ("#ext/robin_map" if part == "robin-map" else "")
    number = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", part], check=True, capture_output=True, text=True).stdout
    return number, f"pkg:deb/debian/{part}@{number.replace('+', '%2B')}?arch=amd64&distro=debian-12"


with tarfile.open(tarball) as tar:
    names = [Path(n) for n in tar.getnames()]
libraries = {n.name for n in names if n.parent.name == "lib"}
licensed = {n.stem for n in names if n.parent.name == "licenses"}
if missing := licensed - set(parts):
    sys.exit(f"{tarball}: licences of {', '.join(sorted(missing))}: found no name of it here")
known = {name for package in licensed for name in parts[package][1]}
if unknown := [n for n in libraries if re.split(r"[-.]", n)[0] not in known]:
    sys.exit(f"{tarball}: libraries {', '.join(sorted(unknown))}: found none of the parts that they belong to")

components = []
for part in sorted(licensed):
    number, address = version_of(part)
    components.append({"type": "library", "bom-ref": part, "name": part, "version": number, "licenses": [{"license": {"id": parts[part][0]}}], "purl": address,
                       "properties": [{"name": "gonio:linked", "value": "shared library" if parts[part][1] else "compiled in"}]})
program = {"type": "application", "bom-ref": "gonio", "name": "gonio", "version": version, "licenses": [{"license": {"id": "Apache-2.0"}}],
           "properties": [{"name": "gonio:commit", "value": commit}]}
print(json.dumps({
    "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
    "serialNumber": f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, f'gonio {version} {commit}')}",
    "metadata": {"component": program},
    "components": components,
    "dependencies": [{"ref": "gonio", "dependsOn": [c["bom-ref"] for c in components]}],
}, indent=1))
