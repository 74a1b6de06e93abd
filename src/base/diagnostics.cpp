#include "base/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/errors.hpp"

namespace nsframe {

void Diagnostics::error(const Location& at, std::string message) {
  std::string text;
  if (!at.file.empty()) text += at.file + ":";
  if (at.line > 0) text += fmt::format("{}:{}:", at.line, at.column);
  text += (text.empty() ? "error: " : " error: ") + std::move(message);
  // one mistake of a file may concern many members
  const auto same = [&](const Entry& told) { return told.text == text; };
  if (!at.file.empty() && std::any_of(entries_.begin(), entries_.end(), same)) return;
  entries_.push_back({at, text});
  messages_.push_back(std::move(text));
}

void Diagnostics::throw_if_any() const {
  if (entries_.empty()) return;
  std::vector<std::size_t> order(entries_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
    const Location &first = entries_[a].at, &second = entries_[b].at;
    return std::tie(first.file, first.line, first.column) < std::tie(second.file, second.line, second.column);
  });
  std::string all;
  for (const std::size_t i : order) {
    if (!all.empty()) all += '\n';
    all += entries_[i].text;
  }
  throw InputError(all);
}

namespace {

// Edit distance with transpositions of neighbours (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

}  // namespace

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(lower(name), lower(candidate));
    if (distance < least && distance < std::max(name.size(), candidate.size())) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "";
  if (const std::string best = nearest(name, candidates); !best.empty()) return fmt::format("; did you mean '{}'?", best);
  constexpr std::size_t shown = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(shown, candidates.size()); ++i) list += (i ? ", " : "") + candidates[i];
  return "; known: " + list + (candidates.size() > shown ? fmt::format(" and {} more", candidates.size() - shown) : "");
}

}  // namespace nsframe
