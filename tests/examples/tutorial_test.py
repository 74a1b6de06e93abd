#!/usr/bin/env python3
"""Goes through docs/tutorial.md as a reader would, from an empty folder: writes its scenes, runs its commands, finds the lines it shows.

    tutorial_test.py PROGRAM TUTORIAL [FOLDER]     exit code 1 and what went wrong; FOLDER: an empty one, kept

Of fenced blocks, ```toml is written to the file its first line names ("# pair.toml"), or added to it; ```sh is run, and must succeed
(```sh fails: must not); each line of ```text must be in what the commands since the last ```toml printed, whatever the spaces and whatever
rounding left (numbers below 1e-13, and what the tutorial shows as "…").
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def words(text):
    return re.sub(r"\b\d(\.\d+)?e-1[4-9]\b", "rounding", " ".join(text.split()))


def shown(line, printed):
    return re.search(r"\S+".join(re.escape(part) for part in words(line).split("…")), printed)


def blocks(text):
    return re.findall(r"^```(\w+)( fails)?\n(.*?)^```$", text, re.S | re.M)


def follow(tutorial, folder, environment):
    """Faults, one sentence each; stops at the first command that didn't do as the tutorial says."""
    faults, printed, counts = [], "", {"toml": 0, "sh": 0, "text": 0}
    for kind, fails, body in blocks(tutorial):
        if kind not in counts:
            return ["a block of the unknown kind '%s'" % kind]
        counts[kind] += 1
        if kind == "toml":
            name = re.match(r"# (\S+\.toml)\n", body)
            if not name:
                return ["a scene that doesn't name its file: %s" % body.splitlines()[0]]
            with open(folder / name.group(1), "a", encoding="utf-8") as file:
                file.write(body + "\n")
            printed = ""
        elif kind == "sh":
            ran = subprocess.run(["bash", "-e", "-c", body], cwd=folder, env=environment, capture_output=True, text=True, timeout=500)
            if (ran.returncode != 0) != bool(fails):
                return faults + ["ended with %d: %s\n%s" % (ran.returncode, body.strip(), ran.stderr)]
            printed += words(ran.stdout + " " + ran.stderr) + " "
        else:
            faults += ["not printed: %s" % line for line in body.splitlines() if not shown(line, printed)]
    return faults + ["no %s in the tutorial" % kind for kind, count in counts.items() if count == 0]


def self_test(folder):
    """A tutorial with faults is told."""
    environment = dict(os.environ)
    good = "```toml\n# a.toml\nx = 1\n```\n```sh\ncat a.toml\n```\n```text\nx  =   1\n```\n"
    assert follow(good, folder, environment) == []
    assert follow(good.replace("x  =", "y ="), folder, environment) == ["not printed: y =   1"]
    assert follow(good.replace("x = 1", "x = 2.2e-16").replace("x  =   1", "x = 1e-15"), folder, environment) == []
    assert follow(good.replace("x = 1", "x = 2.2e-13").replace("x  =   1", "x = 1e-13"), folder, environment) == ["not printed: x = 1e-13"]
    assert follow(good.replace("x  =   1", "x = …"), folder, environment) == []
    assert follow(good.replace("x  =   1", "y = …"), folder, environment) == ["not printed: y = …"]
    assert "ended with 1" in follow(good.replace("cat", "false"), folder, environment)[0]
    assert "ended with 0" in follow(good.replace("```sh", "```sh fails"), folder, environment)[0]
    assert "unknown kind" in follow(good.replace("```sh", "```console"), folder, environment)[0]


def main():
    program, tutorial = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    environment = dict(os.environ, PATH="%s:%s" % (program.parent, os.environ["PATH"]))
    with tempfile.TemporaryDirectory() as name:
        self_test(pathlib.Path(name))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else name)
        faults = follow(tutorial.read_text(encoding="utf-8"), folder, environment)
        for figure in folder.glob("*.svg"):
            if "<polyline" not in figure.read_text(encoding="utf-8"):
                faults.append("%s is empty" % figure.name)
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
