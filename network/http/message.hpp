// What HTTP carries, as far as pages and figures need it.
#pragma once

#include <string>

namespace sofof::network::http {

struct request {
  std::string method; ///< "GET", "HEAD", ...
  std::string path;   ///< Without what follows a "?".
  std::string query;  ///< What follows it.
  std::string accept; ///< Media types that the client takes; empty: any.
};

struct response {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::string location{}; ///< What a server of others says of a new resource.
};

} // namespace sofof::network::http
