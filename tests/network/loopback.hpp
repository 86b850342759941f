// Programs of this machine at both ends of a tunnel, which block but not long.
#pragma once

#include "network/socket.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <poll.h>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace sofof::test {

using namespace std::chrono_literals;
using bytes = std::vector<std::byte>;

/// Only what hangs takes longer, even under sanitizers.
inline constexpr std::chrono::milliseconds patience{30'000};

/// Waits until something has happened on another thread.
template <class Condition>
bool wait_until(Condition happened) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!happened()) {
    if (std::chrono::steady_clock::now() > end)
      return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

inline bytes to_bytes(std::string_view text) {
  const auto all = std::as_bytes(std::span{text});
  return {all.begin(), all.end()};
}

/// A connection of a program that blocks.
class plug {
public:
  explicit plug(descriptor socket) : socket_{std::move(socket)} {
    fcntl(socket_.get(), F_SETFL, fcntl(socket_.get(), F_GETFL) & ~O_NONBLOCK);
    const timeval wait{patience.count() / 1000, 0};
    setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
    setsockopt(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof wait);
  }

  /// @returns whether all went.
  bool send(std::span<const std::byte> all) const {
    while (!all.empty()) {
      const auto size =
          ::send(socket_.get(), all.data(), all.size(), MSG_NOSIGNAL);
      if (size <= 0)
        return false;
      all = all.subspan(static_cast<std::size_t>(size));
    }
    return true;
  }
  bool send(std::string_view text) const {
    return send(std::as_bytes(std::span{text}));
  }

  /// @returns as many bytes, or fewer when it was closed before.
  bytes receive(std::size_t size) const {
    bytes all(size);
    std::size_t done = 0;
    while (done < size) {
      const auto more = recv(socket_.get(), all.data() + done, size - done, 0);
      if (more <= 0)
        break;
      done += static_cast<std::size_t>(more);
    }
    all.resize(done);
    return all;
  }

  /// Waits until the peer closes; what it sends before is dropped.
  bool is_closed() const {
    std::array<std::byte, 4096> waste{};
    for (;;) {
      const auto size = recv(socket_.get(), waste.data(), waste.size(), 0);
      if (size == 0 || (size < 0 && errno == ECONNRESET))
        return true;
      if (size < 0)
        return false;
    }
  }

  int fd() const { return socket_.get(); }

private:
  descriptor socket_;
};

/// Connects to a port of this machine.
inline plug plug_into(std::uint16_t port) {
  auto started = network::start_connecting(network::loopback_port(port));
  REQUIRE(started.error == 0);
  pollfd event{started.socket.get(), POLLOUT, 0};
  REQUIRE(poll(&event, 1, static_cast<int>(patience.count())) == 1);
  REQUIRE(network::connection_error(started.socket) == 0);
  return plug{std::move(started.socket)};
}

/// A port of this machine, each of whose connections is served on a thread.
class server {
public:
  using service = std::function<void(const plug&)>;

  explicit server(service serve)
      : serve_{std::move(serve)},
        listener_{network::listen_at({"127.0.0.1", 0})}, thread_{[this] {
          run();
        }} {}
  ~server() {
    stops_ = true;
    wake_.call();
    thread_.join();
    for (const auto fd : open_)
      shutdown(fd, SHUT_RDWR);
    for (auto& thread : threads_)
      thread.join();
  }

  std::uint16_t port() const { return network::port_of(listener_); }

private:
  void run() {
    for (;;) {
      std::array<pollfd, 2> events{
          {{wake_.fd(), POLLIN, 0}, {listener_.get(), POLLIN, 0}}};
      poll(events.data(), events.size(), -1);
      if (stops_)
        return;
      auto accepted = network::accept_from(listener_);
      if (!accepted.socket)
        continue;
      // Ours stays open until the end, so that its number is nobody else's.
      const auto& connection =
          connections_.emplace_back(std::move(accepted.socket));
      open_.push_back(connection.fd());
      threads_.emplace_back([this, &connection] {
        serve_(connection);
        shutdown(connection.fd(), SHUT_RDWR);
      });
    }
  }

  service serve_;
  descriptor listener_;
  network::wake_up wake_;
  std::atomic<bool> stops_ = false;
  std::list<plug> connections_;
  std::vector<int> open_;
  std::vector<std::thread> threads_;
  std::thread thread_;
};

/// Sends back what it gets.
inline void echo(const plug& connection) {
  std::array<std::byte, 16 * 1024> buffer{};
  for (;;) {
    const auto size = recv(connection.fd(), buffer.data(), buffer.size(), 0);
    if (size <= 0
        || !connection.send(
            std::span{buffer}.first(static_cast<std::size_t>(size))))
      return;
  }
}

/// Sentences of another thread.
class sentences {
public:
  std::function<void(const std::string&)> listener() {
    return [this](const std::string& sentence) {
      const std::lock_guard lock{mutex_};
      all_.push_back(sentence);
    };
  }
  std::vector<std::string> all() const {
    const std::lock_guard lock{mutex_};
    return all_;
  }
  /// Waits for one with this in it.
  bool heard(std::string_view part) const {
    return wait_until([&] {
      return std::ranges::any_of(all(), [&](const auto& sentence) {
        return sentence.find(part) != sentence.npos;
      });
    });
  }

private:
  mutable std::mutex mutex_;
  std::vector<std::string> all_;
};

} // namespace sofof::test
