// Tests of messages between processes: they arrive as they were sent, and
// broken bytes are refused.
#include "messages/protocol/octets.hpp"
#include "tests/messages/random_messages.hpp"
#include "tests/messages/wire.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/message.hpp>
#include <doctest/doctest.h>

#include <bit>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

template <class T>
std::string name_of_type() {
  return to_string(caf::type_name_v<T>);
}

} // namespace

TEST_CASE("every message arrives as it was sent") {
  filler random{1};
  for_every_message([&](auto x) {
    using message = decltype(x);
    CAPTURE(name_of_type<message>());
    for (int k = 0; k < 200; ++k) {
      random.fill(x);
      const auto arrived = load<message>(save(x));
      REQUIRE(arrived);
      REQUIRE(same(x, *arrived));
    }
  });
}

TEST_CASE("the octets of a message are counted without writing it") {
  filler random{4};
  for_every_message([&](auto x) {
    using message = decltype(x);
    CAPTURE(name_of_type<message>());
    for (int k = 0; k < 200; ++k) {
      random.fill(x);
      REQUIRE(octets_of(x) == save(x).size());
    }
  });
}

TEST_CASE("two messages with different contents are not the same") {
  filler random{2};
  for_every_message([&](const auto& x) {
    using message = std::remove_cvref_t<decltype(x)>;
    CAPTURE(name_of_type<message>());
    int different = 0;
    std::vector<message> two(2);
    for (int k = 0; k < 50; ++k) {
      random.fill(two[0]);
      random.fill(two[1]);
      different += !same(two[0], two[1]);
    }
    CHECK(different > 20);
  });
}

TEST_CASE("numbers arrive to the last bit") {
  const auto check = [](double value) {
    const auto arrived = load<point>(save(point{value, -value}));
    REQUIRE(arrived);
    CHECK(std::bit_cast<std::uint64_t>(arrived->x_m)
          == std::bit_cast<std::uint64_t>(value));
  };
  check(0.1);
  check(-0.0);
  check(std::numeric_limits<double>::min());
  check(std::numeric_limits<double>::max());
}

TEST_CASE("a point that is nowhere is refused") {
  constexpr auto infinity = std::numeric_limits<double>::infinity();
  CHECK(!load<point>(save(point{infinity, 0})));
  CHECK(!load<point>(save(point{0, -infinity})));
  CHECK(!load<point>(save(point{std::numeric_limits<double>::quiet_NaN(), 0})));
}

TEST_CASE("a message that was cut off is refused, wherever the cut is") {
  filler random{3};
  for_every_message([&](auto x) {
    using message = decltype(x);
    CAPTURE(name_of_type<message>());
    for (int k = 0; k < 10; ++k) {
      random.fill(x);
      auto bytes = save(x);
      while (!bytes.empty()) {
        bytes.pop_back();
        REQUIRE(!load<message>(bytes));
      }
    }
  });
}

TEST_CASE("whatever bytes come, they make a proper message or none") {
  filler random{4};
  for_every_message([&](auto x) {
    using message = decltype(x);
    CAPTURE(name_of_type<message>());
    for (int k = 0; k < 500; ++k) {
      random.fill(x);
      auto bytes = save(x);
      for (auto flips = random.below(4) + 1; flips > 0 && !bytes.empty();
           --flips)
        bytes[random.below(bytes.size())] =
            static_cast<caf::byte>(random.below(256));
      if (const auto arrived = load<message>(bytes)) {
        const auto again = save(*arrived);
        CHECK(save(*load<message>(again)) == again);
      }
    }
  });
}

TEST_CASE("a message that claims to hold more than it does is refused") {
  service_offer offer{1, {2, 3}, {}};
  auto bytes = save(offer);
  bytes.resize(bytes.size() - sizeof offer.utilisation - 1); // number of kinds
  for (int k = 0; k < 4; ++k)
    bytes.push_back(static_cast<caf::byte>(0xff));
  bytes.push_back(static_cast<caf::byte>(0x0f));
  CHECK(!load<service_offer>(bytes));
}

TEST_CASE("an offer of a provider that stands takes no octet for its motion") {
  service_offer offer{1, {2, 3}, {}};
  const auto bare = octets_of(offer);
  offer.created = time_point{std::chrono::seconds{9}};
  CHECK(octets_of(offer) == bare + 8);
  offer.moves = provider_motion{{1.5, -2}, 80};
  CHECK(octets_of(offer) == bare + 8 + 24);
  CHECK(save(offer).size() == octets_of(offer));
  const auto arrived = load<service_offer>(save(offer));
  REQUIRE(arrived);
  CHECK(arrived->created == offer.created);
  CHECK(arrived->moves == offer.moves);
}

TEST_CASE("a motion that is no number, or too long, is refused") {
  std::optional<time_point> created;
  std::optional<provider_motion> moves;
  offer_stamp stamp{created, moves};
  for (std::size_t size = 0; size < 40; ++size) {
    const auto is_one = size == 0 || size == 8 || size == 24 || size == 32;
    CHECK(stamp.unpack(std::string(size, '\0')) == is_one);
  }
  moves = provider_motion{{0, std::numeric_limits<double>::infinity()}, 80};
  const auto text = stamp.packed();
  moves.reset();
  CHECK_FALSE(stamp.unpack(text));
  CHECK_FALSE(moves);
  CHECK_FALSE(stamp.unpack(std::string(8, '\x7f'))); // in 292 years
}

TEST_CASE_TEMPLATE("an unknown value of an enumeration is refused", T,
                   end_reason, side, qos_breach, lifecycle_step,
                   stream_id::what) {
  int known = 0;
  for (int value = 0; value < 256; ++value)
    if (const auto x = load<T>({static_cast<caf::byte>(value)})) {
      CHECK(static_cast<int>(*x) == value);
      CHECK(value == known);
      ++known;
    }
  const auto expected = std::is_same_v<T, end_reason>        ? 13
                        : std::is_same_v<T, qos_breach>      ? 5
                        : std::is_same_v<T, lifecycle_step>  ? 4
                        : std::is_same_v<T, stream_id::what> ? 4
                                                             : 2;
  CHECK(known == expected);
}

TEST_CASE("every reason to end has a name of its own") {
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < a; ++b)
      CHECK(name_of(static_cast<end_reason>(a))
            != name_of(static_cast<end_reason>(b)));
  CHECK(name_of(end_reason::shutdown) == "shutdown");
  CHECK(name_of(end_reason::left_area) == "left_area");
}

TEST_CASE_FIXTURE(virtual_world, "handles arrive inside messages") {
  const auto one = listen<provider_manager_actor>();
  const auto two = listen<provider_manager_actor>();
  const auto sent = caf::make_message(service_response{1, 101, 7, {}},
                                      std::vector{one.handle, two.handle});
  caf::byte_buffer bytes;
  caf::binary_serializer sink{system(), bytes};
  REQUIRE(sink.apply(sent));
  caf::message arrived;
  caf::binary_deserializer source{system(), bytes};
  REQUIRE(source.apply(arrived));
  REQUIRE(arrived.match_elements<service_response,
                                 std::vector<provider_manager_actor>>());
  CHECK(arrived.get_as<service_response>(0).number == 7);
  CHECK(arrived.get_as<std::vector<provider_manager_actor>>(1)
        == std::vector{one.handle, two.handle});
}
