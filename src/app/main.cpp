#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <functional>

#include "app/commands.hpp"
#include "app/motion.hpp"
#include "app/plot.hpp"
#include "app/report.hpp"
#include "app/section.hpp"
#include "app/study.hpp"
#include "base/errors.hpp"

namespace nsframe::app {

namespace {

CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& text, SceneArguments& arguments) {
  CLI::App* command = program.add_subcommand(name, text);
  command->add_option("scene", arguments.scene, "scene file (TOML)")->required();
  command->add_option("--set", arguments.set, "key=value: change a value of the scene, e.g. --set contact.restitution=0.5")
      ->allow_extra_args(false);
  command->add_option("--threads", arguments.threads, "threads for nonlinear elements and large structures (default: the scene's, 1)")
      ->check(CLI::Range(1, 1024));
  return command;
}

void add_section_command(CLI::App& program, SectionArguments& a, std::function<int()>& command) {
  CLI::App* c = program.add_subcommand("section", "moment-curvature and interaction curves of a section");
  c->add_option("scene", a.scene.scene, "scene file (TOML)")->required();
  c->add_option("section", a.section, "name of the section")->required();
  c->add_option("--set", a.scene.set, "key=value: change a value of the scene")->allow_extra_args(false);
  c->add_option("--axial", a.axial, "axial force held, tension positive, as \"-500 kN\" (default: 0)");
  c->add_option("--angle", a.angle, "axis of bending: 0 about z (default), 90 about y; degrees");
  c->add_option("--curvature", a.curvature, "to reach, as \"0.05 rad/m\" (default: 0.03 over the depth)");
  c->add_option("--cycles", a.cycles, "amplitudes of cycles in place of --curvature");
  c->add_option("--steps", a.steps, "to the curvature, or from peak to peak (default: 200)")->check(CLI::Range(1, 1000000));
  c->add_flag("--free", a.free_axis, "let the axis turn: no moment across (default: no curvature across)");
  c->add_flag("--interaction", a.interaction, "axial force and moment at the strain limits, for the angle and its opposite");
  c->add_option("--surface", a.surface, "the same for so many angles around")->check(CLI::Range(1, 360));
  c->add_option("--points", a.points, "of an interaction curve (default: 41)")->check(CLI::Range(3, 10000));
  c->add_option("--shortening", a.shortening, "strain limit of all materials (default: 0.0035)");
  c->add_option("--elongation", a.elongation, "the same in tension (default: 0.01)");
  c->add_option("--limit", a.limits, "strain limit of a material: C30=-0.0035 shortening, S500=0.05 elongation")
      ->allow_extra_args(false);
  c->add_option("-o,--output", a.scene.output, "folder for section.json, moment_curvature.csv, interaction.csv");
  c->add_flag("--json", a.scene.json, "print JSON");
  c->callback([&] { command = [&] { return section(a); }; });
}

void add_study_command(CLI::App& program, StudyArguments& a, std::function<int()>& command) {
  CLI::App* c = program.add_subcommand("study", "error against time of a scene over dt, scheme, ... against a converged reference");
  c->add_option("scene", a.scene.scene, "scene file (TOML)")->required();
  c->add_option("--set", a.scene.set, "key=value: change a value of the scene in all runs")->allow_extra_args(false);
  c->add_option("--vary", a.vary, "key=value,value,key=value,...: all combinations are run; short keys: dt, scheme, theta, gamma, "
                                  "restitution, pga, duration")
      ->required()
      ->allow_extra_args(false)
      ->delimiter('\0');
  c->add_option("--repeat", a.repeat, "runs of each combination; the least time counts (default: 1)")->check(CLI::Range(1, 1000));
  c->add_option("-o,--output", a.scene.output, "folder for study.csv, study.json, study.svg (default: results/<name of the scene>)");
  std::string schemes;
  for (const std::string& name : scheme_names()) schemes += " " + name;
  c->footer("Schemes:" + schemes + "\nThe reference is the first of exact, exponential, moreau-jean that takes the scene, at halved steps "
            "until two\nsuccessive runs agree; its own error, their difference, is printed.");
  c->callback([&] { command = [&] { return study(a); }; });
}

void add_report_command(CLI::App& program, ReportArguments& a, std::function<int()>& command) {
  CLI::App* c = program.add_subcommand("report", "the results of a run as one HTML page that works offline");
  c->add_option("folder", a.folder, "folder that nsframe run has written")->required();
  c->add_option("-o,--output", a.output, "file (default: report.html in the folder)");
  c->footer("Histories are drawn as far as the run kept them: history = [\"nodes\", \"contacts\", \"energy\", \"ground\"] and floor_spectra\n"
            "in [output] of the scene.");
  c->callback([&] { command = [&] { return report(a); }; });
}

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return bad_input;
  } catch (const ConvergenceError& problem) {
    fmt::print(stderr, "error: {}\n", problem.what());
    return not_converged;
  } catch (const IoError& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return input_output;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "error: {} (this is a defect of nsframe; please report it)\n", problem.what());
    return defect;
  }
}

int program(int count, char** values) {
  CLI::App program{"nsframe: pounding of 3D fiber frames by non-smooth contact dynamics"};
  program.set_version_flag("--version", std::string("nsframe ") + NSFRAME_VERSION);
  program.require_subcommand(1);
  SceneArguments arguments;
  std::function<int()> command;
  CLI::App* run_command = add_command(program, "run", "run a scene; writes summary.json, results.h5, frames.pvd", arguments);
  run_command->add_option("-o,--output", arguments.output, "folder of the results (default: results/<name of the scene>)");
  run_command->add_flag("-q,--quiet", arguments.quiet, "print errors only");
  run_command->add_flag("--resume", arguments.resume,
                        "go on from checkpoint.h5 in the folder of the results, also to a longer analysis.duration");
  run_command->footer("Exit code: 0 done, 2 bad input, 3 did not converge, 4 files, 130 interrupted (143 by SIGTERM).\n"
                      "After 3, 130, 143 or a crash, the same command with --resume goes on with the same bits.");
  run_command->callback([&] { command = [&] { return run(arguments); }; });
  CLI::App* check_command = add_command(program, "check", "validate a scene and print its model", arguments);
  check_command->callback([&] { command = [&] { return check(arguments); }; });
  CLI::App* modes_command = add_command(program, "modes", "frequencies, damping, participation; mode shapes with -o", arguments);
  modes_command->add_option("-o,--output", arguments.output, "folder for the mode shapes (VTK)");
  modes_command->add_flag("--json", arguments.json, "print JSON");
  modes_command->callback([&] { command = [&] { return modes(arguments); }; });
  CLI::App* calibrate_command = add_command(program, "calibrate", "fit parameters of a scene to measured frequencies ([calibration])", arguments);
  calibrate_command->add_option("-o,--output", arguments.output,
                                "folder for calibration.json and the fitted scene.toml (default: results/<name of the scene>_calibrated)");
  calibrate_command->add_flag("-q,--quiet", arguments.quiet, "print errors only");
  calibrate_command->footer("Exit code: 0 fitted, 2 bad input, 3 not converged or a measured mode without a match (files are written all the same).");
  calibrate_command->callback([&] { command = [&] { return calibrate(arguments); }; });
  CLI::App* buckling_command = add_command(
      program, "buckling", "critical factors of the last static stage's loads, or of gravity; shapes with -o", arguments);
  buckling_command->add_option("-o,--output", arguments.output, "folder for the buckling shapes (VTK)");
  buckling_command->add_flag("--json", arguments.json, "print JSON");
  buckling_command->callback([&] { command = [&] { return buckling(arguments); }; });
  CLI::App* export_command = add_command(program, "export", "matrices (Matrix Market) and the expanded scene", arguments);
  export_command->add_option("-o,--output", arguments.output, "folder (default: results/<name of the scene>)");
  export_command->add_flag("-q,--quiet", arguments.quiet, "print errors only");
  export_command->callback([&] { command = [&] { return export_matrices(arguments); }; });
  SectionArguments section_arguments;
  add_section_command(program, section_arguments, command);
  StudyArguments study_arguments;
  add_study_command(program, study_arguments, command);
  add_motion_command(program, command);
  add_spectrum_command(program, command);
  ReportArguments report_arguments;
  add_report_command(program, report_arguments, command);
  add_plot_command(program, command);
  program.add_subcommand("reference", "print the scene reference (docs/scene-reference.md)")->callback([&] {
    command = reference;
  });
  try {
    program.parse(count, values);
  } catch (const CLI::ParseError& problem) {
    return program.exit(problem) == 0 ? done : bad_input;
  }
  return guarded(command);
}

}  // namespace

}  // namespace nsframe::app

int main(int count, char** values) { return nsframe::app::program(count, values); }
