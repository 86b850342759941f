// SR: the vehicle's side of offloading.
#include "actors/offloading/service_requester.hpp"

#include "actors/offloading/onboard_service.hpp"
#include "actors/offloading/service_state.hpp"
#include "actors/runtime/cpu_accounts.hpp"
#include "actors/runtime/on_air.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace sofof {

namespace {

using requester_impl = onboard_requester_actor::extend<
    // The request with this number has been open for too long.
    reacts_to<tick_atom, provider_id, std::uint32_t>,
    // This running service should have given its first data by now.
    reacts_to<tick_atom, session_id>,
    // An epoch of the policy is over.
    reacts_to<tick_atom>>;

// A provider's clock, GHz, where it tells itself how long it computes.
constexpr auto takes_no_time = std::numeric_limits<double>::infinity();

struct requester_state {
  static inline const char* name = "service_requester";

  requester_impl::stateful_pointer<requester_state> self;
  requester_setup setup;
  std::vector<service_state> slots;
  known_providers providers;
  ego_state ego;
  std::uint32_t last_request = 0;
  std::uint64_t decisions = 0;
  duration epoch{}; // of the policy; 0: none

  void start() {
    self->monitor(setup.vehicle);
    for (const auto& kind : setup.kinds)
      add(kind);
    charge_self();
    epoch = from_seconds(setup.lodm->epoch_s());
    if (epoch > duration{0})
      send_after(self, self, epoch, tick_atom_v);
  }

  // For whom it works, in case somebody keeps accounts.
  void charge_self() {
    const auto any_remote =
        std::ranges::any_of(slots, &service_state::is_remote);
    charge(self->system(), self->id(), {setup.station, {}, any_remote});
  }

  // -- services of this vehicle -------------------------------------------

  service_setup setup_of(const service_type& kind) const {
    return onboard_setup(setup, kind, clock_of(self));
  }

  void add(const service_type_ptr& kind) {
    auto own = spawn_onboard_service(self->system(), setup, kind, self,
                                     setup_of(*kind));
    if (own.client != setup.vehicle)
      self->link_to(own.client);
    self->link_to(own.manager);
    slots.push_back(
        {.kind = kind,
         .manager = std::move(own.manager),
         .on_board = on_board_cost(setup.computer, kind->common.task),
         .offloaded =
             offloaded_cost(setup.computer, kind->common.task, takes_no_time),
         .since = now(self)});
  }

  service_state* find(std::string_view kind) {
    auto i = std::ranges::find(
        slots, kind, [](const service_state& s) { return s.kind->name(); });
    return i == slots.end() ? nullptr : &*i;
  }

  struct found {
    service_state* slot = nullptr;
    requester_session* at = nullptr;
    explicit operator bool() const { return at != nullptr; }
  };

  // Where `running` is starting or remote.
  found find(const session_id& running) {
    auto* slot = find(running.kind.view());
    auto* at = slot ? slot->find(running.provider) : nullptr;
    if (!at || at->at == phase::requested || at->running != running)
      return {};
    return {slot, at};
  }

  // -- offer, decision, request -------------------------------------------

  void take(const service_offer& offer, const provider_actor& from) {
    note("offer", offer.provider, {}, 0, {});
    auto& provider = meet(offer.provider, from);
    if (provider.handle != from)
      return; // nobody speaks for another one
    provider.offer = offer;
    provider.offered_at = now(self);
    learn(offer);
    if (provider.open_request)
      return;
    weigh(
        [&](const service_state& slot) {
          return provider.offers(slot.kind->name());
        },
        offer.provider);
  }

  // How good the way is, also while nothing runs there.
  void learn(const service_offer& offer) {
    const auto t = now(self);
    if (!offer.created || *offer.created > t)
      return;
    for (auto& slot : slots)
      if (!slot.find(offer.provider) || slot.is_standby(offer.provider))
        slot.link_of(offer.provider)
            .answered(*offer.created - slot.computing(offer), t);
  }

  // Cycles on board are told at the pace of the epoch.
  void take_epoch() {
    send_after(self, self, epoch, tick_atom_v);
    const auto t = now(self);
    for (auto& slot : slots)
      if (!slot.is_remote())
        setup.lodm->observe(cycle_outcome{
            t, slot.kind->name(), 0, slot.on_board.time_s, false,
            slot.on_board.energy_j,
            to_seconds(epoch) / to_seconds(slot.kind->common.period)});
    weigh([](const service_state&) { return true; }, 0);
  }

  // Decides about the services for which `is_due`.
  // @param offering  Who offers them just now; 0: nobody.
  template <class Predicate>
  void weigh(Predicate is_due, provider_id offering) {
    std::map<provider_id, std::vector<service_name>> wanted;
    const auto path = path_ahead();
    for (auto& slot : slots)
      if (!slot.is_moving() && is_due(slot))
        for (const auto source : decide(slot, offering, path))
          wanted[source].push_back(slot.kind->name());
    for (auto& [source, kinds] : wanted)
      request(source, std::move(kinds), path);
  }

  std::vector<point> path_ahead() const {
    return setup.way->waypoints(ego.s_m, protocol::route_ahead_m,
                                protocol::route_spacing_m);
  }

  known_provider& meet(provider_id id, const provider_actor& from) {
    if (const auto i = providers.find(id); i != providers.end())
      return i->second;
    // Behind a handle is one provider, which has booted since.
    const auto is_same = [&from](const auto& known) {
      return known.second.handle == from;
    };
    const auto before = std::ranges::find_if(providers, is_same);
    if (before == providers.end())
      self->monitor(from);
    // A liar that has booted again is no other one.
    const auto doubted =
        before != providers.end() ? before->second.doubted : distrust{};
    std::erase_if(providers, [&](const auto& known) {
      return is_same(known) && !is_in_use(known.first);
    });
    for (auto& slot : slots)
      std::erase_if(slot.links, [&](const auto& link) {
        return !providers.contains(link.first);
      });
    return providers.emplace(id, known_provider{from, {}, {}, {}, {}, doubted})
        .first->second;
  }

  bool is_in_use(provider_id id) {
    return std::ranges::any_of(
        slots, [id](auto& slot) { return slot.find(id) != nullptr; });
  }

  // @param only  Beside where it runs, who comes into question; 0: all.
  // @returns who shall be asked for a service.
  std::vector<provider_id> decide(service_state& slot, provider_id offering,
                                  std::span<const point> path,
                                  provider_id only = 0) {
    auto all = slot.views(providers, offering, now(self));
    if (only != 0)
      std::erase_if(all, [&](const provider_view& x) {
        return x.id != only && !slot.find(x.id);
      });
    const auto knows = [&all](provider_id id) {
      return std::ranges::find(all, id, &provider_view::id) != all.end();
    };
    if (all.empty() || (offering != 0 && !knows(offering)))
      return {};
    const auto& common = slot.kind->common;
    const service_name kind{slot.kind->name()};
    auto decision =
        setup.lodm->decide({now(self),
                            kind.view(),
                            all,
                            path,
                            ego.own.speed_mps,
                            setup.noise.part("decisions"),
                            ++decisions,
                            slot.current(),
                            slot.since,
                            {common.period, common.limits.max_latency,
                             common.limits.max_interarrival},
                            slot.on_board,
                            setup.future.get()});
    if (decision.release) {
      come_home(slot);
      return {};
    }
    if (decision.source == 0 && decision.second != 0)
      decision.source = slot.current();
    std::vector<provider_id> wanted;
    for (const auto id : {decision.source, decision.second})
      if (id != 0 && knows(id) && !std::ranges::count(wanted, id))
        wanted.push_back(id);
    if (wanted.empty()) {
      if (slot.elsewhere.empty() && offering != 0)
        note("stay_local", offering, kind, 0, decision.why);
      return {};
    }
    slot.wanted = wanted;
    set_standby(slot, wanted.size() > 1 ? decision.hedge_after : duration{0});
    std::erase_if(wanted, [&](provider_id id) { return slot.find(id); });
    if (wanted.empty())
      leave_others(slot);
    return wanted;
  }

  // The provider that the policy wants beside the first may only stand by.
  void set_standby(service_state& slot, duration after) {
    std::optional<offloading::standby> chosen;
    if (after > duration{0})
      chosen = {slot.wanted.back(), after};
    if (chosen == slot.standby)
      return;
    slot.standby = chosen;
    const auto told = chosen.value_or(offloading::standby{});
    self->send(slot.manager, told.provider, told.after);
  }

  void request(provider_id id, std::vector<service_name> wanted,
               const std::vector<point>& path) {
    auto& provider = providers.at(id);
    const auto number = ++last_request;
    auto candidates = find(wanted.front().view())
                          ->candidates(providers, ego.own.position, now(self));
    provider.open_request = number;
    for (const auto& kind : wanted) {
      std::erase(provider.offer.kinds, kind);
      auto* slot = find(kind.view());
      slot->elsewhere.push_back({id, phase::requested, {}, {}, {}});
      note("request", id, kind, 0, {});
    }
    self->send(provider.handle,
               service_request{id, setup.station, number, std::move(wanted),
                               path, ego.own.speed_mps, std::move(candidates)},
               requester_actor{self});
    send_after(self, self, protocol::request_timeout, tick_atom_v, id, number);
  }

  void request_timed_out(provider_id id, std::uint32_t number) {
    auto i = providers.find(id);
    if (i == providers.end() || i->second.open_request != number)
      return;
    i->second.open_request.reset();
    refuse_requested(id, "no answer");
  }

  void refuse_requested(provider_id provider, std::string_view why) {
    for (auto& slot : slots)
      if (const auto* at = slot.find(provider);
          at && at->at == phase::requested)
        refused(slot, provider, why);
  }

  // -- response -----------------------------------------------------------

  void take(const service_response& response,
            const std::vector<provider_manager_actor>& managers) {
    auto i = providers.find(response.provider);
    const auto expected =
        i != providers.end() && i->second.open_request == response.number;
    if (expected)
      i->second.open_request.reset();
    auto manager = managers.begin();
    for (const auto& v : response.verdicts) {
      if (v.accepted && (manager == managers.end() || !is_sound(v, response)))
        break; // a broken peer
      auto* slot = find(v.running.kind.view());
      auto* at = slot ? slot->find(response.provider) : nullptr;
      const auto open = expected && at && at->at == phase::requested;
      if (open && v.accepted)
        accepted(*slot, *at, v, *manager);
      else if (open)
        refused(*slot, response.provider, v.why, v.instead);
      else if (v.accepted && !find(v.running)) // not just a duplicate
        tell_provider({v.running, end_reason::no_data, side::requester});
      if (v.accepted)
        ++manager;
    }
    if (expected)
      refuse_requested(response.provider, "not answered");
  }

  // Counter 0 is the local service; nobody else may go by that name.
  bool is_sound(const verdict& v, const service_response& response) const {
    return v.running.provider == response.provider
           && v.running.station == setup.station && v.running.counter != 0;
  }

  void accepted(service_state& slot, requester_session& at, const verdict& v,
                const provider_manager_actor& manager) {
    at.at = phase::starting;
    at.running = v.running;
    at.accepted = now(self);
    decided(slot, at.provider, true, v.running.counter, v.why);
    self->send(slot.manager, v.running, manager);
    send_after(self, self, protocol::start_timeout, tick_atom_v, v.running);
  }

  // @param instead  Whom the provider would have asked; 0: nobody. The vehicle
  // decides about that one anew.
  void refused(service_state& slot, provider_id provider, std::string_view why,
               provider_id instead = 0) {
    decided(slot, provider, false, 0, why);
    setup.lodm->observe(
        refusal_outcome{now(self), slot.kind->name(), provider, why});
    slot.drop(provider);
    const auto other = providers.find(instead);
    if (other == providers.end() || slot.find(instead)
        || !slot.may_ask(other->second, now(self)))
      return;
    const auto path = path_ahead();
    for (const auto id : decide(slot, instead, path, instead))
      request(id, {service_name{slot.kind->name()}}, path);
  }

  void decided(const service_state& slot, provider_id provider, bool yes,
               std::uint32_t counter, std::string_view why) {
    const service_name kind{slot.kind->name()};
    self->send(setup.recorder,
               decision_record{now(self), setup.station, kind, yes});
    note(yes ? "accepted" : "refused", provider, kind, counter, why);
  }

  // -- data ---------------------------------------------------------------

  void take(const service_result& result) {
    const auto at = find(result.running);
    if (!at) {
      complain(result.running);
      return;
    }
    auto& slot = *at.slot;
    const auto t = now(self);
    const auto latency = t - result.created;
    auto& link = slot.link_of(result.running.provider);
    if (slot.is_standby(result.running.provider))
      link.answered(result.created, t);
    else
      link.arrived(result.created, t);
    setup.lodm->observe(cycle_outcome{
        t, result.running.kind.view(), result.running.provider,
        to_seconds(latency), latency > slot.kind->common.limits.max_latency,
        slot.offloaded.energy_j});
    self->send(slot.manager, result);
  }

  // A provider that sends what nobody wants has missed a service_end.
  void complain(const session_id& running) {
    auto i = providers.find(running.provider);
    if (i == providers.end())
      return;
    const auto t = now(self);
    auto& last = i->second.last_complaint;
    if (last && t - *last < protocol::unknown_result_period)
      return;
    last = t;
    tell_provider({running, end_reason::no_data, side::requester});
  }

  void first_data(const session_id& running) {
    const auto at = find(running);
    if (!at || at.at->at != phase::starting)
      return;
    auto& [slot, there] = at;
    if (!slot->is_remote())
      slot->since = now(self);
    there->joined = std::ranges::any_of(slot->elsewhere, [&](const auto& x) {
      return x.at == phase::remote && slot->wants(x.provider);
    });
    there->at = phase::remote;
    there->first_data = now(self);
    charge_self();
    if (there->joined)
      note("joined", running.provider, running.kind, running.counter, {});
    else
      note_remote(running);
    leave_others(*slot);
  }

  void note_remote(const session_id& running) {
    note("switch", running.provider, running.kind, running.counter, "remote");
  }

  // Ends a service where it runs, at those providers of whom that is true.
  // @returns at whom.
  template <class Predicate>
  std::vector<provider_id> leave(service_state& slot, end_reason reason,
                                 Predicate is_meant) {
    std::vector<provider_id> left;
    for (const auto& at : slot.elsewhere)
      if (at.at == phase::remote && is_meant(at.provider))
        left.push_back(at.provider);
    for (const auto id : left)
      end(slot, id, reason, true);
    return left;
  }

  void leave_others(service_state& slot) {
    const auto left =
        leave(slot, end_reason::handed_over,
              [&slot](provider_id provider) { return !slot.wants(provider); });
    if (!left.empty())
      slot.since = now(self);
  }

  void come_home(service_state& slot) {
    leave(slot, end_reason::released, [](provider_id) { return true; });
  }

  void start_timed_out(const session_id& running) {
    const auto at = find(running);
    if (at && at.at->at == phase::starting)
      end(*at.slot, running.provider, end_reason::no_data, true);
  }

  // -- the end of an offloading -------------------------------------------

  void take(const qos_violation& violation) {
    const auto& running = violation.running;
    const auto reason = reason_of(violation.breach);
    if (violation.breach == qos_breach::implausible) {
      // Also if it has ended the service in the same instant.
      note("implausible", running.provider, running.kind, running.counter,
           violation.why);
      distrust_it(running.provider);
    }
    const auto at = find(running);
    if (!at)
      return;
    if (violation.breach != qos_breach::implausible) {
      note("violation", running.provider, running.kind, running.counter,
           name_of(reason));
    }
    if (violation.breach != qos_breach::latency)
      setup.lodm->observe(cycle_outcome{now(self), running.kind.view(),
                                        running.provider,
                                        std::numeric_limits<double>::infinity(),
                                        true, at.slot->offloaded.energy_j});
    if (!violation.others_hold && at.at->at == phase::remote)
      leave_beside(*at.slot, running.provider);
    end(*at.slot, running.provider, reason, true);
  }

  static end_reason reason_of(qos_breach breach) {
    switch (breach) {
      case qos_breach::latency:
        return end_reason::qos_latency;
      case qos_breach::gap:
        return end_reason::qos_gap;
      case qos_breach::implausible:
        break;
    }
    return end_reason::implausible;
  }

  // For all services: they come from one computer, under one key.
  void distrust_it(provider_id provider) {
    const auto liar = providers.find(provider);
    if (liar == providers.end())
      return;
    for (auto& [id, known] : providers)
      if (known.handle == liar->second.handle)
        known.doubted.add(now(self));
  }

  // Nothing usable has come from the others either; but it is one violation.
  void leave_beside(service_state& slot, provider_id violator) {
    const auto left =
        leave(slot, end_reason::released, [violator](provider_id provider) {
          return provider != violator;
        });
    for (const auto id : left)
      slot.cool_until[id] = now(self) + protocol::cool_down;
  }

  void take(const service_end& e) {
    if (const auto at = find(e.running); at && e.from == side::provider)
      end(*at.slot, e.running.provider, e.reason, false);
  }

  void lost(const caf::actor_addr& who) {
    if (setup.vehicle.address() == who) {
      shut_down();
      self->quit(caf::exit_reason::user_shutdown);
      return;
    }
    for (auto i = providers.begin(); i != providers.end();) {
      if (i->second.handle.address() != who) {
        ++i;
        continue;
      }
      const auto id = i->first;
      i = providers.erase(i);
      note("peer_lost", id, {}, 0, {});
      for (auto& slot : slots) {
        const auto* at = slot.find(id);
        if (at && at->at == phase::requested)
          refused(slot, id, "peer lost");
        else if (at)
          end(slot, id, end_reason::peer_lost, false);
        slot.links.erase(id);
      }
    }
  }

  // Closes a running service, once. The manager activates the local service,
  // unless another provider runs it too, in the turn after this one, at the
  // same time.
  void end(service_state& slot, provider_id provider, end_reason reason,
           bool tell) {
    const auto at = *slot.find(provider);
    slot.drop(provider);
    service_end e{at.running, reason, side::requester};
    self->send(slot.manager, e);
    const auto t = now(self);
    if (tell) {
      e.what =
          slot.kind->termination_message(setup_of(*slot.kind), e, t, &ego.own);
      note_on_air(self, setup.recorder, e.what);
      tell_provider(e);
    }
    const auto was_remote = at.at == phase::remote;
    const auto failed = was_remote && is_fallback(reason);
    const auto comes_home = was_remote && !slot.is_remote();
    self->send(setup.recorder,
               episode_record{at.running, side::requester, at.accepted,
                              was_remote ? at.first_data : at.accepted,
                              was_remote, t, reason, failed && comes_home});
    if (comes_home) {
      slot.since = t;
      note("switch", provider, at.running.kind, at.running.counter, "local");
    } else if (was_remote) {
      note("left", provider, at.running.kind, at.running.counter,
           name_of(reason));
      auto& other = *slot.find(slot.current());
      if (!at.joined && std::exchange(other.joined, false))
        note_remote(other.running);
    }
    if (was_remote)
      setup.lodm->observe(episode_outcome{slot.kind->name(), provider,
                                          to_seconds(t - at.first_data),
                                          name_of(reason), setup.station});
    std::erase_if(slot.cool_until,
                  [t](const auto& other) { return other.second <= t; });
    if (failed)
      slot.cool_until[provider] = t + protocol::cool_down;
    if (was_remote)
      charge_self();
  }

  void tell_provider(const service_end& e) {
    if (auto i = providers.find(e.running.provider); i != providers.end())
      self->send(i->second.handle, e);
  }

  void shut_down() {
    for (auto& slot : slots) {
      const auto all = slot.elsewhere;
      for (const auto& at : all)
        if (at.at != phase::requested)
          end(slot, at.provider, end_reason::shutdown, true);
    }
  }

  void note(std::string what, provider_id provider, service_name kind,
            std::uint32_t counter, std::string_view detail) {
    self->send(setup.recorder,
               event_record{now(self), std::move(what), setup.station, provider,
                            kind, counter, std::string{detail}});
  }
};

requester_impl::behavior_type
requester(requester_impl::stateful_pointer<requester_state> self,
          requester_setup setup) {
  auto& state = self->state;
  state.self = self;
  state.setup = std::move(setup);
  state.start();
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.lost(down.source); });
  self->set_exit_handler([self](const caf::exit_msg& exit) {
    self->state.shut_down();
    self->quit(exit.reason);
  });
  return {
      [self](const service_result& result) { self->state.take(result); },
      [self](const service_offer& offer) {
        const auto from =
            caf::actor_cast<provider_actor>(self->current_sender());
        if (from)
          self->state.take(offer, from);
      },
      [self](const service_response& response,
             const std::vector<provider_manager_actor>& managers) {
        self->state.take(response, managers);
      },
      [self](const service_end& e) { self->state.take(e); },
      [self](const ego_state& ego) { self->state.ego = ego; },
      [self](const session_id& running) { self->state.first_data(running); },
      [self](const qos_violation& violation) { self->state.take(violation); },
      [self](tick_atom, provider_id provider, std::uint32_t number) {
        self->state.request_timed_out(provider, number);
      },
      [self](tick_atom, const session_id& running) {
        self->state.start_timed_out(running);
      },
      [self](tick_atom) { self->state.take_epoch(); },
  };
}

} // namespace

onboard_requester_actor spawn_service_requester(caf::actor_system& sys,
                                                requester_setup setup) {
  return sys.spawn(requester, std::move(setup));
}

} // namespace sofof
