// Subscribers that select by C-ROADS' properties find SOFOF's messages.
#include "actors/broker/c_roads.hpp"

#include "actors/broker/wire.hpp"
#include "messages/etsi/message.hpp"
#include "network/amqp/selector.hpp"

#include <doctest/doctest.h>

#include <string>

namespace sofof::test::c_roads {

using namespace actors::wire;
using network::amqp::find;

constexpr std::chrono::milliseconds some_day{1'700'000'000'000};

/// The pilot crossing of Ulm-Lehr.
constexpr std::int32_t latitude = 484'323'600, longitude = 99'687'300;

template <class T>
network::amqp::message written(T x, std::uint32_t station = 101) {
  x.header.station = station;
  auto octets = messages::etsi::encode_message(x);
  REQUIRE_MESSAGE(octets.value, octets.error);
  return to_amqp({.from = station,
                  .what = broadcast{{.octets = std::move(*octets.value)}}},
                 some_day);
}

network::amqp::message written_cam() {
  messages::etsi::cam x;
  auto& basic = x.body.parameters.basic;
  basic.station_type = 5;
  basic.position.latitude = latitude;
  basic.position.longitude = longitude;
  return written(std::move(x));
}

std::string text(const network::amqp::message& m, std::string_view name) {
  const auto* found = find<std::string>(m.all, name);
  return found ? *found : "";
}

TEST_CASE("a tile's key begins with those of the tiles around it") {
  // The pilot crossing at level 18, computed by hand after Bing's description.
  CHECK(quadtree_key(48.43236, 9.96873) == "120221112001033211");
  // The four quarters of the Earth, and its corners.
  CHECK(quadtree_key(1, -1).starts_with("03"));
  CHECK(quadtree_key(1, 1).starts_with("12"));
  CHECK(quadtree_key(-1, -1).starts_with("21"));
  CHECK(quadtree_key(-1, 1).starts_with("30"));
  CHECK(quadtree_key(90, -180) == std::string(quadtree_levels, '0'));
  CHECK(quadtree_key(-90, 180) == std::string(quadtree_levels, '3'));
}

TEST_CASE("places in one street have one key, places in two towns do not") {
  const auto here = quadtree_key(48.43236, 9.96873);
  CHECK(quadtree_key(48.43237, 9.96874) == here);
  CHECK(quadtree_key(48.7758, 9.1829).substr(0, 10) != here.substr(0, 10));
}

TEST_CASE("a CAM has what a C-ROADS subscriber selects by") {
  auto m = written_cam();
  const auto before = m.all.size();
  add_c_roads_properties(m, "DE12345");
  CHECK(text(m, "messageType") == "CAM");
  CHECK(text(m, "protocolVersion") == "CAM:1.4.1");
  CHECK(text(m, "publisherId") == "DE12345");
  CHECK(text(m, "publicationId") == "DE12345:sofof-CAM");
  CHECK(text(m, "originatingCountry") == "DE");
  CHECK(text(m, "quadTree") == ",120221112001033211,");
  CHECK(*find<double>(m.all, "latitude") == doctest::Approx(48.43236));
  CHECK(*find<double>(m.all, "longitude") == doctest::Approx(9.96873));
  CHECK(*find<std::int64_t>(m.all, "timestamp") == some_day.count());
  CHECK(*find<std::int64_t>(m.all, "stationType") == 5);
  CHECK(m.all.size() == before + 10);

  const auto selects = [&](std::string_view what) {
    return network::amqp::selector{std::string{what}}.matches(m.all);
  };
  CHECK(selects("originatingCountry = 'DE' AND messageType = 'CAM' AND "
                "(quadTree LIKE '%,1202210%' OR quadTree LIKE '%,1202211%')"));
  CHECK_FALSE(selects("quadTree LIKE '%,1202210%'"));
  // The institute's receivers find it as before.
  CHECK(selects("NOT(station_id = 102) AND mid = 2050"));
}

template <class T>
std::string type_of(T x, auto position) {
  position(x).latitude = latitude;
  position(x).longitude = longitude;
  auto m = written(std::move(x));
  add_c_roads_properties(m, "DE1");
  return text(m, "messageType");
}

TEST_CASE("each kind of message is called by its name") {
  using namespace messages::etsi;
  CHECK(type_of(
            tr103562::cpm{}, [](auto& x) -> auto& {
              return x.body.parameters.management.position;
            })
        == "CPM");
  CHECK(type_of(
            mcm{},
            [](auto& x) -> auto& { return x.body.parameters.basic.position; })
        == "MCM");
}

TEST_CASE("a message that says no place stays as it is") {
  auto m = written(messages::etsi::cam{});
  const auto before = m;
  add_c_roads_properties(m, "DE12345");
  CHECK((m == before));
  m.body.resize(7);
  const auto cut = m;
  add_c_roads_properties(m, "DE12345");
  CHECK((m == cut));
}

TEST_CASE("messages of publishers that only know C-ROADS are heard") {
  auto m = written_cam();
  m.all.clear();
  CHECK_FALSE(from_amqp(m));
  m.all["messageType"] = std::string{"CAM"};
  const auto read = from_amqp(m);
  REQUIRE(read);
  CHECK(read->from == 101);
  CHECK_FALSE(read->to);
  CHECK(std::get<broadcast>(read->what).message.octets == m.body);
  // A provider's selector lets them through.
  CHECK(network::amqp::selector{selector_of_provider(900'000'001)}.matches(
      m.all));

  m.all["messageType"] = std::string{"DENM"};
  CHECK_FALSE(from_amqp(m));
  m.all["messageType"] = std::string{"CAM"};
  m.body.resize(3);
  CHECK_FALSE(from_amqp(m));
}

TEST_CASE("a publisher is a country and a number") {
  for (const auto* good : {"DE1", "NO00000", "SE1234567890"})
    CHECK(is_publisher(good));
  for (const auto* bad : {"", "D", "DE", "de1", "DE12345678901", "DE1x", "1DE"})
    CHECK_FALSE(is_publisher(bad));
}

} // namespace sofof::test::c_roads
