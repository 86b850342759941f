// Header by header, each of which says what the next one is.
#include "messages/v2x/captured_frame.hpp"

#include <algorithm>
#include <array>

namespace sofof::messages {

namespace {

/// Octets in order, until one is missing.
class octet_reader {
public:
  explicit octet_reader(std::span<const std::byte> octets) : rest_{octets} {}

  bool is_cut_off() const { return is_cut_off_; }
  std::span<const std::byte> rest() const { return rest_; }

  void skip(std::size_t count) { octets(count); }

  std::span<const std::byte> octets(std::size_t count) {
    if (count > rest_.size()) {
      is_cut_off_ = true;
      count = rest_.size();
    }
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  /// Big-endian, as the networks have it. @returns 0 where octets are missing.
  std::size_t number(std::size_t count) {
    std::size_t x = 0;
    for (const auto octet : octets(count))
      x = x << 8 | std::to_integer<std::size_t>(octet);
    return is_cut_off_ ? 0 : x;
  }

private:
  std::span<const std::byte> rest_;
  bool is_cut_off_ = false;
};

constexpr std::size_t geonet_type = 0x8947;
constexpr std::string_view cut_off = "the packet is cut off";

/// @returns what an EtherType of 802.2 (LLC and SNAP) says; 0: another LLC.
/// In 802.11p, from 2016 on, the EtherType may stand alone.
std::size_t type_after_llc(octet_reader& in) {
  constexpr std::array snap{std::byte{0xaa}, std::byte{0xaa}, std::byte{3}};
  const auto head = in.rest().first(std::min(snap.size(), in.rest().size()));
  if (std::ranges::equal(head, snap)) {
    constexpr std::size_t organisation = 3;
    in.skip(snap.size() + organisation);
  }
  return in.number(2);
}

std::size_t ethernet_type(octet_reader& in) {
  constexpr std::size_t addresses = 12, virtual_lan = 0x8100,
                        provider_lan = 0x88a8;
  in.skip(addresses);
  auto type = in.number(2);
  while (type == virtual_lan || type == provider_lan) {
    in.skip(2);
    type = in.number(2);
  }
  return type;
}

/// @returns 0 for what is no data, or encrypted.
std::size_t ieee80211_type(octet_reader& in) {
  const auto kind = in.number(1), flags = in.number(1);
  constexpr std::size_t version_and_type = 0x0f, data = 0x08, no_data = 0x40,
                        with_qos = 0x80;
  constexpr std::size_t to_and_from_ds = 0x03, is_protected = 0x40,
                        with_ht_control = 0x80;
  if ((kind & version_and_type) != data || (kind & no_data) != 0
      || (flags & is_protected) != 0)
    return 0;
  constexpr std::size_t duration = 2, addresses = 18, sequence = 2,
                        fourth_address = 6, qos = 2, ht_control = 4;
  in.skip(duration + addresses + sequence);
  if ((flags & to_and_from_ds) == to_and_from_ds)
    in.skip(fourth_address);
  if ((kind & with_qos) != 0) {
    in.skip(qos);
    if ((flags & with_ht_control) != 0)
      in.skip(ht_control);
  }
  return type_after_llc(in);
}

std::size_t radiotap_type(octet_reader& in) {
  constexpr std::size_t version_and_padding = 2, of_length = 2;
  in.skip(version_and_padding);
  const auto low = in.number(1), length = low | in.number(1) << 8;
  if (length < version_and_padding + of_length)
    return 0;
  in.skip(length - version_and_padding - of_length);
  return ieee80211_type(in);
}

/// Reads what is below GeoNetworking.
std::size_t network_type(link_layer begins_with, octet_reader& in) {
  constexpr std::size_t before_type = 14, after_type_2 = 18;
  switch (begins_with) {
    case link_layer::ethernet:
      return ethernet_type(in);
    case link_layer::ieee80211:
      return ieee80211_type(in);
    case link_layer::radiotap:
      return radiotap_type(in);
    case link_layer::linux_cooked:
      in.skip(before_type);
      return in.number(2);
    case link_layer::linux_cooked_2: {
      const auto type = in.number(2);
      in.skip(after_type_2);
      return type;
    }
  }
  return 0;
}

/// A length in the octet encoding rules, ITU-T X.696 section 8.6.
std::size_t oer_length(octet_reader& in) {
  constexpr std::size_t is_long = 0x80, longest = 4;
  const auto first = in.number(1);
  if (first < is_long)
    return first;
  const auto octets = first - is_long;
  return octets <= longest ? in.number(octets) : SIZE_MAX;
}

/// Reads until the payload of IEEE 1609.2 data, signed or not.
/// @returns why it cannot; empty: `in` is the payload.
std::string_view open_envelope(octet_reader& in, bool& is_signed) {
  constexpr std::size_t version = 3, unsecured = 0x80, is_signed_data = 0x81,
                        is_encrypted = 0x82;
  constexpr std::size_t with_data = 0x40; // and no hash of other data
  if (in.number(1) != version)
    return "its security header is of an unknown version";
  auto content = in.number(1);
  if (content == is_signed_data) {
    is_signed = true;
    in.skip(1); // which hash was signed
    if ((in.number(1) & with_data) == 0)
      return "it is signed, but carries no message";
    if (in.number(1) != version)
      return "its security header is of an unknown version";
    content = in.number(1);
  }
  if (content == is_encrypted)
    return "it is encrypted";
  if (content != unsecured)
    return "its security header is of an unknown kind";
  const auto payload = in.octets(oer_length(in));
  if (in.is_cut_off())
    return cut_off;
  in = octet_reader{payload};
  return {};
}

/// Source: EN 302 636-4-1, section 9.8.
enum class packet_kind : std::uint8_t {
  beacon = 1,
  unicast,
  anycast,
  broadcast,
  by_topology,
  location_service,
};

/// @returns how long a packet's extended header is, octets; 0 for packets
/// without a payload.
std::size_t extended_header(std::size_t kind) {
  constexpr std::size_t position = 24, short_position = 20, number = 4,
                        area = 16, channel = 4;
  switch (static_cast<packet_kind>(kind)) {
    case packet_kind::unicast:
      return number + position + short_position;
    case packet_kind::anycast:
    case packet_kind::broadcast:
      return number + position + area;
    case packet_kind::by_topology:
      return position + channel; // also number + position, over several hops
    case packet_kind::beacon:
    case packet_kind::location_service:
      break;
  }
  return 0;
}

/// @param in  Behind the basic header.
captured_packet read_common(octet_reader in, bool is_signed) {
  constexpr std::size_t btp_a = 1, btp_b = 2;
  const auto next = in.number(1) >> 4, kind = in.number(1) >> 4;
  in.skip(2); // traffic class, flags
  const auto length = in.number(2);
  in.skip(2); // hops
  const auto header = extended_header(kind);
  if (!in.is_cut_off() && ((next != btp_a && next != btp_b) || header == 0))
    return other_packet{};
  in.skip(header);
  octet_reader payload{in.octets(length)};
  btp_packet found{.port = static_cast<std::uint16_t>(payload.number(2)),
                   .is_signed = is_signed};
  payload.skip(2); // the source's port, or details of the destination
  if (in.is_cut_off() || payload.is_cut_off())
    return broken_packet{cut_off};
  found.message = payload.rest();
  return found;
}

} // namespace

captured_packet find_message(link_layer begins_with,
                             std::span<const std::byte> frame) {
  octet_reader in{frame};
  if (network_type(begins_with, in) != geonet_type)
    return other_packet{};
  constexpr std::size_t newest_version = 1, common = 1, secured = 2;
  const auto first = in.number(1);
  in.skip(3); // reserved, lifetime, remaining hops
  if (in.is_cut_off())
    return broken_packet{cut_off};
  if (first >> 4 > newest_version)
    return broken_packet{"its GeoNetworking is of an unknown version"};
  const auto next = first & 0x0f;
  if (next != common && next != secured)
    return other_packet{};
  bool is_signed = false;
  if (next == secured)
    if (const auto why = open_envelope(in, is_signed); !why.empty())
      return broken_packet{in.is_cut_off() ? cut_off : why};
  return read_common(in, is_signed);
}

} // namespace sofof::messages
