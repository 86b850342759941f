// What crosses a broker comes out as it went in, or not at all.
#include "actors/broker/wire.hpp"
#include "network/amqp/selector.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace sofof::test::over_a_broker {

using namespace actors::wire;
using namespace std::chrono_literals;
using network::amqp::find;

constexpr std::chrono::milliseconds some_day{1'700'000'000'000};

/// @returns the beginning of an ITS message of a station, and some octets.
messages::its_pdu its(std::uint8_t message_id, std::uint32_t station) {
  messages::its_pdu x;
  x.octets = {std::byte{2}, std::byte{message_id}};
  for (int shift = 24; shift >= 0; shift -= 8)
    x.octets.push_back(static_cast<std::byte>(station >> shift & 0xff));
  x.octets.insert(x.octets.end(), 30, std::byte{7});
  return x;
}

messages::service_input input_with(messages::payload what) {
  return {.session = {77, 101, "trajectory_planning", 3},
          .at = time_point{5s},
          .what = std::move(what),
          .in_use = messages::payload::of(its(20, 101)),
          .standby = true};
}

messages::service_result result_with(messages::payload what) {
  messages::service_result x;
  x.session = {77, 101, "trajectory_planning", 3};
  x.cycle = 9;
  x.created = time_point{6s};
  x.what = std::move(what);
  return x;
}

std::vector<envelope> envelopes() {
  const std::string user = "stations 101-103";
  std::vector<envelope> all;
  const auto add = [&](content what) {
    all.push_back({user, 101, station_id{900'000'001}, 4711, std::move(what)});
  };
  all.push_back({user, 101, {}, 0, broadcast{its(2, 101)}});
  all.push_back({user, 101, {}, 0, broadcast{its(14, 101)}});
  add(connect_request{"mec", 10, 0xabcdef});
  add(challenge{10, 0xabcdef, "nonce"});
  add(messages::peer_hello{"mec", {101, 102}, 5, 6, "pem", {std::byte{1}}});
  add(messages::peer_welcome{77, 8});
  add(refusal{"another map", true});
  add(closing{});
  add(messages::ping{1, time_point{2s}});
  add(messages::pong{{1, time_point{2s}}, time_point{3s}, time_point{4s}});
  add(messages::service_request{77, 101, 3, {"one"}, {{1, 2}}, 5.5});
  add(input_with(messages::payload::of(its(20, 101))));
  add(input_with({}));
  add(messages::service_end{{77, 101, "one", 3},
                            messages::end_reason::qos_gap,
                            messages::side::requester,
                            messages::payload::of(its(20, 101))});
  add(offer{{77, {1, 2}, {"one"}, 0.5, 2, 3ms, time_point{9s}}});
  add(messages::service_response{
      77, 101, 3, {{{77, 101, "one", 4}, true, ""}}});
  add(messages::session_digest{77, 101, 4, {{77, 101, "one", 4}}});
  add(result_with(messages::payload::of(its(20, 101))));
  add(result_with({}));
  return all;
}

/// Contents are compared as they are written.
void check_same(const envelope& a, const envelope& b) {
  CHECK(a.user == b.user);
  CHECK(a.from == b.from);
  CHECK(a.to == b.to);
  CHECK(a.link == b.link);
  CHECK(a.what.index() == b.what.index());
  CHECK((to_amqp(a, some_day) == to_amqp(b, some_day)));
}

TEST_CASE("every envelope comes out as it went in") {
  for (const auto& x : envelopes()) {
    CAPTURE(x.what.index());
    const auto read = from_amqp(to_amqp(x, some_day));
    REQUIRE(read);
    check_same(x, *read);
  }
}

TEST_CASE("ITS messages are what receivers of the institute look for") {
  struct {
    std::uint8_t id;
    std::uint16_t mid;
    std::string subject;
    std::chrono::milliseconds ttl;
  } const kinds[] = {{2, 2050, "cam", 1000ms},
                     {14, 2049, "cpm", 100ms},
                     {20, 2052, "mcm", 1000ms}};
  for (const auto& kind : kinds) {
    const auto message = its(kind.id, 101);
    const auto m = to_amqp({"", 101, {}, 0, broadcast{message}}, some_day);
    CHECK(m.subject == kind.subject);
    CHECK(*find<std::uint16_t>(m.all, "mid") == kind.mid);
    CHECK(*find<std::uint32_t>(m.all, "station_id") == 101);
    CHECK(m.ttl == kind.ttl);
    CHECK(m.created == some_day);
    CHECK(m.body == message.octets);
    CHECK(m.all.size() == 2);
  }
}

TEST_CASE("an input or a result of planning is an MCM to everybody else, of "
          "whoever encoded it") {
  const auto m =
      to_amqp({"", 900'000'001, station_id{101}, 4711,
               result_with(messages::payload::of(its(20, 900'000'001)))},
              some_day);
  CHECK(m.subject == "mcm");
  CHECK(*find<std::uint32_t>(m.all, "station_id") == 900'000'001);
  CHECK(*find<std::uint32_t>(m.all, "destination_station_id") == 101);
  CHECK(m.body == its(20, 900'000'001).octets);
}

TEST_CASE("messages of SOFOF alone have no mid, so that others ignore them") {
  for (const auto& x : envelopes()) {
    const auto m = to_amqp(x, some_day);
    CHECK((m.subject == "sofof") == !m.all.contains("mid"));
  }
}

TEST_CASE("a message that is not what it says is not read") {
  auto m = to_amqp({"", 101, {}, 0, broadcast{its(2, 101)}}, some_day);
  CHECK(from_amqp(m));
  const auto spoilt = [&](auto spoil) {
    auto bad = m;
    spoil(bad);
    return !from_amqp(bad);
  };
  CHECK(spoilt([](auto& x) { x.subject = "cpm"; }));
  CHECK(spoilt([](auto& x) { x.all.erase("mid"); }));
  CHECK(spoilt([](auto& x) { x.all["mid"] = std::uint16_t{2049}; }));
  CHECK(spoilt([](auto& x) { x.all["mid"] = std::int64_t{2050}; }));
  CHECK(spoilt([](auto& x) { x.all.erase("station_id"); }));
  CHECK(spoilt([](auto& x) { x.all["station_id"] = std::uint32_t{102}; }));
  CHECK(spoilt([](auto& x) { x.all["sofof"] = std::string{"ping"}; }));
  CHECK(spoilt([](auto& x) { x.body.clear(); }));
}

TEST_CASE("octets that were changed or cut off are read or not, and no more") {
  dice dice{1};
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(dice.between(0, static_cast<double>(n)));
  };
  int read = 0, not_read = 0;
  for (const auto& x : envelopes()) {
    const auto whole = to_amqp(x, some_day);
    for (int i = 0; i < 2000; ++i) {
      auto m = whole;
      auto* octets = &m.body;
      if (auto rest = m.all.find("sofof_rest"); rest != m.all.end() && i % 2)
        octets = std::get_if<std::vector<std::byte>>(&rest->second);
      if (octets->empty())
        break;
      if (i % 3 == 0)
        octets->resize(below(octets->size()));
      else
        for (auto n = 1 + below(4); n > 0; --n)
          (*octets)[below(octets->size())] = static_cast<std::byte>(below(256));
      ++(from_amqp(m) ? read : not_read);
    }
  }
  CHECK(read > 1000);
  CHECK(not_read > 1000);
}

TEST_CASE("vehicles get what is for them and what MCMs tell everybody") {
  const network::amqp::selector wanted{
      selector_of_vehicles({101, 103, 102, 120})};
  const auto gets = [&](std::uint8_t id, std::optional<station_id> to) {
    return wanted.matches(
        to_amqp({"", 7, to, 0, broadcast{its(id, 7)}}, some_day).all);
  };
  CHECK(gets(20, std::nullopt));
  CHECK_FALSE(gets(2, std::nullopt));
  for (std::uint32_t to = 95; to < 130; ++to)
    CHECK(gets(2, station_id{to}) == ((to >= 101 && to <= 103) || to == 120));
}

TEST_CASE("a provider gets what is for it or for everybody, not its own") {
  const network::amqp::selector wanted{selector_of_provider(900'000'001)};
  const auto gets = [&](std::uint32_t from, std::optional<station_id> to) {
    return wanted.matches(
        to_amqp({"", from, to, 0, broadcast{its(20, from)}}, some_day).all);
  };
  CHECK(gets(101, std::nullopt));
  CHECK(gets(101, station_id{900'000'001}));
  CHECK_FALSE(gets(101, station_id{900'000'002}));
  CHECK_FALSE(gets(900'000'001, std::nullopt));
}

} // namespace sofof::test::over_a_broker
