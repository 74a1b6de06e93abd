#!/usr/bin/env python3
"""Checks that includes are written from the root and point one way only:

    base <- materials <- elements <- models <- assembly <- integrators <- app
    contact: base, models/contacts.hpp, models/contact_law.hpp     modal: base     spectra: base     motion: base, spectra
    integrators: also contact     scene: base .. models, motion     output: base .. models, spectra     study: base .. models
    plot: base     study: also plot     report: base, output, plot     calibration: base .. integrators, modal
    app, tests, bench: anything

A test or a bench may also name a helper in its own folder without a path.

    check_includes.py [ROOT]      exit code 1 and one line a violation
    check_includes.py --self-test
"""
import re
import sys
import tempfile
from pathlib import Path

CHAIN = ["base", "materials", "elements", "models", "assembly", "integrators"]
ALLOWED = {folder: set(CHAIN[: i + 1]) for i, folder in enumerate(CHAIN)}
ALLOWED["assembly"] |= {"modal"}
ALLOWED["integrators"] |= {"contact", "modal"}
ALLOWED["calibration"] = set(CHAIN) | {"calibration", "modal"}
ALLOWED["contact"] = {"base", "contact", "models/contacts.hpp", "models/contact_law.hpp"}
ALLOWED["modal"] = {"base", "modal"}
ALLOWED["motion"] = {"base", "motion", "spectra"}
ALLOWED["scene"] = set(CHAIN[:4]) | {"motion", "scene"}
ALLOWED["spectra"] = {"base", "spectra"}
ALLOWED["plot"] = {"base", "plot"}
ALLOWED["study"] = set(CHAIN[:4]) | {"plot", "study"}
ALLOWED["output"] = set(CHAIN[:4]) | {"output", "spectra"}
ALLOWED["report"] = {"base", "output", "plot", "report"}
ANYTHING = {"app", "tests", "bench"}
AT_ROOT = {"materials", "elements", "models", "tests", "bench"}  # the others are below src/
FOLDERS = set(ALLOWED) | ANYTHING

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SUFFIXES = {".hpp", ".cpp", ".h", ".inc"}


def directory(root, folder):
    return root / folder if folder in AT_ROOT else root / "src" / folder


def violations(root):
    for folder in sorted(FOLDERS):
        for path in sorted(directory(root, folder).rglob("*")):
            if path.suffix not in SUFFIXES:
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                quote, target = match.groups()
                place = f"{path.relative_to(root)}:{number}: {target}: "
                first = target.split("/")[0]
                if quote == "<":
                    if "/" in target and first in FOLDERS and (directory(root, first) / target.split("/", 1)[1]).exists():
                        yield place + 'a file of this project is included with "..."'
                elif folder in {"tests", "bench"} and (path.parent / target).exists():
                    continue  # a helper beside the test
                elif first not in FOLDERS or "/" not in target or ".." in target:
                    yield place + "write it from the root, as in \"materials/uniaxial.hpp\""
                elif folder not in ANYTHING and not {first, target} & ALLOWED[folder]:
                    yield place + f"{folder}/ may include {', '.join(sorted(ALLOWED[folder]))} only"
    known = {directory(root, folder) for folder in FOLDERS}
    for path in sorted((root / "src").glob("*")):
        if path.is_dir() and path not in known:
            yield f"{path.relative_to(root)}: new folder: add it to tools/check_includes.py and docs/architecture.md"


def self_test():
    right = {
        "src/base/types.hpp": "#include <vector>\n",
        "materials/law.hpp": '#include "base/types.hpp"\n',
        "elements/beam.cpp": '#include "elements/beam.hpp"\n#include "materials/law.hpp"\n',
        "src/contact/problem.cpp": '#include "models/contacts.hpp"\n',
        "src/integrators/step.cpp": '#include "contact/problem.hpp"\n#include "assembly/assembly.hpp"\n',
        "src/scene/reader.cpp": '#include "models/model.hpp"\n',
        "src/app/main.cpp": '#include "scene/reader.hpp"\n#include "modal/modes.hpp"\n#include "output/vtk.hpp"\n',
        "tests/app/run_test.cpp": '#include "tests/support/x.hpp"\n#include "output/vtk.hpp"\n#include "helper.hpp"\n',
        "tests/app/helper.hpp": "",
    }
    wrong = {
        "materials/sees_element.hpp": '#include "elements/beam.hpp"\n',
        "elements/sees_model.cpp": '#include "models/model.hpp"\n',
        "models/sees_assembly.cpp": '#include "assembly/assembly.hpp"\n',
        "src/base/sees_material.hpp": '#include "materials/law.hpp"\n',
        "src/assembly/sees_contact.cpp": '#include "contact/problem.hpp"\n',
        "src/contact/sees_model.cpp": '#include "models/model.hpp"\n',
        "src/modal/sees_model.cpp": '#include "models/model.hpp"\n',
        "src/modal/sees_assembly.cpp": '#include "assembly/system.hpp"\n',
        "src/scene/sees_output.cpp": '#include "output/vtk.hpp"\n',
        "src/output/sees_scene.cpp": '#  include  "scene/reader.hpp"\n',
        "src/output/not_from_root.cpp": '#include "vtk.hpp"\n',
        "src/base/upwards.cpp": '#include "base/../materials/law.hpp"\n',
        "src/base/angle.cpp": "#include <base/types.hpp>\n",
        "src/unknown/file.cpp": "",
    }
    with tempfile.TemporaryDirectory() as name:
        root = Path(name)
        for path, text in right.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text)
        if found := list(violations(root)):
            return [f"reported without reason: {v}" for v in found]
        for path, text in wrong.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text)
        found = list(violations(root))
        missed = [p for p in wrong if not any(v.startswith((p + ":", str(Path(p).parent) + ": new")) for v in found)]
        extra = [] if len(found) == len(wrong) else [f"{len(found)} violations for {len(wrong)} wrong files"]
        return [f"not reported: {p}" for p in missed] + extra


def main():
    if sys.argv[1:] == ["--self-test"]:
        found = self_test()
    else:
        found = list(violations(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1]).resolve()))
    print("\n".join(found) if found else "ok")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
