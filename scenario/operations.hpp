// What operators ask a process while it runs.
#pragma once

#include "network/http/server.hpp"
#include "recording/live_figures.hpp"
#include "scenario/build.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::scenario {

/// Answers /metrics, for Prometheus, and /healthz.
class operations {
public:
  enum class health : std::uint8_t { starting, ready, ending };

  /// What a provider of this process computes with.
  struct load {
    std::string_view provider;
    std::size_t workers = 0;
    double busy = 0; ///< Share of the last 5 s.
  };

  /// @param now   Tells the time of the run, on any thread.
  /// @param more  Adds figures that no record tells, once it is ready; may be
  ///              empty.
  operations(const recording::run_info& run, std::string role,
             std::function<time_point()> now,
             recording::live_figures::more more);

  /// Listens for those who ask.
  /// @throws network_error when it cannot listen there.
  void serve(const network::network_address& at);

  /// @returns what counts the records of the run and hands them on.
  std::shared_ptr<messages::record_sink>
  counting(std::shared_ptr<messages::record_sink> then) const;

  /// @returns where it is served, for people: "http://127.0.0.1:9464"; empty
  /// if it is not.
  std::string address() const;

  /// @returns the page that was asked for, on any thread.
  network::http::response answer(const network::http::request& to) const;

  /// @returns how it is, on any thread.
  health state() const { return health_; }
  time_point start() const { return start_; }
  time_point now() const { return now_(); }
  std::vector<load> loads() const;

  /// The actors live, and what should come, may.
  /// @param loads  Of providers that run here.
  void ready(std::vector<provider_load> loads);
  /// They are about to end.
  void ending() { health_ = health::ending; }

private:
  void write_loads(recording::exposition& to) const;

  const time_point start_;
  const std::function<time_point()> now_;
  const std::string title_;
  std::atomic<health> health_ = health::starting;
  std::vector<provider_load> loads_; // read once it is ready
  std::shared_ptr<recording::live_figures> figures_;
  std::optional<network::http::server> server_;
};

} // namespace sofof::scenario
