// Who else has seen a body, who has not, and whose word counts for less.
#include "planners/plausibility/testimony.hpp"

#include "planners/plausibility/reputation.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using namespace std::chrono_literals;

namespace {

constexpr time_point said_at{100s};
constexpr sender_id certificate_a = 7, certificate_b = 8, certificate_c = 9;

road_observer mast_number(std::uint32_t number) {
  return {number, true, 0};
}
road_observer vehicle_of(station_id station, sender_id sender) {
  return {station.value(), false, sender};
}

testimony told_by(sender_id who) {
  testimony said;
  said.teller(who);
  return said;
}

} // namespace

TEST_CASE("one's own vehicles confirm nothing, another's do, for a while") {
  auto said = told_by(certificate_a);
  said.confirm(vehicle_of(202, certificate_a), said_at);
  CHECK_FALSE(said.is_confirmed(said_at));
  said.confirm(vehicle_of(101, certificate_b), said_at);
  CHECK(said.is_confirmed(said_at + 1250ms));
  CHECK_FALSE(said.is_confirmed(said_at + 1251ms));
}

TEST_CASE("sensors of the provider deny after three looks in a row") {
  auto said = told_by(certificate_a);
  said.deny(mast_number(0), said_at, true);
  said.deny(mast_number(0), said_at + 50ms, true);
  CHECK_FALSE(said.is_denied_for_all());
  said.confirm(mast_number(1), said_at + 60ms);
  said.deny(mast_number(0), said_at + 100ms, true);
  CHECK_FALSE(said.is_denied_for_all());
  said.deny(mast_number(0), said_at + 150ms, true);
  said.deny(mast_number(0), said_at + 200ms, true);
  CHECK(said.is_denied_for_all());
  CHECK(said.is_confirmed(said_at + 200ms)); // by the other mast
}

TEST_CASE(
    "two vehicles of one sender are certificate_b, and the teller's are none") {
  auto said = told_by(certificate_a);
  said.deny(vehicle_of(101, certificate_b), said_at, true);
  said.deny(vehicle_of(102, certificate_b), said_at, true);
  said.deny(vehicle_of(201, certificate_a), said_at, true);
  CHECK_FALSE(said.is_denied_for_all());
  CHECK(said.is_denied_by(101));
  CHECK_FALSE(said.is_denied_by(103));
  said.deny(vehicle_of(103, certificate_c), said_at, true);
  CHECK(said.is_denied_for_all());
}

TEST_CASE("who sees it after all takes back its own denial") {
  auto said = told_by(certificate_a);
  said.deny(vehicle_of(101, certificate_b), said_at, true);
  said.confirm(vehicle_of(101, certificate_b), said_at + 1s);
  CHECK_FALSE(said.is_denied());
  said.deny(vehicle_of(101, certificate_b), said_at + 2s, true);
  CHECK_FALSE(said.is_confirmed(said_at + 2s));
}

TEST_CASE("a vehicle that may have lost a message denies for as long as it "
          "would take to tell again") {
  auto said = told_by(certificate_a);
  said.deny(vehicle_of(101, certificate_b), said_at, false);
  said.deny(vehicle_of(101, certificate_b), said_at + 1s, false);
  CHECK_FALSE(said.is_denied_by(101));
  said.deny(vehicle_of(101, certificate_b), said_at + 1100ms, false);
  CHECK(said.is_denied_by(101));
}

TEST_CASE("a sender is distrusted for a minute, then for two") {
  reputation senders;
  CHECK_FALSE(senders.has_liars(said_at));
  senders.blame(certificate_a, reputation::everybody, said_at);
  senders.blame(certificate_a, reputation::everybody, said_at + 1s);
  CHECK(senders.is_distrusted(certificate_a, 101, said_at + 60s));
  CHECK_FALSE(senders.is_distrusted(certificate_a, 101, said_at + 61s));
  CHECK_FALSE(senders.is_distrusted(certificate_b, 101, said_at));
  senders.blame(certificate_a, reputation::everybody, said_at + 70s);
  CHECK(senders.is_distrusted(certificate_a, 101, said_at + 189s));
  CHECK_FALSE(senders.is_distrusted(certificate_a, 101, said_at + 190s));
}

TEST_CASE("what one vehicle finds out holds for it alone") {
  reputation senders;
  senders.blame(certificate_a, 101, said_at);
  CHECK(senders.is_distrusted(certificate_a, 101, said_at));
  CHECK_FALSE(senders.is_distrusted(certificate_a, 102, said_at));
}
