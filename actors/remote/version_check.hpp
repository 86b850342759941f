// The first words of a connection: whether both sides speak the same language.
#pragma once

#include "actors/remote/type_block.hpp"
#include "messages/protocol/remote.hpp"

#include <caf/actor_control_block.hpp>
#include <caf/result.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace sofof {

/// What a gate answers: which language it speaks, a number to sign and where
/// to do so; without these two when it speaks another one or is full.
using greeting = caf::result<std::uint32_t, std::uint64_t, std::string,
                             caf::strong_actor_ptr>;

/// @param protocol, types  What the other side speaks.
/// @param let_in           Called if we speak that too: number and place.
template <class LetIn>
greeting greet(std::uint32_t protocol, std::uint64_t types, LetIn let_in) {
  static const auto own_types = fingerprint_of_types();
  std::pair<std::string, caf::strong_actor_ptr> in;
  if (protocol == remote_protocol && types == own_types)
    in = let_in();
  return {remote_protocol, own_types, std::move(in.first),
          std::move(in.second)};
}

} // namespace sofof
