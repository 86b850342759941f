// A thread that carries the bytes of many tunnels, each for as long as the
// certificate at its other end is good.
#pragma once

#include "network/deadline.hpp"
#include "network/keys/revocation_list.hpp"
#include "network/socket.hpp"
#include "network/tls/tls_tunnel.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>
#include <unordered_map>
#include <vector>

namespace sofof::network {

/// Serves its tunnels in turns, on one thread for all of them; ends each when a
/// side closes, nothing crosses, or the certificate is good no more.
class tunnel_loop {
public:
  /// @param idle  A tunnel through which nothing at all crosses for so long is
  ///              closed, as is one whose peer's certificate has expired,
  ///              0.2 s later at most.
  /// @throws network_error when the system has no more files.
  explicit tunnel_loop(std::chrono::milliseconds idle);
  /// Closes all tunnels.
  ~tunnel_loop();
  tunnel_loop(const tunnel_loop&) = delete;
  tunnel_loop& operator=(const tunnel_loop&) = delete;

  /// Carries from now on. Any thread may call this.
  void carry(tls_tunnel tunnel);

  /// Closes all tunnels, soon. Any thread may call this.
  void drop();

  /// Closes the tunnels to hosts whose certificates are revoked, within the
  /// next turn, and all that are carried later. Any thread may call this.
  void revoke(revocation_list revoked);

private:
  /// A tunnel, and what is known of it.
  struct entry {
    tls_tunnel tunnel;
    deadline last_moved;
    std::uint32_t far_events = 0;
    std::uint32_t near_events = 0;
    bool is_ready = true;
  };
  using entry_number = std::uint64_t;

  void run();
  void take_new_ones(deadline now);
  void drop_all();
  void wait_for_events(int timeout_ms);
  void make_ready(entry_number number);
  void serve_ready_ones(deadline now);
  void watch(int fd, entry_number number, std::uint32_t& watched,
             std::uint32_t wanted);
  void close_idle_ones(deadline now);
  void close_distrusted_ones();

  const std::chrono::milliseconds idle_;
  descriptor epoll_;
  wake_up wake_;
  std::atomic<bool> stops_ = false;
  std::atomic<bool> drops_ = false;
  std::mutex mutex_;
  std::vector<tls_tunnel> new_ones_; // guarded by mutex_, as is
  std::optional<revocation_list> new_list_;

  // Of the thread:
  revocation_list revoked_;
  std::unordered_map<entry_number, entry> entries_;
  entry_number last_number_ = 0;
  std::vector<entry_number> ready_;

  std::thread thread_; // last, as it needs all of the above
};

} // namespace sofof::network
