// What may come by one connection of CAF's remote actors (BASP), decided before
// anything of it is deserialised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::actors {

/// The header of a frame, as BASP has it.
struct frame_header {
  std::uint8_t operation = 0;
  std::uint8_t flags = 0;
  std::uint32_t payload_size = 0; ///< Octets.
  std::uint64_t operation_data = 0;
  std::uint64_t source_actor = 0;
  std::uint64_t dest_actor = 0;
};

/// One message that an interface has: the type ids of its elements, in order.
struct message_form {
  std::vector<std::uint16_t> types;
  std::size_t longest = 0; ///< Octets of a frame's payload.
};

/// All messages that a peer may send.
struct message_forms {
  std::vector<message_form> told;     ///< That expect no answer.
  std::vector<message_form> asked;    ///< Requests.
  std::vector<message_form> answered; ///< Answers to requests of ours.
  /// Answers may be errors: of these categories, and with a sentence at most.
  std::uint16_t error_type = 0;
  std::uint16_t string_type = 0;
  std::vector<std::uint16_t> error_categories;
};

/// Octets of a frame before its payload.
inline constexpr std::size_t frame_header_size = 32;

/// Judges the frames of one connection, in the order they come: a handshake
/// first, and no second one; then messages of the given forms, with no actor to
/// forward to and no message inside, and what BASP says about actors. What is
/// refused ends the connection.
class frame_check {
public:
  /// @param is_accepted  Whether the peer has called us, or we the peer.
  /// @param forms        Outlive this.
  frame_check(bool is_accepted, const message_forms& forms);

  /// @returns why the payload that this header announces must not be read;
  /// empty: it may.
  std::string_view objection(const frame_header& header) const;

  /// @returns why this frame must not be handled; empty: it may. Call it after
  /// the former.
  std::string_view objection(const frame_header& header,
                             std::span<const std::byte> payload);

  /// @returns the peer's node id as it was serialised; empty before the
  /// handshake.
  const std::string& node() const { return node_; }

private:
  std::string_view objection_to_message(const frame_header& header,
                                        std::span<const std::byte> payload);

  bool is_accepted_;
  const message_forms& forms_;
  std::size_t longest_message_;
  std::string node_;
};

} // namespace sofof::actors
