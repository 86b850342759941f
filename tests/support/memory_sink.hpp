// Keeps the records of a run in memory, for tests that look at them.
#pragma once

#include "base/overloaded.hpp"
#include "messages/protocol/record.hpp"

#include <vector>

namespace sofof::test {

struct memory_sink final : messages::record_sink {
  std::vector<messages::event_record> events;
  std::vector<messages::decision_record> decisions;
  std::vector<messages::verdict_record> verdicts;
  std::vector<messages::cycle_record> cycles;
  std::vector<messages::work_record> work;
  std::vector<messages::episode_record> episodes;
  std::vector<messages::track_record> tracks;
  std::vector<messages::safety_record> safety;
  std::vector<messages::collision_record> collisions;
  std::vector<messages::drive_record> drives;
  std::vector<messages::trip_record> trips;
  std::vector<messages::claim_record> claims;
  std::vector<messages::scene_record> scenes;
  std::vector<messages::stage_record> stages;
  std::vector<messages::response_record> responses;
  std::vector<messages::prediction_record> predictions;
  std::vector<messages::plan_switch_record> plan_switches;
  std::vector<messages::air_record> air;
  std::vector<messages::trace_record> steps;

  void on_record(const messages::record& x) override {
    std::visit(
        overloaded{
            [this](const messages::event_record& r) { events.push_back(r); },
            [this](const messages::decision_record& r) {
              decisions.push_back(r);
            },
            [this](const messages::verdict_record& r) {
              verdicts.push_back(r);
            },
            [this](const messages::cycle_record& r) { cycles.push_back(r); },
            [this](const messages::work_record& r) { work.push_back(r); },
            [this](const messages::episode_record& r) {
              episodes.push_back(r);
            },
            [this](const messages::track_record& r) { tracks.push_back(r); },
            [this](const messages::safety_record& r) { safety.push_back(r); },
            [this](const messages::collision_record& r) {
              collisions.push_back(r);
            },
            [this](const messages::drive_record& r) { drives.push_back(r); },
            [this](const messages::trip_record& r) { trips.push_back(r); },
            [this](const messages::claim_record& r) { claims.push_back(r); },
            [this](const messages::scene_record& r) { scenes.push_back(r); },
            [this](const messages::stage_record& r) { stages.push_back(r); },
            [this](const messages::response_record& r) {
              responses.push_back(r);
            },
            [this](const messages::prediction_record& r) {
              predictions.push_back(r);
            },
            [this](const messages::plan_switch_record& r) {
              plan_switches.push_back(r);
            },
            [this](const messages::air_record& r) { air.push_back(r); },
            [this](const messages::trace_record& r) { steps.push_back(r); }},
        x);
  }
};

} // namespace sofof::test
