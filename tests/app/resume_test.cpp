// A run that stops and goes on gives the files of one that doesn't. The program is run as a user would.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/files.hpp"
#include "tests/support/hdf5_contents.hpp"

using namespace nsframe::test;

namespace {

using Words = std::vector<std::string>;

std::string scene(const std::string& name) { return std::string(NSFRAME_SOURCE_DIR) + "/examples/" + name + "/scene.toml"; }

// Starts `nsframe run`; what it prints goes to `folder`/printed.
pid_t start(const std::filesystem::path& folder, const std::string& name, Words more) {
  Words words{NSFRAME_PROGRAM, "run", scene(name), "-q", "-o", (folder / "run").string()};
  words.insert(words.end(), more.begin(), more.end());
  const pid_t child = fork();
  if (child != 0) return child;
  const int file = open((folder / "printed").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(NSFRAME_PROGRAM, arguments.data());
  _exit(127);
}

int exit_code(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int run(const TemporaryFolder& folder, const std::string& name, const Words& more) {
  return exit_code(start(folder.path(), name, more));
}

Words duration(const std::string& value, Words more = {}) {
  more.insert(more.end(), {"--set", "analysis.duration=" + value, "--set", "output.history=[\"nodes\", \"contacts\", \"elements\", \"sections\", \"fibers\", \"energy\", \"ground\"]"});
  return more;
}

nlohmann::json summary_without_timing(const std::filesystem::path& folder) {
  nlohmann::json summary = nlohmann::json::parse(file_text(folder / "summary.json"));
  summary.erase("timing");
  return summary;
}

void check_same_results(const TemporaryFolder& one, const TemporaryFolder& other) {
  check_same_contents(one / "run/results.h5", other / "run/results.h5");
  CHECK(summary_without_timing(one / "run") == summary_without_timing(other / "run"));
  const Words apart{"results.h5", "summary.json", "checkpoint.h5"};
  const auto a = files_below(one / "run", apart), b = files_below(other / "run", apart);
  CHECK(a.size() > 20);  // frames, their list, the script and the scene
  CHECK(a.size() == b.size());
  for (const auto& [name, text] : a) CHECK_MESSAGE((b.count(name) == 1 && b.at(name) == text), name);
}

// The duration has impacts in it.
struct Case {
  std::string name, duration;
};
const std::vector<Case> cases{{"two_story_elastic", "6 s"}, {"linear_dampers", "5 s"}, {"two_story", "3 s"}};

}  // namespace

TEST_CASE("a run stopped by SIGTERM and resumed gives the files of an uninterrupted one bit by bit") {
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const TemporaryFolder whole, parts;
    REQUIRE(run(whole, c.name, duration(c.duration)) == 0);
    CHECK(!summary_without_timing(whole / "run")["impacts"].empty());
    // a checkpoint after every step makes the run slow, so that it is stopped in its middle
    const pid_t child = start(parts.path(), c.name, duration(c.duration, {"--set", "output.checkpoint=1e-9"}));
    while (!std::filesystem::exists(parts / "run/checkpoint.h5")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    kill(child, SIGTERM);
    CHECK(exit_code(child) == 128 + SIGTERM);
    const auto stopped = summary_without_timing(parts / "run");
    CHECK(stopped["completed"] == false);
    CHECK(stopped["stop_reason"] == "interrupted");
    CHECK(stopped["steps"] > 1);
    CHECK(file_text(parts / "printed").find("--resume") != std::string::npos);
    CHECK(run(parts, c.name, duration(c.duration, {"--resume"})) == 0);
    check_same_results(whole, parts);
  }
}

TEST_CASE("a completed run resumed to a longer duration gives the files of a long run bit by bit") {
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const TemporaryFolder whole, parts;
    REQUIRE(run(whole, c.name, duration(c.duration)) == 0);
    CHECK(run(parts, c.name, duration("1.2345 s")) == 0);
    CHECK(run(parts, c.name, duration("2.7 s", {"--resume"})) == 0);
    CHECK(run(parts, c.name, duration(c.duration, {"--resume"})) == 0);
    check_same_results(whole, parts);
    CHECK(run(parts, c.name, duration(c.duration, {"--resume"})) == 0);  // nothing is left to do
    check_same_results(whole, parts);
  }
}

TEST_CASE("a run with condensed DOFs and moved supports goes on bit by bit, and its files have every DOF") {
  for (const Case& c : {Case{"two_story_elastic", "3.5 s"}, Case{"wave_passage", "3 s"}}) {
    CAPTURE(c.name);
    const Words stepped{"--set", "analysis.scheme=moreau-jean"};
    const auto with = [&](Words words) {
      words.insert(words.end(), stepped.begin(), stepped.end());
      return words;
    };
    const TemporaryFolder whole, parts;
    REQUIRE(run(whole, c.name, duration(c.duration, stepped)) == 0);
    const auto summary = summary_without_timing(whole / "run");
    CHECK(summary["savings"]["condensed_dofs"] > 0);
    CHECK(summary["dofs"] > summary["savings"]["condensed_dofs"]);
    CHECK(run(parts, c.name, duration("1.2345 s", stepped)) == 0);
    CHECK(run(parts, c.name, duration(c.duration, with({"--resume"}))) == 0);
    check_same_results(whole, parts);
  }
}

TEST_CASE("--resume refuses what it cannot go on from, and leaves the results as they are") {
  const TemporaryFolder folder;
  const std::string name = "two_story_elastic";
  const auto refused = [&](const Words& more, int code, const std::string& reason) {
    const auto before = files_below(folder.path(), {"printed"});
    CHECK(run(folder, name, more) == code);
    const std::string printed = file_text(folder / "printed");
    CHECK_MESSAGE(printed.find(reason) != std::string::npos, printed);
    CHECK(files_below(folder.path(), {"printed"}) == before);
  };
  refused(duration("1 s", {"--resume"}), 2, "nothing to resume");
  REQUIRE(run(folder, name, duration("1 s")) == 0);
  refused(duration("2 s", {"--resume", "--set", "analysis.dt=2 ms"}), 2, "in [analysis], `dt = 0.001` is now `dt = 0.002`");
  refused(duration("2 s", {"--resume", "--set", "contact.restitution=0.1"}), 2, "restitution");
  refused(duration("0.5 s", {"--resume"}), 2, "beyond the duration");
  std::string bytes = file_text(folder / "run/checkpoint.h5");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder / "run/checkpoint.h5", std::ios::binary) << bytes;
  refused(duration("2 s", {"--resume"}), 4, "damaged");
  std::ofstream(folder / "run/checkpoint.h5", std::ios::binary) << bytes.substr(0, bytes.size() / 3);
  refused(duration("2 s", {"--resume"}), 4, "damaged");
}
