// Names for runs, and folders that appear whole.
#include "experiments/sweep/run_store.hpp"

#include "base/fingerprint.hpp"
#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "scenario/run.hpp"
#include "scenario/running_programs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace sofof::experiments {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& folder, const std::error_code& why) {
  throw input_error(fmt::format("cannot keep runs in {}: {}; choose another "
                                "folder with --out",
                                folder.string(), why.message()));
}

/// Removes a folder when its scope ends.
struct removal {
  fs::path folder;
  ~removal() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

/// Waits until a file or a folder is on the disk.
/// @returns the error, if any.
std::error_code flush_to_disk(const fs::path& what) {
  const auto file = ::open(what.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
    return {errno, std::generic_category()};
  const auto error = ::fsync(file) != 0 ? errno : 0;
  ::close(file);
  return {error, std::generic_category()};
}

/// Not all file systems flush folders; all keep the order of renames.
void flush_folder_to_disk(const fs::path& folder) {
  for (const auto& file : fs::directory_iterator{folder})
    if (const auto error = flush_to_disk(file.path()))
      refuse(folder, error);
  flush_to_disk(folder);
}

/// @returns the summary of the run in a folder, as `run_store::summary_of`.
std::optional<std::string> summary_in(const fs::path& folder) {
  auto text = read_text(folder / "summary.json");
  if (!text)
    return std::nullopt;
  constexpr auto no_exceptions = false;
  const auto summary = nlohmann::json::parse(*text, nullptr, no_exceptions);
  if (!summary.is_object())
    return std::nullopt;
  const auto interrupted = summary.find("interrupted");
  if (interrupted == summary.end() || *interrupted != false)
    return std::nullopt;
  return text;
}

} // namespace

std::string name_of_run(const scenario::scenario_definition& s,
                        std::string_view program) {
  const auto configuration = scenario::configuration_of(s);
  std::vector<std::string_view> texts{program, configuration, s.map_text,
                                      s.trace_text};
  if (!s.policies.forecast.text.empty())
    texts.push_back(s.policies.forecast.text);
  const auto keys = scenario::keys_of_policies(s);
  texts.insert(texts.end(), keys.begin(), keys.end());
  for (const auto& p : s.providers)
    if (!p.map_text.empty())
      texts.push_back(p.map_text);
  texts.insert(texts.end(), s.program_texts.begin(), s.program_texts.end());
  std::string whole;
  for (const auto text : texts)
    whole += fmt::format("{}:{}", text.size(), text);
  return fmt::format("{:016x}", fingerprint(whole));
}

run_store::run_store(fs::path folder) : folder_{std::move(folder)} {
  try {
    const auto unfinished = folder_ / "runs" / ".unfinished";
    fs::create_directories(unfinished);
    own_ = std::make_unique<work_folder>(unfinished);
  } catch (const fs::filesystem_error& problem) {
    refuse(folder_, problem.code());
  }
}

fs::path run_store::folder_of(const std::string& name) const {
  return folder_ / "runs" / name;
}

std::optional<std::string>
run_store::summary_of(const std::string& name) const {
  return summary_in(folder_of(name));
}

void run_store::add(
    const std::string& name,
    const std::function<void(const fs::path& there)>& make) const {
  const auto here = own_->path() / std::to_string(++begun_);
  const removal at_end{here};
  const auto run = here / name;
  make(run);
  if (!summary_in(run))
    return;
  flush_folder_to_disk(run);
  publish(run, name);
}

void run_store::publish(const fs::path& run, const std::string& name) const {
  const auto place = folder_of(name);
  for (;;) {
    std::error_code error;
    fs::rename(run, place, error);
    if (!error)
      break;
    if (error != std::errc::directory_not_empty
        && error != std::errc::file_exists)
      refuse(folder_, error);
    if (summary_in(place)) // by another process, meanwhile
      return;
    // What is there is no finished run: it goes with our own folder.
    fs::rename(place, run.parent_path() / "replaced", error);
    if (error && error != std::errc::no_such_file_or_directory)
      refuse(folder_, error);
  }
  flush_to_disk(place.parent_path());
}

} // namespace sofof::experiments
