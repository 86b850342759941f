// A private CA, its certificates, and what is wrong with a folder of them.
#include "network/network_error.hpp"
#include "tests/network/key_folder.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <numeric>
#include <openssl/x509v3.h>
#include <sys/stat.h>

using namespace sofof;
using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

const peer_identity car_of_three{{101, 102, 103}, {}};

/// @returns the sentence of the network_error that the task throws.
std::string sentence_of(const std::function<void()>& task) {
  try {
    task();
  } catch (const network_error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

std::string loading(const fs::path& folder) {
  return sentence_of([&] { credentials{folder}; });
}

mode_t mode_of(const fs::path& path) {
  struct stat info {};
  REQUIRE(stat(path.c_str(), &info) == 0);
  return info.st_mode & 0777;
}

} // namespace

TEST_CASE("what was issued is loaded and names whom it was issued to") {
  const key_folder keys;
  for (const auto& who : {car_of_three, mec}) {
    const auto own = keys.credentials_for(who);
    CHECK(own.identity() == who);
    CHECK(own.certificate_pem().starts_with("-----BEGIN CERTIFICATE-----"));
  }
}

TEST_CASE("secrets are for their owner only") {
  const key_folder keys;
  const auto folder = keys.issue(car_of_three);
  CHECK(mode_of(keys.path() / "ca_key.pem") == 0600);
  CHECK(mode_of(folder / "key.pem") == 0600);
  CHECK(mode_of(folder / "cert.pem") == 0644);
  CHECK(mode_of(folder / "ca.pem") == 0644);
}

TEST_CASE("a folder is named after its peer") {
  const key_folder keys;
  CHECK(issue_keys(keys.path(), car_of_three)
        == keys.path() / "station-101-103");
  CHECK(issue_keys(keys.path(), {{7, 9, 10}, {}})
        == keys.path() / "station-7_9-10");
  CHECK(issue_keys(keys.path(), mec) == keys.path() / "provider-mec");
  std::vector<station_id> odd(50);
  for (std::size_t k = 0; k < odd.size(); ++k)
    odd[k] = static_cast<station_id>(2 * k + 1);
  const peer_identity many{odd, {}};
  const auto folder = issue_keys(keys.path(), many);
  CHECK(folder == keys.path() / "station-1-and-49-more");
  CHECK(credentials{folder}.identity() == many);
}

TEST_CASE("ten thousand stations fit into a certificate") {
  const key_folder keys;
  std::vector<station_id> all(10'000);
  std::iota(all.begin(), all.end(), station_id{1});
  CHECK(keys.credentials_for({all, {}}).identity().stations == all);
}

TEST_CASE("a certificate has what the books ask for") {
  const key_folder keys;
  const auto text = [&](const peer_identity& who) {
    return certificate_from_pem(read_file(keys.issue(who) / "cert.pem"));
  };
  for (const auto& who : {car_of_three, mec}) {
    const auto certificate = text(who);
    auto* x = certificate.get();
    CHECK(X509_get_version(x) == X509_VERSION_3);
    CHECK(ASN1_STRING_length(X509_get0_serialNumber(x)) == 16);
    CHECK(X509_check_ca(x) == 0);
    CHECK(X509_get_key_usage(x) == KU_DIGITAL_SIGNATURE);
    CHECK(X509_get_extended_key_usage(x)
          == (who.is_provider() ? XKU_SSL_SERVER : XKU_SSL_CLIENT));
    CHECK(X509_get0_subject_key_id(x) != nullptr);
    CHECK(X509_get0_authority_key_id(x) != nullptr);
  }
  const auto ca = certificate_from_pem(read_file(keys.path() / "ca.pem"));
  CHECK(X509_check_ca(ca.get()) == 1);
  CHECK(X509_get_pathlen(ca.get()) == 0);
}

TEST_CASE("nothing is written over") {
  const key_folder keys;
  const auto before = read_file(keys.path() / "ca_key.pem");
  CHECK(contains(sentence_of([&] { init_keys(keys.path()); }),
                 "is there already"));
  CHECK(read_file(keys.path() / "ca_key.pem") == before);
  const auto folder = issue_keys(keys.path(), car_of_three);
  const auto key = read_file(folder / "key.pem");
  CHECK(contains(sentence_of([&] { issue_keys(keys.path(), car_of_three); }),
                 "is there already: remove it, or choose another"));
  CHECK(read_file(folder / "key.pem") == key);
}

TEST_CASE("what cannot be issued is refused and leaves nothing behind") {
  const key_folder keys;
  const auto refusal = [&](const peer_identity& who, int days) {
    return sentence_of([&] { issue_keys(keys.path(), who, {days, {}}); });
  };
  CHECK(contains(refusal(car_of_three, 0), "0 days"));
  CHECK(contains(refusal(car_of_three, -1), "-1 days"));
  CHECK(contains(refusal(car_of_three, 100'000), "100000 days"));
  CHECK(contains(refusal({{}, "a/b"}, 1), "'a/b' cannot name a provider"));
  CHECK(contains(refusal({}, 1), "cannot name a provider"));
  CHECK(contains(refusal({{1}, "mec"}, 1), "names a provider or"));
  CHECK(contains(refusal({{2, 1}, {}}, 1), "each once and in order"));
  CHECK(contains(
      sentence_of([&] { issue_keys(keys.path() / "no", car_of_three); }),
      "holds no CA"));
  CHECK(
      contains(sentence_of([&] {
                 issue_keys(keys.path(), car_of_three, {1, "/proc/no/folder"});
               }),
               "/proc/no"));
  int files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator{keys.path()})
    ++files;
  CHECK(files == 2);
}

TEST_CASE("a certificate does not outlive its CA") {
  const key_folder keys;
  const auto end_in_days = [&](long days) {
    keys.alter(
        keys.path(),
        [&](X509& ca) {
          X509_gmtime_adj(X509_getm_notAfter(&ca), days * 24 * 3600);
        },
        "ca.pem");
  };
  const auto refusal = [&](int days) {
    return sentence_of([&] {
      issue_keys(keys.path(), car_of_three, {days, {}});
    });
  };
  end_in_days(10);
  CHECK(contains(refusal(11), "ends within 11 days"));
  const auto folder = keys.issue(car_of_three, 9);
  CHECK(credentials{folder}.identity() == car_of_three);
  end_in_days(-1);
  CHECK(contains(refusal(1), "has expired"));
  write_text(folder / "ca.pem", read_file(keys.path() / "ca.pem"));
  CHECK(contains(loading(folder), "is signed by a CA that has expired"));
}

TEST_CASE("each missing file has its sentence") {
  const key_folder keys;
  for (const auto* name : {"ca.pem", "cert.pem", "key.pem"}) {
    const auto folder = keys.issue(car_of_three);
    fs::remove(folder / name);
    CHECK(loading(folder)
          == "cannot read " + (folder / name).string()
                 + ": No such file or directory; `sofof keys issue` makes it "
                   "in a folder that you can read");
  }
}

TEST_CASE("a file that cannot be read has its sentence") {
  const key_folder keys;
  for (const auto* name : {"ca.pem", "cert.pem", "key.pem"}) {
    const auto folder = keys.issue(car_of_three);
    fs::remove(folder / name);
    fs::create_directory(folder / name);
    CHECK(contains(loading(folder), "cannot read " + (folder / name).string()
                                        + ": Is a directory"));
  }
}

TEST_CASE("a file that is something else has its sentence") {
  const key_folder keys;
  for (const auto* text : {"", "hello",
                           "-----BEGIN CERTIFICATE-----\nAAAA\n"
                           "-----END CERTIFICATE-----\n"}) {
    auto folder = keys.issue(car_of_three);
    write_text(folder / "cert.pem", text);
    CHECK(contains(loading(folder), "cert.pem is not a certificate"));
    folder = keys.issue(car_of_three);
    write_text(folder / "ca.pem", text);
    CHECK(contains(loading(folder), "ca.pem is not a certificate"));
    folder = keys.issue(car_of_three);
    write_text(folder / "key.pem", text);
    CHECK(contains(loading(folder), "key.pem is not a private key"));
  }
  const auto folder = keys.issue(car_of_three);
  write_text(folder / "cert.pem", std::string(70'000, 'a'));
  CHECK(contains(loading(folder), "cert.pem is too long to be right"));
}

TEST_CASE("files that do not belong together have their sentence") {
  const key_folder keys;
  const key_folder others;
  auto folder = keys.issue(car_of_three);
  write_text(folder / "key.pem", read_file(keys.issue(mec) / "key.pem"));
  CHECK(contains(loading(folder), "key.pem is not the key of"));

  folder = keys.issue(car_of_three);
  write_text(folder / "ca.pem", read_file(others.path() / "ca.pem"));
  CHECK(contains(loading(folder), "cert.pem is not signed by this CA"));

  folder = keys.issue(car_of_three);
  write_text(folder / "ca.pem", read_file(folder / "cert.pem"));
  CHECK(contains(loading(folder), "ca.pem is not the certificate of a CA"));
}

TEST_CASE("a certificate whose days are over or to come has its sentence") {
  const key_folder keys;
  auto folder = keys.issue(car_of_three);
  keys.alter(folder, expire);
  CHECK(contains(loading(folder), "cert.pem has expired on 20"));
  folder = keys.issue(car_of_three);
  keys.alter(folder, postpone);
  CHECK(contains(loading(folder), "cert.pem is not valid before 20"));
}

TEST_CASE("a certificate that names nobody has its sentence") {
  const key_folder keys;
  const auto folder = keys.issue(car_of_three);
  keys.alter(folder, [](X509& x) {
    const auto at = X509_get_ext_by_NID(&x, NID_subject_alt_name, -1);
    X509_EXTENSION_free(X509_delete_ext(&x, at));
  });
  CHECK(contains(loading(folder), "cert.pem names no station and no provider"));
}

TEST_CASE("a certificate for one thing is no good for another") {
  const key_folder keys;
  const auto folder = keys.issue(car_of_three);
  keys.alter(folder, [](X509& x) {
    const auto at = X509_get_ext_by_NID(&x, NID_subject_alt_name, -1);
    X509_EXTENSION_free(X509_delete_ext(&x, at));
    const x509_extension_ptr name{X509V3_EXT_conf_nid(
        nullptr, nullptr, NID_subject_alt_name, "URI:urn:sofof:provider:mec")};
    X509_add_ext(&x, name.get(), -1);
  });
  CHECK(contains(loading(folder), "is not made for what it names"));
}
