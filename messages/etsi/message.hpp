// Any of the messages that are known, told apart by how they begin.
#pragma once

#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/cpm_ts103324.hpp"
#include "messages/etsi/mcm.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace sofof::messages::etsi {

using message = std::variant<cam, tr103562::cpm, ts103324::cpm, mcm>;

/// A value, or why there is none.
template <class T>
struct outcome {
  std::optional<T> value;
  std::string error; ///< A sentence without its full stop.
};

/// Decodes what its protocol version and message id tell it to be.
outcome<message> decode_message(std::span<const std::byte> in);

/// Encodes into as many octets as it takes.
outcome<std::vector<std::byte>> encode_message(const message& m);

/// Makes an empty message of a kind.
/// @returns it, or that there is no such kind, and which there are.
outcome<message> make_message(std::uint8_t protocol_version,
                              std::uint8_t message_id);

} // namespace sofof::messages::etsi
