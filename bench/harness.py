"""What the benches share: running programs and measuring them, reading results.h5, tables. Standard library only."""
import ctypes
import datetime
import json
import os
import platform
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BENCH = os.path.join(ROOT, "bench")

# One thread for every library a program might use; OpenSees would else start one a core in its BLAS.
ONE_THREAD = dict(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", MKL_NUM_THREADS="1")

# A fresh small process that runs the command as its child. Linux counts the pages of the process that forked as the
# child's peak memory; so it must be a small one, not this one with its histories.
MEASURE = """
import json, os, resource, subprocess, sys, time
start = time.perf_counter()
done = subprocess.run(sys.argv[2:], stdin=subprocess.DEVNULL, stdout=sys.stderr)
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
with open(sys.argv[1], "w") as file:
    json.dump(dict(exit=done.returncode, wall_s=time.perf_counter() - start, cpu_s=usage.ru_utime + usage.ru_stime,
                   memory_mb=usage.ru_maxrss / 1024), file)
"""


class BenchError(Exception):
    """A program did not run; the text says which and what it printed."""


def measure(command, allowed=(0,)):
    """Runs a command; exit code, wall and CPU time [s] and peak memory [MB] of its process."""
    with tempfile.TemporaryDirectory() as folder:
        usage = os.path.join(folder, "usage.json")
        done = subprocess.run([sys.executable, "-S", "-E", "-c", MEASURE, usage] + command, stderr=subprocess.PIPE,
                              env={**os.environ, **ONE_THREAD}, text=True, errors="replace")
        if not os.path.exists(usage):
            raise BenchError(done.stderr[-2000:])
        with open(usage) as file:
            result = json.load(file)
    if result["exit"] not in allowed:
        raise BenchError("%s\nended with exit code %d:\n%s" % (" ".join(command), result["exit"], done.stderr[-2000:]))
    return result


# --- nsframe

class Hdf5:
    """Reads data sets of doubles with the HDF5 library that nsframe itself is linked to."""

    def __init__(self, program):
        listing = subprocess.run(["ldd", program], stdout=subprocess.PIPE, text=True, check=True).stdout
        found = re.search(r"=> (\S*libhdf5(?:_serial)?\.so\S*)", listing)
        if not found:
            raise BenchError("%s is not linked to a shared HDF5 library" % program)
        self.library = ctypes.CDLL(found.group(1))
        handle = ctypes.c_int64
        for name, arguments in (("H5Fopen", (ctypes.c_char_p, ctypes.c_uint, handle)),
                                ("H5Dopen2", (handle, ctypes.c_char_p, handle)), ("H5Dget_space", (handle,)),
                                ("H5Sget_simple_extent_npoints", (handle,)), ("H5Dclose", (handle,)),
                                ("H5Sclose", (handle,)), ("H5Fclose", (handle,)),
                                ("H5Dread", (handle, handle, handle, handle, handle, ctypes.c_void_p))):
            function = getattr(self.library, name)
            function.argtypes, function.restype = arguments, handle
        for name in ("H5Dread", "H5Dclose", "H5Sclose", "H5Fclose"):
            getattr(self.library, name).restype = ctypes.c_int
        self.library.H5open()
        self.double = ctypes.c_int64.in_dll(self.library, "H5T_NATIVE_DOUBLE_g").value

    def read(self, path, name):
        """All numbers of a data set, in the order of its indices."""
        h5 = self.library
        file = h5.H5Fopen(path.encode(), 0, 0)
        if file < 0:
            raise BenchError("cannot open " + path)
        data = h5.H5Dopen2(file, name.encode(), 0)
        if data < 0:
            raise BenchError("%s has no data set %s" % (path, name))
        space = h5.H5Dget_space(data)
        values = (ctypes.c_double * h5.H5Sget_simple_extent_npoints(space))()
        status = h5.H5Dread(data, self.double, 0, 0, 0, values)
        h5.H5Sclose(space), h5.H5Dclose(data), h5.H5Fclose(file)
        if status < 0:
            raise BenchError("cannot read %s of %s" % (name, path))
        return list(values)


class Nsframe:
    """The program: runs an example with changed values, and reads what it wrote."""

    def __init__(self, program):
        self.program = os.path.abspath(program)
        if not os.access(self.program, os.X_OK):
            raise BenchError("there is no program %s; build it, or name it by --program" % program)
        self.hdf5 = Hdf5(self.program)

    def run(self, example, settings, nodes=(), rate=0):
        """Summary, process usage and, for `nodes`, times and displacement histories in x, y, z: {node: ([..], ..)}."""
        with tempfile.TemporaryDirectory() as folder:
            values = dict(settings)
            values["output.frames"] = 0
            values["output.floor_spectra"] = "none"
            values["output.history"] = '["nodes"]' if nodes else "[]"
            if nodes:
                values["output.nodes"] = "[%s]" % ", ".join('"%s"' % node for node in nodes)
                values["output.history_rate"] = rate
            command = [self.program, "run", os.path.join(ROOT, "examples", example, "scene.toml"), "-q", "-o", folder]
            for key, value in values.items():
                command += ["--set", "%s=%s" % (key, value)]
            usage = measure(command)
            with open(os.path.join(folder, "summary.json")) as file:
                summary = json.load(file)
            time, history = [], {}
            if nodes:
                path = os.path.join(folder, "results.h5")
                time = self.hdf5.read(path, "/time")
                flat = self.hdf5.read(path, "/nodes/displacement")
                width = 6 * len(nodes)
                for i, node in enumerate(nodes):
                    history[node] = tuple(flat[6 * i + k::width] for k in range(3))
        return summary, usage, time, history

    def loop_seconds(self, example, settings, repeat, enough):
        """Times of the step loop, of runs one after another in one process (bench/run_loop.cpp): wall or CPU time, whichever is less."""
        program = os.path.join(os.path.dirname(self.program), "bench", "bench_run_loop")
        if not os.access(program, os.X_OK):
            raise BenchError("there is no program %s; configure with -DNSFRAME_BENCH=ON" % program)
        scene = os.path.join(ROOT, "examples", example, "scene.toml")
        done = subprocess.run([program, scene, str(repeat), repr(enough)] + ["%s=%s" % item for item in settings.items()],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", env={**os.environ, **ONE_THREAD})
        if done.returncode != 0:
            raise BenchError("%s\nended with exit code %d:\n%s" % (program, done.returncode, done.stderr[-2000:]))
        times = json.loads(done.stdout)
        return [min(pair) for pair in zip(times["wall_s"], times["cpu_s"])]


def step_microseconds(summary):
    """Time of the step loop without output, a step [us]."""
    return 1e6 * summary["timing"]["step_loop"] / summary["steps"]


# --- text

def number(value, digits=3):
    if value is None:
        return "–"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        text = "%.*g" % (digits, value)
        return "%.0f" % value if "e" in text else text
    return "%.*e" % (digits - 1, value)


def table(header, rows):
    """A Markdown table, padded so that it can also be read as text."""
    cells = [[str(cell) for cell in row] for row in [header] + rows]
    width = [max(len(row[k]) for row in cells) for k in range(len(header))]
    lines = ["| " + " | ".join(cell.ljust(w) for cell, w in zip(row, width)) + " |" for row in cells]
    lines.insert(1, "|" + "|".join("-" * (w + 2) for w in width) + "|")
    return "\n".join(lines) + "\n"


def machine():
    """Processor, cores and load, one line."""
    model = platform.machine()
    try:
        with open("/proc/cpuinfo") as file:
            model = next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), model)
    except OSError:
        pass
    return "%s, %d cores, load %.1f, %s" % (model, os.cpu_count() or 1, os.getloadavg()[0],
                                            datetime.date.today().isoformat())


def write(folder, name, text, data):
    """Writes NAME.md and NAME.json, and prints the text."""
    write_files(folder, name, text, data)
    print(text)


def write_files(folder, name, text, data):
    """Writes NAME.md and NAME.json."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name + ".md"), "w", encoding="utf-8") as file:
        file.write(text)
    with open(os.path.join(folder, name + ".json"), "w", encoding="utf-8") as file:
        json.dump(data, file, indent=1)
        file.write("\n")


def arguments(parser):
    """The options that all benches have."""
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "nsframe"), help="default: build/nsframe")
    parser.add_argument("--results", default=os.path.join(BENCH, "results"), help="folder of the tables")
    parser.add_argument("--quick", action="store_true",
                        help="a fraction of a second of model time, only to see that the script works")
    return parser


def peer_arguments(parser):
    """The options of benches that run OpenSees too."""
    parser.add_argument("--opensees-python", metavar="P", help="interpreter that has openseespy (default: this one)")
    parser.add_argument("--no-opensees", action="store_true")


def peer_python(options):
    """The interpreter to run OpenSees by, or None and the reason."""
    return (None, "not asked for") if options.no_opensees else opensees_python(options.opensees_python)


def write_compared(options, name, title, how, peer_how, reason, parts, data):
    """Writes the tables of a bench that runs OpenSees too: `how` was measured, and `peer_how` in OpenSees.

    `reason`: why there are no rows of OpenSees, if there are none. The rows are in data["cases"].
    """
    cases = [case["rows"] if isinstance(case, dict) else case for case in data["cases"].values()]
    versions = {row["version"] for rows in cases for row in rows if "version" in row}
    peer = "No rows of OpenSees: %s." % reason if reason else "OpenSees %s: %s." % (", ".join(sorted(versions)), peer_how)
    intro = "# %s\n\n%s. %s\n%s\n" % (title, data["machine"], how, peer)
    write(options.results, name, intro + "\n" + "\n".join(parts), data)


def run_bench(main):
    try:
        main()
    except BenchError as problem:
        sys.exit("error: %s" % problem)


def progress(text):
    print("  " + text, file=sys.stderr, flush=True)


def opensees_python(asked):
    """The interpreter that imports openseespy, or None and the reason."""
    python = asked or sys.executable
    try:
        probe = subprocess.run([python, "-c", "import openseespy.opensees"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, errors="replace", timeout=120)
    except (OSError, subprocess.TimeoutExpired) as problem:
        return None, str(problem)
    if probe.returncode == 0:
        return python, ""
    lines = [line for line in probe.stderr.strip().splitlines() if line]
    return None, "openseespy cannot be imported (%s)" % (lines[-1] if lines else "exit code %d" % probe.returncode)
