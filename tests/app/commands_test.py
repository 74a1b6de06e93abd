#!/usr/bin/env python3
"""Runs the built program: exit codes, what it prints where, and the files it leaves."""
import json
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SOURCE = pathlib.Path(sys.argv[2]).resolve()
BALL = SOURCE / "examples/bouncing_ball/scene.toml"
PAIR = SOURCE / "examples/two_story_elastic/scene.toml"
PUSHOVER = SOURCE / "examples/pushover/scene.toml"
CALIBRATION = SOURCE / "examples/calibration/scene.toml"

# A mass on a yielding spring that one Newton iteration cannot follow once it yields.
EULER = """
[section.c]
E = "210 GPa"
G = "81 GPa"
A = 3.142e-3
Iz = 1.033e-5
Iy = 1.033e-5
J = 8e-8
[structure.c]
geometry = "p-delta"
nodes = [[0, 0, 0, 0], [1, 0, 0, 0.625], [2, 0, 0, 1.25], [3, 0, 0, 1.875], [4, 0, 0, 2.5]]
supports = { 0 = "fixed", 1 = ["uy", "rx", "rz"], 2 = ["uy", "rx", "rz"], 3 = ["uy", "rx", "rz"], 4 = ["uy", "rx", "rz"] }
masses = { 4 = 1 }
beams = [[1, 0, 1, "c"], [2, 1, 2, "c"], [3, 2, 3, "c"], [4, 3, 4, "c"]]
[[static]]
loads = [["c.4", "uz", "-1 kN"]]
"""
STUBBORN = """
[material.bilinear]
law = "Steel01"
fy = 1000
E = 1e5
b = 0.01
[structure.s]
nodes = [[1, 0, 0, 0]]
supports = { 1 = ["uy", "uz", "rx", "ry", "rz"] }
masses = { 1 = "100 kg" }
springs = [{ id = "k", nodes = 1, law = { ux = "bilinear" } }]
initial_velocity = [[1, "ux", "1 m/s"]]
[analysis]
dt = "1 ms"
duration = "0.2 s"
max_newton = 1
algorithm = "newton"
newton_tolerance = 1e-12
max_halvings = 0
[output]
history = ["nodes", "energy"]
"""

SECTIONS = """
[material.steel]
law = "ElasticPP"
E = "200 GPa"
epsyP = 1.25e-3
[section.bar]
patches = [{ material = "steel", y = ["-50 mm", "50 mm"], z = ["-10 mm", "10 mm"], ny = 100, nz = 4 }]
GJ = 1e4
[section.constants]
E = "200 GPa"
poisson = 0.3
A = 1e-3
Iz = 1e-6
Iy = 1e-6
J = 1e-6
"""


def matrix_market(path):
    """Size and entries of a Matrix Market file, coordinate or array."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("%")]
    head = [int(word) for word in lines[0].split()]
    if len(head) == 2:
        return head, [float(line) for line in lines[1:]]
    entries = {}
    for line in lines[1:]:
        i, j, value = line.split()
        entries[int(i), int(j)] = float(value)
    assert len(entries) == head[2], f"{path.name}: {head[2]} entries announced, {len(entries)} found"
    return head[:2], entries


class Commands(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def nsframe(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def scene(self, text, name="s.toml"):
        (self.folder / name).write_text(text)
        return self.folder / name

    def summary(self, folder="out"):
        return json.loads((self.folder / folder / "summary.json").read_text())

    def test_a_run_ends_with_0_and_leaves_its_results(self):
        done = self.nsframe("run", BALL, "-o", "out", "--set", "output.frames=0")
        self.assertIn("results in out", done.stdout)
        self.assertEqual(done.stderr, "", "no progress bar when standard error is not a terminal")
        for name in ("summary.json", "results.h5", "scene.toml"):
            self.assertTrue((self.folder / "out" / name).stat().st_size > 0, name)
        self.assertTrue(self.summary()["completed"])

    def test_the_scene_of_a_run_repeats_it(self):
        self.nsframe("run", BALL, "-o", "out", "-q", "--set", "output.frames=0", "--set", "contact.restitution=0.7")
        self.nsframe("run", "out/scene.toml", "-o", "again", "-q")
        first, second = self.summary(), self.summary("again")
        self.assertEqual(first["impacts"], second["impacts"])
        self.assertEqual(first["energy"], second["energy"])

    def test_without_an_output_folder_results_go_below_the_present_one(self):
        self.nsframe("run", BALL, "-q", "--set", "output.frames=0", "--set", "analysis.duration=0.1")
        self.assertTrue((self.folder / "results/bouncing_ball/summary.json").exists())

    def test_quiet_prints_nothing(self):
        for command in ("run", "export"):
            done = self.nsframe(command, BALL, "-o", "out", "--quiet", "--set", "analysis.duration=0.1")
            self.assertEqual(done.stdout + done.stderr, "", command)

    def test_bad_input_ends_with_2_and_says_where(self):
        bad = self.scene("[analysis]\ntheta = 2\nstep = 1\n")
        done = self.nsframe("run", bad, "-o", "out", code=2)
        self.assertEqual(done.stdout, "")
        self.assertIn("s.toml:2:9: error: theta = 2, must lie in [0.5, 1]", done.stderr)
        self.assertIn("s.toml:3:1: error: unknown key 'step'", done.stderr)
        self.assertFalse((self.folder / "out").exists())
        self.nsframe("run", BALL, "--fast", code=2)
        self.nsframe("walk", BALL, code=2)
        self.nsframe("run", code=2)
        self.nsframe(code=2)
        self.nsframe("run", BALL, "--threads", "0", code=2)
        done = self.nsframe("run", BALL, "--set", "analysis.thetta=1", code=2)
        self.assertIn("did you mean 'theta'", done.stderr)
        self.nsframe("run", BALL, "--set", "analysis.theta", code=2)
        self.nsframe("run", BALL, "--set", "analysis.theta=banana", code=2)

    def test_auto_says_which_scheme_it_takes_and_why_and_again_from_the_scene_it_wrote(self):
        self.nsframe("run", BALL, "-o", "out", "-q", "--set", "output.frames=0", "--set", "analysis.scheme=auto", "--set", "analysis.duration=3.5")
        self.nsframe("run", "out/scene.toml", "-o", "again", "-q")
        for folder in ("out", "again"):
            summary = self.summary(folder)
            self.assertEqual(summary["scheme"], "exact")
            self.assertIn("linear", summary["scheme_reason"])
            self.assertGreater(summary["accumulations"]["ended"], 0)
            self.assertLess(summary["accumulations"]["largest_bounce"], 1e-13)
            self.assertEqual(summary["accumulations"]["plastic"], 0)
        text = self.nsframe("check", self.scene(STUBBORN)).stdout
        self.assertIn("scheme moreau-jean: theta = 1", text)
        self.assertIn("analysis.newton_tolerance is an option of this scheme alone", text)
        bare = STUBBORN.replace("max_newton = 1\n", "").replace("newton_tolerance = 1e-12\n", "").replace("max_halvings = 0\n", "")
        text = self.nsframe("check", self.scene(bare)).stdout
        self.assertIn("scheme exponential: dt = 1 ms, 200 steps to 0.2 s", text)
        self.assertIn("chosen because: element 's.k' (spring) is nonlinear", text)
        done = self.nsframe("run", self.scene(STUBBORN), "-o", "no", "--set", "analysis.accuracy=1e-3", code=2)
        self.assertIn("analysis.accuracy needs scheme = \"exponential\", and this run takes moreau-jean", done.stderr)
        done = self.nsframe("run", self.scene(bare.replace('dt = "1 ms"', 'scheme = "exact"')), "-o", "no", code=2)
        self.assertRegex(done.stderr, r"s\.toml:\d+:10: error: scheme 'exact' is for linear scenes, and element 's\.k' \(spring\) is nonlinear")

    def test_fibers_of_an_element_without_are_bad_input_at_their_place(self):
        text = STUBBORN.replace('history = ["nodes", "energy"]', 'history = ["fibers"]\nfibers = ["s.k", "s.j"]')
        done = self.nsframe("run", self.scene(text), "-o", "out", code=2)
        self.assertIn("s.toml:22:10: error: element 's.k' has no fibers", done.stderr)
        self.assertIn("s.toml:22:10: error: there is no element 's.j'; did you mean 's.k'?", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_a_scene_that_is_not_there_is_bad_input(self):
        done = self.nsframe("run", "nowhere.toml", code=2)
        self.assertEqual(done.stderr, "nowhere.toml: error: cannot open the scene\n")

    def test_bad_input_leaves_an_earlier_result_as_it_is(self):
        self.nsframe("run", BALL, "-o", "out", "-q", "--set", "analysis.duration=0.1")
        before = {path.name: (path.read_bytes(), path.stat().st_mtime_ns) for path in (self.folder / "out").iterdir() if path.is_file()}
        self.nsframe("run", BALL, "-o", "out", "--set", "analysis.theta=3", code=2)
        self.nsframe("run", BALL, "-o", "out", "--set", "ball.supports=3", code=2)
        after = {path.name: (path.read_bytes(), path.stat().st_mtime_ns) for path in (self.folder / "out").iterdir() if path.is_file()}
        self.assertEqual(before, after)

    def test_an_unstable_structure_ends_with_2_and_is_named(self):
        text = STUBBORN.replace('springs = [{ id = "k", nodes = 1, law = { ux = "bilinear" } }]', "")
        done = self.nsframe("check", self.scene(text), code=2)
        self.assertIn("s.toml:7:12: error: structure 's' is unstable: node 's.1' moves in ux", done.stderr)

    def test_a_run_that_does_not_converge_ends_with_3_and_keeps_what_it_has(self):
        done = self.nsframe("run", self.scene(STUBBORN), "-o", "out", code=3)
        self.assertRegex(done.stderr, r"error: stopped at t = 0\.\d+ s: the step at t = .* did not converge .*, largest in element 's\.k'")
        self.assertIn("what was computed until then is kept in out", done.stderr)
        summary = self.summary()
        self.assertFalse(summary["completed"])
        self.assertGreater(summary["steps"], 5)
        self.assertLess(summary["steps"], 200)
        content = (self.folder / "out/results.h5").read_bytes()
        self.assertEqual(content[:8], b"\x89HDF\r\n\x1a\n")
        # complete: as long at least as its superblock says (end-of-file address at byte 40 in version 0, 28 in 2 and 3)
        at = 40 if content[8] == 0 else 28
        self.assertLessEqual(int.from_bytes(content[at:at + 8], "little"), len(content))

    def test_a_folder_that_cannot_be_written_ends_with_4(self):
        (self.folder / "file").write_text("")
        done = self.nsframe("run", BALL, "-o", "file/out", code=4)
        self.assertIn("cannot create folder 'file/out'", done.stderr)
        if os.geteuid() == 0:
            return  # root may write everywhere
        locked = self.folder / "locked"
        locked.mkdir()
        locked.chmod(stat.S_IRUSR | stat.S_IXUSR)
        self.nsframe("run", BALL, "-o", "locked", code=4)
        self.nsframe("export", BALL, "-o", "locked/out", code=4)

    def test_check_prints_the_model_in_plain_words(self):
        text = self.nsframe("check", PAIR).stdout
        # HEA100 in its default mesh: 21.24 cm2 of 210 GPa
        self.assertRegex(text, r"section 'column_left': (52 fibers, )?EA 4\.4\d+e\+05 kN, EIz ")
        for words in ("structure 'left': ", "structure 'right': ", "contact pairs: 4", "mode L1", "linear, the iteration matrix is factored once",
                      "scheme moreau-jean: theta = 1, gamma = 1.5, dt = 1 ms, 20000 steps to 20 s"):
            self.assertIn(words, text)

    def test_modes_are_printed_as_a_table_and_as_json(self):
        table = self.nsframe("modes", PAIR).stdout.splitlines()
        modes = json.loads(self.nsframe("modes", PAIR, "--json").stdout)
        self.assertEqual(len(table), 1 + len(modes))
        first = modes[0]
        self.assertEqual((first["structure"], first["mode"]), ("left", "L1"))
        self.assertAlmostEqual(first["frequency"], 2.10, delta=0.005)  # Table 7 of the paper, within 0.2 %
        self.assertAlmostEqual(first["damping_ratio"], 0.007, places=9)
        self.assertEqual(len(first["participation"]), 3)
        for structure in ("left", "right"):
            frequencies = [mode["frequency"] for mode in modes if mode["structure"] == structure]
            self.assertEqual(frequencies, sorted(frequencies))

    def test_export_writes_matrices_of_the_right_sizes(self):
        self.nsframe("export", PAIR, "-o", "out")
        out = self.folder / "out"
        dofs = len((out / "dofs.csv").read_text().splitlines()) - 1
        self.assertIn(f"{dofs} free DOFs", self.nsframe("check", PAIR).stdout)
        matrices = {name: matrix_market(out / f"{name}.mtx") for name in "MCKH"}
        for name in "MCK":
            size, entries = matrices[name]
            self.assertEqual(size, [dofs, dofs], name)
            largest = max(abs(value) for value in entries.values())
            for (i, j), value in entries.items():  # rounding of the assembly
                self.assertLessEqual(abs(value - entries.get((j, i), 0)), 1e-14 * largest, f"{name}({i}, {j})")
        self.assertEqual(matrices["H"][0], [4, dofs])
        self.assertEqual(len((out / "contacts.csv").read_text().splitlines()), 5)
        size, loads = matrix_market(out / "loads.mtx")
        self.assertEqual(size, [dofs, 2])
        self.assertAlmostEqual(sum(loads[dofs:]), -(2 * 4600 + 2 * 3500), delta=1e-8)  # -M iota

    def test_the_expanded_scene_runs_to_the_same_summary(self):
        short = ("--set", "analysis.duration=3 s", "--set", "output.frames=0")
        self.nsframe("export", PAIR, "-o", "out", "-q", *short)
        self.nsframe("run", PAIR, "-o", "one", "-q", *short)
        self.nsframe("run", "out/scene_expanded.toml", "-o", "two", "-q")
        one, two = self.summary("one"), self.summary("two")
        self.assertGreater(len(one["impacts"]), 0)
        for key in set(one) - {"timing", "title"}:
            self.assertEqual(one[key], two[key], key)

    def test_a_section_is_bent_and_its_interaction_found(self):
        scene = self.scene(SECTIONS)
        done = self.nsframe("section", scene, "bar", "--axial", "-200 kN", "--curvature", "1 rad/m", "-o", "out", "--interaction",
                            "--shortening", "0.1", "--elongation", "0.1")
        for words in ("section 'bar': 400 fibers", "first yield of steel", "largest moment", "interaction at the strain limits",
                      "python3 python/plot_section.py out"):
            self.assertIn(words, done.stdout)
        data = json.loads((self.folder / "out/section.json").read_text())
        curve = data["moment_curvature"]
        plastic, squash = 0.02 * 0.1**2 / 4 * 250e6, 0.1 * 0.02 * 250e6
        self.assertAlmostEqual(data["initial_tangent"][0][0], 0.1 * 0.02 * 200e9, delta=1)
        exact = (1 - (200e3 / squash) ** 2) * plastic
        self.assertAlmostEqual(curve["rows"][-1]["moment"], exact, delta=2e-3 * exact)
        self.assertEqual(len(curve["rows"]), 201)
        self.assertEqual(curve["rows"][-1]["curvature"], 1)
        self.assertEqual(len(data["interaction"]), 2)
        rows = (self.folder / "out/moment_curvature.csv").read_text().splitlines()
        self.assertEqual(len(rows), 202)
        self.assertEqual(float(rows[-1].split(",")[1]), curve["rows"][-1]["moment"])
        self.assertEqual(len((self.folder / "out/interaction.csv").read_text().splitlines()), 1 + 2 * 41)

    def test_a_section_answers_in_json_by_angle_and_in_cycles(self):
        scene = self.scene(SECTIONS)
        weak = json.loads(self.nsframe("section", scene, "bar", "--angle", "90", "--curvature", "5", "--json").stdout)
        plastic = 0.1 * 0.02 * 0.02 / 4 * 250e6
        self.assertAlmostEqual(weak["moment_curvature"]["peak"]["moment"], plastic, delta=0.02 * plastic)  # four fibers across
        cyclic = json.loads(self.nsframe("section", scene, "bar", "--cycles", "0.1", "0.2", "--steps", "20", "--json").stdout)
        self.assertEqual([row["curvature"] for row in cyclic["moment_curvature"]["rows"]][20::20], [0.1, -0.1, 0.2, -0.2, 0])
        surface = json.loads(self.nsframe("section", scene, "bar", "--surface", "8", "--points", "5", "--json").stdout)
        self.assertEqual(len(surface["interaction"]), 8)

    def test_a_section_that_cannot_be_analysed_says_why(self):
        scene = self.scene(SECTIONS)
        done = self.nsframe("section", scene, "bra", code=2)
        self.assertIn("section 'bra' is not defined; did you mean 'bar'?", done.stderr)
        self.assertIn("elastic constants only", self.nsframe("section", scene, "constants", code=2).stderr)
        self.assertIn('--axial = "3 m" is a length, must be a force (N)',
                      self.nsframe("section", scene, "bar", "--axial", "3 m", code=2).stderr)
        self.assertIn("no material 'stel'; did you mean 'steel'?",
                      self.nsframe("section", scene, "bar", "--interaction", "--limit", "stel=0.1", code=2).stderr)
        self.assertIn("exclude each other", self.nsframe("section", scene, "bar", "--cycles", "1", "--curvature", "1", code=2).stderr)
        self.assertIn("cannot carry an axial force of -600000 N",
                      self.nsframe("section", scene, "bar", "--axial", "-600000", code=3).stderr)

    def test_a_static_scene_runs_its_stages_and_tells_of_them(self):
        done = self.nsframe("run", PUSHOVER, "-o", "out", "--set", "output.frames=1")
        self.assertIn("Static stage 'push' by displacement: 100 points", done.stdout)
        self.assertNotIn("checkpoint", done.stdout)
        self.assertFalse((self.folder / "out/checkpoint.h5").exists())
        stage = self.summary()["stages"][0]
        self.assertEqual((stage["stage"], stage["at"], stage["completed"]), ("push", "frame.25 ux", True))
        self.assertAlmostEqual(stage["control_displacement"], 0.25, places=12)
        self.nsframe("run", "out/scene.toml", "-o", "again", "-q", "--set", "output.frames=0")
        self.assertEqual(self.summary("again")["stages"], self.summary()["stages"])

    def test_a_stage_that_cannot_go_on_ends_with_3_and_keeps_its_curve(self):
        text = STUBBORN.replace("initial_velocity = [[1, \"ux\", \"1 m/s\"]]", "").replace("max_newton = 1", "") + \
            "[[static]]\nname = \"pull\"\nloads = [[\"s.1\", \"ux\", 1]]\nat = [\"s.1\", \"ux\"]\nto = 1e9\nmax_iterations = 1\n"
        text = text.replace("b = 0.01", "b = -0.01")
        done = self.nsframe("run", self.scene(text), "-o", "out", code=3)
        self.assertIn("error: stopped: stage 'pull' cannot go on from load factor", done.stderr)
        self.assertIn("largest in element 's.k'; tried: newton", done.stderr)
        self.assertFalse(self.summary()["completed"])
        self.assertEqual(self.summary()["steps"], 0)

    def test_a_run_after_stages_resumes_with_the_same_numbers(self):
        text = STUBBORN.replace("initial_velocity = [[1, \"ux\", \"1 m/s\"]]", "").replace("max_newton = 1", "") + \
            "[[static]]\nloads = [[\"s.1\", \"ux\", 1]]\nto = [900, 100]\n[gravity]\ndirection = \"x\"\nacceleration = 0.1\n"
        scene = self.scene(text.replace("newton_tolerance = 1e-12", ""))
        self.nsframe("run", scene, "-o", "whole", "-q")
        self.nsframe("run", scene, "-o", "parts", "-q", "--set", "analysis.duration=0.1")
        self.nsframe("run", scene, "-o", "parts", "-q", "--resume")
        whole, parts = self.summary("whole"), self.summary("parts")
        self.assertEqual(whole["steps"], 200)
        for key in set(whole) - {"timing"}:
            self.assertEqual(whole[key], parts[key], key)

    def test_an_unknown_algorithm_or_control_is_bad_input_by_place(self):
        done = self.nsframe("run", self.scene(STUBBORN.replace('algorithm = "newton"', 'algorithm = ["newton", "krilov"]')), code=2)
        self.assertRegex(done.stderr, r"s.toml:\d+:\d+: error: algorithm 'krilov' is not known; did you mean 'krylov'\?")
        stage = "[[static]]\nmasses = \"x\"\ncontrol = \"displacemnt\"\nat = [\"s.1\", \"ux\"]\nto = 1\n"
        text = STUBBORN.replace("initial_velocity = [[1, \"ux\", \"1 m/s\"]]", "") + stage
        done = self.nsframe("run", self.scene(text), code=2)
        self.assertRegex(done.stderr, r"s.toml:\d+:11: error: control 'displacemnt' is not known; did you mean 'displacement'\?")

    def test_an_unknown_integrator_or_a_parameter_out_of_its_range_is_bad_input_by_place(self):
        def told(lines):
            return self.nsframe("run", self.scene(STUBBORN.replace('algorithm = "newton"', lines)), code=2).stderr
        self.assertRegex(told('integrator = "generalised-alpha"'),
                         r"s.toml:\d+:14: error: integrator 'generalised-alpha' is not known; did you mean 'generalized-alpha'\?")
        self.assertRegex(told('integrator = "alpha-os"\nrho_infinity = 0.3'),
                         r"s.toml:\d+:16: error: rho_infinity = 0.3, must lie in \[0.5, 1\] for integrator \"alpha-os\"")

    def test_a_fault_of_a_contact_law_is_told_once(self):
        for law, words in (("jankovski", "did you mean 'jankowski'?"), ("jankowski", "needs hertz_stiffness")):
            done = self.nsframe("check", BALL, "--set", f"contact.law={law}", code=2)
            self.assertEqual(done.stderr.count(words), 1, done.stderr)
            self.assertEqual(done.stderr.count("error:"), 1, done.stderr)

    def test_buckling_prints_critical_factors_and_writes_shapes(self):
        done = self.nsframe("buckling", PUSHOVER)
        self.assertIn("critical factors of the loads of stage 'push'", done.stdout)
        scene = self.scene(EULER)
        modes = json.loads(self.nsframe("buckling", scene, "--json").stdout)
        # four elements: 1.01291 times Euler's pi^2 EI/(4 L^2), for the load of 1 kN
        self.assertEqual(modes["modes"][0]["structure"], "c")
        self.assertAlmostEqual(modes["modes"][0]["load_factor"] / 867.465841582, 1, delta=2e-6)
        self.nsframe("buckling", scene, "-o", "shapes")
        self.assertTrue((self.folder / "shapes/frames.pvd").exists())

    def test_calibrate_writes_a_scene_that_runs_and_has_the_fitted_frequencies(self):
        self.assertIn("calibration: 13 parameters, 12 frequencies measured", self.nsframe("check", CALIBRATION).stdout)
        text = self.nsframe("calibrate", CALIBRATION, "-o", "out").stdout
        for words in ("converged: ", "structure    mode   measured Hz", "sensitivities d ln f / d ln p", "singular values", "scene.toml, are in out"):
            self.assertIn(words, text)
        result = json.loads((self.folder / "out/calibration.json").read_text())
        self.assertTrue(result["converged"])
        modes = {(m["structure"], m["mode"]): m["frequency"] for m in json.loads(self.nsframe("modes", "out/scene.toml", "--json").stdout)}
        for f in result["frequencies"]:
            self.assertAlmostEqual(modes[f["structure"], f["mode"]], f["fitted"], delta=1e-8 * f["fitted"])
            self.assertLess(abs(f["fitted"] / f["measured"] - 1), 0.01)
        self.assertNotIn("[calibration]", (self.folder / "out/scene.toml").read_text())
        self.nsframe("run", "out/scene.toml", "-o", "run", "-q", "--set", "analysis.duration=3")
        self.assertTrue(self.summary("run")["completed"])

    def test_calibrate_that_does_not_converge_ends_with_3_and_writes_what_it_has(self):
        done = self.nsframe("calibrate", CALIBRATION, "-q", "--set", "calibration.max_iterations=1", code=3)
        self.assertEqual(done.stdout, "")
        self.assertIn("error: the calibration did not converge: no least squares after 1 iteration", done.stderr)
        result = json.loads((self.folder / "results/calibration_calibrated/calibration.json").read_text())
        self.assertFalse(result["converged"])

    def test_bad_calibrations_end_with_2_in_every_command(self):
        done = self.nsframe("calibrate", PAIR, "-o", "out", code=2)
        self.assertIn("scene.toml: error: the scene has no [calibration]", done.stderr)
        for command in ("check", "modes", "calibrate"):
            done = self.nsframe(command, CALIBRATION, "--set", "calibration.parameters.beam_l.sets=section.beam_left.Ix", code=2)
            self.assertIn("section.beam_left.Ix: there is no key 'Ix'; did you mean 'I", done.stderr)
        text = CALIBRATION.read_text().replace('["left", "L1", "2.10 Hz"]', '["left", "L99", "2.10 Hz"]').replace("../motions", str(SOURCE / "examples/motions"))
        done = self.nsframe("calibrate", self.scene(text), "-o", "out", code=2)
        self.assertRegex(done.stderr, r"s\.toml:\d+:12: error: structure 'left' has no mode 'L99' among its \d+ modes")
        self.assertFalse((self.folder / "out").exists())

    def test_reference_prints_the_documentation_of_scenes(self):
        self.assertEqual(self.nsframe("reference").stdout, (SOURCE / "docs/scene-reference.md").read_text())

    def test_help_fits_a_screen(self):
        for arguments in ((), ("run",), ("check",), ("modes",), ("buckling",), ("export",), ("section",), ("reference",)):
            lines = self.nsframe(*arguments, "--help").stdout.splitlines()
            self.assertLessEqual(len(lines), 40, arguments)
            self.assertGreater(len(lines), 2, arguments)
            self.assertLessEqual(max(map(len, lines)), 120, arguments)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
