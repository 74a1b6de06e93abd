#!/usr/bin/env python3
"""Relative links of the documents lead to files and headings that exist, pictures of examples have the command that made them, and the
glossary cites equations that theory.md has.

    links_test.py ROOT      exit code 1 and one line a fault
"""
import pathlib
import re
import sys


def anchors(path):
    """As GitHub makes them from headings."""
    found = set()
    for line in path.read_text(encoding="utf-8").splitlines():
        heading = re.match(r"#+ (.*)", line)
        if heading:
            text = re.sub(r"[^\w\- ]", "", heading.group(1).replace("`", "").lower())
            found.add(text.strip().replace(" ", "-"))
    return found


def documents(root):
    return [*root.glob("*.md"), *root.glob("docs/*.md"), *root.glob("examples/*/README.md"), *root.glob("bench/*.md"), *root.glob("python/*.md")]


def link_faults(root):
    for document in documents(root):
        text = re.sub(r"^```.*?^```", "", document.read_text(encoding="utf-8"), flags=re.S | re.M)
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = document.parent / name if name else document
            if not path.exists():
                yield "%s: there is no %s" % (document.relative_to(root), target)
            elif anchor and path.suffix == ".md" and anchor not in anchors(path):
                yield "%s: %s has no heading #%s" % (document.relative_to(root), name, anchor)


def picture_faults(root):
    """The picture of an example has a command that writes it."""
    for document in root.glob("examples/*/README.md"):
        text, folder = document.read_text(encoding="utf-8"), document.parent.name
        for name in set(re.findall(r"!\[[^\]]*\]\(([\w.]+)\)", text)):
            if not re.search(r"^    .*(-o|cp \S+) examples/%s/%s$" % (folder, re.escape(name)), text, re.M):
                yield "examples/%s/README.md: no command writes %s" % (folder, name)


def equation_faults(root):
    text = (root / "docs/theory.md").read_text(encoding="utf-8")
    known = set()
    for tag in re.findall(r"\\tag\{([\d, -]+)\}", text):
        first, _, last = tag.partition("-")
        known |= set(range(int(first), int(last) + 1)) if last else {int(number) for number in tag.split(",")}
    for number in re.findall(r"\((\d[\d-]*)\)", (root / "docs/glossary.md").read_text(encoding="utf-8")):
        first, _, last = number.partition("-")
        if not {int(first), int(last or first)} <= known:
            yield "docs/glossary.md: theory.md has no equation (%s)" % number


def main():
    root = pathlib.Path(sys.argv[1])
    faults = [*link_faults(root), *picture_faults(root), *equation_faults(root)]
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
