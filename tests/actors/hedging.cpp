// Tests of a second provider that is called only when the first does not
// answer.
#include "actors/offloading/service_manager.hpp"
#include "tests/actors/requester_world.hpp"

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::policies;
using namespace sofof::test;

namespace {

/// Service "one" runs at the first provider, every 50 ms, and the second one is
/// called when that has not answered 20 ms after a cycle began. All ways take
/// 10 ms.
struct hedged_world : requester_world {
  probe<provider_manager_actor> second = listen<provider_manager_actor>();
  std::uint64_t cycle = 1;

  hedged_world() {
    start_remote({one});
    lodm->preferred = here;
    lodm->second = elsewhere;
    lodm->hedge_after = 20ms;
    offer_from(other, elsewhere, {one});
    accept_at_other();
  }

  void accept_at_other() {
    const auto asked = other->all<service_request>().back();
    tell(requester,
         service_response{
             elsewhere, station, asked.number, {{at_other(), true, "as told"}}},
         std::vector{second.handle});
  }

  session_id at_other() const { return {elsewhere, station, one, 70}; }
  void join() { result(at_other(), 1); }
  /// The second one says that it runs the service, too.
  void confirm() {
    tell_as(other.handle, requester,
            session_digest{elsewhere, station, 70, {at_other()}});
  }
  /// The first answers the next cycle, 40 ms after its last answer; each
  /// second, the other one confirms that it runs the service, too.
  void answer_next() {
    run_for(50ms);
    result(at_here(one, 7), ++cycle);
    if (cycle % 20 == 0)
      confirm();
  }
  void feed() {
    for (const auto& m : vehicle->all<requester_manager_actor>())
      tell(m, service_input{{}, now(), payload::of(echo{1})});
  }
  /// Results of the service that the client got.
  std::vector<service_result> used() const {
    auto all = vehicle->all<service_result>();
    std::erase_if(all,
                  [this](const auto& r) { return r.session.service != one; });
    return all;
  }
  std::size_t calls() const {
    std::size_t n = 0;
    for (const auto& input : second->all<service_input>())
      n += input.standby;
    return n;
  }
};

} // namespace

TEST_CASE_FIXTURE(hedged_world, "whoever is to be on call is called for its "
                                "first result") {
  REQUIRE(second->count<service_input>() == 1);
  CHECK(calls() == 1);
  join();
  CHECK(is_remote(one));
  CHECK(ends().empty());
}

TEST_CASE_FIXTURE(hedged_world, "nobody is called, or fed, as long as the "
                                "first answers each cycle") {
  join();
  second->clear();
  for (int k = 0; k < 40; ++k) {
    answer_next();
    feed();
  }
  CHECK(second->entries().empty());
  CHECK(other->count<service_end>() == 0);
}

TEST_CASE_FIXTURE(hedged_world, "a cycle that is not answered in time is "
                                "called for, once") {
  join();
  answer_next(); // it began 10 ms ago
  second->clear();
  run_for(60ms - 1ns);
  CHECK(calls() == 0);
  run_for(1ns);
  CHECK(calls() == 1);
  CHECK(second->count<service_input>() == 1);
  run_for(20ms);
  CHECK(calls() == 1);
}

TEST_CASE_FIXTURE(hedged_world, "the answer to a call is used, that of the "
                                "first which comes after it is not") {
  join();
  answer_next();
  run_for(65ms);
  vehicle->clear();
  result(at_other(), 2, 5ms);
  REQUIRE(used().size() == 1);
  CHECK(used().front().session == at_other());
  result(at_here(one, 7), ++cycle, 25ms);
  CHECK(used().size() == 1);
  answer_next(); // the next cycle is the first's again
  REQUIRE(used().size() == 2);
  CHECK(used().back().session == at_here(one, 7));
}

TEST_CASE_FIXTURE(hedged_world, "while the first is silent each cycle is "
                                "called for, and then the second is fed") {
  join();
  answer_next();
  second->clear();
  std::uint64_t k = 1;
  for (int n = 0; n < 5; ++n) {
    run_for(n == 0 ? 60ms : 40ms);
    CHECK(calls() == k);
    run_for(10ms);
    result(at_other(), ++k, 5ms);
  }
  CHECK(is_remote(one));
  tell(requester,
       service_end{at_here(one, 7), end_reason::revoked, side::provider});
  CHECK(is_remote(one));
  CHECK(calls() == 5);
  REQUIRE(second->count<service_input>() == 6);
  CHECK(!second->all<service_input>().back().standby);
}

TEST_CASE_FIXTURE(hedged_world, "when nobody answers, called or not, the "
                                "service comes home") {
  join();
  answer_next();
  run_for(101ms);
  CHECK(!is_remote(one));
  CHECK(ends().size() == 1);
  CHECK(other->count<service_end>() == 1);
}

TEST_CASE_FIXTURE(hedged_world, "who is called for a second in vain is given "
                                "up, and who is not called is not") {
  join();
  for (int k = 0; k < 40; ++k)
    answer_next();
  CHECK(other->count<service_end>() == 0);
  for (int k = 0; k < 30; ++k) { // each cycle 30 ms late
    run_for(50ms);
    result(at_here(one, 7), ++cycle, 30ms);
  }
  CHECK(is_remote(one));
  REQUIRE(other->count<service_end>() == 1);
  CHECK(other->all<service_end>().front().reason == end_reason::qos_gap);
}

TEST_CASE_FIXTURE(hedged_world, "one call in vain is no reason to give anybody "
                                "up") {
  join();
  answer_next();
  run_for(50ms + 15ms);
  result(at_here(one, 7), ++cycle, 25ms); // the second one's answer is lost
  run_for(35ms);
  result(at_here(one, 7), ++cycle);
  for (int k = 0; k < 100; ++k)
    answer_next();
  CHECK(calls() == 2);
  CHECK(other->count<service_end>() == 0);
}

TEST_CASE_FIXTURE(hedged_world,
                  "a plan that does not continue does not use its "
                  "cycle up") {
  join();
  answer_next();
  run_for(65ms);
  vehicle->clear();
  tell(requester, service_result{at_other(), 2, now() - 5ms,
                                 payload::of(echo{echo::jump})});
  CHECK(used().empty());
  result(at_here(one, 7), ++cycle, 25ms);
  CHECK(used().size() == 1);
}

TEST_CASE_FIXTURE(hedged_world, "the link to whoever is on call is not judged "
                                "by its silence") {
  join();
  for (std::uint64_t k = 2; k < 40; ++k) // as if it planned every cycle
    result(at_other(), k);
  for (int k = 0; k < 40; ++k)
    answer_next();
  lodm->asked.clear();
  offer_from(provider, here, {one});
  REQUIRE(lodm->asked.size() == 1);
  const auto known = lodm->asked.front().providers;
  const auto there = std::ranges::find(known, elsewhere, &provider_view::id);
  REQUIRE(there != known.end());
  CHECK(there->link.late < 0.5);
}

TEST_CASE_FIXTURE(hedged_world, "whoever takes over alone is told the plan in "
                                "use, and to plan every period") {
  join();
  for (int k = 0; k < 40; ++k)
    answer_next();
  second->clear();
  tell(requester,
       service_end{at_here(one, 7), end_reason::left_area, side::provider});
  REQUIRE(second->count<service_input>() == 1);
  const auto input = second->all<service_input>().front();
  CHECK(!input.standby);
  REQUIRE(input.in_use.as<echo>());
  CHECK(input.in_use.as<echo>()->number == cycle);
}

TEST_CASE("whoever came first and shall be on call is told so") {
  requester_world w;
  auto second = w.listen<provider_manager_actor>();
  const session_id there{w.elsewhere, w.station, w.one, 70};
  w.lodm->preferred = w.here;
  w.lodm->second = w.elsewhere;
  w.lodm->hedge_after = 20ms;
  w.lodm->wanted = {};
  w.offer_from(w.other, w.elsewhere, {w.one});
  w.lodm->wanted = {"one"};
  w.offer({w.one}); // both are asked at once
  REQUIRE(w.other->count<service_request>() == 1);
  w.tell(w.requester,
         service_response{w.elsewhere,
                          w.station,
                          w.other->all<service_request>().back().number,
                          {{there, true, "as told"}}},
         std::vector{second.handle});
  w.answer(w.last_request(), {{w.one, 7}});
  w.result(there, 1);
  REQUIRE(second->count<service_input>() == 1);
  CHECK(!second->all<service_input>().back().standby); // it is alone
  w.result(w.at_here(w.one, 7), 1);
  REQUIRE(second->count<service_input>() == 2);
  CHECK(second->all<service_input>().back().standby);
  // It has not heard that, and goes on.
  w.run_for(100ms);
  w.result(w.at_here(w.one, 7), 2);
  w.result(there, 3);
  CHECK(second->count<service_input>() == 3);
  CHECK(second->all<service_input>().back().standby);
}

TEST_CASE_FIXTURE(hedged_world, "a policy may have all cycles planned again") {
  join();
  answer_next();
  second->clear();
  lodm->hedge_after = {};
  lodm->wanted = {"one"};
  offer_from(provider, here, {one, two});
  REQUIRE(second->count<service_input>() == 1);
  CHECK(!second->all<service_input>().front().standby);
}

TEST_CASE_FIXTURE(hedged_world, "an answer that was long on its way is no "
                                "reason to call again") {
  join();
  answer_next();
  second->clear();
  run_for(65ms); // it is called for
  REQUIRE(calls() == 1);
  for (int k = 0; k < 4; ++k) {
    result(at_here(one, 7), ++cycle, 5ms);
    run_for(50ms);
  }
  const auto before = calls();
  result(at_other(), 2, 60ms); // of that call, 200 ms ago
  CHECK(calls() == before);
  result(at_other(), 3, 5ms); // who has not heard yet goes on
  CHECK(calls() == before + 1);
}
