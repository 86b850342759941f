// Who may look on.
#include "live/gate.hpp"

#include <doctest/doctest.h>

#include <string>

namespace sofof::live {

namespace {

network::http::request asked(std::string host, std::string query = "") {
  network::http::request x;
  x.host = std::move(host);
  x.query = std::move(query);
  return x;
}

} // namespace

TEST_CASE("on this machine no token is needed, but its own name") {
  const gate at{"127.0.0.1"};
  CHECK(at.query() == "");
  for (const auto* host : {"127.0.0.1:9465", "localhost:1", "localhost",
                           "[::1]:9465", "127.0.0.1", ""})
    CHECK(!at.refuse(asked(host)));
  for (const auto* host : {"evil.example:9465", "127.0.0.1.evil.example",
                           "localhost.evil.example", "[::2]", "10.0.0.1"}) {
    CAPTURE(host);
    const auto no = at.refuse(asked(host));
    REQUIRE(no);
    CHECK(no->status == 403);
  }
}

TEST_CASE("on other addresses whoever has the token may look on") {
  const gate at{"0.0.0.0"}, other{"10.0.0.1"};
  const auto token = at.query();
  CHECK(token.starts_with("?token="));
  CHECK(token.size() == 7 + 32);
  CHECK(token != other.query());
  CHECK(!at.refuse(asked("any.example", token.substr(1))));
  for (const auto& query :
       {std::string{}, std::string{"token="}, other.query().substr(1),
        token.substr(1) + "0", token.substr(1, 20)})
    CHECK(at.refuse(asked("any.example", query)));
}

} // namespace sofof::live
