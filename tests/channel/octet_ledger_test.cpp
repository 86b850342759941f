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
  octet_ledger ledger{at(0ms)};
  ledger.send({"CAM", 101, 100, at(0ms)}, at(20ms));
  CHECK(ledger.read(at(0ms)).at(0).what == "CAM");
  auto line = ledger.read(at(20ms - 1ns)).at(0).together();
  CHECK(line.under_way.octets == 100);
  CHECK(line.delivered.messages == 0);
  line = ledger.read(at(20ms)).at(0).together();
  CHECK(line.under_way.messages == 0);
  CHECK(line.delivered.octets == 100);
}

TEST_CASE("a lost message is sent, and never arrives") {
  octet_ledger ledger{at(0ms)};
  ledger.lose({"planning", 101, 300, at(1s), disturbance::loss});
  const auto line = ledger.read(at(10s)).at(0).together();
  CHECK(line.sent.octets == 300);
  CHECK(line.lost.octets == 300);
  CHECK(line.delivered.octets == 0);
}

TEST_CASE("of all that is sent for something nothing vanishes, at any time") {
  constexpr std::array<std::string_view, 3> purposes{"CAM", "one", "two"};
  const random_stream noise{7, "octets"};
  octet_ledger ledger{at(0ms)};
  std::array<std::uint64_t, 3> sent{};
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const auto now = at(1ms * static_cast<int>(k));
    const auto of = static_cast<std::size_t>(noise.uniform(0, 2.999, k, 1));
    const auto octets =
        1 + static_cast<std::size_t>(noise.uniform(0, 1e4, k, 2));
    sent[of] += octets;
    if (noise.uniform(k, 3) < 0.1)
      ledger.lose({purposes[of], 101, octets, now, disturbance::loss});
    else
      ledger.send({purposes[of], 101, octets, now},
                  now + from_seconds(noise.uniform(0, 0.5, k, 4)));
    if (k % 100 != 0)
      continue;
    for (const auto& line : ledger.read(now))
      for (const auto& x : line.rows.sums()) {
        CHECK(x.sent.octets
              == x.delivered.octets + x.lost.octets + x.under_way.octets);
        CHECK(x.sent.messages
              == x.delivered.messages + x.lost.messages + x.under_way.messages);
      }
  }
  for (const auto& line : ledger.read(at(3s))) {
    const auto of = static_cast<std::size_t>(
        std::ranges::find(purposes, line.what) - purposes.begin());
    const auto all = line.together();
    CHECK(all.sent.octets == sent.at(of));
    CHECK(all.under_way.messages == 0);
    CHECK(all.delivered.octets > 0);
    CHECK(all.lost.octets > 0);
    CHECK(line.rows.sums().size() == 2);
  }
}

TEST_CASE(
    "what is disturbed is counted by moment, vehicle and purpose, and told "
    "once") {
  octet_ledger ledger{at(1s)};
  const auto lose = [&ledger](duration t, station_id of, disturbance by) {
    ledger.lose({"one", of, 10, at(t), by});
  };
  lose(3s, 102, disturbance::loss);
  lose(2s, 101, disturbance::outage);
  lose(3s, 102, disturbance::loss);
  lose(3001ms, 102, disturbance::loss);
  ledger.send({"one", 102, 10, at(3s), disturbance::stall}, at(4s));
  ledger.send({"one", 102, 10, at(3s)}, at(4s));
  CHECK(ledger.take_disturbed(at(2s)).empty());
  const auto first = ledger.take_disturbed(at(3s));
  REQUIRE(first.size() == 1);
  CHECK(first[0].at == 1s);
  CHECK(first[0].station == 101);
  CHECK(first[0].count.outage == 1);
  const auto all = ledger.take_disturbed(time_point::max());
  REQUIRE(all.size() == 2);
  CHECK(all[0].at == 2s);
  CHECK(all[0].what == "one");
  CHECK(all[0].count.lost == 2);
  CHECK(all[0].count.stall == 1);
  CHECK(all[0].count.most() == disturbance::loss);
  CHECK(ledger.take_disturbed(time_point::max()).empty());
  CHECK(disturbed_count{}.most() == disturbance::none);
}
