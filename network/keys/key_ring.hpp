// The keys of a process that runs, which are read again when it is told to.
#pragma once

#include "network/keys/credentials.hpp"

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace sofof::network {

/// Any thread may ask for them; one reads them again.
class key_ring {
public:
  using user = std::function<void(const credentials&)>;

  /// @param check  Throws when credentials are not those that are needed, with
  ///               a sentence; of every folder's content that is read.
  /// @throws network_error, and what `check` throws.
  key_ring(std::filesystem::path folder, user check);

  /// @returns what counts now.
  credentials now() const;

  /// Hands all that is read later to this as well.
  void add_user(user renew) { users_.push_back(std::move(renew)); }

  /// Reads the folder again. What is wrong there leaves all as it was.
  /// @returns what came of it, as a sentence without its full stop.
  std::string read_again();

private:
  std::filesystem::path folder_;
  user check_;
  std::vector<user> users_;
  mutable std::mutex mutex_;
  credentials now_; // guarded by mutex_
};

} // namespace sofof::network
