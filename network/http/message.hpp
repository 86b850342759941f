// What HTTP carries, as far as pages and figures need it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sofof::network::http {

struct request {
  std::string method;     ///< "GET", "HEAD", ...
  std::string path;       ///< Without what follows a "?".
  std::string query;      ///< What follows it.
  std::string accept;     ///< Media types that the client takes; empty: any.
  std::string host;       ///< Whom the client believes to ask; may be empty.
  std::string last_event; ///< Of a stream: the last id that it has seen.
};

/// A part of a stream, which several clients may get; null: there is none now.
using piece = std::shared_ptr<const std::string>;

struct response {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::string location{}; ///< What a server of others says of a new resource.
  std::vector<std::pair<std::string, std::string>> fields{}; ///< More of head.
  /// Of a stream, which has no body: called on the server's thread whenever the
  /// client can take another piece, ten times a second at most.
  std::function<piece()> next{};
};

} // namespace sofof::network::http
