// Folders with a lock in each: one that can be locked belongs to nobody.
#include "experiments/sweep/work_folder.hpp"

#include "base/fingerprint.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <unistd.h>

namespace sofof::experiments {

namespace fs = std::filesystem;

namespace {

constexpr auto lock_name = ".lock";

/// @returns a name that no other machine has, until this one is started again.
std::string name_of_machine() {
  std::string host(256, '\0'), boot;
  gethostname(host.data(), host.size() - 1);
  std::ifstream{"/proc/sys/kernel/random/boot_id"} >> boot;
  return fmt::format("{:016x}", fingerprint(host.c_str() + ('/' + boot)));
}

/// Other machines' folders stay: their locks may not be known here.
void remove_abandoned(const fs::path& shared, const std::string& machine) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator{shared, ignored})
    if (entry.path().filename().string().starts_with(machine)
        && fs::exists(entry.path() / lock_name, ignored)
        && file_lock{entry.path() / lock_name}.is_ours())
      fs::remove_all(entry.path(), ignored);
}

} // namespace

work_folder::work_folder(const fs::path& shared) {
  const auto machine = name_of_machine();
  remove_abandoned(shared, machine);
  for (int i = 1;; ++i) {
    path_ = shared / fmt::format("{}-{}-{}", machine, getpid(), i);
    if (!fs::create_directory(path_))
      continue; // of a process in another container
    lock_ = std::make_unique<file_lock>(path_ / lock_name);
    if (!lock_->is_taken() && fs::exists(path_ / lock_name))
      return; // else another process took it for abandoned
  }
}

work_folder::~work_folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

} // namespace sofof::experiments
