// sofof new: proposes a scenario.
#include "apps/command.hpp"
#include "apps/propose.hpp"

#include <iostream>
#include <memory>
#include <string>

namespace sofof::apps {

void add_new(CLI::App& app, int&) {
  struct arguments {
    std::string name, map, out;
  };
  auto* command = app.add_subcommand("new", "Write a scenario to begin with");
  auto args = std::make_shared<arguments>();
  command->add_option("NAME", args->name, "What to call it")
      ->required()
      ->type_name(" ");
  command
      ->add_option("--map", args->map,
                   "Map to drive on: 20 cars on its routes, providers at its "
                   "busiest junctions")
      ->type_name("MAP.toml")
      ->required();
  command->add_option("-o", args->out, "Where to; without: NAME.toml")
      ->type_name("FILE.toml");
  command->footer("Example:\n  sofof new city --map city_map.toml");
  command->callback([args] {
    const auto out = args->out.empty() ? args->name + ".toml" : args->out;
    propose(args->map, args->name, out);
    std::cout << out << '\n';
  });
}

} // namespace sofof::apps
