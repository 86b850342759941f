// SP: the edge server's side of offloading.
#include "actors/offloading/service_provider.hpp"

#include "actors/offloading/service_manager.hpp"
#include "actors/runtime/on_air.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"
#include "base/random_phase.hpp"
#include "messages/v2x/decode_broadcast.hpp"
#include "network/flow/token_bucket.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace sofof {

namespace {

using provider_impl = roadside_provider_actor::extend<
    // Has the station fallen silent, whose record has this number?
    reacts_to<tick_atom, station_id, std::uint64_t>,
    // An epoch of the policy is over.
    reacts_to<tick_atom>>;

/// Records of doubted stations.
constexpr double doubts_per_s = 5;
constexpr double doubts_at_once = 50;

// One running service.
struct service_session {
  session_id running;
  provider_manager_actor manager;
  time_point since;
  periodic_task task;
  std::size_t worker = 0;
  std::vector<candidate> candidates; // as the station told
};

// One station in the area, or that was there a moment ago.
struct station_record {
  std::uint64_t number = 0; // so that a timer knows its record
  requester_actor requester;
  cam latest;
  time_point heard; // when the latest CAM came
  time_point next_offer;
  std::uint32_t last_request = 0;
  std::vector<service_session> sessions;
};

// A request that waits for its answer.
struct open_request {
  service_request what;
  requester_actor from;
};

// What the CODM is asked about one request, and what it gets for an answer.
struct question {
  std::vector<central_decision> verdicts; // one for each kind that it names
  std::vector<request_view> asked;
  std::vector<std::size_t> places; // of what is asked, among the kinds
};

struct provider_state {
  static inline const char* name = "service_provider";

  provider_impl::stateful_pointer<provider_state> self;
  provider_setup setup;
  std::shared_ptr<multi_server_queue> workers;
  std::vector<std::shared_ptr<provider_context>> sites; // of each kind, or null
  std::map<station_id, station_record> stations;
  std::uint32_t counter = 0;
  std::uint64_t records = 0;
  std::uint64_t decisions = 0;
  duration epoch{};                  // of the policy; 0: none
  bool in_epoch = false;             // one has begun
  std::vector<open_request> waiting; // for its end
  token_bucket doubts{doubts_per_s, doubts_at_once};

  // -- what is known beyond a vehicle's input -----------------------------

  void make_sites() {
    for (const auto& kind : setup.kinds)
      sites.push_back(kind->make_site(
          setup_of(*kind, 0, setup.seed.part(kind->name()).part("site"))));
  }

  service_setup setup_of(const service_type& kind, station_id station,
                         random_stream noise) const {
    const auto number = find_kind(kind.name());
    return {.world = setup.world,
            .where = setup.where,
            .station = station,
            .remote = true,
            .noise = noise,
            .crossings_granted = setup.crossings_granted,
            .clock = clock_of(self),
            .site = number && *number < sites.size() ? sites[*number] : nullptr,
            .provider = {provider_station(setup.number), setup.position}};
  }

  template <class Function>
  void tell_sites(Function tell) {
    for (const auto& site : sites)
      if (site) {
        tell(*site);
        for (const auto& x : site->news())
          record(x);
      }
  }

  // What is said of stations has a limit, however many are made up.
  void record(const station_doubt& x) {
    if (!doubts.take(now(self)))
      return;
    self->send(
        setup.recorder,
        event_record{x.at, x.begins ? "doubted" : "believed", x.station,
                     setup.boot, service_name{}, 0,
                     x.begins ? fmt::format("{} value={:.3f} limit={:.3f}",
                                            name_of(x.check), x.value, x.limit)
                              : ""});
  }

  // -- CAM, CPM, offer, CAM check -----------------------------------------

  void take(const its_pdu& message, const requester_actor& requester) {
    const auto heard = understand(message, *setup.where, now(self));
    if (const auto* c = std::get_if<cam>(&heard))
      take(*c, message.sender, requester);
    else if (const auto* seen = std::get_if<object_list>(&heard))
      take(*seen, message.sender, requester);
  }

  // Who is alone in its process stands for itself.
  static sender_id sender_of(sender_id told, station_id station) {
    return told == 0 ? station : told;
  }

  void take(const object_list& seen, sender_id sender,
            const requester_actor& requester) {
    tell_sites([&](provider_context& site) {
      site.hear(seen, sender_of(sender, seen.from));
    });
    const auto known = stations.find(seen.from);
    if (known != stations.end() && known->second.requester == requester)
      known->second.heard = now(self); // it lives
  }

  void take(const cam& c, sender_id sender, const requester_actor& requester) {
    tell_sites([&](provider_context& site) {
      site.hear(c, sender_of(sender, c.station));
    });
    const auto known = stations.find(c.station);
    if (known != stations.end() && c.at < known->second.latest.at)
      return; // overtaken on its way
    if (protocol::is_of_future(c.at, now(self)))
      return; // all true ones would seem overtaken
    if (!setup.area.contains(c.position)) {
      if (known != stations.end())
        forget(known, end_reason::left_area);
      return;
    }
    auto [i, is_new] = stations.try_emplace(c.station);
    auto& station = i->second;
    const auto t = now(self);
    if (is_new) {
      station.number = ++records;
      send_after(self, self, protocol::cam_timeout + duration{1}, tick_atom_v,
                 c.station, station.number);
    }
    if (station.requester != requester)
      meet(c.station, station, requester, t);
    station.latest = c;
    station.heard = t;
    if (t >= station.next_offer)
      offer(station, t);
  }

  // A new requester knows nothing of what ran for the one before.
  void meet(station_id id, station_record& station,
            const requester_actor& requester, time_point t) {
    if (station.requester) {
      drop_waiting(id);
      end_all(station, end_reason::peer_lost);
      self->demonitor(station.requester);
    }
    station.requester = requester;
    station.next_offer = t;
    station.last_request = 0;
    self->monitor(requester);
  }

  void offer(station_record& station, time_point t) {
    service_offer offered{setup.boot,
                          setup.position,
                          {},
                          utilisation(),
                          static_cast<std::uint32_t>(setup.profile->workers),
                          from_seconds(setup.profile->mean_service_s()),
                          t};
    for (const auto& kind : setup.kinds)
      if (!find(station, kind->name()))
        offered.kinds.push_back(kind->name());
    if (offered.kinds.empty())
      return;
    station.next_offer = t + protocol::offer_period;
    self->send(station.requester, offered);
  }

  // One timer per record is under way; it moves on with the latest CAM.
  void check(station_id id, std::uint64_t number) {
    auto i = stations.find(id);
    if (i == stations.end() || i->second.number != number)
      return;
    const auto deadline = i->second.heard + protocol::cam_timeout + duration{1};
    if (now(self) >= deadline)
      forget(i, end_reason::cam_timeout);
    else
      send_at(self, self, deadline, tick_atom_v, id, number);
  }

  void forget(std::map<station_id, station_record>::iterator i,
              end_reason reason) {
    end_all(i->second, reason);
    self->demonitor(i->second.requester);
    stations.erase(i);
  }

  void end_all(station_record& station, end_reason reason) {
    while (!station.sessions.empty())
      end(station, station.sessions.front().running, reason, true);
  }

  // -- request and response -----------------------------------------------

  void take(const service_request& request, const requester_actor& requester) {
    auto i = stations.find(request.station);
    if (request.provider != setup.boot || i == stations.end()) {
      refuse(request, requester, "not in the area");
      return;
    }
    auto& station = i->second;
    if (request.number <= station.last_request)
      return; // a duplicate, or overtaken by a newer one
    station.last_request = request.number;
    if (epoch == duration{0}) {
      answer({{request, requester}});
      return;
    }
    drop_waiting(request.station); // it has given that up
    waiting.push_back({request, requester});
    if (!std::exchange(in_epoch, true))
      send_after(self, self, epoch, tick_atom_v);
  }

  void drop_waiting(station_id station) {
    std::erase_if(waiting, [station](const open_request& open) {
      return open.what.station == station;
    });
  }

  void end_epoch() {
    in_epoch = false;
    if (!waiting.empty())
      answer(std::exchange(waiting, {}));
  }

  // Answers the requests of one epoch together.
  void answer(std::vector<open_request> requests) {
    std::vector<question> questions;
    for (const auto& open : requests)
      questions.push_back(question_of(open));
    std::vector<request_view> asked;
    for (const auto& q : questions)
      asked.insert(asked.end(), q.asked.begin(), q.asked.end());
    const auto decided = ask_codm(asked);
    auto next = decided.begin();
    for (auto& q : questions)
      for (const auto place : q.places)
        q.verdicts[place] = next == decided.end()
                                ? central_decision{false, "not decided"}
                                : *next++;
    for (std::size_t k = 0; k < requests.size(); ++k)
      respond(requests[k], questions[k].verdicts);
  }

  void refuse(const service_request& request, const requester_actor& requester,
              std::string_view why) {
    service_response response{setup.boot, request.station, request.number, {}};
    for (const auto& kind : request.kinds)
      response.verdicts.push_back(
          {{setup.boot, request.station, kind, 0}, false, std::string{why}});
    self->send(requester, response, std::vector<provider_manager_actor>{});
  }

  // The CODM is asked about the kinds that are offered, once each.
  question question_of(const open_request& open) {
    const auto& request = open.what;
    question all;
    for (std::size_t k = 0; k < request.kinds.size(); ++k) {
      const auto& kind = request.kinds[k];
      const auto before = std::span{request.kinds}.first(k);
      const auto station = stations.find(request.station);
      if (station == stations.end()) {
        all.verdicts.push_back({false, "not in the area"});
      } else if (!find_kind(kind.view())) {
        all.verdicts.push_back({false, "not offered here"});
      } else if (std::ranges::find(before, kind) != before.end()) {
        all.verdicts.push_back({false, "named twice"});
      } else {
        // Who asks again no longer runs it: its service_end was lost.
        if (const auto* running = find(station->second, kind.view()))
          end(station->second, running->running, end_reason::no_data, true);
        all.verdicts.emplace_back();
        all.places.push_back(k);
        all.asked.push_back({request.station, kind.view(), request.route,
                             request.speed_mps, utilisation_by(kind.view()),
                             task_of(kind.view()), request.candidates});
      }
    }
    return all;
  }

  // @returns one decision for each request; sessions that the CODM wants to be
  // rid of are ended.
  std::vector<central_decision>
  ask_codm(std::span<const request_view> requests) {
    std::vector<session_view> sessions;
    std::vector<session_id> running;
    for (const auto& [id, other] : stations)
      for (const auto& s : other.sessions) {
        const auto kind = s.running.kind.view();
        sessions.push_back({id, kind, s.since, s.task, s.worker,
                            utilisation_by(kind), s.candidates});
        running.push_back(s.running);
      }
    auto decided =
        setup.codm->decide({now(self), requests, sessions, utilisation(),
                            static_cast<std::size_t>(setup.profile->workers),
                            setup.area, setup.world->map, setup.boot,
                            setup.seed.part("decisions"), ++decisions});
    const auto most = requests.size() + running.size();
    for (auto k = requests.size(); k < std::min(decided.size(), most); ++k)
      if (const auto& r = running[k - requests.size()]; !decided[k].accept)
        if (const auto i = stations.find(r.station); i != stations.end())
          end(i->second, r, end_reason::revoked, true);
    if (decided.size() > requests.size())
      decided.resize(requests.size());
    return decided;
  }

  // @returns how a service of this kind computes, without an offset.
  periodic_task task_of(std::string_view kind) const {
    const auto number = find_kind(kind);
    if (!number)
      return {};
    constexpr double deviations = 3;
    const auto& options = setup.kinds[*number]->common;
    const auto longest_s = setup.profile->mean_service_s()
                           + deviations * setup.profile->service_deviation_s();
    return {.wcet = from_seconds(longest_s * options.demand),
            .period = options.period,
            .deadline = options.limits.max_latency};
  }

  // @returns the share of the workers that a service of this kind takes.
  double utilisation_by(std::string_view kind) const {
    const auto number = find_kind(kind);
    if (!number)
      return 0;
    const auto& options = setup.kinds[*number]->common;
    return setup.profile->mean_service_s() * options.demand
           / to_seconds(options.period)
           / static_cast<double>(setup.profile->workers);
  }

  // @returns what all that runs here takes of them.
  double utilisation() const {
    double all = 0;
    for (const auto& [id, station] : stations)
      for (const auto& s : station.sessions)
        all += utilisation_by(s.running.kind.view());
    return all;
  }

  void respond(const open_request& open,
               const std::vector<central_decision>& decisions) {
    const auto& request = open.what;
    service_response response{setup.boot, request.station, request.number, {}};
    std::vector<provider_manager_actor> managers;
    for (std::size_t k = 0; k < request.kinds.size(); ++k) {
      const auto& kind = request.kinds[k];
      verdict v{{setup.boot, request.station, kind, 0},
                decisions[k].accept,
                std::string{decisions[k].why},
                decisions[k].instead};
      const auto station = stations.find(request.station);
      if (v.accepted && station != stations.end()) {
        v.running.counter = ++counter;
        managers.push_back(
            start(station->second, v.running, open, decisions[k]));
      }
      response.verdicts.push_back(std::move(v));
    }
    self->send(open.from, response, managers);
  }

  provider_manager_actor start(station_record& station,
                               const session_id& running,
                               const open_request& open,
                               const central_decision& how) {
    const auto& kind = *setup.kinds[find_kind(running.kind.view()).value()];
    const auto noise = setup.seed.part(kind.name()).part(running.station);
    offloading::cycle_setup remote;
    remote.running = running;
    remote.function =
        kind.make_function(setup_of(kind, running.station, noise));
    remote.period = kind.common.period;
    remote.phase = how.offset.value_or(
        random_phase(noise.part("remote phase"), remote.period));
    remote.keeps_phase = how.offset.has_value();
    auto task = task_of(kind.name());
    task.offset = remote.phase;
    remote.finish = computing_time(kind, running.station);
    auto manager = spawn_provider_manager(
        self->system(), {std::move(remote), open.from, self, setup.recorder});
    self->monitor(manager);
    station.sessions.push_back(
        {running, manager, now(self), task, how.worker, open.what.candidates});
    return manager;
  }

  std::function<time_point(time_point, std::uint64_t)>
  computing_time(const service_type& kind, station_id station) const {
    if (!setup.virtual_time)
      return [](time_point start, std::uint64_t) { return start; };
    const channel draws{setup.profile, setup.seed, station, setup.number};
    return [draws, demand = kind.common.demand,
            queue = workers](time_point start, std::uint64_t cycle) {
      const auto work = to_seconds(draws.service_time(cycle)) * demand;
      return queue->finish(start, from_seconds(work));
    };
  }

  // The number of an offered kind.
  std::optional<std::size_t> find_kind(std::string_view name) const {
    auto i = std::ranges::find(setup.kinds, name,
                               [](const auto& kind) { return kind->name(); });
    if (i == setup.kinds.end())
      return std::nullopt;
    return static_cast<std::size_t>(i - setup.kinds.begin());
  }

  static const service_session* find(const station_record& station,
                                     std::string_view kind) {
    auto i =
        std::ranges::find(station.sessions, kind, [](const service_session& s) {
          return s.running.kind.view();
        });
    return i == station.sessions.end() ? nullptr : &*i;
  }

  // -- the end of a running service ---------------------------------------

  void take(const service_end& e) {
    if (e.from != side::requester)
      return;
    if (auto i = stations.find(e.running.station); i != stations.end())
      end(i->second, e.running, e.reason, false);
  }

  void lost(const caf::down_msg& down) {
    const auto& who = down.source;
    for (auto i = stations.begin(); i != stations.end(); ++i) {
      if (i->second.requester.address() == who) {
        forget(i, end_reason::peer_lost);
        return;
      }
      for (const auto& s : i->second.sessions)
        if (s.manager.address() == who) {
          // A manager that was never fed gives up; any other has died.
          const auto reason = down.reason == caf::exit_reason::user_shutdown
                                  ? end_reason::no_data
                                  : end_reason::peer_lost;
          end(i->second, s.running, reason, true);
          return;
        }
    }
  }

  // Closes a running service, once; unknown ones have been closed before.
  void end(station_record& station, session_id running, end_reason reason,
           bool tell) {
    auto i =
        std::ranges::find(station.sessions, running, &service_session::running);
    if (i == station.sessions.end())
      return;
    service_end e{running, reason, side::provider};
    self->demonitor(i->manager);
    self->send(i->manager, e);
    if (tell) {
      if (const auto kind = find_kind(running.kind.view()))
        e.what = setup.kinds[*kind]->termination_message(
            setup_of(*setup.kinds[*kind], running.station, setup.seed), e,
            now(self), nullptr);
      note_on_air(self, setup.recorder, e.what);
      self->send(station.requester, e);
    }
    self->send(setup.recorder,
               episode_record{running, side::provider, i->since, i->since, true,
                              now(self), reason, false});
    setup.codm->observe(episode_outcome{running.kind.view(), setup.boot,
                                        to_seconds(now(self) - i->since),
                                        name_of(reason), running.station});
    station.sessions.erase(i);
    station.next_offer = now(self) + protocol::offer_period;
  }

  void shut_down() {
    while (!stations.empty())
      forget(stations.begin(), end_reason::shutdown);
  }
};

provider_impl::behavior_type
provider(provider_impl::stateful_pointer<provider_state> self,
         provider_setup setup) {
  auto& state = self->state;
  state.self = self;
  state.setup = std::move(setup);
  state.make_sites();
  state.epoch = from_seconds(state.setup.codm->epoch_s());
  state.workers =
      std::make_shared<multi_server_queue>(state.setup.profile->workers);
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.lost(down); });
  self->set_exit_handler([self](const caf::exit_msg& exit) {
    self->state.shut_down();
    self->quit(exit.reason);
  });
  return {
      [self](const its_pdu& message, const requester_actor& requester) {
        self->state.take(message, requester);
      },
      [self](const service_request& request, const requester_actor& requester) {
        self->state.take(request, requester);
      },
      [self](const service_end& e) { self->state.take(e); },
      [self](const roadside_detections& view) {
        self->state.tell_sites([&](provider_context& site) { site.see(view); });
      },
      [self](tick_atom, station_id station, std::uint64_t number) {
        self->state.check(station, number);
      },
      [self](tick_atom) { self->state.end_epoch(); },
  };
}

} // namespace

roadside_provider_actor spawn_service_provider(caf::actor_system& sys,
                                               provider_setup setup) {
  return sys.spawn(provider, std::move(setup));
}

} // namespace sofof
