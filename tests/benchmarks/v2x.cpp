// How long the codecs of ITS messages take. The sizes are those for which
// there are figures of other codecs: docs/benchmarks.md.
#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/cpm_ts103324.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/etsi/uper.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <stdexcept>

namespace {

using namespace sofof;
using namespace sofof::messages;

constexpr std::size_t objects_in_a_cpm = 26;
constexpr std::size_t waypoints_in_an_mcm = 50;

/// The least that a vehicle tells: 41 octets.
etsi::cam small_cam() {
  etsi::cam message;
  message.header.station = 101;
  return message;
}

/// Objects as cars see them: where, how fast, how large, and what.
etsi::tr103562::cpm full_cpm_tr() {
  etsi::tr103562::cpm message;
  auto& body = message.body.parameters;
  body.station_data.emplace();
  auto& objects = body.objects.emplace();
  objects.resize(objects_in_a_cpm);
  for (auto& x : objects) {
    x.yaw.emplace();
    x.planar_dimension_1.emplace();
    x.planar_dimension_2.emplace();
    x.classification.emplace().resize(1);
  }
  body.number_of_objects = objects_in_a_cpm;
  return message;
}

etsi::ts103324::cpm full_cpm_ts() {
  etsi::ts103324::cpm message;
  auto& containers = message.body.containers;
  containers.resize(2);
  containers[0].value.emplace<etsi::ts103324::originating_vehicle>();
  auto& seen =
      containers[1].value.emplace<etsi::ts103324::perceived_object_container>();
  seen.number_of_objects = objects_in_a_cpm;
  seen.objects.resize(objects_in_a_cpm);
  for (auto& x : seen.objects) {
    x.id.emplace();
    x.velocity.emplace().value.emplace<etsi::cartesian_velocity>();
    x.angles.emplace();
    x.x_dimension.emplace();
    x.y_dimension.emplace();
    x.classification.emplace().resize(1);
  }
  return message;
}

/// A plan, as SOFOF sends it.
etsi::mcm suggestion() {
  etsi::mcm message;
  auto& maneuver = message.body.parameters.maneuver.value
                       .emplace<etsi::suggested_maneuver_container>()
                       .maneuver.emplace();
  maneuver.participants.push_back(101);
  auto& waypoints =
      maneuver.parameters.value.emplace<etsi::maneuver_constraints>().waypoints;
  waypoints.resize(waypoints_in_an_mcm);
  for (auto& x : waypoints) {
    x.min_velocity = etsi::speed_value{833};
    x.max_velocity = etsi::speed_value{833};
  }
  return message;
}

template <class Message>
void encode(benchmark::State& state, Message message) {
  std::array<std::byte, 4096> room;
  std::size_t octets = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(message);
    octets = etsi::encode(message, room);
    benchmark::DoNotOptimize(room);
  }
  if (octets == 0)
    throw std::logic_error{"the message cannot be encoded"};
  state.counters["octets"] = static_cast<double>(octets);
}

template <class Message>
void decode(benchmark::State& state, const Message& message) {
  std::array<std::byte, 4096> room;
  const auto octets = etsi::encode(message, room);
  Message again;
  auto good = true;
  for (auto _ : state) {
    benchmark::DoNotOptimize(room);
    good = etsi::decode(std::span{room}.first(octets), again) && good;
    benchmark::DoNotOptimize(again);
  }
  if (!good)
    throw std::logic_error{"the message cannot be decoded"};
}

BENCHMARK_CAPTURE(encode, cam, small_cam());
BENCHMARK_CAPTURE(decode, cam, small_cam());
BENCHMARK_CAPTURE(encode, cpm_tr103562, full_cpm_tr());
BENCHMARK_CAPTURE(decode, cpm_tr103562, full_cpm_tr());
BENCHMARK_CAPTURE(encode, cpm_ts103324, full_cpm_ts());
BENCHMARK_CAPTURE(decode, cpm_ts103324, full_cpm_ts());
BENCHMARK_CAPTURE(encode, mcm, suggestion());
BENCHMARK_CAPTURE(decode, mcm, suggestion());

} // namespace
