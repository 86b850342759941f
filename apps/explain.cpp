// sofof explain: tells why an episode of a run ended.
#include "apps/command.hpp"
#include "experiments/explain/story.hpp"

#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace sofof::apps {

namespace {

struct explain_arguments {
  std::string folder;
  std::optional<std::uint64_t> station;
  std::optional<double> at_s;
  std::string service;
};

} // namespace

void add_explain(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "explain", "Tell why an episode of a run ended, in some ten lines");
  auto args = std::make_shared<explain_arguments>();
  command->add_option("DIR", args->folder, "Results folder of a run")
      ->required()
      ->type_name(" ");
  command->add_option("--station", args->station, "Of this vehicle")
      ->type_name("ID");
  command
      ->add_option("--at", args->at_s,
                   "The episode that runs at this second, or is nearest "
                   "(default: the first that ended early, else the longest)")
      ->type_name("SECONDS");
  command->add_option("--service", args->service, "Of this service")
      ->type_name("NAME");
  command->footer("Example:\n  sofof explain results/ulm_lehr-1 --station 102 "
                  "--at 13.2");
  command->callback([args] {
    std::cout << experiments::explain::tell(
        args->folder, {args->station, args->at_s, args->service});
  });
}

} // namespace sofof::apps
