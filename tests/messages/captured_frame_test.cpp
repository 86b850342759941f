// ITS messages in frames as sniffers capture them.
#include "messages/v2x/captured_frame.hpp"

#include "messages/etsi/message.hpp"
#include "messages/v2x/geonet.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/hex.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>

using namespace sofof;
using namespace sofof::messages;
using test::from_hex;
using test::octets;

namespace {

octets operator+(octets a, const octets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

octets some_message(std::size_t size = 41) {
  octets message(size);
  for (std::size_t i = 0; i < size; ++i)
    message[i] = static_cast<std::byte>(i * 7 + 2);
  return message;
}

/// Ethernet of our own.
octets ethernet_frame(const octets& message) {
  std::string frame;
  append_frame(frame, {.station = 101, .station_type = 5}, btp_port::cam,
               message);
  octets x(frame.size());
  std::ranges::transform(frame, x.begin(),
                         [](char c) { return static_cast<std::byte>(c); });
  return x;
}

constexpr std::size_t ethernet_header = 14;

octets geonet_packet(const octets& message) {
  auto x = ethernet_frame(message);
  x.erase(x.begin(), x.begin() + ethernet_header);
  return x;
}

/// Behind a security header: version 3, signed data, SHA-256, a payload and no
/// hash, then unsecured data of this length; after it the rest of a signature.
octets signed_packet(const octets& message) {
  auto x = geonet_packet(message);
  constexpr std::size_t basic_header = 4;
  auto head = octets(x.begin(), x.begin() + basic_header);
  const auto rest = octets(x.begin() + basic_header, x.end());
  head[0] = std::byte{0x12};
  auto length =
      rest.size() < 128
          ? octets{static_cast<std::byte>(rest.size())}
          : octets{std::byte{0x82}, static_cast<std::byte>(rest.size() >> 8),
                   static_cast<std::byte>(rest.size())};
  return head + from_hex("038100400380") + length + rest
         + from_hex("4001240001b2c3d4e5f6a7b8");
}

const octets addresses = from_hex("ffffffffffff020000000065");
const octets to_all_80211 = from_hex("0000"
                                     "ffffffffffff"
                                     "020000000065"
                                     "ffffffffffff"
                                     "1000");

/// What a frame carries, for longer than the frame lives.
struct found_message {
  octets message;
  std::uint16_t port = 0;
  bool is_signed = false;
};

found_message found_in(link_layer layer, const octets& frame) {
  const auto found = find_message(layer, frame);
  const auto* packet = std::get_if<btp_packet>(&found);
  REQUIRE(packet);
  return {{packet->message.begin(), packet->message.end()},
          packet->port,
          packet->is_signed};
}

std::string trouble(const octets& frame) {
  const auto found = find_message(link_layer::ethernet, frame);
  const auto* broken = std::get_if<broken_packet>(&found);
  return broken ? std::string{broken->why} : "";
}

} // namespace

TEST_CASE("a message is found below each layer that sniffers record") {
  const auto message = some_message();
  const auto geonet = from_hex("8947") + geonet_packet(message);
  const auto snap = from_hex("aaaa03000000") + geonet;
  const auto found = [&](link_layer layer, const octets& frame) {
    const auto x = found_in(layer, frame);
    return x.message == message && x.port == btp_port::cam && !x.is_signed;
  };
  const auto padding = from_hex("00000000");
  CHECK(found(link_layer::ethernet, ethernet_frame(message)));
  CHECK(found(link_layer::ethernet, ethernet_frame(message) + padding));
  CHECK(found(link_layer::ethernet, addresses + from_hex("81000007") + geonet));
  CHECK(found(link_layer::ieee80211, from_hex("0800") + to_all_80211 + snap));
  CHECK(found(link_layer::ieee80211,
              from_hex("8800") + to_all_80211 + from_hex("0500") + snap));
  CHECK(found(link_layer::ieee80211,
              from_hex("8800") + to_all_80211 + from_hex("0500") + geonet));
  CHECK(found(link_layer::radiotap, from_hex("00000c000480000002001800")
                                        + from_hex("8800") + to_all_80211
                                        + from_hex("0500") + snap + padding));
  CHECK(found(link_layer::linux_cooked,
              from_hex("0001000100060200000000650000") + geonet));
  CHECK(found(link_layer::linux_cooked_2,
              from_hex("8947")
                  + from_hex("000000000002000101060200000000650000")
                  + geonet_packet(message)));
}

TEST_CASE("a signed message is found, and nobody says that it is genuine") {
  for (const std::size_t size : {20U, 41U, 300U}) {
    const auto message = some_message(size);
    const auto found =
        found_in(link_layer::ethernet,
                 addresses + from_hex("8947") + signed_packet(message));
    CHECK(found.message == message);
    CHECK(found.is_signed);
  }
}

TEST_CASE("a message comes by each kind of GeoNetworking packet that has one") {
  const auto message = some_message();
  const auto packet = geonet_packet(message);
  const octets head(packet.begin(), packet.begin() + 12);
  const octets payload(packet.begin() + 40, packet.end());
  struct kind {
    int code;
    std::size_t header;
  };
  for (const auto& [code, header] :
       {kind{0x20, 48}, {0x30, 44}, {0x41, 44}, {0x50, 28}, {0x51, 28}}) {
    CAPTURE(code);
    auto frame = addresses + from_hex("8947") + head + octets(header) + payload;
    frame[ethernet_header + 5] = static_cast<std::byte>(code);
    CHECK(found_in(link_layer::ethernet, frame).message == message);
  }
}

TEST_CASE("what carries no message is none, and what should is broken") {
  const auto is_other = [](link_layer layer, const octets& frame) {
    return std::holds_alternative<other_packet>(find_message(layer, frame));
  };
  CHECK(is_other(link_layer::ethernet, {}));
  CHECK(is_other(link_layer::ethernet, addresses + from_hex("0800450000")));
  CHECK(is_other(link_layer::ieee80211, from_hex("80000000"))); // beacon
  CHECK(is_other(link_layer::ieee80211,
                 from_hex("0840") + to_all_80211 + from_hex("8947")));
  auto beacon = ethernet_frame(some_message());
  beacon[ethernet_header + 5] = std::byte{0x10};
  CHECK(is_other(link_layer::ethernet, beacon));

  auto whole = ethernet_frame(some_message());
  CHECK(trouble(whole) == "");
  for (auto size = ethernet_header; size < whole.size(); ++size)
    REQUIRE(trouble({whole.begin(), whole.begin() + size})
            == "the packet is cut off");
  auto newer = whole;
  newer[ethernet_header] = std::byte{0x21};
  CHECK(trouble(newer) == "its GeoNetworking is of an unknown version");
  auto secret = addresses + from_hex("8947") + signed_packet(some_message());
  secret[ethernet_header + 5] = std::byte{0x82};
  CHECK(trouble(secret) == "it is encrypted");
}

TEST_CASE("mutated frames are read within their bounds or refused") {
  test::dice dice{7};
  const auto pick = [&dice](std::size_t below) {
    return static_cast<std::size_t>(
        dice.between(0, static_cast<double>(below)));
  };
  const octets starts[]{
      ethernet_frame(some_message()),
      addresses + from_hex("8947") + signed_packet(some_message()),
      from_hex("00000c000480000002001800") + from_hex("8800") + to_all_80211
          + from_hex("0500aaaa030000008947") + signed_packet(some_message())};
  for (int i = 0; i < 100'000; ++i) {
    auto frame = starts[pick(3)];
    for (auto changes = 1 + pick(4); changes > 0; --changes)
      frame[pick(frame.size())] = static_cast<std::byte>(pick(256));
    frame.resize(std::min(frame.size(), 1 + pick(2 * frame.size())));
    const octets exact = frame; // no room behind it
    const auto found = find_message(static_cast<link_layer>(pick(5)), exact);
    if (const auto* x = std::get_if<btp_packet>(&found)) {
      REQUIRE(x->message.size() <= exact.size());
      (void)etsi::decode_message(x->message);
    }
  }
}
