// docs/verification.md against the cases of the registry.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>

#include "tests/support/files.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe::test;

TEST_CASE("docs/verification.md is what the verification cases give, to the digits shown") {
  const std::string path = std::string(NSFRAME_SOURCE_DIR) + "/docs/verification.md";
  const std::string document = verification_document();
  if (std::getenv("NSFRAME_WRITE_VERIFICATION")) std::ofstream(path, std::ios::binary) << document;
  CHECK(document_difference(file_text(path), document) == "");
}

TEST_CASE("verification cases have titles of their own") {
  std::set<std::string> titles;
  for (const VerificationCase& one : verification_cases()) CHECK_MESSAGE(titles.insert(one.title).second, one.title);
}

TEST_CASE("documents are the same up to one unit of the last digit shown, and no further") {
  const std::string head = "| quantity | nsframe |\n";
  CHECK(document_difference(head + "| u, mm | 1.2345 | 1.234 | < 1e-6 | 1.0e-05 abs |", head + "| u, mm | 1.2346 | 1.234 | < 1e-6 | 1.0e-05 abs |") == "");
  CHECK(document_difference("| u | 1.2345 | 2 |", "| u | 1.2347 | 2 |") != "");
  CHECK(document_difference("| u | 2.1e-05 | 2 |", "| u | 2.2e-05 | 2 |") == "");
  CHECK(document_difference("| u | 2.1e-05 | 2 |", "| u | 2.1e-04 | 2 |") != "");
  CHECK(document_difference("| u | 1 |", "| v | 1 |") != "");
  const auto of_zero = [](const char* value, const char* difference) { return fmt::format("| error, J | {} | 0 | {} | 1.0e-09 abs |", value, difference); };
  CHECK(document_difference(of_zero("-7.36e-12", "7.4e-12"), of_zero("3.7e-13", "3.7e-13")) == "");
  CHECK(document_difference(of_zero("7.36e-11", "7.4e-11"), of_zero("3.7e-13", "3.7e-13")) != "");
  CHECK(document_difference("a\nb", "a") != "");
  CHECK(document_difference("| u | nan | 2 |", "| u | 1 | 2 |") != "");
}

TEST_CASE("a value beyond its tolerance, or none at all, does not hold") {
  CHECK(VerificationRow{"u", 1.001, 1, relative(1.1e-3)}.holds());
  CHECK_FALSE(VerificationRow{"u", 1.001, 1, relative(0.9e-3)}.holds());
  CHECK(VerificationRow{"u", 10.01, 10, absolute(0.011)}.holds());
  CHECK_FALSE(VerificationRow{"u", 10.01, 10, absolute(0.009)}.holds());
  CHECK_FALSE(VerificationRow{"u", std::nan(""), 10, absolute(1)}.holds());
}
