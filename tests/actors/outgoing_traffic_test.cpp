// Tests of what vehicles send to a provider on another host all the time.
#include "actors/remote/outgoing_traffic.hpp"

#include "base/protocol.hpp"
#include "tests/support/at.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace std::chrono_literals;
using test::at;

namespace {

struct traffic_of_two {
  static constexpr station_id::rep first = 101, second = 102;
  static constexpr std::byte cam_id{2}, cpm_id{14};
  const session_id running{11, first, "one", 7};

  /// Of these last octets.
  static its_pdu message_of(std::byte id, station_id::rep station,
                            int mark = 0) {
    return {{std::byte{2},
             id,
             {},
             {},
             {},
             std::byte(station),
             static_cast<std::byte>(mark)},
            {},
            0};
  }

  /// @returns the last octet of an ITS message; nothing if none is sent.
  std::optional<int>
  mark_of(const std::optional<outgoing_traffic::message>& sent) {
    if (!sent)
      return std::nullopt;
    const auto& x = std::get<outgoing_traffic::its_message>(*sent);
    return std::to_integer<int>(x.content.octets.back());
  }

  /// Both stations have had their turns.
  struct begun_traffic : outgoing_traffic {
    begun_traffic() : outgoing_traffic{{first, second}} {
      for (const auto& turn : open(at(10s)))
        begin(turn.station, turn.at);
    }
  };
};

} // namespace

TEST_CASE_FIXTURE(traffic_of_two,
                  "nothing goes out before the provider knows our clock") {
  outgoing_traffic traffic{{first, second}};
  CHECK_FALSE(traffic.offer(first, message_of(cam_id, first), at(9s)));
  CHECK_FALSE(traffic.is_open());
}

TEST_CASE_FIXTURE(traffic_of_two,
                  "stations begin one after the other, 5 ms apart") {
  outgoing_traffic traffic{{first, second}};
  const auto turns = traffic.open(at(10s));
  REQUIRE(turns.size() == 2);
  CHECK(turns[0].at == at(10s));
  CHECK(turns[1].at == at(10s + 5ms));
  traffic.begin(first, at(10s));
  CHECK_FALSE(traffic.is_waiting(first));
  CHECK(traffic.is_waiting(second));
}

TEST_CASE_FIXTURE(traffic_of_two,
                  "a thousand stations have all begun within a second") {
  outgoing_traffic traffic{std::vector<station_id>(1000, first)};
  CHECK(traffic.open(at(10s)).back().at < at(11s));
}

TEST_CASE_FIXTURE(
    traffic_of_two,
    "a station begins with its latest CAM, unless that is too old") {
  for (const auto age : {0ns, protocol::cam_timeout}) {
    outgoing_traffic traffic{{first}};
    traffic.offer(first, message_of(cam_id, first, 1), at(8s - age));
    traffic.offer(first, message_of(cam_id, first, 2), at(10s - age));
    traffic.open(at(10s));
    CHECK(mark_of(traffic.begin(first, at(10s))) == 2);
  }
  outgoing_traffic traffic{{first}};
  traffic.offer(first, message_of(cam_id, first), at(7s));
  traffic.open(at(10s));
  CHECK_FALSE(traffic.begin(first, at(10s)));
  CHECK_FALSE(traffic.is_waiting(first));
}

TEST_CASE_FIXTURE(
    traffic_of_two,
    "the turn of an earlier connection does not count in the next") {
  outgoing_traffic traffic{{first}};
  traffic.open(at(10s));
  traffic.close();
  CHECK_FALSE(traffic.begin(first, at(10s)));
  traffic.open(at(20s));
  CHECK_FALSE(traffic.begin(first, at(20s - 1ns)));
  CHECK(traffic.is_waiting(first));
}

TEST_CASE_FIXTURE(
    traffic_of_two,
    "of CAMs that wait for an acknowledgement the latest goes out") {
  begun_traffic traffic;
  CHECK(mark_of(traffic.offer(first, message_of(cam_id, first, 1), at(11s)))
        == 1);
  for (int mark : {2, 3})
    CHECK_FALSE(traffic.offer(first, message_of(cam_id, first, mark), at(11s)));
  const stream_id stream{first, stream_id::what::cam, 0};
  CHECK(mark_of(traffic.acknowledge(stream, at(11s))) == 3);
}

TEST_CASE_FIXTURE(
    traffic_of_two,
    "CAMs, CPMs and inputs, and other stations, do not wait for one "
    "another") {
  begun_traffic traffic;
  const service_input input{running, at(11s), {}};
  for (int k = 0; k < 2; ++k) {
    const auto is_first = k == 0;
    CHECK(traffic.offer(first, message_of(cam_id, first), at(11s)).has_value()
          == is_first);
    CHECK(traffic.offer(first, message_of(cpm_id, first), at(11s)).has_value()
          == is_first);
    CHECK(traffic.offer(second, message_of(cam_id, second), at(11s)).has_value()
          == is_first);
    CHECK(traffic.offer(input, at(11s)).has_value() == is_first);
  }
}

TEST_CASE_FIXTURE(traffic_of_two,
                  "what has ended holds nothing up, and sends nothing more") {
  begun_traffic traffic;
  const service_input input{running, at(11s), {}};
  CHECK(traffic.offer(input, at(11s)).has_value());
  CHECK_FALSE(traffic.offer(input, at(11s)).has_value());
  traffic.forget(running);
  CHECK_FALSE(
      traffic.acknowledge(stream_of(running, stream_id::what::input), at(11s))
          .has_value());
  CHECK(traffic.offer(input, at(11s)).has_value());
}
