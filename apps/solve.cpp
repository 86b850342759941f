// sofof solve: solves the planning problems of a file.
#include "experiments/solve/solve.hpp"

#include "apps/command.hpp"
#include "experiments/solve/practice_file.hpp"

#include <iostream>
#include <memory>
#include <string>

namespace sofof::apps {

namespace {

struct arguments {
  std::string file, out, practice;
  experiments::solve_options options;
};

} // namespace

void add_solve(CLI::App& app, int&) {
  auto* command =
      app.add_subcommand("solve", "Solve the planning problems of a file");
  auto args = std::make_shared<arguments>();
  command->add_option("FILE", args->file, "Problems (JSON)")->required();
  command->add_flag("--cold", args->options.cold,
                    "Solve each without the plan before");
  command
      ->add_option("--repeat", args->options.repeat,
                   "Go through the list N times, for profilers")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_option("--out", args->out, "Write a JSON object a line")
      ->type_name("FILE");
  command
      ->add_option("--practice", args->practice,
                   "Write problems to practise on into FILE first")
      ->type_name("path|velocity");
  command->footer("Example:\n  sofof solve slalom.json --practice path "
                  "--out plans.jsonl");
  command->callback([args] {
    if (!args->practice.empty())
      experiments::write_practice(args->file, args->practice);
    if (!args->out.empty())
      args->options.out = args->out;
    experiments::solve_problems(args->file, args->options, std::cout);
  });
}

} // namespace sofof::apps
