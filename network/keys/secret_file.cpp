// The bits of a file's mode.
#include "network/keys/secret_file.hpp"

#include "network/network_error.hpp"

#include <fmt/format.h>

#include <sys/stat.h>

namespace sofof::network {

void check_secret(const std::filesystem::path& file) {
  struct stat about {};
  if (stat(file.c_str(), &about) != 0 || !S_ISREG(about.st_mode))
    return;
  constexpr mode_t all_bits = 0777, of_others = 077;
  if ((about.st_mode & of_others) != 0)
    throw network_error{fmt::format(
        "{} is secret, but others may use it (mode {:04o}): `chmod 600 {}`, "
        "and issue another one if they have seen it",
        file.string(), about.st_mode & all_bits, file.string())};
}

} // namespace sofof::network
