// Names for runs, and a lock around them.
#include "scenario/sweep/run_store.hpp"

#include "scenario/input_error.hpp"
#include "scenario/run.hpp"
#include "scenario/toml_file.hpp"
#include "world/fingerprint.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace sofof {

namespace fs = std::filesystem;

namespace {

constexpr auto for_everybody_to_read = 0644;

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw input_error(fmt::format("cannot keep runs in {}: {}; choose another "
                                "folder with --out",
                                folder.string(), why));
}

} // namespace

std::string name_of_run(const scenario& s, std::string_view program) {
  const auto configuration = configuration_of(s);
  std::string whole;
  for (const auto text :
       {program, std::string_view{configuration}, std::string_view{s.map_text},
        std::string_view{s.trace_text}})
    whole += fmt::format("{}:{}", text.size(), text);
  return fmt::format("{:016x}", fingerprint(whole));
}

run_store::run_store(fs::path folder) : folder_{std::move(folder)} {
  std::error_code error;
  fs::create_directories(folder_ / "runs", error);
  if (error)
    refuse(folder_, error.message());
  const auto file = folder_ / "runs" / ".lock";
  lock_ =
      ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, for_everybody_to_read);
  if (lock_ < 0)
    refuse(folder_, std::strerror(errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0)
    return;
  ::close(lock_);
  refuse(folder_, "another sweep is at work there");
}

run_store::~run_store() {
  ::close(lock_); // which unlocks it
}

fs::path run_store::folder_of(const std::string& name) const {
  return folder_ / "runs" / name;
}

std::optional<std::string>
run_store::summary_of(const std::string& name) const {
  auto text = read_text(folder_of(name) / "summary.json");
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

} // namespace sofof
