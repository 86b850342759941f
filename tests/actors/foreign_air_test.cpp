// What stations of other programs say: providers hear it, and serve nobody.
#include "actors/simulation/foreign_air.hpp"

#include "tests/support/on_air.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <optional>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct foreign_world : virtual_world {
  probe<provider_actor> provider = listen<provider_actor>();
  probe<air_actor> air = listen<air_actor>();
  std::optional<foreign_air> ear;

  foreign_world() {
    foreign_air_setup setup;
    setup.providers = {provider.handle};
    setup.air = air.handle;
    setup.own = {101};
    setup.decode = decode_in_ulm();
    ear.emplace(system(), std::move(setup));
  }
  ~foreign_world() {
    ear.reset();
    settle();
  }

  void say(its_pdu what) {
    ear->on_message(std::move(what));
    settle();
  }
  its_pdu cam_of(station_id who) {
    return pdu_of(cam{who, now(), {1, 2}, 3, 4, 0});
  }
};

} // namespace

TEST_CASE_FIXTURE(foreign_world, "a provider hears a station of another "
                                 "program, and whose word it is") {
  say(cam_of(900));
  say(cam_of(901));
  const auto heard = provider->all<its_pdu>();
  REQUIRE(heard.size() == 2);
  CHECK(heard[0].octets == cam_of(900).octets);
  CHECK(heard[0].sender.has_value());
  CHECK(heard[0].sender == heard[1].sender); // nobody has proved more
  CHECK(air->entries().empty());             // vehicles hear no CAM
}

TEST_CASE_FIXTURE(foreign_world, "nobody is heard in the name of a station of "
                                 "this scenario, or of a provider") {
  say(cam_of(101));
  say(cam_of(provider_station(0)));
  say({.octets = std::vector<std::byte>(5)});
  CHECK(provider->entries().empty());
}

TEST_CASE_FIXTURE(foreign_world, "so many stations are heard at once, and "
                                 "others once some are silent") {
  for (station_id::rep who = 1000; who < 2000; ++who)
    say(cam_of(who));
  CHECK(provider->entries().size() == 256);
  run_for(std::chrono::seconds{11});
  say(cam_of(1999));
  CHECK(provider->entries().size() == 257);
  CHECK_FALSE(provider->seconds<requester_actor>().front()); // it asks nothing
}
