// Providers and vehicles that show each other certificates, and strangers.
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"

using namespace sofof::test;

namespace {

/// Makes a CA with certificates for the provider and for stations.
void make_keys(const workplace& at, const std::string& folder) {
  do_keys(at, {"init", folder});
  do_keys(at, {"issue", folder, "--provider", "mec"});
  do_keys(at, {"issue", folder, "--station", "101-103"});
  do_keys(at, {"issue", folder, "--station", "104-106"});
}

std::size_t occurrences(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (auto i = text.find(part); i != text.npos; i = text.find(part, i + 1))
    ++n;
  return n;
}

const words mine{"--station", "101-103"};
const words yours{"--station", "104-106"};

words keys(const std::string& folder) {
  return {"--keys", folder};
}

} // namespace

TEST_CASE("vehicles and a provider of one CA work together") {
  const workplace at;
  make_keys(at, "keys");
  const auto settings = patient(6);
  provider_process provider{at, "provider",
                            settings + keys("keys/provider-mec")};
  drive_process drive{at, "drive", provider.port(),
                      settings + mine + keys("keys/station-101-103")
                          + words{"--duration", "3s"}};
  const auto end = drive.run().wait();
  CAPTURE(end.err);
  CHECK(end.code == 0);
  const auto summary = summary_of(drive.out());
  CHECK(summary["episodes"] == 3);
  CHECK(summary["fallbacks"] == 0);
  check_safe(summary);
  const auto last = stop(provider.run());
  CHECK(last.code == 0);
  CHECK(last.err == "");
  CHECK_FALSE(contains(last.out, "refused"));
}

TEST_CASE("vehicles find a secured provider again that was killed") {
  const workplace at;
  make_keys(at, "keys");
  const auto settings = patient(6);
  const auto with_keys = settings + keys("keys/provider-mec");
  std::optional<provider_process> provider{std::in_place, at, "first",
                                           with_keys};
  const auto port = provider->port();
  drive_process drive{at, "drive", port,
                      settings + mine + keys("keys/station-101-103")};
  REQUIRE(wait_for_offloaded(drive, 3));
  provider->run().send(SIGKILL);
  provider->run().wait();
  provider.emplace(at, "second", with_keys, port);
  pass(3);
  CHECK(stop(drive.run()).code == 130);
  CHECK(stop(provider->run()).code == 0);
  CHECK(remote_times(drive.out()).size() == 6);
  check_safe(summary_of(drive.out()));
}

TEST_CASE("strangers are refused, and honest vehicles do not notice") {
  const workplace at;
  make_keys(at, "keys");
  make_keys(at, "foreign");
  const auto settings = patient(6);
  provider_process provider{at, "provider",
                            settings + keys("keys/provider-mec")};
  drive_process honest{at, "honest", provider.port(),
                       settings + mine + keys("keys/station-101-103")};
  REQUIRE(wait_for_offloaded(honest, 3));
  const words length{"--duration", "3s"};
  drive_process foreign{at, "foreign_drive", provider.port(),
                        settings + yours + length
                            + keys("foreign/station-104-106")};
  drive_process plain{at, "plain", provider.port(), settings + yours + length};
  for (auto* drive : {&foreign, &plain}) {
    const auto end = drive->run().wait();
    CAPTURE(end.out);
    CAPTURE(end.err);
    CHECK(end.code == 0);
    CHECK(contains(end.out, "no connection to provider mec"));
    if (drive == &plain)
      CHECK(contains(end.out, "is it a port that wants --keys?"));
    const auto summary = summary_of(drive->out());
    CHECK(summary["episodes"] == 0);
    check_safe(summary);
  }
  CHECK(stop(honest.run()).code == 130);
  const auto summary = summary_of(honest.out());
  CHECK(summary["episodes"] == 3);
  CHECK(summary["fallbacks"] == 0);
  CHECK(events_of(honest.out(), "violation").empty());

  const auto end = stop(provider.run());
  CHECK(end.code == 0);
  CHECK(contains(end.out, "\nrefused: "));
  CHECK(occurrences(end.out, "\nrefused: ") <= 5); // once a second at most
}

TEST_CASE("vehicles do not trust a provider of another CA, nor a plain one") {
  const workplace at;
  make_keys(at, "keys");
  make_keys(at, "foreign");
  const auto settings = patient(6);
  for (const auto& more : {keys("foreign/provider-mec"), words{}}) {
    CAPTURE(more);
    provider_process provider{at, more.empty() ? "plain" : "foreign_provider",
                              settings + more};
    drive_process drive{at, more.empty() ? "first" : "second", provider.port(),
                        settings + mine + keys("keys/station-101-103")
                            + words{"--duration", "2s"}};
    const auto end = drive.run().wait();
    CHECK(end.code == 0);
    CAPTURE(end.out);
    CHECK(contains(end.out, "no connection to provider mec"));
    CHECK(summary_of(drive.out())["episodes"] == 0);
    check_safe(summary_of(drive.out()));
  }
}

TEST_CASE("keys that are no good are refused at the start") {
  const workplace at;
  make_keys(at, "keys");
  std::filesystem::copy(at / "keys/provider-mec", at / "keyless");
  std::filesystem::remove(at / "keyless/key.pem");
  std::filesystem::copy(at / "keys/provider-mec", at / "broken");
  at.write("broken/cert.pem", "no certificate");
  std::filesystem::copy(at / "keys/provider-mec", at / "mixed");
  std::filesystem::copy_file(at / "keys/station-101-103/key.pem",
                             at / "mixed/key.pem",
                             std::filesystem::copy_options::overwrite_existing);
  for (const auto& [folder, said] :
       std::vector<std::pair<std::string, std::string>>{
           {"nowhere", "nowhere"},
           {"keyless", "key.pem"},
           {"broken", "cert.pem"},
           {"mixed", "key.pem"},
           {"keys/station-101-103", "not for provider mec"}}) {
    CAPTURE(folder);
    const auto end =
        at.run_sofof({"provide", scenario_file, "--out", "out", "--listen",
                      "127.0.0.1:0", "--keys", folder});
    CAPTURE(end.err);
    CHECK(end.code == 2);
    CHECK(contains(end.err, said));
    CHECK(occurrences(end.err, "\n") == 1);
    CHECK_FALSE(std::filesystem::exists(at / "out"));
  }
  const auto end =
      at.run_sofof(drive_words("out", 1, yours + keys("keys/station-101-103")));
  CAPTURE(end.err);
  CHECK(end.code == 2);
  CHECK(contains(end.err, "not for station 104"));
  CHECK_FALSE(std::filesystem::exists(at / "out"));
}
