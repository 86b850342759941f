// When CAMs are sent (EN 302 637-2, section 6.1.3).
#include "messages/v2x/cam_rules.hpp"
#include "tests/messages/v2x_sender.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace std::chrono_literals;
using test::degree;

namespace {

constexpr time_point first_cam{20s};

/// Times, since the start, at which a vehicle that asks every 100 ms sends.
template <class Motion>
std::vector<int> sent_ms(cam_trigger trigger, int until_ms, Motion motion) {
  std::vector<int> times;
  for (auto ms = 0; ms <= until_ms; ms += 100)
    if (trigger.check(first_cam + ms * 1ms, motion(0.001 * ms)).send)
      times.push_back(ms);
  return times;
}

told_motion east(double x_m, double speed_mps, double heading_rad = 0) {
  return {{x_m, 0}, heading_rad, speed_mps};
}

} // namespace

TEST_CASE("a standing vehicle sends a CAM once a second") {
  CHECK(sent_ms(cam_trigger{}, 3000, [](double) { return east(7, 0); })
        == std::vector{0, 1000, 2000, 3000});
}

TEST_CASE("a vehicle at constant speed sends a CAM when it has moved 4 m") {
  CHECK(sent_ms(cam_trigger{}, 2000,
                [](double t_s) { return east(13 * t_s, 13); })
        == std::vector{0, 400, 800, 1200, 1600, 2000});
  CHECK(
      sent_ms(cam_trigger{}, 500, [](double t_s) { return east(50 * t_s, 50); })
      == std::vector{0, 100, 200, 300, 400, 500});
}

TEST_CASE("4 m exactly are no news") {
  cam_trigger trigger;
  trigger.check(first_cam, east(0, 10));
  CHECK_FALSE(trigger.check(first_cam + 400ms, east(4, 10)).send);
  CHECK(trigger.check(first_cam + 500ms, east(4.01, 10)).send);
}

TEST_CASE("a vehicle that brakes sends a CAM at every half metre a second") {
  CHECK(sent_ms(cam_trigger{}, 1000,
                [](double t_s) { return east(2 * t_s, 2 - 2 * t_s); })
        == std::vector{0, 300, 600, 900});
}

TEST_CASE("a vehicle that turns sends a CAM at every 4 degrees, west too") {
  const auto turns = [](double t_s) {
    return east(t_s, 1, wrap_angle(std::numbers::pi - 0.1 + 21 * degree * t_s));
  };
  CHECK(sent_ms(cam_trigger{}, 1000, turns)
        == std::vector{0, 200, 400, 600, 800, 1000});
}

TEST_CASE("after news CAMs keep their pace three times more, then go slow") {
  const auto starts = [](double t_s) { return east(0, t_s < 0.25 ? 0 : 1); };
  CHECK(sent_ms(cam_trigger{}, 4000, starts)
        == std::vector{0, 300, 600, 900, 1200, 2200, 3200});
}

TEST_CASE("news between the three repetitions begin the count anew") {
  const auto twice = [](double t_s) {
    return east(0, t_s < 0.25 ? 0 : t_s < 0.75 ? 1 : 2);
  };
  // 300 (news), 600, 800 (news, after 200 ms), and three more.
  CHECK(sent_ms(cam_trigger{}, 3000, twice)
        == std::vector{0, 300, 600, 800, 1000, 1200, 1400, 2400});
}

TEST_CASE("a busy channel holds CAMs back") {
  const cam_trigger held{generation_rule::triggered, 300ms};
  CHECK(sent_ms(held, 1000, [](double t_s) { return east(50 * t_s, 50); })
        == std::vector{0, 300, 600, 900});
}

TEST_CASE("by the clock, a CAM is sent every 100 ms whatever happens") {
  const cam_trigger steady{generation_rule::fixed_10hz};
  CHECK(sent_ms(steady, 500, [](double) { return east(0, 0); })
        == std::vector{0, 100, 200, 300, 400, 500});
}

TEST_CASE("no two CAMs are closer than 100 ms, however often is asked") {
  for (const auto rule :
       {generation_rule::triggered, generation_rule::fixed_10hz}) {
    cam_trigger trigger{rule};
    auto sent = 0;
    for (auto ms = 0; ms < 1000; ++ms)
      if (trigger.check(first_cam + ms * 1ms, east(ms, 100)).send)
        ++sent;
    CHECK(sent == 10);
  }
}

TEST_CASE("the low-frequency container comes with the first CAM and then "
          "after half a second") {
  cam_trigger fast;
  std::vector<int> with;
  for (auto ms = 0; ms <= 1500; ms += 100)
    if (fast.check(first_cam + ms * 1ms, east(0.05 * ms, 50)).low_frequency)
      with.push_back(ms);
  CHECK(with == std::vector{0, 500, 1000, 1500});
  cam_trigger slow; // every second: in each
  CHECK(slow.check(first_cam, east(0, 0)).low_frequency);
  CHECK(slow.check(first_cam + 1s, east(0, 0)).low_frequency);
}

TEST_CASE("without a CAM there is no low-frequency container") {
  cam_trigger trigger;
  trigger.check(first_cam, east(0, 0));
  const auto no = trigger.check(first_cam + 600ms, east(0, 0));
  CHECK_FALSE(no.send);
  CHECK_FALSE(no.low_frequency);
}

TEST_CASE("a vehicle that does not know its motion sends a CAM a second") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(sent_ms(cam_trigger{}, 2000, [](double) { return east(nan, nan, nan); })
        == std::vector{0, 1000, 2000});
}

TEST_CASE("a clock that goes back sends nothing") {
  cam_trigger trigger;
  trigger.check(first_cam, east(0, 0));
  CHECK_FALSE(trigger.check(first_cam - 5s, east(100, 30)).send);
  CHECK(trigger.check(first_cam + 100ms, east(100, 30)).send);
}
