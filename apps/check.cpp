// sofof check: reads a scenario and prints what it really says.
#include "apps/command.hpp"
#include "apps/scenario_arguments.hpp"

#include <iostream>
#include <memory>

namespace sofof::apps {

void add_check(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "check", "Check a scenario and print its effective configuration");
  auto args = std::make_shared<scenario_arguments>();
  args->add_to(*command);
  command->footer("Example:\n  sofof check config/ulm_lehr.toml "
                  "--set network.profile=paper_5g");
  command->callback([args] { std::cout << scenario::to_toml(args->load()); });
}

} // namespace sofof::apps
