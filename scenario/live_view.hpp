// Somebody who looks on while a run goes on.
#pragma once

#include "messages/protocol/record.hpp"
#include "messages/protocol/service.hpp"
#include "recording/run_info.hpp"
#include "scenario/operations.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace sofof::scenario {

/// Shows a run to people, and slows nothing down.
class live_view {
public:
  virtual ~live_view() = default;

  /// @returns what sees the records of the run and hands them on.
  virtual std::shared_ptr<messages::record_sink>
  seeing(std::shared_ptr<messages::record_sink> then) const = 0;

  /// @returns what is called with each CAM that a provider of this process
  /// hears, and when; on any thread.
  virtual std::function<void(const messages::cam&, time_point)>
  hearing() const = 0;

  /// @returns where it is shown, for people.
  virtual std::string address() const = 0;
};

/// What there is to see.
struct live_subject {
  const scenario_definition& what; ///< Loaded; not used later on.
  const recording::run_info& run;  ///< Likewise.
  std::string_view role;           ///< Of the process: "provide", say.
  const operations& figures;       ///< Outlives who looks on.
};

} // namespace sofof::scenario
