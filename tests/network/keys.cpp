// A private CA, its certificates, and what is wrong with a folder of them.
#include "network/network_error.hpp"
#include "tests/network/key_folder.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <numeric>
#include <openssl/x509v3.h>
#include <sys/stat.h>

using namespace sofof;
using namespace sofof::network;
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
  std::vector<station_id> all;
  for (station_id::rep k = 1; k <= 10'000; ++k)
    all.push_back(k);
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
                                        + ": it is a folder"));
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

TEST_CASE("a key that others may use is refused") {
  const key_folder keys;
  for (const auto mode : {0640, 0604, 0620, 0644, 0666, 0610}) {
    CAPTURE(mode);
    const auto folder = keys.issue(car_of_three);
    REQUIRE(chmod((folder / "key.pem").c_str(), mode) == 0);
    CHECK(contains(loading(folder),
                   "`chmod 600 " + (folder / "key.pem").string() + "`"));
  }
  REQUIRE(chmod((keys.path() / "ca_key.pem").c_str(), 0640) == 0);
  CHECK(
      contains(sentence_of([&] { keys.issue(mec); }), "ca_key.pem is secret"));
}

TEST_CASE("a CA names neither hosts nor mailboxes") {
  const key_folder keys;
  for (const auto* name : {"DNS:example.org", "IP:10.0.0.1", "IP:2001:db8::1",
                           "email:mail@example.org"}) {
    CAPTURE(name);
    const auto folder = keys.issue(car_of_three);
    keys.alter(folder, [name](X509& x) {
      const auto at = X509_get_ext_by_NID(&x, NID_subject_alt_name, -1);
      X509_EXTENSION_free(X509_delete_ext(&x, at));
      const auto both = std::string{"URI:urn:sofof:station:101,"} + name;
      const x509_extension_ptr names{X509V3_EXT_conf_nid(
          nullptr, nullptr, NID_subject_alt_name, both.c_str())};
      X509_add_ext(&x, names.get(), -1);
    });
    CHECK(contains(loading(folder), "names a host or a mailbox"));
  }
  CHECK(keys.credentials_for({{}, "mec.ulm.example"}).identity().provider
        == "mec.ulm.example");
}

TEST_CASE("a CA with names of its own names nobody else") {
  const key_folder other;
  const auto folder = other.path() / "narrow";
  init_keys(folder, {{101, 102, 103}, {"mec"}});
  const auto refusal = [&](const peer_identity& who) {
    return sentence_of([&] { issue_keys(folder, who); });
  };
  CHECK(refusal(car_of_three) == "nothing was thrown");
  CHECK(refusal(mec) == "nothing was thrown");
  CHECK(contains(refusal({{103, 104}, {}}), "which its CA may not name"));
  CHECK(contains(refusal({{}, "other"}), "which its CA may not name"));
  // Somebody with its key can sign anything, but nobody believes it.
  const auto keys = folder / "station-101-103";
  const auto certificate = certificate_from_pem(read_file(keys / "cert.pem"));
  const auto at =
      X509_get_ext_by_NID(certificate.get(), NID_subject_alt_name, -1);
  X509_EXTENSION_free(X509_delete_ext(certificate.get(), at));
  const x509_extension_ptr name{X509V3_EXT_conf_nid(
      nullptr, nullptr, NID_subject_alt_name, "URI:urn:sofof:station:7")};
  X509_add_ext(certificate.get(), name.get(), -1);
  const auto ca_key = key_from_pem(read_file(folder / "ca_key.pem"));
  REQUIRE(X509_sign(certificate.get(), ca_key.get(), EVP_sha256()) > 0);
  write_text(keys / "cert.pem", to_pem(*certificate));
  CHECK(contains(loading(keys), "station 7, which its CA may not name"));
}

TEST_CASE("a folder may trust several CAs") {
  const key_folder keys;
  const key_folder others;
  const auto folder = keys.issue(car_of_three);
  const auto own_ca = read_file(folder / "ca.pem");
  const auto other_ca = read_file(others.path() / "ca.pem");
  for (const auto& text : {own_ca + other_ca, other_ca + own_ca}) {
    write_text(folder / "ca.pem", text);
    const credentials own{folder};
    CHECK(own.authorities() == 2);
    for (const auto* ca : {&keys, &others})
      CHECK(own.examine(*certificate_from_pem(
                            read_file(ca->issue(mec) / "cert.pem")))
                .who
            == mec);
  }
  write_text(folder / "ca.pem", own_ca
                                    + "-----BEGIN CERTIFICATE-----\nAAAA\n"
                                      "-----END CERTIFICATE-----\n");
  CHECK(contains(loading(folder), "ca.pem is not a certificate"));
  // Who signs may trust others, too, and says so to those it signs for.
  write_text(keys.path() / "ca.pem", other_ca + own_ca);
  CHECK(keys.credentials_for(mec).authorities() == 2);
}

TEST_CASE("certificates are revoked by whom they name, or by their number") {
  const key_folder keys;
  const auto revoked = [&](const revocation_choice& which) {
    return revoke_keys(keys.path(), which).size();
  };
  const auto first = keys.issue({{101, 102}, {}});
  const auto second = keys.issue({{102, 103}, {}});
  const auto third = keys.issue({{103}, {}});
  const auto provider = keys.issue(mec);
  CHECK(revoked({{{102}, {}}, {}}) == 2);
  CHECK(revoked({{{102}, {}}, {}}) == 0);
  CHECK(revoked({{{101, 103}, {}}, {}}) == 1);
  CHECK(contains(sentence_of([&] {
                   revoked({{{7}, {}}, {}});
                 }),
                 "has issued nothing to station 7"));
  const auto own = keys.credentials_for({{9}, {}});
  const auto is_good = [&](const fs::path& folder) {
    const auto verdict =
        own.examine(*certificate_from_pem(read_file(folder / "cert.pem")));
    return verdict.who.has_value();
  };
  CHECK(own.revoked().size() == 3);
  CHECK_FALSE(is_good(first));
  CHECK_FALSE(is_good(second));
  CHECK_FALSE(is_good(third));
  CHECK(is_good(provider));
  const auto serial =
      serial_of(*certificate_from_pem(read_file(provider / "cert.pem")));
  CHECK(revoked({{}, serial}) == 1);
  CHECK(revoked({{}, "12:34:ab"}) == 1);
  CHECK(contains(sentence_of([&] {
                   revoked({{}, "no"});
                 }),
                 "'no' is no serial number"));
  CHECK(keys.credentials_for(mec).revoked().size() == 5);
}

TEST_CASE("a renewed certificate names the same peer") {
  const key_folder keys;
  const auto folder = keys.issue(car_of_three);
  const auto before = credentials{folder};
  keys.alter(folder, expire);
  CHECK(renew_keys(keys.path(), folder, 30) == car_of_three);
  const credentials after{folder};
  CHECK(after.identity() == car_of_three);
  CHECK(after.certificate_pem() != before.certificate_pem());
  CHECK(mode_of(folder / "key.pem") == 0600);

  const auto refusal = [&](const fs::path& of) {
    return sentence_of([&] { renew_keys(keys.path(), of); });
  };
  const key_folder others;
  CHECK(contains(refusal(others.issue(mec)), "is not signed by this CA"));
  CHECK(contains(refusal(keys.path() / "none"), "holds no certificate"));
  write_text(folder / "notes.txt", "mine");
  CHECK(contains(refusal(folder), "notes.txt is no file of"));
  fs::remove(folder / "notes.txt");
  revoke_keys(keys.path(), {car_of_three, {}});
  CHECK(contains(refusal(folder), "has been revoked"));
}

TEST_CASE("a list of revoked certificates is numbers, or refused with its "
          "place") {
  const revocation_list list{"\n# lost in May\n 0A:1b:2C # stations 101\r\n"
                             "0a1b2c\nff\n",
                             "revoked"};
  CHECK(list.size() == 2);
  CHECK(list.contains(std::string{"0A1B2C"}));
  CHECK(list.contains(std::string{"FF"}));
  CHECK_FALSE(list.contains(std::string{"0A1B"}));
  for (const auto* text : {"ff\nxyz\n", "ff\n12 34\n", "\n0\n"})
    CHECK(contains(sentence_of([&] {
                     revocation_list{text, "revoked"};
                   }),
                   "revoked:2: this is no serial number"));
  const key_folder keys;
  const auto folder = keys.issue(mec);
  fs::create_directory(folder / "revoked");
  CHECK(contains(loading(folder), "revoked: it is a folder"));
}

TEST_CASE("damaged lists of CAs and of revoked certificates do no harm") {
  const key_folder keys;
  const key_folder others;
  const auto authorities =
      read_file(keys.path() / "ca.pem") + read_file(others.path() / "ca.pem");
  const std::string numbers = "# lost\n0a:1B # car\nffee\n\n12345678\n";
  dice draws{3};
  const auto damaged = [&](std::string text) {
    const auto changes = draws.between(1, 6);
    for (int i = 0; i < changes; ++i)
      text[static_cast<std::size_t>(
          draws.between(0, static_cast<double>(text.size())))] =
          static_cast<char>(draws.between(-128, 128));
    return text;
  };
  int good = 0;
  constexpr int tries = 2000;
  for (int n = 0; n < tries; ++n) {
    CHECK(certificates_from_pem(damaged(authorities)).size() <= 2);
    const auto text = damaged(numbers);
    const auto said = sentence_of([&] {
      good += revocation_list{text, "x"}.size() <= 4;
    });
    CHECK((said == "nothing was thrown" || said.starts_with("x:")));
  }
  CHECK(good > 0);
  CHECK(good < tries);
}
