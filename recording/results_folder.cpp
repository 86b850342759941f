// Making a folder without taking anybody else's.
#include "recording/results_folder.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sofof::recording {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view files_of_a_run[] = {"summary.json",
                                               "summary.json.tmp",
                                               "config.toml",
                                               "config.toml.tmp",
                                               "episodes.csv",
                                               "cycles.csv",
                                               "tracks.csv",
                                               "events.jsonl",
                                               "timing.csv",
                                               "timing.csv.tmp",
                                               "map.toml",
                                               "map.toml.tmp",
                                               "trace.txt",
                                               "trace.txt.tmp",
                                               "vehicles.csv",
                                               "distributions.csv",
                                               "cpu.csv",
                                               "cpu.csv.tmp",
                                               "margins.csv",
                                               "load.csv",
                                               "load.csv.tmp",
                                               "octets.csv",
                                               "octets.csv.tmp",
                                               "disturbed.csv",
                                               "disturbed.csv.tmp",
                                               "claims.csv",
                                               "protocol_trace.csv",
                                               "scene.csv",
                                               "responses.csv",
                                               "energy.csv",
                                               "energy.csv.tmp",
                                               "plans.csv",
                                               "quality.csv",
                                               "quality.csv.tmp",
                                               "forecast.csv",
                                               "forecast.csv.tmp",
                                               "lodm_snapshot.txt",
                                               "lodm_snapshot.txt.tmp"};

/// With copies of what programs consist of.
constexpr std::string_view folders_of_a_run[] = {"lodm_program",
                                                 "codm_program"};

bool is_provider_map(std::string_view name) {
  if (!name.starts_with(provider_map_prefix))
    return false;
  name.remove_prefix(provider_map_prefix.size());
  const auto digits = name.find_first_not_of("0123456789");
  return digits > 0 && digits != name.npos
         && (name.substr(digits) == ".toml"
             || name.substr(digits) == ".toml.tmp");
}

/// @returns the names of all files of a run that may be there.
std::vector<std::string> results_in(const fs::path& folder) {
  std::vector<std::string> all{std::begin(files_of_a_run),
                               std::end(files_of_a_run)};
  std::error_code error;
  for (const auto& file : fs::directory_iterator{folder, error})
    if (auto name = file.path().filename().string(); is_provider_map(name))
      all.push_back(std::move(name));
  return all;
}

[[noreturn]] void refused(const fs::path& folder, const std::string& why,
                          int error = 0) {
  refuse_to_write(fmt::format("cannot make the results folder {}: {}; choose "
                              "another one with --out",
                              folder.string(), why),
                  error);
}

/// Makes a folder and its parents, or nothing.
/// @returns whether it was not there before.
bool make_all(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (auto at = folder; !at.empty() && !fs::exists(at, error) && !error;
       at = at.parent_path())
    missing.push_back(at);
  bool made = false;
  std::vector<fs::path> done;
  while (!error && !missing.empty()) {
    made = fs::create_directory(missing.back(), error);
    if (made)
      done.push_back(missing.back());
    missing.pop_back();
  }
  if (!error)
    return made;
  std::error_code ignored;
  for (; !done.empty(); done.pop_back())
    fs::remove(done.back(), ignored);
  refused(folder, error.message(), error.value());
}

std::string safe_name(std::string_view scenario, std::string_view also = {}) {
  std::string name{scenario};
  for (auto& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.'
        && also.find(c) == also.npos)
      c = '_';
  return name;
}

/// @returns ",lodm=never,duration=20s": of each change the last part of its
/// key.
std::string suffix_of(std::span<const std::string> changes) {
  constexpr std::size_t longest = 80;
  std::string all;
  for (const std::string_view change : changes) {
    const auto dot = change.substr(0, change.find('=')).rfind('.');
    all += ',';
    all += safe_name(change.substr(dot + 1), "="); // npos + 1 is 0
  }
  return all.substr(0, longest);
}

} // namespace

fs::path make_results_folder(const std::optional<fs::path>& wanted,
                             std::string_view scenario, std::int64_t seed,
                             bool force, std::span<const std::string> changes,
                             const fs::path& parent) {
  if (!wanted) {
    const auto name =
        fmt::format("{}-{}{}", safe_name(scenario), seed, suffix_of(changes));
    auto folder = parent / name;
    for (int i = 2; !make_all(folder); ++i)
      folder = parent / fmt::format("{}-{}", name, i);
    return folder;
  }
  // "out/" has an empty last part.
  auto folder = wanted->has_filename() ? *wanted : wanted->parent_path();
  std::error_code error;
  if (make_all(folder))
    return folder;
  if (!fs::is_directory(folder, error))
    refused(folder, "a file of that name is in the way");
  const auto empty = fs::is_empty(folder, error);
  if (error)
    refused(folder, error.message());
  if (!empty && !force)
    throw input_error(fmt::format(
        "the results folder {} is not empty; choose another one with --out, or "
        "replace the results in it with --force",
        folder.string()));
  return folder;
}

bool same_place(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error))
    return true;
  const auto place = [&error](const fs::path& path) {
    const auto whole = fs::absolute(path, error);
    const auto found = fs::weakly_canonical(whole, error);
    return error ? whole.lexically_normal() : found;
  };
  return place(a) == place(b);
}

bool is_result(const fs::path& file, const fs::path& folder) {
  auto names = results_in(folder);
  if (auto name = file.filename().string(); is_provider_map(name))
    names.push_back(std::move(name));
  return std::ranges::any_of(
      names, [&](const auto& name) { return same_place(file, folder / name); });
}

void remove_results(const fs::path& folder) {
  for (const auto& name : results_in(folder)) {
    std::error_code error;
    fs::remove(folder / name, error);
    if (error)
      refuse_to_write(
          fmt::format("cannot replace {}: {}; choose another folder with --out",
                      (folder / name).string(), error.message()),
          error.value());
  }
  for (const auto name : folders_of_a_run) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error)
      refuse_to_write(fmt::format("cannot replace {}: {}; choose another "
                                  "folder with --out",
                                  (folder / name).string(), error.message()),
                      error.value());
  }
}

} // namespace sofof::recording
