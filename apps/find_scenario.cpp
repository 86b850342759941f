// Looks where scenarios usually are.
#include "apps/find_scenario.hpp"

#include "apps/program.hpp"
#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "base/options/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

namespace sofof::apps {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view usual_folders[]{"config", "config/bench"};
constexpr std::string_view ending = ".toml";

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::vector<fs::path> scenarios_in(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator{folder, ignored})
    if (entry.path().extension() == ending && is_file(entry.path()))
      all.push_back(entry.path());
  std::ranges::sort(all);
  return all;
}

/// @returns the folders that a name may be of: its own one, or the usual ones,
/// here or where the program was installed.
std::vector<fs::path> folders_for(const fs::path& name) {
  if (name.has_parent_path())
    return {name.parent_path()};
  std::vector<fs::path> all{"."};
  all.insert(all.end(), std::begin(usual_folders), std::end(usual_folders));
  std::error_code ignored;
  if (const auto here = fs::read_symlink(program_file, ignored); !here.empty())
    for (const auto folder : usual_folders)
      all.push_back(here.parent_path().parent_path() / "share/sofof" / folder);
  return all;
}

/// @returns the scenario whose name is nearest; an empty one for none.
fs::path nearest_to(const fs::path& name) {
  std::vector<fs::path> files;
  for (const auto& folder : folders_for(name))
    for (auto& file : scenarios_in(folder))
      files.push_back(folder == "." ? file.filename() : std::move(file));
  std::vector<std::string> stems;
  for (const auto& file : files)
    stems.push_back(file.stem().string());
  const std::vector<std::string_view> known(stems.begin(), stems.end());
  const auto wanted =
      (name.extension() == ending ? name.stem() : name.filename()).string();
  const auto best = nearest_word(wanted, known);
  const auto found = std::ranges::find(known, best);
  return best.empty() ? fs::path{} : files[found - known.begin()];
}

} // namespace

std::string find_scenario(const std::string& name) {
  std::error_code ignored;
  const fs::path wanted{name};
  if (name.empty() || name == "-" || fs::exists(wanted, ignored))
    return name;
  auto file = wanted;
  if (file.extension() != ending)
    file += ending;
  for (const auto& folder : folders_for(wanted))
    if (const auto there = folder == "."              ? file
                           : wanted.has_parent_path() ? file
                                                      : folder / file;
        is_file(there)) {
      std::fprintf(stderr, "sofof: taking %s\n", there.c_str());
      return there.string();
    }
  if (const auto meant = nearest_to(wanted); !meant.empty())
    throw input_error{fmt::format(
        "{}: this file cannot be read: No such file or directory, did you mean "
        "{}?",
        name, meant.string())};
  return name;
}

void refuse_map(const std::string& file) {
  constexpr std::string_view of_maps[]{"\n[[lane]]", "\n[[route]]"};
  constexpr std::string_view of_scenarios[]{"\n[[fleet]]", "\n[[provider]]",
                                            "\nmap ="};
  const auto text = "\n" + read_text(file).value_or("");
  const auto stands = [&text](std::string_view key) {
    return text.find(key) != text.npos;
  };
  if (std::ranges::any_of(of_maps, stands)
      && std::ranges::none_of(of_scenarios, stands))
    throw input_error{fmt::format(
        "{}: this is a map; name a scenario that says `map = \"{}\"`.", file,
        fs::path{file}.filename().string())};
}

} // namespace sofof::apps
