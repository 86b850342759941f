// The packed encoding rules, bit by bit, on types of our own.
#include "messages/etsi/uper.hpp"

#include "messages/etsi/explain.hpp"
#include "messages/etsi/hex.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>

namespace sofof::messages::etsi {
namespace {

enum class colour : std::uint8_t { red, green, blue };
enum class mood : std::uint8_t { glad, sad };

struct pair {
  static constexpr auto may_grow = extensible;
  integer<0, 7> first;
  std::optional<integer<0, 7>> second;

  static void fields(auto& x, auto&& visit) {
    visit("first", x.first);
    visit("second", x.second);
  }
};

struct nested {
  pair before;
  integer<0, 255> after;

  static void fields(auto& x, auto&& visit) {
    visit("before", x.before);
    visit("after", x.after);
  }
};

struct usual {
  defaulted<integer<0, 255>, 7> number;

  static void fields(auto& x, auto&& visit) { visit("number", x.number); }
};

using either =
    choice<alternative<"number", integer<0, 15>>, alternative<"flag", bool>>;
using perhaps = extensible_choice<alternative<"only", integer<0, 15>>>;
using box = open_type<integer<1, 16>, registered<2, "Pair", pair>>;

/// @returns zeros and ones, the last octet filled with zeros; nothing if it
/// cannot be encoded.
template <class T>
std::string bits_of(const T& x) {
  std::array<std::byte, 600> out{};
  const auto size = encode(x, out);
  std::string bits;
  for (std::size_t i = 0; i < size * 8; ++i)
    bits += (std::to_integer<unsigned>(out[i / 8]) >> (7 - i % 8) & 1) != 0
                ? '1'
                : '0';
  return bits;
}

std::vector<std::byte> octets_of(std::string bits) {
  bits.resize((bits.size() + 7) / 8 * 8, '0');
  std::vector<std::byte> octets(bits.size() / 8);
  for (std::size_t i = 0; i < bits.size(); ++i)
    if (bits[i] == '1')
      octets[i / 8] |= static_cast<std::byte>(0x80u >> i % 8);
  return octets;
}

/// @returns what is decoded; nothing if it is refused.
template <class T>
std::optional<T> read_bits(const std::string& bits) {
  T x;
  return decode(octets_of(bits), x) ? std::optional{x} : std::nullopt;
}

template <class T>
std::string fault_of(const std::string& bits) {
  return explain_decoding<T>(octets_of(bits));
}

} // namespace

template <>
inline constexpr auto names_of<colour> = enumerated("red", "green", "blue");
template <>
inline constexpr auto names_of<mood> = enumerated_extensible("glad", "sad");

TEST_CASE("a number takes the bits that its range needs, from its low end on") {
  CHECK(bits_of(integer<0, 255>{1}) == "00000001");
  CHECK(bits_of(integer<10, 13>{12}) == "10000000");
  CHECK(bits_of(integer<-5, 2>{-5}) == "00000000");
  CHECK(bits_of(integer<-5, 2>{2}) == "11100000");
  CHECK(bits_of(integer<0, 4'398'046'511'103>{4'398'046'511'103})
        == std::string(42, '1') + std::string(6, '0'));
  CHECK(bits_of(integer<0, 100>{100}) == "11001000");
  CHECK(read_bits<integer<-5, 2>>("110")->value == 1);
  CHECK(read_bits<integer<3, 3>>("")->value == 3);
}

TEST_CASE("a number beyond its range is neither written nor read") {
  CHECK(bits_of(integer<0, 100>{101}) == "");
  CHECK(bits_of(integer<-5, 2>{-6}) == "");
  CHECK(explain_encoding(integer<-5, 2>{-6}) == "the message = -6 is below -5");
  CHECK(!read_bits<integer<0, 100>>("1100101"));
  CHECK(fault_of<integer<0, 100>>("1100101")
        == "the message = 101 is beyond 100, at bit 0 of 8");
}

TEST_CASE("an extended number goes behind a length") {
  using type = extensible_integer<1, 255>;
  CHECK(bits_of(type{255}) == "0111111100000000");
  CHECK(bits_of(type{256})
        == "1"
           "00000010"
           "0000000100000000"
           "0000000");
  CHECK(bits_of(type{-1})
        == "1"
           "00000001"
           "11111111"
           "0000000");
  CHECK(bits_of(type{128 * 256})
        == "1"
           "00000011"
           "000000001000000000000000"
           "0000000");
  for (const auto value : {0, -1, 127, 128, 256, -128, -129, 32767, 32768,
                           -32769, 8388607, 2147483647, -2147483647 - 1}) {
    CAPTURE(value);
    CHECK(read_bits<type>(bits_of(type{value}))->value == value);
  }
  CHECK(fault_of<type>("1"
                       "00000101")
        == "the message has a length beyond 4, at bit 2 of 16");
  CHECK(!read_bits<type>("1"
                         "00000000"));
}

TEST_CASE("an enumeration counts its names") {
  CHECK(bits_of(colour::blue) == "10000000");
  CHECK(*read_bits<colour>("01") == colour::green);
  CHECK(!read_bits<colour>("11"));
  CHECK(bits_of(static_cast<colour>(3)) == "");
}

TEST_CASE("an enumeration that grew keeps values that have no name yet") {
  CHECK(bits_of(mood::sad) == "01000000");
  const auto later = read_bits<mood>("1"
                                     "0"
                                     "000101");
  REQUIRE(later);
  CHECK(static_cast<int>(*later) == 7);
  CHECK(bits_of(*later) == "10000101");
  CHECK(!read_bits<mood>("1"
                         "1"
                         "00000001"
                         "01000000"));
}

TEST_CASE("optional members are announced before the first member") {
  CHECK(bits_of(pair{5, {}}) == "00101000");
  CHECK(bits_of(pair{5, integer<0, 7>{3}}) == "01101011");
  const auto both = read_bits<pair>("01101011");
  REQUIRE(both);
  CHECK(both->first == 5);
  CHECK(both->second == 3);
}

TEST_CASE("additions of later versions are skipped") {
  // Two additions, the second there, with two octets; and one behind it.
  const auto x = read_bits<nested>("1"
                                   "0"
                                   "101"
                                   "0"
                                   "000001"
                                   "01"
                                   "00000010"
                                   "1111111100000000"
                                   "00001001");
  REQUIRE(x);
  CHECK(x->before.first == 5);
  CHECK(!x->before.second);
  CHECK(x->after == 9);
  CHECK(fault_of<nested>("1"
                         "0"
                         "101"
                         "0"
                         "000000"
                         "1"
                         "01111111"
                         "11")
        == "before needs 1016 bits, more than are left, at bit 14 of 24");
}

TEST_CASE("a member with its usual value is not sent") {
  CHECK(bits_of(usual{7}) == "00000000");
  CHECK(bits_of(usual{8})
        == "1"
           "00001000"
           "0000000");
  CHECK(read_bits<usual>("0")->number.value == 7);
}

TEST_CASE("room that is used again forgets what it held") {
  pair x{5, integer<0, 7>{3}};
  REQUIRE(decode(octets_of("00001000"), x));
  CHECK(!x.second);
  usual y{9};
  REQUIRE(decode(octets_of("0"), y));
  CHECK(y.number.is_usual());
}

TEST_CASE("a choice tells which way it goes") {
  either flag;
  flag.value.emplace<1>(true);
  CHECK(bits_of(flag) == "11000000");
  CHECK(bits_of(perhaps{}) == "00000000"); // the only one needs no index
  CHECK(read_bits<either>("01111")->value.index() == 0);
  CHECK(fault_of<perhaps>("1"
                          "0"
                          "000000")
        == "the message is alternative 1, and only 0 to 0 are known, at bit 2 "
           "of 8");
}

TEST_CASE("a list tells how long it is") {
  using list = sequence_of<integer<0, 7>, 1, 4>;
  using growing = extensible_sequence_of<integer<0, 7>, 1, 4>;
  list three;
  for (const std::uint8_t x : {1, 2, 3})
    three.push_back(x);
  CHECK(bits_of(three)
        == "10"
           "001"
           "010"
           "011"
           "00000");
  CHECK(read_bits<list>("10"
                        "001"
                        "010"
                        "011")
            ->size()
        == 3);
  CHECK(bits_of(list{}) == "");
  CHECK(explain_encoding(list{})
        == "the message has 0 entries, and only 1 to 4 are allowed");
  CHECK(fault_of<growing>("1"
                          "00000101")
        == "the message has 5 entries, and only 1 to 4 are allowed, at bit 2 "
           "of 16");
  CHECK(fault_of<list>("10"
                       "001"
                       "010")
        == "[2] needs 3 bits, more than are left, at bit 8 of 8");
  using six = sequence_of<integer<0, 7>, 0, 5>;
  CHECK(!read_bits<six>("110"));
}

TEST_CASE("bits of a bit string go first to last") {
  bit_string<7> bits;
  bits.set(0);
  bits.set(5);
  CHECK(bits_of(bits) == "10000100");
  CHECK(read_bits<bit_string<7>>("1000010")->test(5));
  CHECK(bits_of(bit_string<7>{128}) == "");
}

TEST_CASE("an open type knows how long it is") {
  const box known{{}, pair{5, {}}};
  const std::string text = "0001"
                           "00000001"
                           "00101000"
                           "0000";
  CHECK(bits_of(known) == text);
  CHECK(std::get<pair>(read_bits<box>(text)->value).first == 5);

  // More inside than is known is skipped, less is refused.
  const auto longer = read_bits<box>("0001"
                                     "00000010"
                                     "00101000"
                                     "11111111");
  REQUIRE(longer);
  CHECK(std::get<pair>(longer->value).first == 5);
  CHECK(!read_bits<box>("0001"
                        "00000000"));
  CHECK(fault_of<box>("0001"
                      "00000010"
                      "0000")
        == "the message needs 16 bits, more than are left, at bit 5 of 16");
}

TEST_CASE("an open type of an unknown number is kept as it is") {
  const std::string text = "1001"
                           "00000010"
                           "1010101001010101"
                           "0000";
  const auto unknown = read_bits<box>(text);
  REQUIRE(unknown);
  CHECK(unknown->id() == 10);
  CHECK(std::get<opaque>(unknown->value).octets.size() == 2);
  CHECK(bits_of(*unknown) == text);
}

TEST_CASE("lengths from 128 on take two octets, from 16384 on are refused") {
  box unknown{10, opaque{}};
  auto& octets = std::get<opaque>(unknown.value).octets;
  octets.resize(127);
  CHECK(bits_of(unknown).substr(4, 8) == "01111111");
  octets.resize(128);
  CHECK(bits_of(unknown).substr(4, 16) == "1000000010000000");
  CHECK(std::get<opaque>(read_bits<box>(bits_of(unknown))->value).octets.size()
        == 128);
  octets.resize(16384);
  CHECK(explain_encoding(unknown) == "the message has a length beyond 16383");
  CHECK(fault_of<box>("1001"
                      "11000001")
        == "the message has a length beyond 16383, at bit 5 of 16");
}

TEST_CASE("only zeros fill the last octet, and nothing follows it") {
  CHECK(read_bits<integer<0, 7>>("101"));
  CHECK(!read_bits<integer<0, 7>>("10100001"));
  CHECK(fault_of<integer<0, 7>>("10100001")
        == "the bits that fill the last octet are not all zero, at bit 3 of 8");
  CHECK(!read_bits<integer<0, 7>>("10100000"
                                  "00000000"));
  CHECK(fault_of<integer<0, 7>>("10100000"
                                "00000000")
        == "more follows than the message is long, at bit 3 of 16");
}

TEST_CASE("a buffer that is too small is not overrun") {
  sequence_of<integer<0, 255>, 0, 9> list;
  for (std::uint8_t x = 0; x < 9; ++x)
    list.push_back(x);
  std::array<std::byte, 10> room{};
  for (std::size_t size = 0; size < room.size(); ++size)
    CHECK(encode(list, std::span{room}.first(size)) == 0);
  CHECK(encode(list, room) == 10);
  CHECK(encoded_size(list) == 10);
}

} // namespace sofof::messages::etsi
