// Reads a capture of ITS messages from the bytes on, with nothing of ours.
#pragma once

#include "tests/support/hex.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::test {

/// Numbers and stretches, one after the other.
class octet_reader {
public:
  explicit octet_reader(std::string_view text) : rest_{text} {}

  bool at_end() const { return rest_.empty(); }

  std::string_view take(std::size_t count) {
    if (count > rest_.size())
      throw std::runtime_error{"the capture ends too early"};
    const auto taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  /// As networks have them.
  std::uint64_t big_endian(std::size_t count) {
    std::uint64_t x = 0;
    for (const auto c : take(count))
      x = x << 8 | static_cast<unsigned char>(c);
    return x;
  }

  /// As the machine has them that this runs on.
  std::uint64_t little_endian(std::size_t count) {
    std::uint64_t x = 0;
    const auto taken = take(count);
    for (auto i = taken.rbegin(); i != taken.rend(); ++i)
      x = x << 8 | static_cast<unsigned char>(*i);
    return x;
  }

private:
  std::string_view rest_;
};

/// One message with what the layers below say of its sender.
struct captured {
  std::uint64_t unix_ns = 0;
  std::uint64_t ethernet_source = 0;
  std::uint64_t station_type = 0;
  std::uint64_t address = 0; ///< Of GeoNetworking, 48 bits.
  std::uint32_t timestamp = 0;
  std::int32_t latitude = 0, longitude = 0;
  std::uint64_t speed = 0, heading = 0;
  bool is_mobile = false, is_accurate = false;
  std::uint64_t port = 0;
  octets message;
};

/// @throws std::runtime_error for what is no Ethernet frame with a
/// GeoNetworking single-hop broadcast of a BTP-B packet.
inline captured take_apart(std::string_view frame) {
  octet_reader in{frame};
  captured x;
  const auto expect = [](std::uint64_t is, std::uint64_t should_be,
                         const char* what) {
    if (is != should_be)
      throw std::runtime_error{std::string{"unexpected "} + what};
  };
  expect(in.big_endian(6), 0xffff'ffff'ffff, "receiver");
  x.ethernet_source = in.big_endian(6);
  expect(in.big_endian(2), 0x8947, "EtherType");

  expect(in.big_endian(1), 0x11, "version or next header");
  expect(in.big_endian(1), 0, "reserved octet");
  in.take(1); // lifetime
  expect(in.big_endian(1), 1, "hop limit");
  expect(in.big_endian(1), 0x20, "header after the common one");
  expect(in.big_endian(1), 0x50, "kind of packet");
  in.take(1); // traffic class
  const auto flags = in.big_endian(1);
  const auto payload = in.big_endian(2);
  expect(in.big_endian(1), 1, "largest hop limit");
  in.take(1);
  x.station_type = in.big_endian(2) >> 10 & 0x1f;
  x.address = in.big_endian(6);
  x.timestamp = static_cast<std::uint32_t>(in.big_endian(4));
  x.latitude = static_cast<std::int32_t>(in.big_endian(4));
  x.longitude = static_cast<std::int32_t>(in.big_endian(4));
  const auto speed = in.big_endian(2);
  x.is_mobile = flags == 0x80;
  x.is_accurate = (speed & 0x8000) != 0;
  x.speed = speed & 0x7fff;
  x.heading = in.big_endian(2);
  in.take(4);

  constexpr std::size_t btp = 4;
  if (payload < btp)
    throw std::runtime_error{"the payload is too short"};
  x.port = in.big_endian(2);
  in.take(2);
  for (const auto c : in.take(payload - btp))
    x.message.push_back(static_cast<std::byte>(c));
  if (!in.at_end())
    throw std::runtime_error{"the frame is longer than its payload"};
  return x;
}

/// @param file  The content of a pcap file with nanoseconds.
/// @throws std::runtime_error for anything else.
inline std::vector<captured> read_capture(std::string_view file) {
  octet_reader in{file};
  if (in.little_endian(4) != 0xa1b23c4d || in.little_endian(2) != 2
      || in.little_endian(2) != 4)
    throw std::runtime_error{"this is no pcap file of version 2.4"};
  in.take(12); // zone, accuracy, longest packet
  if (in.little_endian(4) != 1)
    throw std::runtime_error{"this is no Ethernet"};
  std::vector<captured> all;
  while (!in.at_end()) {
    const auto s = in.little_endian(4), ns = in.little_endian(4);
    const auto kept = in.little_endian(4), sent = in.little_endian(4);
    if (kept != sent || ns >= 1'000'000'000)
      throw std::runtime_error{"a packet is cut off or has no time"};
    all.push_back(take_apart(in.take(kept)));
    all.back().unix_ns = s * 1'000'000'000 + ns;
  }
  return all;
}

} // namespace sofof::test
