// A peer that may get an endpoint.
#pragma once

#include "messages/interfaces.hpp"

#include <caf/allowed_unsafe_message_type.hpp>

#include <memory>
#include <string>
#include <utility>

namespace sofof::actors {

struct handshake_state; // actors/remote/handshake.cpp

} // namespace sofof::actors

namespace sofof::messages {

/// A hello that a handshake of this process has examined. Nothing else makes
/// one that holds anything, and none crosses between processes.
class admission {
public:
  struct content {
    peer_hello hello;
    vehicle_endpoint_actor peer;
    std::string name; ///< Of the holder of its certificate.
  };

  admission() = default; ///< Holds nothing; CAF wants it.

  /// @returns who may get an endpoint; null for nobody.
  const content* get() const { return content_.get(); }

private:
  friend struct actors::handshake_state;
  explicit admission(content what)
      : content_{std::make_shared<const content>(std::move(what))} {}

  std::shared_ptr<const content> content_;
};

} // namespace sofof::messages

CAF_ALLOW_UNSAFE_MESSAGE_TYPE(sofof::messages::admission)
