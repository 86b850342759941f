// The scene message: what each part of it takes, and what is refused.
#include "messages/v2x/scene/scene_message.hpp"

#include "messages/etsi/explain.hpp"
#include "messages/etsi/message.hpp"
#include "messages/v2x/encoded.hpp"
#include "tests/messages/codec_laws.hpp"
#include "tests/support/allocations.hpp"

#include <doctest/doctest.h>

#include <bitset>
#include <string>

namespace sofof::messages {
namespace {

scene_message empty_scene() {
  scene_message m;
  m.header.station = 9001;
  m.body.generation = 1000;
  m.body.age = 120;
  m.body.reference = {484'010'822, 99'876'076};
  return m;
}

/// Somebody leads, and two cross.
scene_message typical_scene() {
  auto m = empty_scene();
  auto& lead = m.body.lead.emplace();
  lead.station = 102;
  lead.rear = 2345;
  lead.speed = 1389;
  lead.accel = -50;
  m.body.crossings.push_back({{4000, 510}, 230, 180, true, 12, 7});
  m.body.crossings.push_back({{4320, 480},
                              -30,
                              scene::stays_for_ever,
                              false,
                              scene::brakes_beyond,
                              0x80000066});
  return m;
}

/// As long as it can be.
scene_message full_scene() {
  auto m = typical_scene();
  auto& x = m.body;
  x.lead->told.emplace().resize(scene::most_moments);
  for (auto& moment : *x.lead->told)
    moment.time.value = 21;
  x.crossings.resize(scene::most_crossings);
  x.beside.resize(scene::most_bodies);
  for (auto& body : x.beside)
    body = {{}, 0, 0, {1}, {1}, {1}};
  x.yields.resize(scene::most_yields);
  x.keep_free.resize(scene::most_kept_free);
  return m;
}

/// A number from `low` on in so many bits, the highest first.
std::string in_bits(int count, std::int64_t number, std::int64_t low = 0) {
  return std::bitset<64>{static_cast<std::uint64_t>(number - low)}
      .to_string()
      .substr(static_cast<std::size_t>(64 - count));
}

std::string beginning(bool has_lead, bool is_impatient) {
  return in_bits(8, 1) + in_bits(8, 255) + in_bits(32, 9001) // header
         + in_bits(1, has_lead) + in_bits(16, 1000) + in_bits(13, 120)
         + in_bits(31, 484'010'822, -900'000'000)
         + in_bits(32, 99'876'076, -1'800'000'000) + in_bits(1, is_impatient);
}

std::string filled(std::string all) {
  all.append((8 - all.size() % 8) % 8, '0');
  return all;
}

} // namespace

TEST_CASE("a scene with nobody in it takes 21 octets") {
  const auto octets = test::uper_of(empty_scene());
  CHECK(test::to_bits(octets)
        == filled(beginning(false, false) + in_bits(6, 0) + in_bits(5, 0)
                  + in_bits(5, 0) + in_bits(5, 0)));
  CHECK(test::to_hex(octets) == "01ff0000232901f401e293f2a23389ee7760000000");
}

TEST_CASE("a scene with a lead and two who cross takes 55 octets") {
  const auto octets = test::uper_of(typical_scene());
  const auto expected =
      beginning(true, false)
      + "10" // of a known station, which tells nothing of its drive
      + in_bits(32, 102) + in_bits(16, 2345, -16'384) + in_bits(14, 1389)
      + in_bits(12, -50, -2048) + in_bits(6, 2) + in_bits(16, 4000, -16'384)
      + in_bits(16, 510) + in_bits(14, 230, -8192) + in_bits(14, 180) + "1"
      + in_bits(6, 12) + in_bits(32, 7, 1) + in_bits(16, 4320, -16'384)
      + in_bits(16, 480) + in_bits(14, -30, -8192) + in_bits(14, 16'383) + "0"
      + in_bits(6, 63) + in_bits(32, 0x80000066, 1) + in_bits(5, 0)
      + in_bits(5, 0) + in_bits(5, 0);
  CHECK(test::to_bits(octets) == filled(expected));
  CHECK(test::to_hex(octets)
        == "01ff0000232981f401e293f2a23389ee776200000066492915b5f382"
           "4fa001fe83980b4980000000ca1c003c0ff17ffefe000001940000");
}

TEST_CASE("a body beside takes 10 octets, less what it has not") {
  auto m = empty_scene();
  const auto without = etsi::encoded_size(m) * 8;
  m.body.beside.push_back({{1200, 450}, -1750, -600, {-13'888}, {35}, {3250}});
  auto expected = beginning(false, false) + in_bits(6, 0) + in_bits(5, 1)
                  + "111" + in_bits(16, 1200, -16'384) + in_bits(16, 450)
                  + in_bits(16, -1750, -32'768) + in_bits(16, -600, -32'768)
                  + in_bits(18, -13'888, -131'072) + in_bits(11, 35)
                  + in_bits(14, 3250) + in_bits(5, 0) + in_bits(5, 0);
  CHECK(test::to_bits(test::uper_of(m)) == filled(expected));
  m.body.beside[0].speed.value = 0;
  m.body.beside[0].lacks.value = 0;
  m.body.beside[0].left.value = 0;
  CHECK(etsi::encoded_size(m) * 8 - without <= 72); // 67, and to the octet
}

TEST_CASE("of a told drive a moment takes 13 bits, at the usual steps") {
  auto m = empty_scene();
  auto& told = m.body.lead.emplace().told.emplace();
  told.resize(1);
  const auto one = etsi::encoded_size(m);
  told.resize(1 + 8);
  CHECK(etsi::encoded_size(m) == one + 13);
  for (auto& moment : told)
    moment.time.value = 21;
  told.resize(1);
  CHECK(etsi::encoded_size(m) - one <= 2);
}

TEST_CASE("yields and what stays free follow in order") {
  auto m = empty_scene();
  m.body.is_impatient = true;
  m.body.yields.push_back(4000);
  m.body.keep_free.push_back({-200, 900});
  const auto expected = beginning(false, true) + in_bits(6, 0) + in_bits(5, 0)
                        + in_bits(5, 1) + in_bits(16, 4000, -16'384)
                        + in_bits(5, 1) + in_bits(16, -200, -16'384)
                        + in_bits(16, 900);
  CHECK(test::to_bits(test::uper_of(m)) == filled(expected));
}

TEST_CASE("the longest scene fits, and a longer list does not") {
  CHECK(etsi::encoded_size(full_scene()) < longest_message);
  CHECK(encoded(full_scene()).octets.size()
        == etsi::encoded_size(full_scene()));
  const auto is_refused = [](const auto& prolong) {
    auto m = full_scene();
    prolong(m.body);
    return encoded(m).octets.empty();
  };
  CHECK(is_refused([](auto& x) { x.crossings.push_back({}); }));
  const auto message = full_scene();
  CHECK(message.body.beside.capacity() == scene::most_bodies);
  CHECK(message.body.yields.capacity() == scene::most_yields);
  CHECK(message.body.keep_free.capacity() == scene::most_kept_free);
  CHECK(message.body.lead->told->capacity() == scene::most_moments);
}

TEST_CASE("what is no scene message is not decoded as one") {
  const auto whole = test::uper_of(typical_scene());
  scene_message back;
  REQUIRE(etsi::decode(whole, back));
  for (const auto octet : {std::size_t{0}, std::size_t{1}}) {
    for (int value = 0; value < 256; ++value) {
      auto other = whole;
      other[octet] = static_cast<std::byte>(value);
      CHECK(etsi::decode(other, back) == (other == whole));
    }
  }
  auto other = whole;
  other[1] = std::byte{20};
  CHECK(etsi::explain_decoding<scene_message>(other)
        == "this is an MCM of protocol version 1, and not a message 255 of "
           "protocol version 1");
}

TEST_CASE("no message of ETSI's has the key of a scene message") {
  CHECK_FALSE(etsi::make_message(scene_message::protocol_version,
                                 scene_message::message_id)
                  .value);
  CHECK_FALSE(etsi::decode_message(test::uper_of(typical_scene())).value);
}

TEST_CASE("a scene message says whose it is as all ITS messages do") {
  CHECK(encoded(typical_scene()).station() == station_id{9001});
}

TEST_CASE("a scene message that is cut off or goes on is refused") {
  for (const auto& m : {empty_scene(), typical_scene(), full_scene()}) {
    const auto whole = test::uper_of(m);
    scene_message back;
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const test::octets part(whole.data(), whole.data() + size);
      CHECK_FALSE(etsi::decode(part, back));
    }
    auto longer = whole;
    longer.push_back(std::byte{0});
    CHECK_FALSE(etsi::decode(longer, back));
  }
}

TEST_CASE("the body of a crossing has a number") {
  auto m = typical_scene();
  m.body.crossings[0].body = 0;
  CHECK(test::uper_of(m).empty());
}

TEST_CASE("scene messages of any content come back, within their ranges") {
  test::check_random_messages<scene_message>(500);
  test::check_ranges<scene_message>(5);
}

TEST_CASE("scene messages that end early or are damaged do no harm") {
  test::check_truncation<scene_message>(20);
  test::check_damage<scene_message>(1000);
}

TEST_CASE("encoding a scene message takes nothing from the heap") {
  static std::array<std::byte, longest_message> room;
  const auto message = full_scene();
  const auto before = test::allocations;
  const auto octets = etsi::encode(message, room);
  const auto after = test::allocations;
  REQUIRE(octets > 0);
  CHECK(after == before);
}

} // namespace sofof::messages
