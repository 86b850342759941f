// Keeps the records of a run in memory, for tests that look at them.
#pragma once

#include "base/overloaded.hpp"
#include "messages/protocol/record.hpp"

#include <vector>

namespace sofof::test {

struct memory_sink final : record_sink {
  std::vector<event_record> events;
  std::vector<decision_record> decisions;
  std::vector<cycle_record> cycles;
  std::vector<episode_record> episodes;
  std::vector<track_record> tracks;
  std::vector<safety_record> safety;
  std::vector<collision_record> collisions;
  std::vector<drive_record> drives;
  std::vector<plan_switch_record> plan_switches;
  std::vector<air_record> air;

  void on_record(const record& x) override {
    std::visit(
        overloaded{
            [this](const event_record& r) { events.push_back(r); },
            [this](const decision_record& r) { decisions.push_back(r); },
            [this](const cycle_record& r) { cycles.push_back(r); },
            [this](const episode_record& r) { episodes.push_back(r); },
            [this](const track_record& r) { tracks.push_back(r); },
            [this](const safety_record& r) { safety.push_back(r); },
            [this](const collision_record& r) { collisions.push_back(r); },
            [this](const drive_record& r) { drives.push_back(r); },
            [this](const plan_switch_record& r) { plan_switches.push_back(r); },
            [this](const air_record& r) { air.push_back(r); }},
        x);
  }
};

} // namespace sofof::test
