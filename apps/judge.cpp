// sofof judge: drives scenarios of CommonRoad.
#include "experiments/judge/judge.hpp"

#include "apps/command.hpp"
#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "experiments/judge/judged_table.hpp"
#include "experiments/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sofof::apps {

namespace {

namespace fs = std::filesystem;
using namespace experiments::judge;

struct judge_arguments {
  std::vector<std::string> files, set;
  std::string out;
  bool force = false, quiet = false;
};

/// @returns the files, and all .xml of folders among them, in order.
std::vector<std::string> files_in(const std::vector<std::string>& named) {
  std::vector<std::string> all;
  for (const auto& name : named) {
    std::error_code none;
    if (!fs::is_directory(name, none)) {
      all.push_back(name);
      continue;
    }
    std::vector<std::string> inside;
    for (const auto& entry : fs::directory_iterator{name, none})
      if (entry.path().extension() == ".xml"
          && !entry.path().filename().string().starts_with("solution_"))
        inside.push_back(entry.path().string());
    if (inside.empty())
      throw input_error{
          fmt::format("{}: there is no .xml file in this folder.", name)};
    std::ranges::sort(inside);
    all.insert(all.end(), inside.begin(), inside.end());
  }
  return all;
}

fs::path make_folder(const std::string& name, bool force) {
  std::error_code problem;
  fs::create_directories(name, problem);
  if (!fs::is_directory(name))
    throw input_error{fmt::format("{}: this folder cannot be made: {}; choose "
                                  "another one with --out.",
                                  name, problem.message())};
  if (!force && !fs::is_empty(name, problem))
    throw input_error{fmt::format("{}: this folder is not empty; choose "
                                  "another one with --out, or add --force.",
                                  name)};
  return name;
}

int run(const judge_arguments& args) {
  const auto files = files_in(args.files);
  judge_options options{.out = {}, .changes = args.set};
  if (!args.out.empty())
    options.out = make_folder(args.out, args.force);
  const auto out = options.out;
  judge by{std::move(options)};
  std::vector<judged> rows;
  if (!args.quiet)
    std::cout << table_head();
  for (const auto& file : files)
    for (auto& row : by.look_at(file)) {
      if (!args.quiet)
        std::cout << table_line(row) << std::flush;
      rows.push_back(std::move(row));
    }
  std::cout << summary(rows);
  if (out) {
    write_file(*out / "judge.csv", to_csv(rows));
    experiments::report::write_html(judged_page(rows), *out / "judge.html",
                                    output_file::other_folder);
    std::cout << (*out / "judge.html").string() << '\n';
  }
  const judged_counts counts{rows};
  return counts.of(outcome::refused) > 0 ? 2 : counts.own_fault > 0 ? 1 : 0;
}

} // namespace

void add_judge(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "judge", "Drive planning problems of CommonRoad, and judge how");
  auto args = std::make_shared<judge_arguments>();
  command
      ->add_option("FILES", args->files,
                   "Scenarios of CommonRoad (.xml), or folders of these")
      ->required()
      ->type_name(" ");
  command
      ->add_option("--out", args->out,
                   "Folder for a report, a table, solutions, and each problem "
                   "as a scenario for sofof run")
      ->type_name("DIR");
  command->add_flag("--force", args->force,
                    "Write into a folder that is not empty");
  command->add_flag("--quiet", args->quiet, "Only how many there are of each");
  command
      ->add_option("--set", args->set,
                   "Change an option of all scenarios, e.g. "
                   "sensors.range_m=150")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1);
  command->footer("Exit code: 2 when a file is wrong, 1 when there was a "
                  "collision by own fault, else 0.\nExample:\n  sofof judge "
                  "scenarios/ --out results/judged");
  command->callback([args, &exit_code] { exit_code = run(*args); });
}

} // namespace sofof::apps
