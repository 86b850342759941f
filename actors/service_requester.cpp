// SR: the vehicle's side of offloading.
#include "actors/service_requester.hpp"

#include "actors/cpu_accounts.hpp"
#include "actors/on_air.hpp"
#include "actors/service_manager.hpp"
#include "actors/time.hpp"
#include "world/protocol.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <map>
#include <optional>

namespace sofof {

namespace {

using requester_impl = onboard_requester_actor::extend<
    // The request with this number has been open for too long.
    takes<tick_atom, boot_id, std::uint32_t>,
    // This running service should have given its first data by now.
    takes<tick_atom, running_service>>;

// A provider that this station has heard of.
struct known_provider {
  provider_actor handle;
  std::optional<std::uint32_t> open_request;
  std::optional<time_point>
      last_complaint;  // about results of unknown running services
  service_offer offer; // the latest, without what was asked for since
  time_point offered_at;
};

enum class phase { local, requested, starting, remote };

// One kind of service in this vehicle.
struct service_slot {
  service_kind_ptr kind;
  requester_manager_actor manager;
  phase at = phase::local;
  boot_id provider = 0;    // asked, or running there
  running_service running; // from acceptance on
  time_point accepted;
  time_point first_data;
  std::map<boot_id, time_point> cool_until;
};

// A return to the local service that nobody planned.
bool is_fallback(end_reason reason) {
  return reason != end_reason::left_area && reason != end_reason::shutdown;
}

struct requester_state {
  static inline const char* name = "service_requester";

  requester_impl::stateful_pointer<requester_state> self;
  requester_setup setup;
  std::vector<service_slot> slots;
  std::map<boot_id, known_provider> providers;
  ego_state ego;
  std::uint32_t last_request = 0;
  std::uint64_t decisions = 0;

  void start() {
    self->monitor(setup.vehicle);
    for (const auto& kind : setup.kinds)
      slots.push_back({kind, spawn_manager(kind), {}, {}, {}, {}, {}, {}});
    charge_self();
  }

  // For whom it works, in case somebody keeps accounts.
  void charge_self() {
    const auto any_remote = std::ranges::any_of(
        slots, [](const auto& slot) { return slot.at == phase::remote; });
    charge(self->system(), self->id(), {setup.station, {}, any_remote});
  }

  // -- services of this vehicle -------------------------------------------

  service_setup setup_of(const service_kind& kind) const {
    return {.world = setup.world,
            .where = setup.where,
            .station = setup.station,
            .noise = setup.noise.part(kind.name()),
            .crossings_granted = setup.crossings_granted,
            .clock = clock_of(self)};
  }

  requester_manager_actor spawn_manager(const service_kind_ptr& shared) {
    const auto& kind = *shared;
    const auto here = setup_of(kind);
    auto client = kind.spawn_client(self->system(), here, setup.vehicle);
    if (client != setup.vehicle)
      self->link_to(client);
    auto manager = spawn_requester_manager(
        self->system(),
        {setup.station, kind.name(), kind.common,
         [shared, here](service_input input, bool takes_over) {
           return shared->on_air(here, std::move(input), takes_over);
         },
         [shared, here](const payload& result, const service_input& latest,
                        time_point now) {
           return shared->off_air(here, result, latest, now);
         },
         local_instance(kind, here), client, self, setup.recorder});
    self->link_to(manager);
    return manager;
  }

  instance_setup local_instance(const service_kind& kind,
                                const service_setup& here) const {
    instance_setup local;
    local.function = kind.make_function(here);
    local.period = kind.common.period;
    local.phase = duration{static_cast<duration::rep>(
        here.noise.part("local phase").uniform(0)
        * static_cast<double>(local.period.count()))};
    local.finish = local_run_time(kind.common, here.noise);
    return local;
  }

  std::function<time_point(time_point, std::uint64_t)>
  local_run_time(const service_options& options, random_stream noise) const {
    if (!setup.virtual_time)
      return [](time_point start, std::uint64_t) { return start; };
    return [options, draws = noise.part("local run time")](
               time_point start, std::uint64_t cycle) {
      const auto drawn =
          from_seconds(draws.normal(to_seconds(options.run_time_mean),
                                    to_seconds(options.run_time_sd), cycle));
      return start + std::clamp(drawn, duration{0}, options.run_time_max);
    };
  }

  service_slot* find(std::string_view kind) {
    auto i = std::ranges::find(
        slots, kind, [](const service_slot& s) { return s.kind->name(); });
    return i == slots.end() ? nullptr : &*i;
  }

  // The slot in which `running` is starting or remote.
  service_slot* find(const running_service& running) {
    auto* slot = find(running.kind.view());
    const auto alive =
        slot && slot->at >= phase::starting && slot->running == running;
    return alive ? slot : nullptr;
  }

  // -- offer and request --------------------------------------------------

  void take(const service_offer& offer, const provider_actor& from) {
    note("offer", offer.provider, {}, 0, {});
    auto& provider = meet(offer.provider, from);
    if (provider.handle != from)
      return; // nobody speaks for another one
    provider.offer = offer;
    provider.offered_at = now(self);
    if (provider.open_request)
      return;
    std::map<boot_id, std::vector<service_name>> wanted;
    const auto path = setup.way->waypoints(ego.s_m, protocol::route_ahead_m,
                                           protocol::route_spacing_m);
    for (const auto& slot : slots)
      if (slot.at == phase::local && offers(provider, slot))
        if (const auto source = choose(slot, offer.provider, path); source != 0)
          wanted[source].push_back(slot.kind->name());
    for (auto& [source, kinds] : wanted)
      request(source, std::move(kinds), path);
  }

  known_provider& meet(boot_id id, const provider_actor& from) {
    if (const auto i = providers.find(id); i != providers.end())
      return i->second;
    // Behind a handle is one provider, which has booted since.
    const auto is_same = [&from](const auto& known) {
      return known.second.handle == from;
    };
    if (std::ranges::none_of(providers, is_same))
      self->monitor(from);
    std::erase_if(providers, [&](const auto& known) {
      return is_same(known) && !is_in_use(known.first);
    });
    return providers.emplace(id, known_provider{from, {}, {}, {}, {}})
        .first->second;
  }

  bool is_in_use(boot_id id) const {
    return std::ranges::any_of(slots, [id](const service_slot& slot) {
      return slot.at != phase::local && slot.provider == id;
    });
  }

  // @returns who shall be asked for a service now that somebody offers it;
  // 0 for nobody.
  boot_id choose(const service_slot& slot, boot_id offering,
                 std::span<const point> path) {
    auto all = offers_for(slot);
    const auto this_one = std::ranges::find(all, offering, &provider_view::id);
    if (this_one == all.end())
      return 0;
    std::rotate(all.begin(), this_one, this_one + 1);
    const service_name kind{slot.kind->name()};
    const auto decision = setup.lodm->decide(
        {now(self), kind.view(), all, path, ego.own.speed_mps,
         setup.noise.part("decisions"), ++decisions});
    if (std::ranges::find(all, decision.source, &provider_view::id)
        != all.end())
      return decision.source;
    note("stay_local", offering, kind, 0, decision.why);
    return 0;
  }

  // @returns who may be asked for this service.
  std::vector<provider_view> offers_for(const service_slot& slot) const {
    const auto t = now(self);
    std::vector<provider_view> all;
    for (const auto& [id, provider] : providers) {
      const auto cool = slot.cool_until.find(id);
      const auto cools = cool != slot.cool_until.end() && t < cool->second;
      const auto is_old = t - provider.offered_at > protocol::offer_validity;
      if (offers(provider, slot) && !is_old && !cools && !provider.open_request)
        all.push_back({id, provider.offer.position,
                       std::max(0.0, provider.offer.utilisation)});
    }
    return all;
  }

  static bool offers(const known_provider& provider, const service_slot& slot) {
    const auto& kinds = provider.offer.kinds;
    return std::ranges::find(kinds, slot.kind->name()) != kinds.end();
  }

  void request(boot_id id, std::vector<service_name> wanted,
               const std::vector<point>& path) {
    auto& provider = providers.at(id);
    const auto number = ++last_request;
    provider.open_request = number;
    for (const auto& kind : wanted) {
      std::erase(provider.offer.kinds, kind);
      auto* slot = find(kind.view());
      slot->at = phase::requested;
      slot->provider = id;
      note("request", id, kind, 0, {});
    }
    self->send(provider.handle,
               service_request{id, setup.station, number, std::move(wanted),
                               path, ego.own.speed_mps},
               requester_actor{self});
    send_after(self, self, protocol::request_timeout, tick_atom_v, id, number);
  }

  void request_timed_out(boot_id id, std::uint32_t number) {
    auto i = providers.find(id);
    if (i == providers.end() || i->second.open_request != number)
      return;
    i->second.open_request.reset();
    for (auto& slot : slots)
      if (slot.at == phase::requested && slot.provider == id)
        refused(slot, "no answer");
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
      const auto open = expected && slot && slot->at == phase::requested
                        && slot->provider == response.provider;
      if (open && v.accepted)
        accepted(*slot, v, *manager);
      else if (open)
        refused(*slot, v.why);
      else if (v.accepted && !find(v.running)) // not just a duplicate
        tell_provider({v.running, end_reason::no_data, side::requester});
      if (v.accepted)
        ++manager;
    }
    if (expected)
      for (auto& slot : slots)
        if (slot.at == phase::requested && slot.provider == response.provider)
          refused(slot, "not answered");
  }

  // Counter 0 is the local service; nobody else may go by that name.
  bool is_sound(const verdict& v, const service_response& response) const {
    return v.running.provider == response.provider
           && v.running.station == setup.station && v.running.counter != 0;
  }

  void accepted(service_slot& slot, const verdict& v,
                const provider_manager_actor& manager) {
    slot.at = phase::starting;
    slot.running = v.running;
    slot.accepted = now(self);
    decided(slot, true, v.why);
    self->send(slot.manager, v.running, manager);
    send_after(self, self, protocol::start_timeout, tick_atom_v, v.running);
  }

  void refused(service_slot& slot, std::string_view why) {
    decided(slot, false, why);
    slot.at = phase::local;
  }

  void decided(const service_slot& slot, bool yes, std::string_view why) {
    const service_name kind{slot.kind->name()};
    self->send(setup.recorder,
               decision_record{now(self), setup.station, kind, yes});
    note(yes ? "accepted" : "refused", slot.provider, kind,
         yes ? slot.running.counter : 0, why);
  }

  // -- data ---------------------------------------------------------------

  void take(const service_result& result) {
    auto* slot = find(result.running);
    if (!slot) {
      complain(result.running);
      return;
    }
    const auto latency = now(self) - result.created;
    setup.lodm->observe(cycle_outcome{
        result.running.kind.view(), result.running.provider,
        to_seconds(latency), latency > slot->kind->common.limits.max_latency});
    self->send(slot->manager, result);
  }

  // A provider that sends what nobody wants has missed a service_end.
  void complain(const running_service& running) {
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

  void first_data(const running_service& running) {
    auto* slot = find(running);
    if (!slot || slot->at != phase::starting)
      return;
    slot->at = phase::remote;
    slot->first_data = now(self);
    charge_self();
    note("switch", running.provider, running.kind, running.counter, "remote");
  }

  void start_timed_out(const running_service& running) {
    auto* slot = find(running);
    if (slot && slot->at == phase::starting)
      end(*slot, end_reason::no_data, true);
  }

  // -- the end of an offloading -------------------------------------------

  void take(const qos_violation& violation) {
    auto* slot = find(violation.running);
    if (!slot)
      return;
    const auto reason = violation.breach == qos_breach::latency
                            ? end_reason::qos_latency
                            : end_reason::qos_gap;
    note("violation", slot->provider, violation.running.kind,
         violation.running.counter, name_of(reason));
    end(*slot, reason, true);
  }

  void take(const service_end& e) {
    if (auto* slot = find(e.running); slot && e.from == side::provider)
      end(*slot, e.reason, false);
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
        if (slot.at == phase::local || slot.provider != id)
          continue;
        if (slot.at == phase::requested)
          refused(slot, "peer lost");
        else
          end(slot, end_reason::peer_lost, false);
      }
    }
  }

  // Closes the slot's running service, once. The manager activates the local
  // service in the turn after this one, at the same time.
  void end(service_slot& slot, end_reason reason, bool tell) {
    service_end e{slot.running, reason, side::requester};
    self->send(slot.manager, e);
    const auto t = now(self);
    if (tell) {
      e.what = slot.kind->farewell(setup_of(*slot.kind), e, t, &ego.own);
      note_on_air(self, setup.recorder, e.what);
      tell_provider(e);
    }
    const auto was_remote = slot.at == phase::remote;
    const auto fallback = was_remote && is_fallback(reason);
    self->send(setup.recorder,
               episode_record{slot.running, side::requester, slot.accepted,
                              was_remote ? slot.first_data : slot.accepted,
                              was_remote, t, reason, fallback});
    if (was_remote) {
      note("switch", slot.provider, slot.running.kind, slot.running.counter,
           "local");
      setup.lodm->observe(episode_outcome{slot.kind->name(), slot.provider,
                                          to_seconds(t - slot.first_data),
                                          name_of(reason)});
    }
    std::erase_if(slot.cool_until,
                  [t](const auto& other) { return other.second <= t; });
    if (fallback)
      slot.cool_until[slot.provider] = t + protocol::cool_down;
    slot.at = phase::local;
    if (was_remote)
      charge_self();
  }

  void tell_provider(const service_end& e) {
    if (auto i = providers.find(e.running.provider); i != providers.end())
      self->send(i->second.handle, e);
  }

  void shut_down() {
    for (auto& slot : slots)
      if (slot.at >= phase::starting)
        end(slot, end_reason::shutdown, true);
  }

  void note(std::string what, boot_id provider, service_name kind,
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
      [self](const running_service& running) {
        self->state.first_data(running);
      },
      [self](const qos_violation& violation) { self->state.take(violation); },
      [self](tick_atom, boot_id provider, std::uint32_t number) {
        self->state.request_timed_out(provider, number);
      },
      [self](tick_atom, const running_service& running) {
        self->state.start_timed_out(running);
      },
  };
}

} // namespace

onboard_requester_actor spawn_service_requester(caf::actor_system& sys,
                                                requester_setup setup) {
  return sys.spawn(requester, std::move(setup));
}

} // namespace sofof
