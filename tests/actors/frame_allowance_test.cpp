// Tests of how much a peer may send.
#include "actors/remote/frame_allowance.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>

namespace sofof::test::allowances {

using namespace actors;

namespace {

using namespace std::chrono_literals;

int frames_until_refused(frame_allowance& allowance, time_point now) {
  int frames = 0;
  while (allowance.objection(10, now).empty())
    ++frames;
  return frames;
}

constexpr frame_bounds bounds{100, 1e9};
constexpr auto at_once = 200;

} // namespace

TEST_CASE("a peer that sends more than its share is refused, and one that was "
          "held up for two seconds is not") {
  time_point now{};
  frame_allowance by_frames{{100, 1e9}};
  CHECK(frames_until_refused(by_frames, now) == 200);
  CHECK(by_frames.objection(10, now) == "it sends too many messages");
  CHECK(frames_until_refused(by_frames, now + 1s) == 100);

  frame_allowance by_octets{{1e9, 10'000}};
  for (int k = 0; k < 4; ++k)
    CHECK(by_octets.objection(4900, now) == "");
  CHECK(by_octets.objection(4900, now) == "it sends too many octets");
}

TEST_CASE("bounds grow with the stations of a peer") {
  const auto one = bounds_for(1), twenty = bounds_for(20);
  // 10 CAMs, 10 CPMs, 2 services of 20 inputs and 20 acknowledgements, and
  // 20 pings, asked and answered.
  CHECK(one.frames_s > 2 * (10 + 10 + 2 * 40 + 40));
  CHECK(twenty.frames_s > 19 * (one.frames_s - bounds_for(0).frames_s));
  CHECK(twenty.octets_s > one.octets_s);
}

TEST_CASE("a peer that connects again, or twice, may send no more for it") {
  frame_allowances all;
  const time_point now{};
  CHECK(frames_until_refused(*all.of("car", bounds, now), now) == at_once);
  CHECK(frames_until_refused(*all.of("car", bounds, now), now) == 0);
  CHECK(frames_until_refused(*all.of("car", bounds, now + 1s), now + 1s)
        == at_once / 2);
  const auto open = all.of("car", bounds, now + 9s);
  CHECK(all.of("car", bounds, now + 9s) == open);
}

TEST_CASE("what another peer sends is not charged") {
  frame_allowances all;
  const time_point now{};
  CHECK(frames_until_refused(*all.of("car", bounds, now), now) == at_once);
  CHECK(frames_until_refused(*all.of("other", bounds, now), now) == at_once);
}

TEST_CASE("peers that are gone are forgotten once they may send all again") {
  frame_allowances all;
  time_point now{};
  for (int k = 0; k < 100; ++k)
    CHECK(all.of(std::to_string(k), bounds, now)->objection(10, now).empty());
  CHECK(all.size() == 100);
  const auto connected = all.of("7", bounds, now);
  all.of("car", bounds, now + 2s);
  CHECK(all.size() == 2);
}

} // namespace sofof::test::allowances
