// A record as PEER AT2: four lines of header, five values a line in units of g, eight digits.
#pragma once

#include <string>

#include "motion/record.hpp"

namespace nsframe {

// `title` on the first line, the record's description on the second; line breaks in them become blanks.
std::string at2_text(const Record& record, const std::string& title);

}  // namespace nsframe
