// Tests of the network link: it looks like the far end, later or never.
#include "actors/simulation/network_link.hpp"

#include "messages/protocol/octets.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::channel;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// A link between a probe that stands for the requester (near) and one that
/// stands for the provider (far). Every message takes exactly 20 ms.
struct linked_world : virtual_world {
  const session_id one{11, 101, "one", 7}, two{11, 101, "two", 8};
  probe<provider_actor> far = listen<provider_actor>();
  probe<requester_actor> near = listen<requester_actor>();
  probe<provider_manager_actor> first = listen<provider_manager_actor>();
  probe<provider_manager_actor> second = listen<provider_manager_actor>();
  std::shared_ptr<octet_ledger> octets_up =
      std::make_shared<octet_ledger>(now());
  std::shared_ptr<octet_ledger> octets_down =
      std::make_shared<octet_ledger>(now());
  link_actor link = join({});

  static channel_profile steady() {
    channel_profile p;
    p.network = delay_distribution::uniform(20ms, 20ms);
    return p;
  }

  /// The same in a cell of 1 Mbit/s.
  static channel_profile slow() {
    auto p = steady();
    p.cell_mbps = 1;
    return p;
  }

  link_actor join(std::optional<link_fault_options> faults,
                  const channel_profile& profile = steady(),
                  const std::shared_ptr<shared_server_queue>& cell = nullptr) {
    const random_stream seed{1, "network"};
    const channel_draws draws{std::make_shared<const channel_profile>(profile),
                              seed, 101, 0};
    link_setup setup{{{draws, direction::up, cell}, octets_up},
                     {{draws, direction::down, cell}, octets_down},
                     {},
                     101};
    if (faults)
      setup.faults.emplace(seed.part("faults"), *faults);
    return own(spawn_network_link(system(), far.handle, std::move(setup)));
  }

  void say_cam() {
    tell(link, pdu_of(cam{101, now(), {1, 2}, 3, 4, 5}), near.handle);
  }
  /// Lets both ends know each other, and forgets about it.
  void meet() {
    say_cam();
    run_for(1s);
    far->clear();
  }
  /// The provider accepts both services.
  void accept() {
    tell(link, service_response{11, 101, 3, {{one, true, ""}, {two, true, ""}}},
         std::vector{first.handle, second.handle});
    run_for(1s);
  }
  void result(std::uint64_t cycle) {
    tell(link, service_result{one, cycle, now(), payload::of(echo{cycle})});
  }
  std::vector<std::uint64_t> cycles() const {
    std::vector<std::uint64_t> all;
    for (const auto& r : near->all<service_result>())
      all.push_back(r.cycle);
    return all;
  }
};

} // namespace

TEST_CASE_FIXTURE(linked_world, "a CAM arrives after the delay, unchanged") {
  const auto sent = now();
  say_cam();
  run_for(20ms - 1ns);
  CHECK(far->count<its_pdu>() == 0);
  run_for(1ns);
  REQUIRE(far->count<its_pdu>() == 1);
  CHECK(far->times<its_pdu>().front() == sent + 20ms);
  CHECK(far->all<its_pdu>().front().octets
        == pdu_of(cam{101, sent, {1, 2}, 3, 4, 5}).octets);
}

TEST_CASE_FIXTURE(linked_world, "to the provider the link looks like the "
                                "requester") {
  say_cam();
  tell(link, service_request{11, 101, 3, {"one"}, {{1, 2}}, 5}, near.handle);
  run_for(20ms);
  CHECK(far->seconds<requester_actor>()
        == std::vector<requester_actor>(2, requester_actor{link}));
  REQUIRE(far->count<service_request>() == 1);
  CHECK(far->all<service_request>().front().number == 3);
}

TEST_CASE_FIXTURE(linked_world, "to the requester the link looks like the "
                                "provider") {
  meet();
  const auto sent = now();
  tell_as(far.handle, link, service_offer{11, {1, 2}, {"one"}});
  run_for(1s);
  REQUIRE(near->count<service_offer>() == 1);
  CHECK(near->times<service_offer>().front() == sent + 20ms);
  CHECK(caf::actor_cast<provider_actor>(near->entries().front().from)
        == provider_actor{link});
}

TEST_CASE_FIXTURE(linked_world, "to the requester the link looks like the "
                                "managers of its services") {
  meet();
  accept();
  REQUIRE(near->count<service_response>() == 1);
  CHECK(near->all<service_response>().front().verdicts.size() == 2);
  const auto given = near->seconds<std::vector<provider_manager_actor>>();
  REQUIRE(given.size() == 1);
  CHECK(
      given.front()
      == std::vector<provider_manager_actor>(2, provider_manager_actor{link}));
}

TEST_CASE_FIXTURE(linked_world,
                  "each input finds its manager, after the delay") {
  meet();
  accept();
  const auto sent = now();
  tell(link, service_input{two, sent, payload::of(echo{2})});
  tell(link, service_input{one, sent, payload::of(echo{1})});
  run_for(1s);
  REQUIRE(first->count<service_input>() == 1);
  REQUIRE(second->count<service_input>() == 1);
  CHECK(first->all<service_input>().front().session == one);
  CHECK(second->all<service_input>().front().what.as<echo>()->number == 2);
  CHECK(first->times<service_input>().front() == sent + 20ms);
}

TEST_CASE_FIXTURE(linked_world, "a refused service has no manager") {
  meet();
  tell(link, service_response{11, 101, 3, {{one, false, ""}, {two, true, ""}}},
       std::vector{second.handle});
  tell(link, service_input{two, now(), payload::of(echo{2})});
  tell(link, service_input{one, now(), payload::of(echo{1})});
  run_for(1s);
  CHECK(second->count<service_input>() == 1);
  CHECK(first->count<service_input>() == 0);
}

TEST_CASE_FIXTURE(linked_world, "an ended service is not fed any more") {
  meet();
  accept();
  tell(link, service_end{one, end_reason::qos_gap, side::requester});
  tell(link, service_input{one, now(), payload::of(echo{1})});
  tell(link, service_input{two, now(), payload::of(echo{1})});
  run_for(1s);
  CHECK(first->count<service_input>() == 0);
  CHECK(second->count<service_input>() == 1);
}

TEST_CASE_FIXTURE(linked_world, "a service_end goes to the other side") {
  meet();
  const auto sent = now();
  tell(link, service_end{one, end_reason::qos_gap, side::requester});
  tell(link, service_end{two, end_reason::left_area, side::provider});
  run_for(1s);
  REQUIRE(far->count<service_end>() == 1);
  REQUIRE(near->count<service_end>() == 1);
  CHECK(far->all<service_end>().front().session == one);
  CHECK(near->all<service_end>().front().session == two);
  CHECK(far->times<service_end>().front() == sent + 20ms);
  CHECK(near->times<service_end>().front() == sent + 20ms);
}

TEST_CASE_FIXTURE(linked_world, "a result arrives after the delay, unchanged") {
  meet();
  const auto sent = now();
  result(5);
  run_for(1s);
  REQUIRE(near->count<service_result>() == 1);
  CHECK(near->times<service_result>().front() == sent + 20ms);
  const auto r = near->all<service_result>().front();
  CHECK(r.session == one);
  CHECK(r.created == sent);
  CHECK(r.what.as<echo>()->number == 5);
}

TEST_CASE_FIXTURE(linked_world,
                  "before anybody has spoken, the provider's words get lost") {
  tell(link, service_offer{11, {}, {"one"}});
  result(1);
  run_for(1s);
  CHECK(near->entries().empty());
  CHECK(!is_gone(link));
}

TEST_CASE_FIXTURE(linked_world,
                  "results arrive in the order they were sent, however the "
                  "delay varies") {
  link = join({}, *find_channel_profile("paper_5g"));
  meet();
  std::vector<std::uint64_t> sent;
  for (std::uint64_t k = 1; k <= 500; ++k) {
    result(k);
    sent.push_back(k);
    run_for(100us);
  }
  run_for(1s);
  CHECK(cycles() == sent);
}

TEST_CASE_FIXTURE(linked_world,
                  "what else is sent does not change when results arrive") {
  const auto profile = *find_channel_profile("paper_5g");
  const auto arrivals = [&](bool with_offers) {
    link = join({}, profile);
    meet();
    near->clear();
    const auto began = now();
    for (std::uint64_t k = 1; k <= 50; ++k) {
      result(k);
      run_for(90ms);
      if (with_offers)
        tell(link, service_offer{11, {}, {"one"}});
      run_for(110ms);
    }
    std::vector<duration> all;
    for (const auto t : near->times<service_result>())
      all.push_back(t - began);
    return all;
  };
  const auto alone = arrivals(false);
  CHECK(alone.size() == 50);
  CHECK(arrivals(true) == alone);
}

TEST_CASE_FIXTURE(linked_world, "an ITS message is in the air for as long as "
                                "its octets take, with the layers below") {
  link = join({}, slow());
  for (const std::size_t n : {10u, 100u, 1000u}) {
    CAPTURE(n);
    const its_pdu message{std::vector<std::byte>(n)};
    const auto sent = now();
    tell(link, message, near.handle);
    run_for(1s);
    CHECK(far->times<its_pdu>().back() == sent + 20ms + 8us * (n + 44));
    // A result of a service that it is a part of takes as much longer as the
    // rest of it is.
    const auto again = now();
    const service_result result{one, n, again, payload::of(message)};
    const auto octets = octets_of(result) + 44;
    CHECK(octets > n + 44);
    tell(link, result);
    run_for(1s);
    CHECK(near->times<service_result>().back() == again + 20ms + 8us * octets);
  }
}

TEST_CASE_FIXTURE(linked_world,
                  "a longer message of the protocol takes longer") {
  link = join({}, slow());
  meet();
  const auto takes = [&](std::size_t points) {
    const auto sent = now();
    tell(link,
         service_request{11, 101, 3, {"one"}, std::vector<point>(points), 5},
         near.handle);
    run_for(1s);
    return far->times<service_request>().back() - sent;
  };
  const auto empty = takes(0);
  CHECK(empty > 20ms);
  CHECK(takes(100) == empty + 100 * 16 * 8us);
  const auto offer_takes = [&](std::size_t kinds) {
    const auto sent = now();
    tell(link,
         service_offer{11, {}, std::vector<service_name>(kinds, {"one"})});
    run_for(1s);
    return near->times<service_offer>().back() - sent;
  };
  CHECK(offer_takes(5) > offer_takes(1));
}

TEST_CASE_FIXTURE(linked_world, "who shares a cell waits for the other's "
                                "octets") {
  const auto cell = std::make_shared<shared_server_queue>(1);
  link = join({}, slow(), cell);
  const auto other = join({}, slow(), cell);
  const auto sent = now();
  tell(link, its_pdu{std::vector<std::byte>(956)}, near.handle);
  tell(other, its_pdu{std::vector<std::byte>(56)}, near.handle);
  run_for(1s);
  CHECK(far->times<its_pdu>()
        == std::vector{sent + 20ms + 8ms, sent + 20ms + 8ms + 800us});
}

TEST_CASE_FIXTURE(linked_world, "all that is sent is counted by what it is "
                                "for, until it arrives or is lost") {
  meet();
  accept();
  link = join(link_fault_options{0.3, 0.2, 0, 300ms});
  say_cam();
  tell(link, service_response{11, 101, 3, {{one, true, ""}, {two, true, ""}}},
       std::vector{first.handle, second.handle});
  run_for(1s);
  far->clear();
  near->clear();
  first->clear();
  std::size_t octets = 0;
  for (std::uint64_t k = 1; k <= 100; ++k) {
    const service_result result{one, k, now(), payload::of(echo{k})};
    octets = octets_of(result);
    tell(link, result);
    tell(link, service_input{one, now(), payload::of(echo{k})});
    say_cam();
    run_for(10ms);
  }
  const auto line = [&](octet_ledger& ledger, std::string_view what) {
    for (const auto& x : ledger.read(now()))
      if (x.what == what)
        return x.together();
    return octet_fates{};
  };
  const auto down = line(*octets_down, "one");
  CHECK(down.sent.octets == down.sent.messages * octets);
  CHECK(down.sent.messages > 100); // some twice
  CHECK(down.lost.messages > 0);
  CHECK(down.under_way.messages > 0);
  CHECK(down.delivered.messages == near->count<service_result>());
  CHECK(line(*octets_up, "one").delivered.messages
        == first->count<service_input>());
  CHECK(line(*octets_up, "CAM").delivered.messages > 0);
  run_for(1s);
  const auto later = line(*octets_down, "one");
  CHECK(later.under_way.messages == 0);
  CHECK(later.delivered.messages == near->count<service_result>());
  CHECK(later.sent.octets == later.delivered.octets + later.lost.octets);
}

TEST_CASE_FIXTURE(linked_world, "the link does not outlive the provider") {
  meet();
  kill(far.handle);
  CHECK(is_gone(link));
}

TEST_CASE_FIXTURE(linked_world, "the link does not outlive the requester") {
  meet();
  kill(near.handle);
  CHECK(is_gone(link));
}

TEST_CASE_FIXTURE(linked_world, "what is lost never arrives, either way") {
  link = join(link_fault_options{1, 0, 0, 0ms});
  say_cam();
  result(1);
  tell(link, service_offer{11, {}, {"one"}});
  run_for(5s);
  CHECK(far->entries().empty());
  CHECK(near->entries().empty());
}

TEST_CASE_FIXTURE(linked_world, "what is doubled arrives twice, the first "
                                "time on time") {
  link = join(link_fault_options{0, 1, 0, 300ms});
  const auto sent = now();
  say_cam();
  result(1);
  run_for(5s);
  REQUIRE(far->count<its_pdu>() == 2);
  CHECK(near->count<service_result>() == 2);
  CHECK(far->times<its_pdu>().front() == sent + 20ms);
}

TEST_CASE_FIXTURE(linked_world, "what is reordered arrives once, some later "
                                "than what was sent after it") {
  link = join(link_fault_options{0, 0, 0.5, 300ms});
  say_cam();
  for (std::uint64_t k = 1; k <= 100; ++k) {
    result(k);
    run_for(10ms);
  }
  run_for(1s);
  auto all = cycles();
  CHECK(all.size() == 100);
  CHECK(!std::ranges::is_sorted(all));
  std::ranges::sort(all);
  CHECK(std::ranges::adjacent_find(all) == all.end());
}
