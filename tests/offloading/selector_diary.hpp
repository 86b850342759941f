// A service of numbers, and what a selector of its results wants, written down.
#pragma once

#include "offloading/source_selector.hpp"
#include "tests/support/echo.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::test::numbers_service {

using namespace messages;
using namespace std::chrono_literals;

inline constexpr std::uint64_t implausible = 1000, useless = 1001;

inline payload of(std::uint64_t number) {
  return payload::of(echo{number});
}

struct numbers_judge final : offloading::result_judge {
  offloading::judged_result judge(const payload& result, const service_input&,
                                  time_point) override {
    const auto number = result.as<echo>()->number;
    if (number == implausible)
      return {.what = {}, .refused = objection{"number", 1000, 999}};
    if (number == useless)
      return {.what = {}, .useless = objection{"number", 1001, 999}};
    return {.what = result};
  }
};

/// Numbers that may all follow each other, and cross the air as they are.
struct numbers final : offloading::vehicle_service {
  std::shared_ptr<offloading::service_function> make_function() const override {
    return nullptr; // a selector needs none
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<numbers_judge>();
  }
};

inline offloading::selector_setup numbers_setup() {
  offloading::service_options options;
  options.limits = {50ms, 100ms, 500ms};
  options.period = 50ms;
  options.input_period = 100ms;
  return {101, {"numbers", options, std::make_shared<numbers>()}};
}

/// Writes down what a selector wants, a word or two for each call.
struct diary final : offloading::selector_port {
  std::vector<std::string> lines;
  std::string detail; ///< Of the latest event.
  std::optional<duration> safe;
  std::vector<work_record> work;
  std::vector<scene_record> scenes;

  void write(std::string line) { lines.push_back(std::move(line)); }
  static std::string name(const session_id& x) {
    return x.is_remote() ? std::string(1, "?AB"[x.provider.value()]) : "own";
  }

  void feed_local(const service_input&) override {}
  void feed_remote(service_input x) override {
    write("feed " + name(x.session) + (x.standby ? ", stand by" : ""));
  }
  void use(const service_result& x) override {
    write("use " + name(x.session));
  }
  void go_remote() override { write("own function rests"); }
  void go_local(service_input x) override {
    write(x.in_use.type().empty() ? "own function plans anew"
                                  : "own function plans on");
  }
  void run_along(service_input x) override {
    CHECK(x.standby);
    write("own function runs along");
  }
  void rest() override { write("own function rests again"); }
  void announce_source(bool remote) override {
    write(remote ? "source: remote" : "source: local");
  }
  void report_first_data(const session_id& x) override {
    write("first data of " + name(x));
  }
  void report(qos_violation x) override {
    write(
        (x.breach == qos_breach::implausible ? "implausible: " : "violation: ")
        + name(x.session));
  }
  void report_safe_response(duration longest) override { safe = longest; }
  void watch(const session_id& x, time_point) override {
    write("watch " + name(x));
  }
  void watch_arrival(const arrival&) override {}
  void watch_limits(const qos_limits& x) override {
    write("limits: " + std::to_string(x.max_latency / 1ms) + " ms, input "
          + std::to_string(x.max_input_age / 1ms) + " ms");
  }
  void watch_useless(const session_id& x, const implausibility&) override {
    write("useless: " + name(x));
  }
  void watch_end(const service_end&) override { write("watch nothing"); }
  void record(sofof::messages::record&& x) override {
    if (const auto* event = std::get_if<event_record>(&x)) {
      write(std::string{name_of(event->what)});
      detail = event->detail;
    }
    if (const auto* done = std::get_if<work_record>(&x))
      work.push_back(*done);
    if (const auto* seen = std::get_if<scene_record>(&x))
      scenes.push_back(*seen);
  }
  void wake_at(time_point t, std::uint64_t number) override {
    wakes.emplace_back(t, number);
  }

  std::vector<std::pair<time_point, std::uint64_t>> wakes;
};

using lines = std::vector<std::string>;

} // namespace sofof::test::numbers_service
