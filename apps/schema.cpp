// sofof schema: what editors check files by while they are written.
#include "apps/command.hpp"
#include "experiments/schema/file_schemas.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <memory>
#include <string>

namespace sofof::apps {

void add_schema(CLI::App& app, int&) {
  namespace schema = experiments::schema;
  auto* command = app.add_subcommand(
      "schema", "Print the JSON schema of a kind of file, for editors");
  auto kind = std::make_shared<std::string>();
  command
      ->add_option(
          "KIND", *kind,
          fmt::format("Of files: {}", fmt::join(schema::file_kinds, ", ")))
      ->required()
      ->type_name(" ");
  command->footer("Example:\n  sofof schema scenario >scenario.json\n"
                  "then, as the first line of a scenario,\n"
                  "  #:schema ./scenario.json");
  command->callback([kind] { std::cout << schema::schema_of(*kind); });
}

} // namespace sofof::apps
