#include "report/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <unordered_map>

#include "base/errors.hpp"

namespace nsframe {
namespace {

nlohmann::json read_summary(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw InputError(fmt::format("error: there is no folder '{}'", folder.string()));
  const std::filesystem::path path = folder / "summary.json";
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InputError(
        fmt::format("error: '{}' has no summary.json: name a folder that nsframe run has written", folder.string()));
  }
  nlohmann::json summary = nlohmann::json::parse(stream, nullptr, false);
  if (summary.is_discarded() || !summary.is_object() || summary.value("program", "") != "nsframe") {
    throw InputError(fmt::format("error: '{}' is not a summary of nsframe", path.string()));
  }
  return summary;
}

std::filesystem::path results_in(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "results.h5";
  if (!std::filesystem::exists(path)) throw InputError(fmt::format("error: '{}' has no results.h5", folder.string()));
  return path;
}

// [first[i], first[i + 1]) of `values`, for each i.
std::vector<std::vector<int>> ragged(const std::vector<int>& values, const std::vector<int>& first) {
  std::vector<std::vector<int>> lists;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) lists.emplace_back(values.begin() + first[i], values.begin() + first[i + 1]);
  return lists;
}

void read_members(const Hdf5Reader& results, DrawnModel& model) {
  const std::vector<std::string> ids = results.texts("/model/members/id");
  const std::vector<int> nodes = results.integers("/model/members/nodes"), curved = results.integers("/model/members/curved");
  const std::vector<double> ends = results.numbers("/model/members/ends");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    DrawnModel::Member member{ids[i], {nodes[2 * i], nodes[2 * i + 1]}, {}, curved[i] != 0};
    std::copy_n(ends.begin() + static_cast<std::ptrdiff_t>(6 * i), 6, member.ends);
    model.members.push_back(std::move(member));
  }
}

DrawnModel read_model(const Hdf5Reader& results) {
  if (!results.has("/model/nodes/id")) {
    throw InputError(
        fmt::format("error: '{}' has no group /model: an earlier nsframe wrote it; run the scene again", results.path().string()));
  }
  DrawnModel model;
  model.structures = results.texts("/model/structures");
  model.nodes = results.texts("/model/nodes/id");
  model.position = results.numbers("/model/nodes/position");
  model.structure = results.integers("/model/nodes/structure");
  read_members(results, model);
  model.slabs = ragged(results.integers("/model/slabs/corner"), results.integers("/model/slabs/first"));
  const std::vector<int> structures = results.integers("/model/floors/structure");
  const std::vector<double> levels = results.numbers("/model/floors/level");
  auto nodes = ragged(results.integers("/model/floors/node"), results.integers("/model/floors/first"));
  for (std::size_t i = 0; i < levels.size(); ++i) model.floors.push_back({structures[i], levels[i], std::move(nodes[i])});
  const std::vector<double> positions = results.numbers("/model/pairs/position"), normals = results.numbers("/model/pairs/normal");
  std::vector<double> gaps(positions.size() / 3, 0);
  if (results.has("/model/pairs/gap")) gaps = results.numbers("/model/pairs/gap");
  const std::vector<int> sides = results.integers("/model/pairs/structures");
  for (std::size_t i = 0; 3 * i < positions.size(); ++i) {
    model.pairs.push_back({{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]},
                           {normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]},
                           gaps[i],
                           {sides[2 * i], sides[2 * i + 1]}});
  }
  return model;
}

}  // namespace

RunFolder::RunFolder(const std::filesystem::path& folder)
    : summary(read_summary(folder)), results(results_in(folder)), model(read_model(results)) {
  if (!results.has("/time")) return;  // static stages only
  time = results.numbers("/time");
  if (!results.has("/nodes/id")) return;
  std::unordered_map<std::string, int> index;
  for (std::size_t i = 0; i < model.size(); ++i) index[model.nodes[i]] = static_cast<int>(i);
  for (const std::string& id : results.texts("/nodes/id")) recorded.push_back(index.at(id));
}

void RunFolder::limit(double from, double to) {
  const auto first = std::lower_bound(time.begin(), time.end(), from - 1e-9), last = std::upper_bound(first, time.end(), to + 1e-9);
  if (last - first < 2) {
    const std::string had = time.empty() ? "none" : fmt::format("{:g} to {:g} s", time.front(), time.back());
    throw InputError(fmt::format("error: no histories from {:g} to {:g} s; the results have {}", from, to, had));
  }
  first_row = static_cast<std::size_t>(first - time.begin());
  time = {first, last};
}

}  // namespace nsframe
