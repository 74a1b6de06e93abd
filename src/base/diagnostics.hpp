// Collects every error of an input before stopping, each with the place it was read from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nsframe {

// Where a value was read: file (may be empty), line and column from 1; line 0 means "not from a file".
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

// A name that refers to something defined elsewhere, and where the reference was read.
struct Reference {
  std::string name;
  Location at;
};

class Diagnostics {
 public:
  void error(const Location& at, std::string message);
  bool empty() const { return messages_.empty(); }
  const std::vector<std::string>& messages() const { return messages_; }
  // Throws InputError with all messages, in the order of their places; does nothing when there are none.
  void throw_if_any() const;

 private:
  struct Entry {
    Location at;
    std::string text;
  };
  std::vector<Entry> entries_;
  std::vector<std::string> messages_;
};

// The candidate nearest to `name` by edit distance (at most a third of its length, at least 2); empty if none.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

// "; did you mean 'x'?" for the nearest candidate, else "; known: a, b, c" (shortened), else empty.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace nsframe
