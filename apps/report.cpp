// sofof report: shows results folders as one HTML file.
#include "apps/command.hpp"
#include "base/input_error.hpp"
#include "experiments/dehler2025/describe_sweep.hpp"
#include "experiments/report/describe.hpp"
#include "experiments/report/html.hpp"
#include "recording/results_folder.hpp"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace sofof::apps {

namespace {

struct report_arguments {
  std::vector<std::string> folders;
  std::string out;

  /// A report must not take the place of what it is about.
  static void check(const std::filesystem::path& to,
                    const std::vector<std::filesystem::path>& from) {
    for (const auto& folder : from)
      if (recording::is_result(to, folder))
        throw input_error(to.string()
                          + " is one of the run's results; choose another "
                            "file with -o");
  }

  static experiments::report::document
  what(const std::vector<std::filesystem::path>& from) {
    if (from.size() == 1 && experiments::study::is_sweep_folder(from.front()))
      return experiments::study::describe_sweeps(from.front(), SOFOF_VERSION);
    return experiments::report::describe(from, SOFOF_VERSION);
  }

  /// @returns where it was written to.
  std::filesystem::path obey() const {
    const std::vector<std::filesystem::path> from(folders.begin(),
                                                  folders.end());
    // A reproduction has its own report.html.
    const auto* name = experiments::study::is_sweep_folder(from.front())
                           ? "sweeps.html"
                           : "report.html";
    auto to = out.empty() ? from.front() / name : std::filesystem::path{out};
    check(to, from);
    experiments::report::write_html(what(from), to);
    return to;
  }
};

} // namespace

void add_report(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "report", "Show results folders as one HTML file, for any browser");
  auto args = std::make_shared<report_arguments>();
  command
      ->add_option("DIR", args->folders,
                   "Results folders of runs, or one of sweeps")
      ->required()
      ->type_name(" ");
  command
      ->add_option("-o,--out", args->out,
                   "The file (default report.html in the first folder, of "
                   "sweeps sweeps.html)")
      ->type_name("FILE");
  command->footer("One folder is shown by itself, two side by side, more one "
                  "after the other.\nExample:\n  sofof report "
                  "results/ulm_lehr-1 -o report.html");
  command->callback([args] {
    const auto to = args->obey();
    std::cout << "report in " << to.string() << '\n';
  });
}

} // namespace sofof::apps
