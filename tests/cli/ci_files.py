"""Runs what the CI files of docs/examples/ci say, step by step: ci_files.py FOLDER PROGRAM_FOLDER RELEASE_FOLDER

Each file's commands run in a copy of FOLDER by the shell that its build server takes.  They take gonio from the wheel and the tarball in
RELEASE_FOLDER; where that has none, the commands that take it are left out, and the program in PROGRAM_FOLDER stands in PATH.
"""

import glob
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

folder, program, release = map(Path, sys.argv[1:])
environment = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "VIRTUAL"))}


def made(pattern):
    """The file of the release, and its digest; none where it is not there."""
    found = sorted(release.glob(pattern))
    if not found:
        print(f"{folder}: without {pattern} in {release}, which release/make makes: the built program is run in its place.")
        return None, None
    return found[0], hashlib.sha256(found[0].read_bytes()).hexdigest()


def run(script, at, env):
    done = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", script], cwd=at, env=env, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, f"exit {done.returncode} of\n{script}\n{done.stdout}"
    return done.stdout


def files(at, pattern):
    found = [f for f in glob.glob(str(at / pattern), recursive=True) if Path(f).stat().st_size > 0]
    assert found, f"{pattern}: nothing is there"
    return found


def github(at):
    workflow = yaml.safe_load((at / ".github/workflows/materials.yml").read_text())
    assert set(workflow[True]) == {"push", "pull_request"}, "YAML reads on as a truth"
    wheel, digest = made(f"gonio-*-cp3{sys.version_info.minor}-*.whl" if sys.version_info < (3, 12) else "gonio-*-abi3-*.whl")
    assert set(workflow["env"]) == {"GONIO"}
    assert workflow["env"]["GONIO"].startswith("https://") and "#sha256=" in workflow["env"]["GONIO"]
    env = {**environment, "PATH": f"{program}:{environment['PATH']}"}
    if wheel:
        subprocess.run([sys.executable, "-m", "venv", at / "python"], check=True)
        env["PATH"] = f"{at}/python/bin:{environment['PATH']}"
        env["GONIO"] = f"{wheel.resolve().as_uri()}#sha256={digest}"
    (job,) = workflow["jobs"].values()
    assert job["runs-on"] == "ubuntu-24.04" and job["timeout-minutes"] <= 60
    for step in job["steps"]:
        if "run" in step and (wheel or "pip" not in step["run"]):
            print(run(step["run"], at, env))
        elif step.get("uses", "").startswith("actions/cache@") and wheel:
            assert step["with"]["path"] == ".gonio"
        elif step.get("uses", "").startswith("actions/upload-artifact@"):
            assert step["if"] == "always()" and files(at, step["with"]["path"])
        elif "upload-sarif@" in step.get("uses", ""):
            assert step["if"] == "always()" and files(at, step["with"]["sarif_file"] + "/*.sarif")
            assert workflow["permissions"]["security-events"] == "write"
    if wheel:
        used = run("command -v gonio; ls .gonio", at, env)
        assert used.startswith(f"{at}/python/bin/gonio") and ".whl" in used, used


def gitlab(at):
    (job,) = yaml.safe_load((at / ".gitlab-ci.yml").read_text()).values()
    tarball, digest = made("gonio-*-linux-x86_64.tar.gz")
    env = {**environment, **job["variables"]}
    script = job["script"]
    if tarball:
        env |= {"GONIO": tarball.resolve().as_uri(), "GONIO_SHA256": digest}
        script = [*script, 'test "$(command -v gonio)" = "$PWD/gonio/bin/gonio"']
    else:
        env["PATH"] = f"{program}:{environment['PATH']}"
        script = [line for line in script if "check-materials" in line]
    print(run("\n".join(script), at, env))
    assert files(at, job["artifacts"]["reports"]["junit"]) and job["artifacts"]["when"] == "always"
    assert job["artifacts"]["paths"] == ["results"]


for server in (github, gitlab):
    with tempfile.TemporaryDirectory(prefix="gonio-ci-") as place:
        copy = Path(place).resolve() / "repository"
        shutil.copytree(folder, copy)
        server(copy)
