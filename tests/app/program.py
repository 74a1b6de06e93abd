"""The program under test, for tests that are called as `TEST.py PROGRAM SOURCE_DIR ...`."""
import json
import pathlib
import subprocess
import sys

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()


def nsframe(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300)


def run(folder, example, *settings):
    """Runs an example into the folder, without frames unless a setting asks for them; its summary."""
    flags = [flag for setting in ("output.frames=0", *settings) for flag in ("--set", setting)]
    ran = nsframe("run", SOURCE / "examples" / example / "scene.toml", "-q", "-o", folder, *flags)
    assert ran.returncode == 0, ran.stderr
    return json.loads((pathlib.Path(folder) / "summary.json").read_text())
