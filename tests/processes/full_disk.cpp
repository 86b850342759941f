// A disk that takes no more, which /dev/full stands for.
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"

using namespace sofof::test;

namespace {

const words onto_full_disk{"--pcap", "/dev/full"};

std::size_t occurrences(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (auto i = text.find(part); i != text.npos; i = text.find(part, i + 1))
    ++n;
  return n;
}

void check_says_once(const ending& end) {
  CAPTURE(end.out);
  CHECK(end.err == "");
  CHECK(end.code == 1);
  CHECK(occurrences(end.out, "the run goes on without results: cannot write "
                             "/dev/full: No space left on device")
        == 1);
}

} // namespace

TEST_CASE("vehicles whose results cannot be written drive on, with their "
          "provider") {
  const workplace at;
  const auto settings = patient(6);
  provider_process provider{at, "provider", settings};
  drive_process drive{at, "drive", provider.port(),
                      settings + onto_full_disk + words{"--duration", "4s"}};
  check_says_once(drive.run().wait());
  CHECK_FALSE(std::filesystem::exists(drive.out() / "summary.json"));
  CHECK(stop(provider.run()).code == 0);
  const auto summary = summary_of(provider.out());
  CHECK(summary["fallbacks"] == 0);
  CHECK(events_of(provider.out(), "peer_lost").size() == 1);
}

TEST_CASE("a provider whose results cannot be written goes on planning") {
  const workplace at;
  const auto settings = patient(6);
  provider_process provider{at, "provider", settings + onto_full_disk};
  drive_process drive{at, "drive", provider.port(),
                      settings + words{"--duration", "4s"}};
  CHECK(drive.run().wait().code == 0);
  const auto summary = summary_of(drive.out());
  CHECK(summary["episodes"] == 6);
  CHECK(summary["fallbacks"] == 0);
  check_safe(summary);
  check_says_once(stop(provider.run()));
}

TEST_CASE("a run whose results cannot be written ends") {
  const workplace at;
  const auto end = at.run_sofof(
      words{"run", scenario_file, "--duration", "60s", "--out", "out"}
      + onto_full_disk);
  CHECK(end.code == 2);
  CHECK(contains(end.err, "cannot write /dev/full: No space left on device"));
  CHECK_FALSE(std::filesystem::exists(at / "out/summary.json"));
}

TEST_CASE("what vehicles record is on the disk within a second") {
  const workplace at;
  drive_process drive{at, "drive", 1, patient(1) + words{"--duration", "60s"}};
  const auto table = drive.out() / "tracks.csv";
  const auto size = [&] {
    std::error_code none;
    const auto octets = std::filesystem::file_size(table, none);
    return none ? 0 : octets;
  };
  REQUIRE(wait_until([&] { return size() > 1000; }));
  for (int k = 0; k < 3; ++k) {
    const auto before = size();
    pass(1);
    CHECK(size() > before);
  }
  stop(drive.run(), SIGKILL);
  CHECK(rows_of(table).size() > 30);
}
