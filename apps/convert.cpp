// sofof convert: writes a run in the formats of other tools.
#include "experiments/convert/convert.hpp"

#include "apps/command.hpp"

#include <iostream>
#include <memory>
#include <string>

namespace sofof::apps {

void add_convert(CLI::App& app, int&) {
  struct arguments {
    std::string folder, out;
  };
  auto* command = app.add_subcommand(
      "convert", "Write a run for Foxglove, SUMO or a map viewer");
  auto args = std::make_shared<arguments>();
  command->add_option("RESULTS", args->folder, "Results folder of a run")
      ->required()
      ->type_name(" ");
  command
      ->add_option("-o", args->out,
                   "Where to: FILE.mcap, FILE.fcd.xml, FILE.geojson or "
                   "FILE.latencies.csv")
      ->type_name("FILE")
      ->required();
  command->footer("Example:\n  sofof convert results/ulm_lehr-1 -o run.mcap");
  command->callback([args] {
    experiments::convert::convert(args->folder, args->out);
    std::cout << args->out << '\n';
  });
}

} // namespace sofof::apps
