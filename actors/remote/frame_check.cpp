// Frames of BASP 0.18.7, read as far as they have to be judged.
#include "actors/remote/frame_check.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace sofof {

namespace {

/// Source: caf/io/basp/message_type.hpp.
enum operation : std::uint8_t {
  server_handshake,
  client_handshake,
  direct_message,
  routed_message,
  monitor_message,
  down_message,
  basp_heartbeat,
};

/// Source: caf/message_id.hpp.
constexpr std::uint64_t told_id = 0x1000'0000'0000'0000;
constexpr std::uint64_t response_bit = 0x8000'0000'0000'0000;
constexpr std::uint64_t stream_bit = 0x2000'0000'0000'0000;
constexpr std::uint64_t number_bits = 0x0fff'ffff'ffff'ffff;

/// A node id: its kind, then process and host.
constexpr std::size_t node_size = 1 + 4 + 20;
constexpr std::byte hashed_node{1};

constexpr std::size_t longest_server_handshake = 4096;
constexpr std::size_t longest_error = 4096;

/// Reads numbers as CAF's binary serializer writes them; nothing past the end.
class frame_reader {
public:
  explicit frame_reader(std::span<const std::byte> octets) : left_{octets} {}

  std::optional<std::uint16_t> number(std::size_t octets) {
    if (left_.size() < octets)
      return std::nullopt;
    std::uint16_t value = 0;
    for (const auto octet : left_.first(octets))
      value = static_cast<std::uint16_t>(value << 8
                                         | std::to_integer<unsigned>(octet));
    left_ = left_.subspan(octets);
    return value;
  }

  /// @returns a size below 2^14: of one octet or two, and of no more than it
  /// needs.
  std::optional<std::size_t> short_size() {
    const auto low = number(1);
    if (!low || *low < 0x80)
      return low;
    const auto high = number(1);
    if (!high || *high == 0 || *high >= 0x80)
      return std::nullopt;
    return static_cast<std::size_t>(*high) << 7 | (*low & 0x7f);
  }

  std::size_t left() const { return left_.size(); }

private:
  std::span<const std::byte> left_;
};

bool is_node(std::span<const std::byte> octets) {
  return octets.size() >= node_size && octets.front() == hashed_node;
}

/// The types of a message.
class type_list {
public:
  /// Reads them after the stages, of which there must be none.
  /// @returns nothing if there are some, or more types than in any form.
  static std::optional<type_list> read(frame_reader& in) {
    type_list types;
    const auto stages = in.short_size();
    const auto count = in.short_size();
    if (stages != 0 || !count || *count > types.types_.size())
      return std::nullopt;
    types.count_ = *count;
    for (std::size_t i = 0; i < *count; ++i) {
      const auto type = in.number(2);
      if (!type)
        return std::nullopt;
      types.types_[i] = *type;
    }
    return types;
  }

  bool are(std::span<const std::uint16_t> others) const {
    return std::ranges::equal(std::span{types_}.first(count_), others);
  }

private:
  std::array<std::uint16_t, 8> types_{};
  std::size_t count_ = 0;
};

/// Whether what is left is an error that names its cause in a sentence at most.
bool is_plain_error(frame_reader& in, const message_forms& forms) {
  const auto is_present = in.number(1);
  if (is_present == 0)
    return in.left() == 0;
  const auto code = in.number(1);
  const auto category = in.number(2);
  const auto elements = in.short_size();
  if (is_present != 1 || !code || !category || !elements
      || std::ranges::count(forms.error_categories, *category) == 0)
    return false;
  if (*elements == 0)
    return in.left() == 0;
  const auto type = in.number(2);
  const auto length = in.short_size();
  return *elements == 1 && type == forms.string_type && length == in.left();
}

std::size_t longest_of(const message_forms& forms) {
  std::size_t longest = longest_error;
  for (const auto* list : {&forms.told, &forms.asked, &forms.answered})
    for (const auto& form : *list)
      longest = std::max(longest, form.longest);
  return longest;
}

} // namespace

frame_check::frame_check(bool is_accepted, const message_forms& forms)
    : is_accepted_{is_accepted}, forms_{forms}, longest_message_{
                                                    longest_of(forms)} {}

std::string_view frame_check::objection(const frame_header& header) const {
  const auto handshake = is_accepted_ ? client_handshake : server_handshake;
  if (node_.empty() != (header.operation == handshake))
    return node_.empty() ? "its first frame is not its handshake"
                         : "it introduces its node twice";
  const auto is_one_of = [&](auto low, auto high) {
    return header.payload_size >= low && header.payload_size <= high;
  };
  const auto fits = [&] {
    switch (header.operation) {
      case client_handshake:
        return is_accepted_ && is_one_of(node_size, node_size);
      case server_handshake:
        return !is_accepted_ && is_one_of(node_size, longest_server_handshake);
      case direct_message:
        return is_one_of(1u, longest_message_);
      case monitor_message:
        return is_one_of(2 * node_size, 2 * node_size);
      case down_message:
        return is_one_of(2 * node_size, 2 * node_size + longest_error);
      case basp_heartbeat:
        return is_one_of(0u, 0u);
      default:
        return false;
    }
  };
  if (header.flags != 0 || !fits())
    return "its frame is none that it may send";
  return {};
}

std::string_view frame_check::objection(const frame_header& header,
                                        std::span<const std::byte> payload) {
  switch (header.operation) {
    case client_handshake:
    case server_handshake:
      if (!is_node(payload))
        return "it has no node id";
      node_.assign(reinterpret_cast<const char*>(payload.data()), node_size);
      return {};
    case direct_message:
      return objection_to_message(header, payload);
    case monitor_message:
    case down_message:
      if (!is_node(payload) || !is_node(payload.subspan(node_size)))
        return "it speaks for no node";
      return {};
    default:
      return {};
  }
}

std::string_view
frame_check::objection_to_message(const frame_header& header,
                                  std::span<const std::byte> payload) {
  constexpr std::string_view unknown = "its message is none that it may send";
  const auto id = header.operation_data;
  if (id & stream_bit)
    return unknown;
  const auto is_answer = (id & response_bit) != 0;
  if (!is_answer && id != told_id && (id & number_bits) == 0)
    return unknown;
  frame_reader in{payload};
  const auto types = type_list::read(in);
  if (!types)
    return unknown;
  const auto& forms = is_answer       ? forms_.answered
                      : id == told_id ? forms_.told
                                      : forms_.asked;
  const auto form = std::ranges::find_if(
      forms, [&](const message_form& x) { return types->are(x.types); });
  if (form != forms.end())
    return payload.size() <= form->longest ? std::string_view{}
                                           : "its message is too long";
  if (is_answer && !forms_.answered.empty()
      && types->are({&forms_.error_type, 1}) && is_plain_error(in, forms_))
    return {};
  return unknown;
}

} // namespace sofof
