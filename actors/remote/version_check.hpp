// The first question between two processes: whether they speak the same
// version of the protocol.
#pragma once

#include "actors/remote/type_block.hpp"
#include "messages/protocol/remote.hpp"

#include <caf/actor_control_block.hpp>
#include <caf/result.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace sofof::actors {

/// What an acceptor answers: version and types of its own, a number to sign and
/// the handshake; without these two when the peer's are others, or nobody is
/// let in now.
using version_answer = caf::result<std::uint32_t, std::uint64_t, std::string,
                                   caf::strong_actor_ptr>;

/// @param protocol, types  The peer's.
/// @param begin_handshake  Called if ours are the same: number and handshake.
template <class Begin>
version_answer check_version(std::uint32_t protocol, std::uint64_t types,
                             Begin begin_handshake) {
  static const auto own_types = fingerprint_of_types();
  std::pair<std::string, caf::strong_actor_ptr> in;
  if (protocol == messages::remote_protocol && types == own_types)
    in = begin_handshake();
  return {messages::remote_protocol, own_types, std::move(in.first),
          std::move(in.second)};
}

} // namespace sofof::actors
