#include "app/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <string_view>
#include <vector>

#include "base/errors.hpp"

namespace nsframe::app {

namespace {

constexpr std::array<std::string_view, 3> free_keys{"analysis.duration", "analysis.threads", "output.checkpoint"};

struct SceneLine {
  std::string table, text;
};

// The lines of a complete scene that a resumed run must share.
std::vector<SceneLine> binding_lines(std::string_view scene) {
  std::vector<SceneLine> lines;
  std::string table;
  while (!scene.empty()) {
    const std::size_t end = std::min(scene.find('\n'), scene.size());
    const std::string line(scene.substr(0, end));
    scene.remove_prefix(std::min(end + 1, scene.size()));
    if (line.empty()) continue;
    if (line.front() == '[') table = line.substr(0, line.find(']') + 1);
    const std::string key = table.size() < 2 ? "" : table.substr(1, table.size() - 2) + "." + line.substr(0, line.find(' '));
    if (std::find(free_keys.begin(), free_keys.end(), key) == free_keys.end()) lines.push_back({table, line});
  }
  return lines;
}

// Where two scenes part, in words; empty when they don't.
std::string difference(const std::string& before, const std::string& now) {
  const std::vector<SceneLine> old_lines = binding_lines(before), new_lines = binding_lines(now);
  const std::size_t common = std::min(old_lines.size(), new_lines.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (old_lines[i].text == new_lines[i].text) continue;
    return fmt::format("in {}, `{}` is now `{}`", old_lines[i].table, old_lines[i].text, new_lines[i].text);
  }
  if (old_lines.size() == new_lines.size()) return "";
  const bool longer = new_lines.size() > old_lines.size();
  const SceneLine& line = longer ? new_lines[common] : old_lines[common];
  return fmt::format("in {}, `{}` is {}", line.table, line.text, longer ? "new" : "gone");
}

volatile std::sig_atomic_t received_signal = 0;

void note(int signal) { received_signal = signal; }

void handle(void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Checkpoint checkpoint_to_resume(const std::filesystem::path& folder, const std::string& scene) {
  const std::filesystem::path path = folder / "checkpoint.h5";
  if (!std::filesystem::exists(path)) {
    throw InputError(fmt::format("error: nothing to resume: there is no '{}'; run without --resume", path.string()));
  }
  Checkpoint checkpoint = read_checkpoint(path);
  if (checkpoint.version != NSFRAME_VERSION) {
    throw InputError(fmt::format("error: '{}' was written by nsframe {}, this is {}: run again without --resume",
                                 path.string(), checkpoint.version, NSFRAME_VERSION));
  }
  if (const std::string where = difference(checkpoint.scene, scene); !where.empty()) {
    throw InputError(fmt::format("error: the scene is not that of '{}': {}; only analysis.duration, analysis.threads and "
                                 "output.checkpoint may change. Run without --resume",
                                 path.string(), where));
  }
  return checkpoint;
}

SignalWatch::SignalWatch() {
  received_signal = 0;
  handle(note, static_cast<int>(SA_RESETHAND));
}

SignalWatch::~SignalWatch() { handle(SIG_DFL, 0); }

int SignalWatch::received() { return received_signal; }

}  // namespace nsframe::app
