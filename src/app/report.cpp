// nsframe report: the results of a run as one HTML page.
#include "app/report.hpp"

#include <fmt/format.h>

#include "output/files.hpp"
#include "report/page.hpp"

namespace nsframe::app {

int report(const ReportArguments& arguments) {
  const std::filesystem::path target = arguments.output.empty() ? arguments.folder / "report.html" : arguments.output;
  const std::string page = report_page(arguments.folder);
  write_text_file(target, page);
  fmt::print("{} ({:.1f} MB): open it in a browser\n", target.string(), 1e-6 * static_cast<double>(page.size()));
  return done;
}

}  // namespace nsframe::app
