// What operators ask a process while it runs.
#pragma once

#include "network/http/server.hpp"
#include "recording/live_figures.hpp"
#include "scenario/build.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sofof::scenario {

/// Serves /metrics, for Prometheus, and /healthz.
class operations {
public:
  /// @param now   Tells the time of the run, on any thread.
  /// @param more  Adds figures that no record tells, once it is ready; may be
  ///              empty.
  /// @throws network_error when it cannot listen there.
  operations(const network::network_address& at, const recording::run_info& run,
             std::string role, std::function<time_point()> now,
             recording::live_figures::more more);

  /// @returns what counts the records of the run and hands them on.
  std::shared_ptr<messages::record_sink>
  counting(std::shared_ptr<messages::record_sink> then) const;

  /// @returns its address, for people: "http://127.0.0.1:9464".
  std::string address() const;

  /// The actors live, and what should come, may.
  /// @param loads  Of providers that run here.
  void ready(std::vector<provider_load> loads);
  /// They are about to end.
  void ending() { health_ = health::ending; }

private:
  enum class health : std::uint8_t { starting, ready, ending };

  network::http::response answer(const network::http::request& to) const;
  void write_loads(recording::exposition& to) const;

  const time_point start_;
  const std::function<time_point()> now_;
  const std::string title_;
  std::atomic<health> health_ = health::starting;
  std::vector<provider_load> loads_; // read once it is ready
  std::shared_ptr<recording::live_figures> figures_;
  network::http::server server_;
};

} // namespace sofof::scenario
