// sofof report: shows results folders as one HTML file.
#include "apps/command.hpp"
#include "scenario/report/describe.hpp"
#include "scenario/report/html.hpp"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace sofof {

namespace {

struct report_arguments {
  std::vector<std::string> folders;
  std::string out;

  /// @returns where it was written to.
  std::filesystem::path obey() const {
    const std::vector<std::filesystem::path> from(folders.begin(),
                                                  folders.end());
    const auto to =
        out.empty() ? from.front() / "report.html" : std::filesystem::path{out};
    report::write_html(report::describe(from, SOFOF_VERSION), to);
    return to;
  }
};

} // namespace

void add_report(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "report", "Show results folders as one HTML file, for any browser");
  auto args = std::make_shared<report_arguments>();
  command->add_option("DIR", args->folders, "Results folders of runs")
      ->required()
      ->type_name(" ");
  command
      ->add_option("-o,--out", args->out,
                   "The file (default report.html in the first folder)")
      ->type_name("FILE");
  command->footer("One folder is shown by itself, two side by side, more one "
                  "after the other.\nExample:\n  sofof report "
                  "results/ulm_lehr-1 -o report.html");
  command->callback(
      [args] { std::cout << "report in " << args->obey().string() << '\n'; });
}

} // namespace sofof
