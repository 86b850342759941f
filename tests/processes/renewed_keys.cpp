// Keys that change while vehicles drive.
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"

using namespace sofof::test;

namespace {

/// @returns how often a program has printed something so far.
std::size_t times_printed(const program& run, std::string_view part) {
  const auto text = run.printed();
  std::size_t n = 0;
  for (auto i = text.find(part); i != text.npos; i = text.find(part, i + 1))
    ++n;
  return n;
}

/// Lets a program read its keys again, and waits until it has.
bool reads_again(program& run) {
  constexpr std::string_view said = "keys were read again: ";
  const auto before = times_printed(run, said);
  run.send(SIGHUP);
  return wait_until([&] { return times_printed(run, said) > before; });
}

} // namespace

TEST_CASE("keys are read again without an end of any session, and who is "
          "revoked is out within a second") {
  const workplace at;
  do_keys(at, {"init", "keys"});
  do_keys(at, {"issue", "keys", "--provider", "mec"});
  do_keys(at, {"issue", "keys", "--station", "101-103"});
  do_keys(at, {"issue", "keys", "--station", "104-106"});
  const auto settings = patient(6);
  provider_process provider{at, "provider",
                            settings + words{"--keys", "keys/provider-mec"}};
  drive_process lost{
      at, "lost", provider.port(),
      settings
          + words{"--station", "101-103", "--keys", "keys/station-101-103"}};
  drive_process kept{
      at, "kept", provider.port(),
      settings
          + words{"--station", "104-106", "--keys", "keys/station-104-106"}};
  REQUIRE(wait_for_offloaded(lost, 3));
  REQUIRE(wait_for_offloaded(kept, 3));

  for (int k = 0; k < 5; ++k) {
    REQUIRE(reads_again(provider.run()));
    REQUIRE(reads_again(kept.run()));
  }
  do_keys(at, {"renew", "keys", "keys/provider-mec"});
  REQUIRE(reads_again(provider.run()));
  const auto certificate = read_file(at / "keys/provider-mec/cert.pem");
  at.write("keys/provider-mec/cert.pem", "broken");
  provider.run().send(SIGHUP);
  REQUIRE(wait_until([&] {
    return contains(provider.run().printed(), "keys stay as they were: ");
  }));
  at.write("keys/provider-mec/cert.pem", certificate);
  CHECK(events_of(provider.out(), "peer_lost").empty());

  do_keys(at, {"revoke", "keys", "--station", "102"});
  std::filesystem::copy_file(at / "keys/revoked",
                             at / "keys/provider-mec/revoked");
  const auto begun = monotonic::now();
  provider.run().send(SIGHUP);
  REQUIRE(wait_until([&] {
    return contains(provider.run().printed(), "was disconnected: its "
                                              "certificate has been revoked");
  }));
  CHECK(seconds(monotonic::now() - begun) < 1);
  pass(1.5);
  CHECK(stop(lost.run()).code == 130);
  CHECK(stop(kept.run()).code == 130);
  CHECK(stop(provider.run()).code == 0);
  CHECK(summary_of(kept.out())["fallbacks"] == 0);
  CHECK(events_of(kept.out(), "provider_lost").empty());
  CHECK(events_of(lost.out(), "provider_lost").size() == 1);
  CHECK(events_of(lost.out(), "provider_connected").size() == 1);
  CHECK(remote_times(lost.out()).size() == 3);
  check_safe(summary_of(lost.out()));
}

TEST_CASE("without keys SIGHUP ends a provider") {
  const workplace at;
  provider_process provider{at, "provider", patient(1)};
  CHECK(stop(provider.run(), SIGHUP).signal == SIGHUP);
}

TEST_CASE("keys that others may use are refused") {
  const workplace at;
  do_keys(at, {"init", "keys"});
  do_keys(at, {"issue", "keys", "--provider", "mec"});
  std::filesystem::permissions(at / "keys/provider-mec/key.pem",
                               std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  const auto end =
      at.run_sofof({"provide", scenario_file, "--out", "out", "--listen",
                    "127.0.0.1:0", "--keys", "keys/provider-mec"});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "`chmod 600 keys/provider-mec/key.pem`"));
}
