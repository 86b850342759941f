// All new, or all as it was.
#include "network/keys/key_ring.hpp"

#include <fmt/format.h>

#include <exception>
#include <string_view>
#include <utility>

namespace sofof::network {

namespace {

std::string count(std::size_t n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

} // namespace

key_ring::key_ring(std::filesystem::path folder, user check)
    : folder_{std::move(folder)}, check_{std::move(check)}, now_{folder_} {
  check_(now_);
}

credentials key_ring::now() const {
  const std::lock_guard lock{mutex_};
  return now_;
}

std::string key_ring::read_again() {
  try {
    const credentials fresh{folder_};
    check_(fresh);
    for (const auto& renew : users_)
      renew(fresh);
    {
      const std::lock_guard lock{mutex_};
      now_ = fresh;
    }
    return fmt::format("keys were read again: {} until {}, {}, {} revoked",
                       describe(fresh.identity()), end_of(fresh.certificate()),
                       count(fresh.authorities(), "CA"),
                       count(fresh.revoked().size(), "certificate"));
  } catch (const std::exception& problem) {
    return fmt::format("keys stay as they were: {}", problem.what());
  }
}

} // namespace sofof::network
