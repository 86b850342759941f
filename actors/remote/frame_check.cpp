// Frames of BASP 0.18.7, read as far as they have to be judged.
#include "actors/remote/frame_check.hpp"

#include "actors/remote/frame_reader.hpp"

#include <algorithm>

namespace sofof::actors {

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

bool is_node(std::span<const std::byte> octets) {
  return octets.size() >= node_size && octets.front() == hashed_node;
}

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
  const auto types = element_types::read(in);
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

} // namespace sofof::actors
