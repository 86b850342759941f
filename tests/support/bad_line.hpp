// A bad line to a TCP port of this machine: a proxy with a thread of its own
// that delays, holds up and cuts what passes through it.
#pragma once

#include "base/random.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <deque>
#include <list>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace sofof::test {

/// What is wrong with a line, each way. TCP hides losses: what was lost comes
/// a retransmission later, and all that follows waits for it.
struct line_faults {
  std::chrono::microseconds delay{0};
  std::chrono::microseconds jitter{0}; ///< Uniform, on top of the delay.
  double loss = 0;                     ///< Of a piece of at most 16 KiB.
  std::chrono::milliseconds retransmission{200};
};

class bad_line {
public:
  /// @param to    A port of this machine.
  /// @param seed  Of all draws.
  bad_line(std::uint16_t to, const line_faults& faults, std::uint64_t seed)
      : to_{to}, faults_{faults}, draws_{seed, "bad_line"} {
    listener_ = socket(AF_INET, SOCK_STREAM, 0);
    auto at = address(0);
    socklen_t size = sizeof at;
    auto* any = reinterpret_cast<sockaddr*>(&at);
    if (listener_ < 0 || bind(listener_, any, size) != 0
        || listen(listener_, 16) != 0
        || getsockname(listener_, any, &size) != 0)
      throw std::system_error{errno, std::generic_category(), "bad_line"};
    port_ = ntohs(at.sin_port);
    thread_ = std::thread{[this] { pass_on(); }};
  }

  ~bad_line() {
    ends_ = true;
    thread_.join();
    close(listener_);
  }

  bad_line(const bad_line&) = delete;
  bad_line& operator=(const bad_line&) = delete;

  std::uint16_t port() const { return port_; }

  /// From now on nothing gets through, either way, until it is given back;
  /// nobody is told.
  void interrupt() { interrupted_ = true; }
  void restore() { interrupted_ = false; }

  /// Ends all connections; new ones are possible.
  void cut() { cut_ = true; }

private:
  using clock = std::chrono::steady_clock;
  static constexpr std::size_t piece_size = 16 * 1024;
  static constexpr std::size_t most_pieces = 1024; // under way, each way

  struct piece {
    clock::time_point due;
    std::string bytes;
  };
  struct way {
    int from = -1;
    int to = -1;
    std::deque<piece> under_way;
  };
  struct connection {
    std::array<way, 2> ways;
    bool ended = false;
  };

  static sockaddr_in address(std::uint16_t port) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    at.sin_port = htons(port);
    return at;
  }

  static void send_at_once(int fd) {
    const int yes = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  }

  void pass_on() {
    while (!ends_) {
      wait();
      if (cut_.exchange(false))
        for (auto& c : connections_)
          c.ended = true;
      take_in();
      for (auto& c : connections_)
        if (!interrupted_)
          for (auto& w : c.ways)
            c.ended = c.ended || !read(w) || !write(w);
      connections_.remove_if([](const connection& c) {
        if (c.ended)
          hang_up(c);
        return c.ended;
      });
    }
    for (const auto& c : connections_)
      hang_up(c);
  }

  /// Until there is something to do, a millisecond at most.
  void wait() const {
    std::vector<pollfd> all{{listener_, POLLIN, 0}};
    for (const auto& c : connections_)
      for (const auto& w : c.ways)
        if (!interrupted_ && w.under_way.size() < most_pieces)
          all.push_back({w.from, POLLIN, 0});
    poll(all.data(), all.size(), 1);
  }

  void take_in() {
    pollfd waiting{listener_, POLLIN, 0};
    if (poll(&waiting, 1, 0) <= 0)
      return;
    const auto near = accept(listener_, nullptr, nullptr);
    const auto far = socket(AF_INET, SOCK_STREAM, 0);
    const auto at = address(to_);
    if (near < 0 || far < 0
        || connect(far, reinterpret_cast<const sockaddr*>(&at), sizeof at)
               != 0) {
      close(near);
      close(far);
      return;
    }
    send_at_once(near);
    send_at_once(far);
    connections_.push_back({{way{near, far, {}}, way{far, near, {}}}, false});
  }

  static void hang_up(const connection& c) {
    for (const auto& w : c.ways)
      close(w.from);
  }

  /// @returns false at the end of the connection.
  bool read(way& w) {
    if (w.under_way.size() >= most_pieces)
      return true;
    std::string bytes(piece_size, '\0');
    const auto n = recv(w.from, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (n <= 0)
      return n < 0 && errno == EAGAIN;
    bytes.resize(static_cast<std::size_t>(n));
    auto due = clock::now() + faults_.delay
               + std::chrono::duration_cast<std::chrono::microseconds>(
                   faults_.jitter * draws_.uniform(drawn_, 0));
    if (draws_.uniform(drawn_, 1) < faults_.loss)
      due += faults_.retransmission;
    ++drawn_;
    if (!w.under_way.empty())
      due = std::max(due, w.under_way.back().due);
    w.under_way.push_back({due, std::move(bytes)});
    return true;
  }

  static bool write(way& w) {
    const auto now = clock::now();
    while (!w.under_way.empty() && w.under_way.front().due <= now) {
      auto& bytes = w.under_way.front().bytes;
      const auto n =
          send(w.to, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (n < 0)
        return errno == EAGAIN;
      bytes.erase(0, static_cast<std::size_t>(n));
      if (!bytes.empty())
        return true;
      w.under_way.pop_front();
    }
    return true;
  }

  std::uint16_t to_;
  line_faults faults_;
  random_stream draws_;
  std::uint64_t drawn_ = 0;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::list<connection> connections_;
  std::atomic<bool> ends_ = false;
  std::atomic<bool> interrupted_ = false;
  std::atomic<bool> cut_ = false;
  std::thread thread_;
};

} // namespace sofof::test
