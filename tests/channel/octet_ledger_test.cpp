// Octets that are sent arrive, are lost, or are under way.
#include "channel/octet_ledger.hpp"

#include "base/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using namespace std::chrono_literals;

namespace {

constexpr time_point at(duration t) {
  return time_point{t};
}

} // namespace

TEST_CASE("a message is under way until it arrives") {
  octet_ledger ledger;
  ledger.send("CAM", 100, at(0ms), at(20ms));
  auto line = ledger.read(at(20ms - 1ns)).at(0);
  CHECK(line.what == "CAM");
  CHECK(line.under_way.octets == 100);
  CHECK(line.delivered.messages == 0);
  line = ledger.read(at(20ms)).at(0);
  CHECK(line.under_way.messages == 0);
  CHECK(line.delivered.octets == 100);
}

TEST_CASE("a lost message is sent, and never arrives") {
  octet_ledger ledger;
  ledger.lose("planning", 300);
  const auto line = ledger.read(at(10s)).at(0);
  CHECK(line.sent.octets == 300);
  CHECK(line.lost.octets == 300);
  CHECK(line.delivered.octets == 0);
}

TEST_CASE("of all that is sent for something nothing vanishes, at any time") {
  constexpr std::array<std::string_view, 3> purposes{"CAM", "one", "two"};
  const random_stream noise{7, "octets"};
  octet_ledger ledger;
  std::array<std::uint64_t, 3> sent{};
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const auto now = at(1ms * static_cast<int>(k));
    const auto of = static_cast<std::size_t>(noise.uniform(0, 2.999, k, 1));
    const auto octets =
        1 + static_cast<std::size_t>(noise.uniform(0, 1e4, k, 2));
    sent[of] += octets;
    if (noise.uniform(k, 3) < 0.1)
      ledger.lose(purposes[of], octets);
    else
      ledger.send(purposes[of], octets, now,
                  now + from_seconds(noise.uniform(0, 0.5, k, 4)));
    if (k % 100 != 0)
      continue;
    for (const auto& line : ledger.read(now)) {
      CHECK(line.sent.octets
            == line.delivered.octets + line.lost.octets
                   + line.under_way.octets);
      CHECK(line.sent.messages
            == line.delivered.messages + line.lost.messages
                   + line.under_way.messages);
    }
  }
  for (const auto& line : ledger.read(at(3s))) {
    const auto of = static_cast<std::size_t>(
        std::ranges::find(purposes, line.what) - purposes.begin());
    CHECK(line.sent.octets == sent.at(of));
    CHECK(line.under_way.messages == 0);
    CHECK(line.delivered.octets > 0);
    CHECK(line.lost.octets > 0);
  }
}
