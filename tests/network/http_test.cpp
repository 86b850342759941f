// A small HTTP server, and who asks it.
#include "network/http/client.hpp"
#include "network/http/server.hpp"
#include "network/network_error.hpp"
#include "tests/network/loopback.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::test::http_pages {

using namespace network;

namespace {

/// Says what it was asked.
struct echo {
  http::server server{{"127.0.0.1", 0}, [](const http::request& x) {
                        return http::response{
                            x.path == "/nothing" ? 404U : 200U, "text/x",
                            x.method + ' ' + x.path + ' ' + x.query};
                      }};

  http::response ask(const std::string& target) const {
    return http::get({server.address(), target}, patience);
  }
  plug connect() const { return plug_into(server.address().port); }
};

/// @returns what comes until the end, or as much as was wanted.
std::string answer_to(const echo& to, std::string_view words,
                      std::size_t most = 4096) {
  const auto line = to.connect();
  line.send(words);
  std::string text;
  for (const auto x : line.receive(most))
    text += static_cast<char>(x);
  return text;
}

} // namespace

TEST_CASE("a page is asked for and comes") {
  const echo at;
  const auto page = at.ask("/a/b?c=d&e");
  CHECK(page.status == 200);
  CHECK(page.type == "text/x");
  CHECK(page.body == "GET /a/b c=d&e");
  CHECK(at.ask("/nothing").status == 404);
}

TEST_CASE("a client may ask again on its connection, and for heads alone") {
  const echo at;
  const auto text = answer_to(at, "GET /1 HTTP/1.1\r\nHost: x\r\n\r\n"
                                  "HEAD /2 HTTP/1.1\r\nHost: x\r\n\r\n"
                                  "GET /3 HTTP/1.1\r\nHost: x\r\n"
                                  "Connection: close\r\n\r\n");
  CHECK(text.find("GET /1 ") != text.npos);
  CHECK(text.find("HEAD /2 ") == text.npos);
  CHECK(text.find("Content-Length: 8\r\n") != text.npos);
  CHECK(text.ends_with("GET /3 "));
}

TEST_CASE("what is no question of ours is refused, and others are served") {
  const echo at;
  CHECK(answer_to(at, "POST / HTTP/1.0\r\nContent-Length: 0\r\n\r\n")
            .starts_with("HTTP/1.0 405"));
  CHECK(answer_to(at, "POST / HTTP/1.0\r\nContent-Length: 9999999\r\n\r\n")
        == "");
  CHECK(answer_to(at, "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03") == "");
  CHECK(answer_to(at, "GET / HTTP/1.1\r\nLong: " + std::string(20'000, 'x'))
        == "");
  CHECK(at.ask("/").status == 200);
}

TEST_CASE("who connects and says nothing keeps nobody waiting for long") {
  const echo at;
  std::vector<plug> silent;
  for (int i = 0; i < 63; ++i)
    silent.push_back(at.connect());
  CHECK(at.ask("/").status == 200);
  silent.push_back(at.connect());
  silent.push_back(at.connect()); // all places are taken now
  const auto line = at.connect();
  line.send("GET / HTTP/1.0\r\n\r\n");
  silent.clear();
  CHECK(line.receive(12) == to_bytes("HTTP/1.0 200"));
}

TEST_CASE("what is asked has a method, and a body with its type") {
  std::string heard;
  test::server at{[&](const plug& from) {
    while (!heard.ends_with("{\"a\":1}"))
      heard += static_cast<char>(from.receive(1).at(0));
    from.send("HTTP/1.1 201 Created\r\nLocation: /x/7\r\n"
              "Content-Length: 2\r\n\r\nok");
  }};
  const auto answer = http::ask({"PUT", "application/json", "{\"a\":1}"},
                                {{"127.0.0.1", at.port()}, "/x"}, {patience});
  CHECK(answer.status == 201);
  CHECK(answer.location == "/x/7");
  CHECK(answer.body == "ok");
  CHECK(heard.starts_with("PUT /x HTTP/1.1\r\n"));
  CHECK(heard.find("Content-Type: application/json\r\n") != heard.npos);
  CHECK(heard.find("Content-Length: 7\r\n") != heard.npos);
}

TEST_CASE("an answer that is too long is given up, however it comes") {
  for (const std::string_view text :
       {"Content-Length: 6\r\n\r\n123456",
        "Content-Length: 999999999999\r\n\r\n1", "\r\n123456",
        "Transfer-Encoding: "
        "chunked\r\n\r\n3\r\n123\r\n3\r\n456\r\n0\r\n\r\n"}) {
    CAPTURE(text);
    test::server at{[&](const plug& to) {
      (void)to.receive(20);
      to.send("HTTP/1.1 200 OK\r\n" + std::string{text});
    }};
    const http::url all{{"127.0.0.1", at.port()}, "/"};
    CHECK_THROWS_WITH_AS(http::ask({}, all, {patience, 5}),
                         doctest::Contains("body limit"), network_error);
  }
  const echo at;
  CHECK(http::ask({}, {at.server.address(), "/"}, {patience, 6}).body
        == "GET / ");
}

TEST_CASE("a host that nobody knows is an error in a sentence") {
  CHECK_THROWS_WITH_AS(http::get({{"nobody.invalid", 80}, "/"}, patience),
                       doctest::Contains("nobody.invalid has no address"),
                       network_error);
}

TEST_CASE("an answer that does not come is an error in a sentence") {
  using namespace std::chrono_literals;
  http::url nobody{{"127.0.0.1", 0}, "/"};
  {
    const echo at;
    nobody.at = at.server.address();
  }
  CHECK_THROWS_AS(http::get(nobody, patience), network_error);
  const auto silent = listen_at({"127.0.0.1", 0});
  const http::url mute{{"127.0.0.1", port_of(silent)}, "/"};
  CHECK_THROWS_WITH_AS(http::get(mute, 50ms),
                       doctest::Contains("has not answered within 50 ms"),
                       network_error);
}

TEST_CASE("an address that is taken is refused") {
  const echo at;
  const auto again = [&] {
    http::server{at.server.address(),
                 [](const http::request&) { return http::response{}; }};
  };
  CHECK_THROWS_WITH_AS(again(), doctest::Contains("cannot listen at 127.0.0.1"),
                       network_error);
}

TEST_CASE("URLs have a host, perhaps a port and a path") {
  const auto read = [](std::string_view text) {
    const auto x = http::parse_url(text);
    return x ? print_address(x->at) + ' ' + x->target : "";
  };
  CHECK(read("http://127.0.0.1:9464") == "127.0.0.1:9464 /");
  CHECK(read("http://mec.example/healthz") == "mec.example:80 /healthz");
  CHECK(read("http://[::1]:9464/a?b") == "[::1]:9464 /a?b");
  CHECK(read("http://[::1]/") == "[::1]:80 /");
  for (const auto* wrong :
       {"", "127.0.0.1:9464", "https://x", "http://", "http://x:y/",
        "http://x:70000/", "http://x/a b", "http://x/\n"})
    CHECK(read(wrong) == "");
}

} // namespace sofof::test::http_pages
