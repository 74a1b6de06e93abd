// Cases whose values are published or known in closed form: each is a test, and a chapter of docs/verification.md.
//
// A case is one function:
//
//   VERIFICATION_CASE("Modes", "Bathe-Wilson frame", "What is modelled, and where the values come from.") {
//     rows.add("lambda 1, 1/s2", our_value, 0.589541, relative(1e-5));
//   }
//
// It fails when a value is further from its reference than its tolerance. The table is written anew by
//
//   NSFRAME_WRITE_VERIFICATION=1 build/tests/test_verification -tc="docs/verification.md*"
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace nsframe::test {

struct Tolerance {
  double value;
  bool relative;
};
inline Tolerance relative(double value) { return {value, true}; }
inline Tolerance absolute(double value) { return {value, false}; }

struct VerificationRow {
  std::string quantity;   // with its unit
  double value, reference;
  Tolerance tolerance;
  // Difference as the tolerance means it: relative to the reference, or absolute.
  double difference() const;
  bool holds() const { return difference() <= tolerance.value; }  // false for NaN
};

class VerificationRows {
 public:
  void add(std::string quantity, double value, double reference, Tolerance tolerance) {
    rows_.push_back({std::move(quantity), value, reference, tolerance});
  }
  const std::vector<VerificationRow>& all() const { return rows_; }

 private:
  std::vector<VerificationRow> rows_;
};

struct VerificationCase {
  std::string chapter, title, text;
  void (*fill)(VerificationRows& rows);
};

// Every case of the program, chapter by chapter, by title within.
std::vector<VerificationCase> verification_cases();
bool register_case(VerificationCase one);
void check_case(const char* title, void (*fill)(VerificationRows& rows));

// docs/verification.md from all cases.
std::string verification_document();

// What differs between two documents, line by line, empty when nothing does. Numbers may differ by one unit of the last
// digit shown.
std::string document_difference(const std::string& one, const std::string& other);

}  // namespace nsframe::test

#define VERIFICATION_CASE_NAMED(name, chapter, title, text)                                                       \
  static void name(nsframe::test::VerificationRows& rows);                                                        \
  [[maybe_unused]] static const bool name##_registered = nsframe::test::register_case({chapter, title, text, name}); \
  TEST_CASE(title) { nsframe::test::check_case(title, name); }                                                    \
  static void name(nsframe::test::VerificationRows& rows)
#define VERIFICATION_CASE_EXPANDED(name, chapter, title, text) VERIFICATION_CASE_NAMED(name, chapter, title, text)
#define VERIFICATION_CASE(chapter, title, text) \
  VERIFICATION_CASE_EXPANDED(DOCTEST_ANONYMOUS(verification_case_), chapter, title, text)
