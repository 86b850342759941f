// What is remembered of a long run.
#include "channel/time_rows.hpp"

#include "channel/load_meter.hpp"
#include "channel/octet_ledger.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using namespace std::chrono_literals;

TEST_CASE("half an hour is told by the second, a day by the minute") {
  CHECK(length_of_rows(0s) == 1s);
  CHECK(length_of_rows(30min) == 1s);
  CHECK(length_of_rows(30min + 1s) == 2s);
  CHECK(length_of_rows(1h) == 2s);
  CHECK(length_of_rows(24h) == 64s);
}

TEST_CASE("rows grow longer, never more, and nothing of them is lost") {
  time_rows<int> rows;
  for (auto second = 0; second < 10'000; ++second) {
    rows.at(second * 1s) += 1;
    const auto& sums = rows.sums();
    CHECK(sums.size() <= 1801);
    CHECK(std::accumulate(sums.begin(), sums.end(), 0) == second + 1);
  }
  CHECK(rows.length() == 8s);
  CHECK(rows.sums()[0] == 8);
  rows.at(1s) += 5; // what is told late is still told where it belongs
  CHECK(rows.sums()[0] == 13);
}

TEST_CASE("a meter of two hours says the same as all of its jobs") {
  struct job {
    duration arrives, wait, work;
  };
  test::dice dice{5};
  std::vector<job> jobs;
  for (duration t{}; t < 2h; t += from_seconds(dice.between(0, 2)))
    jobs.push_back({t, from_seconds(dice.between(0, 0.1)),
                    from_seconds(dice.between(0, 1.5))});
  constexpr time_point start{7s};
  load_meter meter{2, start};
  for (const auto& x : jobs)
    meter.add(start + x.arrives, x.wait, x.work, "planning");
  const auto all = meter.read();
  CHECK(all.bins.size() < 1000);

  const auto asked_from = [&](duration from, duration to) {
    duration sum{};
    for (const auto& x : jobs)
      if (x.arrives >= from && x.arrives < to)
        sum += x.work;
    return sum;
  };
  const auto row = all.rows.length();
  CHECK(row == 4s);
  for (duration t{}; t < 2h; t += 100 * row)
    CHECK(all.between(t, t + row).asked == asked_from(t, t + row));
  const auto sum = all.between(0s, duration::max());
  CHECK(sum.jobs == jobs.size());
  CHECK(sum.asked == sum.busy);
  CHECK(all.busy_for("planning", duration::max()) == sum.busy);

  std::vector<duration> bins(2 * 36'000 + 20);
  for (const auto& x : jobs)
    bins[static_cast<std::size_t>(x.arrives / 100ms)] += x.work;
  duration most{}, full{};
  for (auto k = 0; k * 100ms < all.bins_from; ++k) {
    const auto asked =
        std::accumulate(bins.begin() + k, bins.begin() + k + 5, duration{});
    most = std::max(most, asked);
    if (k % 5 == 0 && asked > 900ms) // of two servers in half a second
      full += 500ms;
  }
  CHECK(all.most_asked == most);
  CHECK(all.full == full);
  CHECK(full > 0s);
}

TEST_CASE("a ledger of two hours has lost no octet") {
  octet_ledger ledger{time_point{}};
  test::dice dice{6};
  std::uint64_t sent = 0;
  for (duration t{}; t < 2h; t += from_seconds(dice.between(0, 2))) {
    const auto octets = static_cast<std::size_t>(dice.between(1, 1000));
    sent += octets;
    // Some arrive when rows have grown longer.
    ledger.send({"planning", 101, octets, time_point{t}},
                time_point{t + from_seconds(dice.between(0, 2000))});
  }
  ledger.send({"CAM", 101, 10, time_point{}}, time_point{}); // and no more
  const auto lines = ledger.read(time_point{2h});
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].rows.length() == 4s);
  CHECK(lines[1].rows.length() == 4s);
  CHECK(lines[0].rows.sums().size() <= 1801);
  for (const auto& x : lines[0].rows.sums())
    CHECK(x.sent.octets == x.delivered.octets + x.under_way.octets);
  CHECK(lines[0].together().sent.octets == sent);
  CHECK(lines[0].together().under_way.octets > 0);
}
