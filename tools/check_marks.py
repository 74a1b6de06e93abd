#!/usr/bin/env python3
"""Checks that no file carries a mark of unfinished work; what is left to do belongs in an issue.

    check_marks.py [ROOT]         exit code 1 and one line a mark
    check_marks.py --self-test
"""
import re
import sys
import tempfile
from pathlib import Path

FOLDERS = ["src", "materials", "elements", "models", "tests", "bench", "tools", "docs", "examples", "python", ".ci"]
SUFFIXES = {".hpp", ".cpp", ".h", ".inc", ".py", ".sh", ".md", ".toml", ".txt", ".cmake", ".json", ".cff"}
MARK = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK|W" r"IP)\b")  # split, so that this file passes


def marks(root):
    files = [path for folder in FOLDERS for path in (root / folder).rglob("*")] + list(root.glob("*"))
    for path in sorted(files):
        if path.is_file() and (path.suffix in SUFFIXES or path.name == "run"):
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if match := MARK.search(line):
                    yield f"{path.relative_to(root)}:{number}: {match.group()}: finish it, or open an issue"


def self_test():
    with tempfile.TemporaryDirectory() as name:
        root = Path(name)
        (root / "src/base").mkdir(parents=True)
        (root / "src/base/right.hpp").write_text("// the method to do it\n")
        (root / "src/base/wrong.hpp").write_text("int x;\nint y;  // TO" "DO: check\n")
        found = list(marks(root))
        return [] if len(found) == 1 and found[0].startswith("src/base/wrong.hpp:2:") else [f"found {found}"]


def main():
    if sys.argv[1:] == ["--self-test"]:
        found = self_test()
    else:
        found = list(marks(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1]).resolve()))
    print("\n".join(found) if found else "ok")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
