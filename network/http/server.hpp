// A small HTTP server for those who watch a process.
#pragma once

#include "network/http/message.hpp"
#include "network/network_address.hpp"

#include <functional>
#include <memory>

namespace sofof::network::http {

/// Answers GET and HEAD on a thread of its own, some connections at once:
/// requests of at most 8 KiB, and nobody may take longer than 10 s for one.
/// Further connections wait for their turn.
class server {
public:
  /// @param answer  Called on the server's thread; it must not take long.
  /// @throws network_error when it cannot listen there.
  server(const network_address& at,
         std::function<response(const request&)> answer);
  /// Ends connections and thread.
  ~server();
  server(const server&) = delete;
  server& operator=(const server&) = delete;

  /// @returns where it listens, with the port that the system chose for port 0.
  network_address address() const;

private:
  class state;
  std::unique_ptr<state> state_;
};

} // namespace sofof::network::http
