#include "study/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace nsframe {

namespace {

std::string joined(const std::vector<std::string>& parts, const char* between) {
  return fmt::format("{}", fmt::join(parts, between));
}

// "dt=1e-3" for "analysis.dt=1e-3".
std::string label(const Combination& settings) {
  std::vector<std::string> parts;
  for (const std::string& text : settings) {
    const std::string key = text.substr(0, text.find('='));
    parts.push_back(key.starts_with("analysis.") ? text.substr(9) : text);
  }
  return parts.empty() ? "the scene as it is" : joined(parts, " ");
}

double relative(const Study& study, const StudyRow& row) {
  const double peak = study.references[static_cast<std::size_t>(row.reference)].peak;
  return peak > 0 ? row.error / peak : 0;
}

// CSV: a field with a comma or a quote is quoted, quotes doubled.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

}  // namespace

std::string study_text(const Study& study) {
  std::string out;
  const auto to = std::back_inserter(out);
  if (!study.title.empty()) fmt::format_to(to, "{}\n", study.title);
  fmt::format_to(to, "\nReferences (own error: difference to a run with twice the step)\n");
  for (std::size_t i = 0; i < study.references.size(); ++i) {
    const StudyReference& r = study.references[i];
    fmt::format_to(to, "  {}  {}, dt {:g} ms, own error {:.1e} m, peak {:.4g} m, {} poundings of {} impacts{}\n", i + 1, r.scheme,
                   1e3 * r.dt, r.own_error, r.peak, r.poundings, r.impacts, r.physics.empty() ? "" : ": " + label(r.physics));
  }
  std::size_t width = 8;
  for (const StudyRow& row : study.rows) width = std::max(width, label(row.settings).size());
  fmt::format_to(to, "\nLargest error of the displacements; poundings matched within 20 ms\n");
  fmt::format_to(to, "  {:<{}}  {:>3}  {:>9}  {:>9}  {:>9}  {:>7}  {:>7}  {:>6}  {:>5}  {:>8}\n", "settings", width, "ref", "error, m",
                 "of peak", "loop, s", "impacts", "matched", "missed", "extra", "added, %");
  for (const StudyRow& row : study.rows) {
    if (!row.failure.empty()) {
      fmt::format_to(to, "  {:<{}}  {:>3}  {}\n", label(row.settings), width, row.reference + 1, row.failure);
      continue;
    }
    fmt::format_to(to, "  {:<{}}  {:>3}  {:>9.2e}  {:>9.1e}  {:>9.2e}  {:>7}  {:>7}  {:>6}  {:>5}  {:>8.3f}\n", label(row.settings),
                   width, row.reference + 1, row.error, relative(study, row), row.seconds, row.impacts, row.poundings.matched,
                   row.poundings.missed, row.poundings.extra, 100 * row.added_damping);
  }
  return out;
}

std::string study_csv(const Study& study) {
  std::string out;
  std::vector<std::string> keys;
  if (!study.rows.empty()) {
    for (const std::string& text : study.rows.front().settings) keys.push_back(field(text.substr(0, text.find('='))));
  }
  for (const std::string& key : keys) out += key + ",";
  out += "reference,error_m,error_of_peak,reference_own_error_m,step_loop_s,steps,impacts,poundings_matched,poundings_missed,"
         "poundings_extra,added_damping,failure\n";
  for (const StudyRow& row : study.rows) {
    for (const std::string& text : row.settings) out += field(text.substr(text.find('=') + 1)) + ",";
    if (!row.failure.empty()) {
      out += fmt::format("{},,,,,,,,,,,{}\n", row.reference + 1, field(row.failure));
      continue;
    }
    out += fmt::format("{},{:.9g},{:.9g},{:.3g},{:.6g},{},{},{},{},{},{:.6g},\n", row.reference + 1, row.error, relative(study, row),
                       study.references[static_cast<std::size_t>(row.reference)].own_error, row.seconds, row.steps, row.impacts,
                       row.poundings.matched, row.poundings.missed, row.poundings.extra, row.added_damping);
  }
  return out;
}

std::string study_json(const Study& study) {
  using Json = nlohmann::ordered_json;
  Json references = Json::array(), rows = Json::array();
  for (const StudyReference& r : study.references) {
    references.push_back({{"physics", r.physics}, {"scheme", r.scheme}, {"dt", r.dt}, {"own_error", r.own_error}, {"peak", r.peak},
                          {"impacts", r.impacts}, {"poundings", r.poundings}});
  }
  for (const StudyRow& row : study.rows) {
    Json settings = Json::object();
    for (const std::string& text : row.settings) settings[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
    Json json{{"settings", settings}, {"reference", row.reference}, {"scheme", row.scheme}};
    if (!row.failure.empty()) {
      json["failure"] = row.failure;
    } else {
      json.update({{"error", row.error}, {"error_of_peak", relative(study, row)}, {"step_loop", row.seconds}, {"steps", row.steps},
                   {"impacts", row.impacts}, {"poundings_matched", row.poundings.matched},
                   {"poundings_missed", row.poundings.missed}, {"poundings_extra", row.poundings.extra},
                   {"added_damping", row.added_damping}});
    }
    rows.push_back(json);
  }
  return Json{{"title", study.title}, {"references", references}, {"runs", rows}}.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace nsframe
