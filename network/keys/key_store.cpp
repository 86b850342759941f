// How a private CA keeps its folder, and fills those of others.
#include "network/keys/key_store.hpp"

#include "base/files/regular_file.hpp"
#include "network/keys/atomic_file.hpp"
#include "network/keys/certificate.hpp"
#include "network/keys/revocation_list.hpp"
#include "network/keys/secret_file.hpp"
#include "network/keys/station_list.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <openssl/x509.h>
#include <sys/stat.h>
#include <system_error>

namespace sofof::network {

namespace fs = std::filesystem;

namespace {

constexpr mode_t for_all = 0644;
constexpr mode_t for_owner = 0600;
/// What a folder is called may not be longer; letters.
constexpr std::size_t longest_folder_name = 64;
constexpr std::array<std::string_view, 4> files_of_keys{"ca.pem", "cert.pem",
                                                        "key.pem", "revoked"};

/// @returns "provider-mec", "station-101-106", "station-7_101-106" or, where
/// that is too long, "station-7-and-55-more".
std::string folder_name(const peer_identity& who) {
  if (who.is_provider())
    return "provider-" + who.provider;
  auto name = "station-" + print_stations(who.stations);
  std::ranges::replace(name, ',', '_');
  if (name.size() > longest_folder_name)
    name = fmt::format("station-{}-and-{}-more", who.stations.front(),
                       who.stations.size() - 1);
  return name;
}

/// @returns the content of a file of the CA; empty when there is none.
std::string content_of(const fs::path& path, std::size_t most) {
  auto content = read_regular_file(path, most);
  if (!content.refusal.empty() && content.error != ENOENT)
    throw network_error{
        fmt::format("cannot read {}: {}", path.string(), content.refusal)};
  return std::move(content.text);
}

/// A CA that signs.
struct authority {
  fs::path folder;
  std::string pem; ///< Of all CAs that are trusted in its folder.
  std::vector<x509_ptr> trusted;
  key_ptr key;
  X509* own = nullptr; ///< One of those trusted.

  fs::path issued_file() const { return folder / "issued"; }
  fs::path revoked_file() const { return folder / "revoked"; }
  std::string revoked() const {
    return content_of(revoked_file(), revocation_list::longest);
  }
};

authority open_authority(const fs::path& folder) {
  const auto key_file = folder / "ca_key.pem";
  authority ca;
  ca.folder = folder;
  ca.pem = content_of(folder / "ca.pem", largest_certificate);
  check_secret(key_file);
  ca.trusted = certificates_from_pem(ca.pem);
  ca.key = key_from_pem(content_of(key_file, largest_certificate));
  for (const auto& each : ca.trusted)
    if (ca.key && X509_check_private_key(each.get(), ca.key.get()) == 1)
      ca.own = each.get();
  forget_openssl_errors();
  if (!ca.own)
    throw network_error{fmt::format(
        "{} holds no CA that can be read: `sofof keys init` makes one",
        folder.string())};
  if (has_expired(*ca.own))
    throw network_error{
        fmt::format("the CA in {} has expired: `sofof keys init` makes another",
                    folder.string())};
  return ca;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw network_error{fmt::format("cannot make the folder {}: {}; choose "
                                    "another",
                                    folder.string(), error.message())};
}

void refuse_existing(const fs::path& path, const char* advice) {
  std::error_code none;
  if (fs::exists(fs::symlink_status(path, none)))
    throw network_error{
        fmt::format("{} is there already: {}", path.string(), advice)};
}

/// A folder on its way to its name; gone with its owner when it never got it.
class unfinished_folder {
public:
  explicit unfinished_folder(const fs::path& final_path)
      : final_{final_path}, name_{final_path.string() + ".XXXXXX"} {
    if (!mkdtemp(name_.data()))
      refuse();
  }
  ~unfinished_folder() {
    std::error_code ignored;
    fs::remove_all(name_, ignored);
  }
  unfinished_folder(const unfinished_folder&) = delete;
  unfinished_folder& operator=(const unfinished_folder&) = delete;

  fs::path operator/(const char* file) const { return fs::path{name_} / file; }
  void finish() const {
    if (chmod(name_.c_str(), folder_for_all) != 0
        || std::rename(name_.c_str(), final_.c_str()) != 0)
      refuse();
  }

  /// The same in the place of a folder that is there, at once.
  void replace() const {
    if (chmod(name_.c_str(), folder_for_all) != 0
        || renameat2(AT_FDCWD, name_.c_str(), AT_FDCWD, final_.c_str(),
                     RENAME_EXCHANGE)
               != 0)
      refuse();
  }

private:
  static constexpr mode_t folder_for_all = 0755;

  [[noreturn]] void refuse() const {
    throw network_error{
        fmt::format("cannot write {}: {}; choose another folder with --out",
                    final_.string(), std::generic_category().message(errno))};
  }

  fs::path final_;
  std::string name_;
};

void check_wish(const peer_identity& who, const issue_options& options) {
  if (options.days < 1 || options.days > longest_validity_days)
    throw network_error{
        fmt::format("a certificate cannot be valid for {} days: 1 to {} can be",
                    options.days, longest_validity_days)};
  if (who.stations.empty() && !is_provider_name(who.provider))
    throw network_error{fmt::format(
        "'{}' cannot name a provider: letters, digits, '.', '-' and '_' can, a "
        "letter or digit first, 63 at most",
        who.provider)};
  const auto uris = uris_of(who);
  if (identity_of(uris) != who)
    throw network_error{fmt::format("a certificate names a provider or 1 to {} "
                                    "stations, each once and in order",
                                    most_stations)};
}

/// Makes a key and a certificate in a folder.
/// @returns the certificate.
x509_ptr fill(const unfinished_folder& out, const authority& ca,
              const peer_identity& who, int days) {
  const auto key = make_key();
  auto certificate = make_certificate(*key, who, days, *ca.own, *ca.key);
  if (ASN1_TIME_compare(X509_get0_notAfter(certificate.get()),
                        X509_get0_notAfter(ca.own))
      > 0)
    throw network_error{fmt::format(
        "the CA in {} ends within {} days: choose fewer with --days, or make "
        "another CA with `sofof keys init`",
        ca.folder.string(), days)};
  const auto verdict = examine(*certificate, *store_of(ca.trusted));
  if (!verdict.who)
    throw network_error{
        fmt::format("the CA in {} cannot issue this: the certificate {}",
                    ca.folder.string(), verdict.refusal)};
  const auto text = to_pem(*certificate);
  if (text.size() > largest_certificate)
    throw network_error{"so many single stations do not fit into one "
                        "certificate: use ranges, or several certificates"};
  create_file(out / "ca.pem", ca.pem, for_all);
  create_file(out / "cert.pem", text, for_all);
  create_file(out / "key.pem", to_pem(*key), for_owner);
  if (const auto revoked = ca.revoked(); !revoked.empty())
    create_file(out / "revoked", revoked, for_all);
  return certificate;
}

// -- what was issued ---------------------------------------------------------

std::string issued_line(const X509& certificate, const peer_identity& who) {
  return fmt::format("{} {} # until {}\n", serial_of(certificate),
                     describe(who), end_of(certificate));
}

void log_issued(const authority& ca, const X509& certificate,
                const peer_identity& who) {
  append_to_file(ca.issued_file(), issued_line(certificate, who), for_all);
}

struct issued_certificate {
  std::string serial;
  std::string name; ///< As `describe` prints it.
};

std::vector<issued_certificate> issued_by(const authority& ca) {
  constexpr std::size_t longest_register = std::size_t{64} << 20;
  const auto text = content_of(ca.issued_file(), longest_register);
  std::vector<issued_certificate> all;
  for (std::string_view rest = text; !rest.empty();) {
    const auto line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const auto blank = line.find(' ');
    const auto end = line.find(" #");
    if (blank != line.npos && end != line.npos && blank < end)
      all.push_back({std::string{line.substr(0, blank)},
                     std::string{line.substr(blank + 1, end - blank - 1)}});
  }
  return all;
}

/// @returns whether a certificate of this name speaks for one of these.
bool speaks_for(std::string_view name, const peer_identity& who) {
  if (who.is_provider())
    return name == describe(who);
  const auto stations = parse_stations(name.substr(name.find(' ') + 1));
  return !name.starts_with("provider ") && stations
         && std::ranges::any_of(
             *stations, [&](station_id station) { return who.has(station); });
}

std::vector<issued_certificate> chosen(const authority& ca,
                                       const revocation_choice& which) {
  auto all = issued_by(ca);
  if (which.serial.empty()) {
    std::erase_if(
        all, [&](const auto& x) { return !speaks_for(x.name, which.who); });
    return all;
  }
  const auto serial = parse_serial(which.serial);
  if (serial.empty())
    throw network_error{
        fmt::format("'{}' is no serial number; `openssl x509 -noout -serial "
                    "-in cert.pem` prints that of a certificate",
                    which.serial)};
  std::erase_if(all, [&](const auto& x) { return x.serial != serial; });
  if (all.empty())
    all.push_back({serial, "a certificate that `issued` does not list"});
  return all;
}

} // namespace

void init_keys(const fs::path& folder, const permitted_names& names) {
  const auto ca_file = folder / "ca.pem";
  const auto key_file = folder / "ca_key.pem";
  constexpr auto advice = "a new CA would make all its certificates worthless; "
                          "choose another folder";
  refuse_existing(ca_file, advice);
  refuse_existing(key_file, advice);
  make_folder(folder);
  const auto key = make_key();
  const auto ca = make_authority(*key, names);
  create_file(key_file, to_pem(*key), for_owner);
  create_file(ca_file, to_pem(*ca), for_all);
}

fs::path issue_keys(const fs::path& folder, const peer_identity& who,
                    const issue_options& options) {
  check_wish(who, options);
  const auto ca = open_authority(folder);
  const auto wanted = options.out.value_or(folder / folder_name(who));
  // "keys/" and "keys" are the same folder, but only one of them has a name.
  auto target = wanted.has_filename() ? wanted : wanted.parent_path();
  refuse_existing(target, "remove it, or choose another folder with --out");
  if (target.has_parent_path())
    make_folder(target.parent_path());
  const unfinished_folder out{target};
  const auto certificate = fill(out, ca, who, options.days);
  log_issued(ca, *certificate, who);
  out.finish();
  return target;
}

peer_identity renew_keys(const fs::path& folder, const fs::path& of, int days) {
  const auto ca = open_authority(folder);
  const auto target = of.has_filename() ? of : of.parent_path();
  const auto old = certificate_from_pem(
      content_of(target / "cert.pem", largest_certificate));
  if (!old)
    throw network_error{fmt::format("{} holds no certificate: `sofof keys "
                                    "issue` makes it",
                                    target.string())};
  const auto verdict = examine(*old, *store_of(ca.trusted), validity::ever);
  if (!verdict.who)
    throw network_error{fmt::format("the certificate in {} {} (the CA is in "
                                    "{}): `sofof keys issue` makes another",
                                    target.string(), verdict.refusal,
                                    folder.string())};
  const auto revoked_file = ca.revoked_file().string();
  if (revocation_list{ca.revoked(), revoked_file}.contains(*old))
    throw network_error{
        fmt::format("the certificate in {} has been revoked: `sofof keys "
                    "issue` makes another",
                    target.string())};
  check_wish(*verdict.who, {days, {}});
  for (const auto& entry : fs::directory_iterator{target})
    if (std::ranges::find(files_of_keys, entry.path().filename().string())
        == files_of_keys.end())
      throw network_error{
          fmt::format("{} is no file of `sofof keys issue`: move it elsewhere, "
                      "as the folder is replaced",
                      entry.path().string())};
  const unfinished_folder out{target};
  const auto certificate = fill(out, ca, *verdict.who, days);
  log_issued(ca, *certificate, *verdict.who);
  out.replace();
  return *verdict.who;
}

std::vector<std::string> revoke_keys(const fs::path& folder,
                                     const revocation_choice& which) {
  const auto ca = open_authority(folder);
  const auto certificates = chosen(ca, which);
  if (certificates.empty())
    throw network_error{fmt::format(
        "{} has issued nothing to {}; `openssl x509 -noout -serial -in "
        "cert.pem` prints the serial number of a certificate, for --serial",
        folder.string(), describe(which.who))};
  auto text = ca.revoked();
  const auto file = ca.revoked_file();
  const revocation_list before{text, file.string()};
  std::vector<std::string> names;
  for (const auto& [serial, name] : certificates)
    if (!before.contains(serial)) {
      text += fmt::format("{} # {}\n", serial, name);
      names.push_back(fmt::format("{} ({})", name, serial));
    }
  if (!names.empty())
    replace_file(file, text, for_all);
  return names;
}

} // namespace sofof::network
