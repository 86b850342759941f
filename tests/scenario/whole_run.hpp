// A scenario played in virtual time.
#pragma once

#include "scenario/build.hpp"
#include "scenario/runtime.hpp"
#include "tests/support/memory_sink.hpp"

#include <memory>

namespace sofof::test {

/// @returns the records of a whole run.
inline memory_sink play(const scenario::scenario_definition& s) {
  auto records = std::make_shared<memory_sink>();
  const auto time = scenario::make_virtual_runtime();
  const auto actors =
      scenario::build(time->system(), s, records, time->clock(), true);
  time->run_until(time->now() + s.length);
  scenario::dismiss(actors, *time);
  return *records;
}

} // namespace sofof::test
