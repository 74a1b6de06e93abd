"""The record of every motion: the shipped one, files that the user names, and the stand-in for the one that isn't public."""
import os

import cases


class Record:
    """file: absolute path; text: what the tables say of it; measured: by `nsframe motion info`."""

    def __init__(self, program, file, shipped=False, made=False):
        self.file, self.shipped, self.made = os.path.abspath(file), shipped, made
        self.measured = program.record(self.file)
        self.told = {**self.measured, "shipped": shipped, "made": made}


def artificial(program, folder, seed, kind="1"):
    """The file of an artificial motion of Eurocode 8, type `kind`."""
    file = os.path.join(folder, f"stand_in_type_{kind}_seed_{seed}.at2")
    arguments = list(cases.ARTIFICIAL)
    arguments[arguments.index("--type") + 1] = kind
    program.call("motion", "artificial", *arguments, "--seed", str(seed), "-o", file)
    return file


def gather(program, folder, given):
    """motion -> (record of its rows or None, other records: label -> Record). given: motion -> files of the user."""
    shipped = os.path.join(os.path.dirname(os.path.abspath(__file__)), cases.EL_CENTRO_FILE)
    found = {"el_centro": (Record(program, shipped, shipped=True), {})}
    stand_in = Record(program, artificial(program, folder, cases.SEED), made=True)
    others = {f"seed {seed}": Record(program, artificial(program, folder, seed), made=True) for seed in cases.OTHER_SEEDS}
    others["type 2"] = Record(program, artificial(program, folder, cases.SEED, "2"), made=True)
    found["cadarache"] = (stand_in, others)
    for motion, files in given.items():
        records = [Record(program, file) for file in files]
        if motion == "el_centro":
            found[motion][1].update({record.measured["description"]: record for record in records})
        else:
            found[motion] = (records[0] if records else None, {r.measured["description"]: r for r in records[1:]})
    return found
