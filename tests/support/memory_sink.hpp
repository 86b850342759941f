// Keeps the records of a run in memory, for tests that look at them.
#pragma once

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

  void take(const event_record& x) override { events.push_back(x); }
  void take(const decision_record& x) override { decisions.push_back(x); }
  void take(const cycle_record& x) override { cycles.push_back(x); }
  void take(const episode_record& x) override { episodes.push_back(x); }
  void take(const track_record& x) override { tracks.push_back(x); }
  void take(const safety_record& x) override { safety.push_back(x); }
  void take(const collision_record& x) override { collisions.push_back(x); }
  void take(const drive_record& x) override { drives.push_back(x); }
  void take(const plan_switch_record& x) override {
    plan_switches.push_back(x);
  }
  void take(const air_record& x) override { air.push_back(x); }
};

} // namespace sofof::test
