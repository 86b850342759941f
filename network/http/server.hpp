// A small HTTP server for those who watch a process.
#pragma once

#include "network/http/message.hpp"
#include "network/network_address.hpp"

#include <cstddef>
#include <functional>
#include <memory>

namespace sofof::network::http {

/// How many clients a server has at once.
struct limits {
  std::size_t connections = 64; ///< Further ones wait for their turn.
  std::size_t streams = 64;     ///< Besides; further ones are refused: 503.
};

/// Answers GET and HEAD on a thread of its own, some connections at once:
/// requests of at most 8 KiB, and nobody may take longer than 10 s for one.
/// Who follows a stream gets a piece of it ten times a second. A client that
/// has not taken its last piece yet loses the next one; one that takes none for
/// 30 s loses its connection. Nobody waits for it.
class server {
public:
  /// @param answer  Called on the server's thread; it must not take long.
  /// @throws network_error when it cannot listen there.
  server(const network_address& at,
         std::function<response(const request&)> answer, limits most = {});
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
