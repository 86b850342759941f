// sofof new: a scenario to begin with.
#include "apps/command.hpp"
#include "apps/new_scenario.hpp"
#include "apps/propose.hpp"
#include "base/files/output_file.hpp"
#include "base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace sofof::apps {

namespace {

namespace fs = std::filesystem;

/// @returns the file for a name, "mine" or "mine.toml".
fs::path file_for(const std::string& name) {
  fs::path file{name};
  if (file.extension() != ".toml")
    file += ".toml";
  const auto stem = file.stem().string();
  if (stem.empty() || stem == ".toml" || name.ends_with('/')
      || stem.find_first_of("\"\\\n\r\t") != stem.npos)
    throw input_error{fmt::format(
        "\"{}\" is no name for a scenario; \"mine\" is one, its file is "
        "mine.toml.",
        name)};
  return file;
}

std::string text_for(std::string_view name) {
  constexpr std::string_view blank = "NAME";
  std::string text{new_scenario_text};
  for (auto at = text.find(blank); at != text.npos;
       at = text.find(blank, at + name.size()))
    text.replace(at, blank.size(), name);
  return text;
}

/// @returns the error of the system, 0 for none.
int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const auto written = write(file, text.data(), text.size());
    if (written < 0 && errno != EINTR)
      return errno;
    text.remove_prefix(static_cast<std::size_t>(std::max(written, ssize_t{0})));
  }
  return 0;
}

/// Writes a file that was not there before, whole or not at all.
void write_new(const fs::path& file, std::string_view text) {
  const auto out =
      open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  auto error = out < 0 ? errno : write_all(out, text);
  if (out >= 0 && close(out) != 0 && error == 0)
    error = errno;
  if (error == 0)
    return;
  if (error == EEXIST)
    throw input_error{
        fmt::format("{} is there already; choose another name, or remove it.",
                    file.string())};
  std::error_code ignored;
  if (out >= 0)
    fs::remove(file, ignored);
  refuse_to_write(fmt::format("{} cannot be written: {}.", file.string(),
                              std::generic_category().message(error)),
                  error);
}

} // namespace

void add_new(CLI::App& app, int&) {
  struct arguments {
    std::string name, map;
  };
  auto* command = app.add_subcommand(
      "new", "Write a small scenario with comments, to begin with");
  auto args = std::make_shared<arguments>();
  command
      ->add_option("NAME", args->name, "Of the scenario; its file is NAME.toml")
      ->required()
      ->type_name(" ");
  command
      ->add_option("--map", args->map,
                   "Map to drive on: 20 cars on its routes, providers at its "
                   "busiest junctions")
      ->type_name("MAP.toml");
  command->footer("Examples:\n  sofof new mine\n  sofof run mine.toml\n"
                  "  sofof new city --map city_map.toml");
  command->callback([args] {
    const auto file = file_for(args->name);
    const auto name = file.stem().string();
    write_new(file, args->map.empty()
                        ? text_for(name)
                        : proposed_text(args->map, name, file.string()));
    std::cout << fmt::format("{0} is written; sofof run {0} drives it\n",
                             file.string());
  });
}

} // namespace sofof::apps
