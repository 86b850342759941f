// TCP sockets by the system's calls.
#include "network/socket.hpp"

#include "network/network_error.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <system_error>
#include <unistd.h>

namespace sofof::network {

namespace {

struct list_deleter {
  void operator()(addrinfo* x) const { freeaddrinfo(x); }
};
using address_list = std::unique_ptr<addrinfo, list_deleter>;

address_list look_up(const network_address& address, int flags, int& error) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* list = nullptr;
  error = getaddrinfo(address.host.c_str(),
                      std::to_string(address.port).c_str(), &wanted, &list);
  return address_list{error == 0 ? list : nullptr};
}

void enable(const descriptor& socket, int level, int option) {
  const int on = 1;
  setsockopt(socket.get(), level, option, &on, sizeof on);
}

descriptor new_socket(int family) {
  return descriptor{
      ::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
}

} // namespace

std::string print_address(const socket_address& address) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (getnameinfo(reinterpret_cast<const sockaddr*>(&address.storage),
                  address.size, host.data(), host.size(), port.data(),
                  port.size(), NI_NUMERICHOST | NI_NUMERICSERV)
      != 0)
    return "an unknown address";
  return std::strchr(host.data(), ':')
             ? fmt::format("[{}]:{}", host.data(), port.data())
             : fmt::format("{}:{}", host.data(), port.data());
}

descriptor listen_at(const network_address& address) {
  constexpr int waiting = 512;
  int error = 0;
  const auto list = look_up(address, AI_PASSIVE, error);
  if (!list)
    throw network_error{fmt::format("cannot listen on {}: {}; name an address "
                                    "of this machine",
                                    print_address(address),
                                    gai_strerror(error))};
  auto socket = new_socket(list->ai_family);
  if (socket)
    enable(socket, SOL_SOCKET, SO_REUSEADDR);
  if (!socket || bind(socket.get(), list->ai_addr, list->ai_addrlen) != 0
      || listen(socket.get(), waiting) != 0)
    throw network_error{fmt::format(
        "cannot listen on {}: {}; choose another port or address",
        print_address(address), std::generic_category().message(errno))};
  return socket;
}

std::uint16_t port_of(const descriptor& listener) {
  socket_address address;
  address.size = sizeof address.storage;
  auto* any = reinterpret_cast<sockaddr*>(&address.storage);
  if (getsockname(listener.get(), any, &address.size) != 0)
    return 0;
  return ntohs(any->sa_family == AF_INET6
                   ? reinterpret_cast<const sockaddr_in6*>(any)->sin6_port
                   : reinterpret_cast<const sockaddr_in*>(any)->sin_port);
}

accepted_socket accept_from(const descriptor& listener) {
  accepted_socket accepted;
  accepted.peer.size = sizeof accepted.peer.storage;
  accepted.socket = descriptor{accept4(
      listener.get(), reinterpret_cast<sockaddr*>(&accepted.peer.storage),
      &accepted.peer.size, SOCK_NONBLOCK | SOCK_CLOEXEC)};
  if (accepted.socket)
    enable(accepted.socket, IPPROTO_TCP, TCP_NODELAY);
  else
    accepted.error = errno;
  return accepted;
}

std::vector<socket_address> resolve(const network_address& address) {
  int error = 0;
  const auto list = look_up(address, AI_ADDRCONFIG, error);
  std::vector<socket_address> all;
  for (const auto* one = list.get(); one; one = one->ai_next) {
    auto& next = all.emplace_back();
    std::memcpy(&next.storage, one->ai_addr, one->ai_addrlen);
    next.size = one->ai_addrlen;
  }
  return all;
}

started_connection
start_connecting(const socket_address& address,
                 const std::function<void(std::uint16_t)>& on_bound) {
  started_connection started{new_socket(address.storage.ss_family), 0};
  if (!started.socket)
    return {{}, errno};
  if (on_bound) {
    const auto any = loopback_port(0);
    if (bind(started.socket.get(),
             reinterpret_cast<const sockaddr*>(&any.storage), any.size)
        != 0)
      return {{}, errno};
    on_bound(port_of(started.socket));
  }
  enable(started.socket, IPPROTO_TCP, TCP_NODELAY);
  if (connect(started.socket.get(),
              reinterpret_cast<const sockaddr*>(&address.storage), address.size)
          != 0
      && errno != EINPROGRESS)
    return {{}, errno};
  return started;
}

socket_address loopback_port(std::uint16_t port) {
  socket_address address;
  auto& v4 = reinterpret_cast<sockaddr_in&>(address.storage);
  v4.sin_family = AF_INET;
  v4.sin_port = htons(port);
  v4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.size = sizeof v4;
  return address;
}

int connection_error(const descriptor& socket) {
  int error = 0;
  socklen_t size = sizeof error;
  if (getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size) != 0)
    return errno;
  return error;
}

void give_up_after(const descriptor& socket,
                   std::chrono::milliseconds silence) {
  const auto wait = static_cast<unsigned>(silence.count());
  setsockopt(socket.get(), IPPROTO_TCP, TCP_USER_TIMEOUT, &wait, sizeof wait);
}

wake_up::wake_up() : event_{eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)} {
  if (!event_)
    throw network_error{"no more files can be opened: raise `ulimit -n`"};
}

void wake_up::call() {
  eventfd_write(event_.get(), 1);
}

void wake_up::answer() {
  eventfd_t count = 0;
  eventfd_read(event_.get(), &count);
}

} // namespace sofof::network
