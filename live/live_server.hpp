// Shows a run while it goes on, in browsers.
#pragma once

#include "network/http/server.hpp"
#include "scenario/live_view.hpp"

#include "live/gate.hpp"
#include "live/run_state.hpp"
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace sofof::live {

/// Serves a page, the scene and a stream of what happens, and what operators
/// ask. Frames are made on the server's thread, and only while somebody looks.
class live_server final : public scenario::live_view {
public:
  /// @throws network::network_error when it cannot listen there.
  live_server(const network::network_address& at,
              const scenario::live_subject& of);
  /// Tells those who follow that the run has ended, if it has: a moment.
  ~live_server() override;
  live_server(const live_server&) = delete;
  live_server& operator=(const live_server&) = delete;

  std::shared_ptr<messages::record_sink>
  seeing(std::shared_ptr<messages::record_sink> then) const override;
  std::function<void(const messages::cam&, time_point)>
  hearing() const override;
  std::string address() const override;

private:
  network::http::response answer(const network::http::request& to);
  network::http::response follow(const network::http::request& to);
  network::http::piece next(std::uint64_t& seen);
  void renew_frame();

  const scenario::operations& figures_;
  const std::string run_;          ///< A number that no other run has.
  std::vector<std::string> names_; ///< Of providers.
  std::string scene_;
  std::shared_ptr<run_state> state_;
  // Of the server's thread:
  std::string frame_;
  std::uint64_t number_ = 0;
  std::atomic<time_point> made_at_ = time_point{};  ///< Read by any.
  std::uint64_t piece_after_ = 0, piece_until_ = 0; ///< Events in `piece_`.
  network::http::piece piece_;

  std::mutex end_mutex_;
  std::condition_variable end_is_told_;
  bool is_end_told_ = false;

  const gate gate_;
  network::http::server server_;
};

} // namespace sofof::live
