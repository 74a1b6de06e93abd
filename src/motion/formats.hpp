// The registry of record formats: one file a format, one line in formats.cpp.
#pragma once

#include "motion/lines.hpp"
#include "motion/record.hpp"

namespace nsframe {

// What is known of a file before it is read.
struct FileBeginning {
  std::string extension;  // upper case, ".AT2"
  std::string text;       // first 8 kB, upper case
};

struct RecordFormat {
  const char* name;
  const char* text;  // what it is
  bool (*recognises)(const FileBeginning&);
  // Reads dt and acceleration, in m/s2 when `unit` says so of the file, else sets `unit` to what the file says.
  // dt = 0 or no unit: the file doesn't say. Throws RecordFault.
  struct Reading {
    Record record;  // accelerations in `unit`
    std::optional<AccelerationUnit> unit;
  };
  Reading (*read)(LineReader&, const ReadOptions&);
};

extern const RecordFormat peer_at2, cosmos_v2, csmip_v2, esm_dyna, knet_ascii, plain_text;

// Of the channels of a file that holds several: what each begins with is offered, the chosen one is to be read.
class ChannelChoice {
 public:
  explicit ChannelChoice(const ReadOptions& options) : wanted_(options.channel) {}
  // True for the channel that is to be read. Without a wanted one the first, and a second one is a fault.
  bool offer(const std::string& name, int line);
  void finish(int line) const;  // throws RecordFault when the wanted channel is missing

 private:
  std::optional<int> wanted_;
  int offered_ = 0;
  std::string first_;
};

}  // namespace nsframe
