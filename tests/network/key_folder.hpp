// A CA with some certificates in a folder of its own; gone with its test.
#pragma once

#include "network/keys/credentials.hpp"
#include "network/keys/key_store.hpp"
#include "tests/support/files.hpp"

#include <atomic>
#include <filesystem>
#include <openssl/evp.h>
#include <openssl/x509.h>
#include <string>
#include <string_view>
#include <unistd.h>

namespace sofof::test {

inline const network::peer_identity car{{101, 102}, {}};
inline const network::peer_identity mec{{}, "mec"};

class key_folder {
public:
  key_folder()
      : path_{std::filesystem::temp_directory_path()
              / ("sofof_network_" + std::to_string(getpid()) + "_"
                 + std::to_string(count_++))} {
    network::init_keys(path_);
  }
  ~key_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  key_folder(const key_folder&) = delete;
  key_folder& operator=(const key_folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// @returns a folder of a new certificate.
  std::filesystem::path issue(const network::peer_identity& who,
                              int days = 1) const {
    network::issue_options options{days, {}};
    options.out = path_ / ("issued-" + std::to_string(count_++));
    return network::issue_keys(path_, who, options);
  }
  network::credentials
  credentials_for(const network::peer_identity& who) const {
    return network::credentials{issue(who)};
  }

  /// Signs a certificate again after something in it was changed.
  /// @param change  Called with the X509&.
  template <class Change>
  void alter(const std::filesystem::path& folder, Change change,
             const char* file = "cert.pem") const {
    const auto certificate =
        network::certificate_from_pem(read_file(folder / file));
    const auto key = network::key_from_pem(read_file(path_ / "ca_key.pem"));
    change(*certificate);
    network::require_openssl(
        X509_sign(certificate.get(), key.get(), EVP_sha256()) > 0, "signing");
    write_text(folder / file, network::to_pem(*certificate));
  }

private:
  inline static std::atomic<int> count_ = 0;
  std::filesystem::path path_;
};

/// Makes a certificate's days lie in the past.
inline void expire(X509& certificate) {
  constexpr long day_s = 24 * 3600;
  X509_gmtime_adj(X509_getm_notBefore(&certificate), -2 * day_s);
  X509_gmtime_adj(X509_getm_notAfter(&certificate), -day_s);
}

/// Makes a certificate's days lie in the future.
inline void postpone(X509& certificate) {
  constexpr long day_s = 24 * 3600;
  X509_gmtime_adj(X509_getm_notBefore(&certificate), day_s);
}

} // namespace sofof::test
