// Takes all records and keeps none; a base for what keeps some of them.
#pragma once

#include "messages/protocol/record.hpp"

namespace sofof {

struct no_records : record_sink {
  void take(const event_record&) override {}
  void take(const decision_record&) override {}
  void take(const cycle_record&) override {}
  void take(const episode_record&) override {}
  void take(const track_record&) override {}
  void take(const safety_record&) override {}
  void take(const collision_record&) override {}
  void take(const drive_record&) override {}
  void take(const plan_switch_record&) override {}
  void take(const air_record&) override {}
};

} // namespace sofof
