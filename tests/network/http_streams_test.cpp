// Those who follow a stream of a server.
#include "network/http/client.hpp"
#include "network/http/server.hpp"
#include "tests/network/loopback.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::test::http_followers {

using namespace network;

namespace {

constexpr std::size_t room = 3;

/// Sends numbers to each who follows, one after the other.
struct counting_server {
  std::size_t filling = 0; ///< Octets behind each number.
  std::atomic<int> asked = 0;
  http::server server{{"127.0.0.1", 0},
                      [this](const http::request& x) { return answer(x); },
                      {8, room}};

  explicit counting_server(std::size_t octets = 0) : filling{octets} {}

  http::response answer(const http::request& x) {
    http::response of;
    of.body = x.path + ' ' + x.host + ' ' + x.last_event;
    of.fields = {{"X-More", "yes"}};
    if (x.path == "/numbers")
      of.next = [this, n = 0]() mutable {
        ++asked;
        return std::make_shared<const std::string>(
            std::to_string(++n) + std::string(filling, ' ') + '\n');
      };
    return of;
  }
  int status() const {
    return static_cast<int>(
        http::get({server.address(), "/"}, patience).status);
  }
  plug follow() const {
    auto line = plug_into(server.address().port);
    line.send("GET /numbers HTTP/1.1\r\nHost: x\r\n\r\n");
    return line;
  }
};

std::string text_of(const bytes& all) {
  std::string text;
  for (const auto x : all)
    text += static_cast<char>(x);
  return text;
}

/// @returns what comes until a text has come.
std::string heard_until(const plug& line, std::string_view end) {
  std::string text;
  while (text.find(end) == text.npos) {
    const auto more = line.receive(1);
    if (more.empty())
      break;
    text += text_of(more);
  }
  return text;
}

} // namespace

TEST_CASE("who follows gets a head without an end, and piece after piece") {
  const counting_server at;
  const auto line = at.follow();
  const auto begin = std::chrono::steady_clock::now();
  const auto text = heard_until(line, "11\n");
  const auto took = std::chrono::steady_clock::now() - begin;
  CHECK(text.starts_with("HTTP/1.1 200 OK\r\n"));
  CHECK(text.find("X-More: yes\r\n") != text.npos);
  CHECK(text.find("Content-Length") == text.npos);
  CHECK(text.find("\r\n\r\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n") != text.npos);
  CHECK(took > 900ms); // ten times a second
}

TEST_CASE("streams leave as soon as their clients do, and make room") {
  const counting_server at;
  std::list<plug> lines;
  for (std::size_t i = 0; i < room; ++i) {
    lines.push_back(at.follow());
    CHECK(heard_until(lines.back(), "\r\n\r\n1\n").ends_with("\n1\n"));
  }
  const auto refused = at.follow();
  CHECK(heard_until(refused, "later").starts_with("HTTP/1.1 503"));
  CHECK(at.status() == 200); // is no stream
  lines.pop_front();
  CHECK(wait_until([&] {
    const auto again = at.follow();
    return heard_until(again, "\r\n").starts_with("HTTP/1.1 200");
  }));
  lines.clear();
  CHECK(wait_until([&] { // nobody asks for pieces any more
    const auto before = at.asked.load();
    std::this_thread::sleep_for(250ms);
    return at.asked == before;
  }));
}

TEST_CASE("who does not read loses pieces, and nobody waits for it") {
  constexpr std::size_t large = 1'000'000;
  const counting_server at{large};
  const auto stuck = at.follow();
  const auto quick = at.follow();
  int lines = 0;
  std::thread reader{[&] { // ten pieces of a megabyte
    for (std::size_t size = 0; size < 10 * large;) {
      const auto more = quick.receive(64 * 1024);
      if (more.empty())
        return;
      size += more.size();
      lines += static_cast<int>(std::ranges::count(more, std::byte{'\n'}));
    }
  }};
  std::chrono::steady_clock::duration worst{};
  for (int i = 0; i < 10; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    CHECK(at.status() == 200);
    worst = std::max(worst, std::chrono::steady_clock::now() - begin);
    std::this_thread::sleep_for(100ms);
  }
  reader.join();
  CHECK(worst < 1s);
  CHECK(lines >= 10);
  // What the kernel keeps for the stuck one, and no more, was made for it.
  CHECK(at.asked < 10 + lines + 12);
  CHECK(heard_until(stuck, "2 ").find("\n2 ") != std::string::npos);
}

TEST_CASE("heads of streams alone are no streams") {
  const counting_server at;
  const auto line = plug_into(at.server.address().port);
  line.send("HEAD /numbers HTTP/1.1\r\nHost: x\r\n\r\n");
  const auto text = heard_until(line, "nothing of this");
  CHECK(text.starts_with("HTTP/1.1 200 OK\r\n"));
  CHECK(text.ends_with("\r\n\r\n"));
  CHECK(at.asked == 0);
}

TEST_CASE("a server ends while somebody follows and somebody is stuck") {
  auto at = std::make_unique<counting_server>(1'000'000);
  const auto stuck = at->follow();
  const auto line = at->follow();
  CHECK(heard_until(line, "\r\n\r\n1 ").ends_with("1 "));
  at.reset();
  CHECK(line.is_closed());
  CHECK(stuck.is_closed());
}

TEST_CASE("requests tell the host and the last event that a client knows") {
  const counting_server at;
  const auto line = plug_into(at.server.address().port);
  line.send("GET /a HTTP/1.0\r\nHost: there:80\r\nLast-Event-ID: 17\r\n\r\n");
  CHECK(heard_until(line, "nothing of this").ends_with("/a there:80 17"));
}

} // namespace sofof::test::http_followers
