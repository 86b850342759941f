// Counts, and tells what was counted.
#include "recording/live_figures.hpp"

#include "messages/etsi/cam.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/etsi/uper.hpp"

#include <algorithm>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>
#include <variant>

namespace sofof::recording {

namespace {

using kind = exposition::kind;

constexpr std::string_view messages_on_air[]{"cam", "cpm", "mcm_up",
                                             "mcm_down"};

/// @returns what comes before the first number of a reason: "no room" of "no
/// room value=0.84 limit=0.8", "latency" of "latency value_ms=61.2".
std::string_view words_of(std::string_view reason) {
  const auto number = reason.find('=');
  if (number == reason.npos)
    return reason;
  const auto space = reason.rfind(' ', number);
  return space == reason.npos ? std::string_view{} : reason.substr(0, space);
}

double seconds_of(const timeval& x) {
  constexpr double per_us = 1e-6;
  return static_cast<double>(x.tv_sec)
         + per_us * static_cast<double>(x.tv_usec);
}

/// What every process tells by these names, wherever it runs.
void write_process(exposition& to) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  to.family("process_cpu_seconds", kind::counter,
            "Computing time of this process, user and system.", "seconds");
  to.sample({}, seconds_of(used.ru_utime) + seconds_of(used.ru_stime));
  std::ifstream pages{"/proc/self/statm"};
  double all = 0, resident = 0;
  if (pages >> all >> resident) {
    to.family("process_resident_memory_bytes", kind::gauge,
              "Resident memory of this process.", "bytes");
    to.sample({}, resident * static_cast<double>(sysconf(_SC_PAGESIZE)));
  }
}

} // namespace

void live_histogram::add(duration x) {
  const auto s = to_seconds(x);
  const auto at = std::ranges::lower_bound(limits, s) - limits.begin();
  ++counts_[static_cast<std::size_t>(at)];
  sum_s_ += s;
}

void live_histogram::write(exposition& to, const exposition::labels& of) const {
  std::array<std::uint64_t, limits.size() + 1> counts{};
  std::ranges::transform(counts_, counts.begin(),
                         [](const auto& x) { return x.load(); });
  to.histogram(of, limits, counts, sum_s_);
}

void live_counters::add(std::string_view name) {
  ++at(name.empty() ? "other" : name).count;
}

void live_counters::expect(std::string_view name) {
  at(name);
}

live_counters::named& live_counters::at(std::string_view name) {
  const auto size = size_.load(std::memory_order_relaxed);
  for (std::size_t i = 0; i < size; ++i)
    if (all_[i].name == name)
      return all_[i];
  if (size == most)
    return all_.back(); // that of all others
  all_[size].name = size + 1 == most ? "other" : name;
  size_.store(size + 1, std::memory_order_release);
  return all_[size];
}

live_figures::live_figures(const run_info& run, std::string role, more also)
    : version_{run.version}, role_{std::move(role)}, is_provider_{role_
                                                                  == "provide"},
      also_{std::move(also)}, vehicles_{
                                  static_cast<std::int64_t>(run.vehicles)} {
  for (const auto& name : run.services) {
    auto& service = services_.emplace_back(name);
    for (std::size_t k = 0; k < end_reason_count; ++k)
      service.ended.expect(
          messages::name_of(static_cast<messages::end_reason>(k)));
  }
}

void live_figures::on_record(const messages::record& x) {
  std::visit([this](const auto& of_a_kind) { add(of_a_kind); }, x);
}

live_figures::service_figures*
live_figures::find(const messages::service_name& name) {
  const auto found =
      std::ranges::find(services_, name.view(), &service_figures::name);
  return found == services_.end() ? nullptr : &*found;
}

void live_figures::add(const messages::event_record& x) {
  using messages::event_type;
  const auto of_process = x.station == station_id{0};
  auto* service = find(x.service);
  const auto name = service ? std::string_view{service->name} : "";
  const auto who = user{name, x.station};
  switch (x.what) {
    case event_type::offer:
      ++offers_;
      break;
    case event_type::switched:
      if (x.remote)
        remote_.insert(who);
      else
        remote_.erase(who);
      if (service)
        service->running = std::ranges::count(remote_, who.first, &user::first);
      break;
    case event_type::result_refused:
      if (const auto why = words_of(x.detail);
          why == "latency" || why == "input_age")
        late_.insert(who);
      break;
    case event_type::clock_in_doubt:
      in_doubt_.insert(who);
      break;
    case event_type::clock_known:
      in_doubt_.erase(who);
      break;
    case event_type::violation:
      if (service)
        service->violations.add(words_of(x.detail));
      break;
    case event_type::implausible:
      if (service)
        service->implausible.add(x.check);
      break;
    case event_type::peer_connected:
      ++peers_;
      break;
    case event_type::peer_lost:
      peers_ -= of_process;
      break;
    case event_type::peer_refused:
      ++refused_peers_;
      break;
    case event_type::provider_connected:
      ++providers_;
      break;
    case event_type::provider_lost:
      --providers_;
      break;
    case event_type::near_miss:
      ++near_misses_;
      break;
    default:
      break;
  }
}

void live_figures::add(const messages::decision_record& x) {
  if (auto* service = find(x.service))
    ++(x.accepted ? service->accepted : service->rejected);
}

void live_figures::add(const messages::verdict_record& x) {
  auto* service = find(x.session.service);
  if (!service)
    return;
  if (!x.accepted)
    service->verdicts.add(words_of(x.why));
  if (!is_provider_) // which its vehicles tell of, too
    return;
  ++(x.accepted ? service->accepted : service->rejected);
  service->running += x.accepted;
}

void live_figures::add(const messages::cycle_record& x) {
  auto* service = find(x.session.service);
  if (!service)
    return;
  const auto who = user{service->name, x.session.station};
  const auto was_late = late_.erase(who) > 0;
  if (x.used) {
    ++service->used;
    in_doubt_.erase(who); // another source's clock was
  } else if (was_late)
    ++service->late;
  else if (in_doubt_.contains(who))
    ++service->unknown;
  else
    ++service->other;
  service->latency.add(x.received - x.created);
  service->input_age.add(x.received - x.timing.input_at);
  service->wait.add(x.timing.queue);
  if (x.interarrival)
    service->gap.add(*x.interarrival);
}

void live_figures::add(const messages::episode_record& x) {
  auto* service = find(x.session.service);
  const auto is_own = (x.of == messages::side::provider) == is_provider_;
  if (!service || !is_own)
    return;
  service->ended.add(messages::name_of(x.reason));
  service->fallbacks += x.fallback;
  service->running -= is_provider_;
  in_doubt_.erase({service->name, x.session.station});
}

void live_figures::add(const messages::safety_record& x) {
  driven_s_ += to_seconds(x.driven);
  without_plan_s_ += to_seconds(x.without_fresh_plan);
  off_road_s_ += to_seconds(x.off_road);
}

void live_figures::add(const messages::air_record& x) {
  const auto octets = x.message.view();
  messages::etsi::bit_reader in{octets};
  messages::etsi::pdu_header header;
  messages::etsi::read(in, header);
  const auto is_mcm = header.message_id == messages::etsi::mcm::message_id;
  const auto is_cam = header.message_id == messages::etsi::cam::message_id;
  const auto is_down = is_provider_station(header.station.value);
  auto& of = air_[is_cam ? 0 : is_mcm ? 2 + is_down : 1];
  ++of.messages;
  of.octets += octets.size();
}

void live_figures::write_services(exposition& to) const {
  const auto each = [&](const char* name, kind what, const char* help,
                        const auto& tell, const char* unit = "") {
    to.family(name, what, help, unit);
    for (const auto& x : services_)
      tell(x, std::pair<std::string_view, std::string_view>{"service", x.name});
  };
  using service = service_figures;
  each("sofof_sessions", kind::gauge, "Offloadings that run.",
       [&](const service& x, const auto& label) {
         to.sample({label}, static_cast<double>(x.running));
       });
  each("sofof_requests", kind::counter, "Services asked for, by the answer.",
       [&](const service& x, const auto& label) {
         to.sample({label, {"verdict", "accepted"}}, x.accepted.load());
         to.sample({label, {"verdict", "rejected"}}, x.rejected.load());
       });
  const auto by_name = [&](const char* name, const char* help,
                           const char* label_name, const auto& counters) {
    each(name, kind::counter, help, [&](const service& x, const auto& label) {
      (x.*counters).each([&](std::string_view why, std::uint64_t count) {
        to.sample({label, {label_name, why}}, count);
      });
    });
  };
  by_name("sofof_requests_rejected", "Refusals of this provider, by reason.",
          "reason", &service::verdicts);
  by_name("sofof_episodes_ended", "Offloadings that ended, by reason.",
          "reason", &service::ended);
  if (is_provider_)
    return;
  by_name("sofof_violations",
          "Times that the QoS watchdog ended one, by limit.", "reason",
          &service::violations);
  by_name("sofof_implausible_results",
          "Results that no vehicle should follow, by the check they failed.",
          "check", &service::implausible);
  each("sofof_fallbacks", kind::counter,
       "Times that the own function had to jump in.",
       [&](const service& x, const auto& label) {
         to.sample({label}, x.fallbacks.load());
       });
  each("sofof_results", kind::counter, "Results of providers, by their use.",
       [&](const service& x, const auto& label) {
         to.sample({label, {"outcome", "used"}}, x.used.load());
         to.sample({label, {"outcome", "late"}}, x.late.load());
         to.sample({label, {"outcome", "unknown"}}, x.unknown.load());
         to.sample({label, {"outcome", "other"}}, x.other.load());
       });
  const auto histogram = [&](const char* name, const char* help,
                             const auto& of) {
    each(
        name, kind::histogram, help,
        [&](const service& x, const auto& label) {
          (x.*of).write(to, {label});
        },
        "seconds");
  };
  histogram("sofof_result_latency_seconds",
            "From when a result was sent to when it came.", &service::latency);
  histogram("sofof_result_gap_seconds", "Between two results of an offloading.",
            &service::gap);
  histogram("sofof_input_age_seconds",
            "From when a result's input was made to when the result came.",
            &service::input_age);
  histogram("sofof_result_wait_seconds",
            "For which a result waited for a worker of its provider.",
            &service::wait);
}

void live_figures::write_driving(exposition& to) const {
  const auto gauge = [&](const char* name, const char* help, const auto& x) {
    to.family(name, kind::gauge, help);
    to.sample({}, static_cast<double>(x.load()));
  };
  const auto seconds = [&](const char* name, const char* help, const auto& x) {
    to.family(name, kind::counter, help, "seconds");
    to.sample({}, x.load());
  };
  const auto counter = [&](const char* name, const char* help, const auto& x) {
    to.family(name, kind::counter, help);
    to.sample({}, x.load());
  };
  if (is_provider_) {
    gauge("sofof_peers", "Connections from vehicles.", peers_);
    counter("sofof_peers_refused", "Times that a peer was not let in.",
            refused_peers_);
    return;
  }
  gauge("sofof_vehicles", "Vehicles that are driven here.", vehicles_);
  if (role_ == "drive")
    gauge("sofof_providers_connected", "Providers that can be reached.",
          providers_);
  counter("sofof_offers", "Offers that vehicles have received.", offers_);
  seconds("sofof_driven_seconds", "By all vehicles together.", driven_s_);
  seconds("sofof_without_fresh_plan_seconds",
          "For which a vehicle had no plan that is fresh: never.",
          without_plan_s_);
  seconds("sofof_off_road_seconds", "For which a vehicle was off its lane.",
          off_road_s_);
  counter("sofof_collisions", "Times that two bodies touched.", collisions_);
  counter("sofof_near_misses", "Times that two vehicles came near.",
          near_misses_);
}

void live_figures::write_air(exposition& to) const {
  const auto each = [&](const auto& member) {
    for (std::size_t i = 0; i < air_.size(); ++i)
      to.sample({{"type", messages_on_air[i]}}, (air_[i].*member).load());
  };
  to.family("sofof_messages_sent", kind::counter,
            "ITS messages that were sent from here.");
  each(&air_figures::messages);
  to.family("sofof_message_sent_bytes", kind::counter,
            "What these have taken, without lower layers.", "bytes");
  each(&air_figures::octets);
}

std::string live_figures::text(exposition_format format) const {
  exposition all{format};
  all.family("sofof_build_info", kind::gauge, "What runs here.");
  all.sample({{"version", version_}, {"role", role_}}, std::uint64_t{1});
  write_services(all);
  write_driving(all);
  write_air(all);
  if (also_)
    also_(all);
  write_process(all);
  return all.finish();
}

} // namespace sofof::recording
