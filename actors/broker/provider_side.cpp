// An actor for each process of vehicles, which sends letters.
#include "actors/broker/provider_side.hpp"

#include "base/protocol.hpp"

#include <caf/exit_reason.hpp>
#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

namespace sofof::actors {

namespace {

/// So many processes may have introduced themselves or be about to.
constexpr std::size_t most_processes = 1024;

/// Stands for the vehicles of one process. Their hello comes from a letter.
using process_actor = messages::vehicle_endpoint_actor::extend<
    messages::reacts_to<messages::peer_hello>>;

/// A process of vehicles, known by its link.
struct vehicle_process {
  process_actor stands_for_it;
  messages::provider_endpoint_actor endpoint; ///< Null before it is let in.
  station_id speaker = 0;                     ///< Whose station it knocked as.
  std::set<station_id> stations;              ///< It was let in with these.

  /// @returns whether a letter in its name may be for this station.
  bool is_of(station_id x) const {
    return x == speaker || stations.contains(x);
  }
};

} // namespace

struct provider_side::shared {
  shared(caf::actor_system& s, provider_side_setup with)
      : sys{s}, setup{std::move(with)} {}

  caf::actor_system& sys;
  const provider_side_setup setup;
  std::mutex mutex;                                  // of the following
  std::map<std::int64_t, vehicle_process> processes; // by link
  std::map<station_id, std::int64_t> links;

  std::optional<vehicle_process> find(std::int64_t link) {
    const std::lock_guard lock{mutex};
    const auto at = processes.find(link);
    return at == processes.end() ? std::nullopt : std::optional{at->second};
  }

  std::optional<vehicle_process> find(station_id station) {
    const std::lock_guard lock{mutex};
    const auto at = links.find(station);
    return at == links.end() ? std::nullopt
                             : std::optional{processes.at(at->second)};
  }

  void let_in(std::int64_t link, const messages::peer_hello& hello,
              const messages::provider_endpoint_actor& endpoint) {
    const std::lock_guard lock{mutex};
    auto& process = processes.at(link);
    process.endpoint = endpoint;
    process.stations = {hello.stations.begin(), hello.stations.end()};
    for (const auto station : hello.stations)
      links.insert_or_assign(station, link);
  }

  void forget(std::int64_t link) {
    const std::lock_guard lock{mutex};
    std::erase_if(links, [=](const auto& x) { return x.second == link; });
    processes.erase(link);
  }
};

namespace {

struct process_state {
  static inline const char* name = "process_of_vehicles";

  process_actor::stateful_pointer<process_state> self = nullptr;
  std::shared_ptr<provider_side::shared> shared;
  std::int64_t link = 0;
  station_id speaker = 0;
  messages::handshake_actor handshake;
  messages::provider_endpoint_actor endpoint;

  ~process_state() {
    if (!shared)
      return;
    if (endpoint)
      send(speaker, wire::goodbye{});
    shared->forget(link);
  }

  void send(station_id to, wire::content what) const {
    shared->setup.send({.user = shared->setup.user,
                        .from = shared->setup.station,
                        .to = to,
                        .link = link,
                        .what = std::move(what)});
  }

  void refuse(const caf::error& error) {
    send(speaker, wire::refusal{sentence_of(error),
                                error == caf::sec::invalid_argument});
    self->quit();
  }

  static std::string sentence_of(const caf::error& error) {
    if (const auto& words = error.context();
        words.match_elements<std::string>())
      return words.get_as<std::string>(0);
    return to_string(error);
  }

  void knock(std::uint32_t protocol, std::uint64_t types) {
    self->request(shared->setup.acceptor, protocol::handshake_timeout, protocol,
                  types)
        .then(
            [this](std::uint32_t ours, std::uint64_t our_types,
                   const std::string& nonce, const caf::strong_actor_ptr& in) {
              send(speaker, wire::invitation{ours, our_types, nonce});
              handshake = caf::actor_cast<messages::handshake_actor>(in);
              if (handshake)
                self->monitor(handshake);
              else
                self->quit();
            },
            [this](const caf::error& error) { refuse(error); });
  }

  void on_hello(const messages::peer_hello& hello) {
    if (!handshake || endpoint)
      return;
    self->demonitor(handshake);
    self->request(handshake, protocol::handshake_timeout, hello,
                  messages::vehicle_endpoint_actor{self})
        .then(
            [this, hello](const messages::peer_welcome& welcome,
                          const messages::provider_endpoint_actor& by) {
              endpoint = by;
              self->monitor(endpoint);
              shared->let_in(link, hello, endpoint);
              send(speaker, welcome);
            },
            [this](const caf::error& error) { refuse(error); });
  }

  void on_result(const messages::service_result& x) {
    send(x.session.station, x);
    self->send(endpoint, messages::stream_of(
                             x.session, messages::stream_id::what::result));
  }
};

process_actor::behavior_type
process_of_vehicles(process_actor::stateful_pointer<process_state> self,
                    std::shared_ptr<provider_side::shared> shared,
                    std::int64_t link, station_id speaker,
                    const wire::knock& knock) {
  auto& s = self->state;
  s.self = self;
  s.shared = std::move(shared);
  s.link = link;
  s.speaker = speaker;
  self->set_down_handler([self](const caf::down_msg&) { self->quit(); });
  s.knock(knock.protocol, knock.types);
  return {
      [self](station_id::rep to, const messages::service_offer& x) {
        self->state.send(to, wire::offer{x});
      },
      [self](const messages::service_response& x) {
        self->state.send(x.station, x);
      },
      [self](const messages::session_digest& x) {
        self->state.send(x.station, x);
      },
      [self](const messages::service_result& x) { self->state.on_result(x); },
      [self](const messages::service_end& x) {
        self->state.send(x.session.station, x);
      },
      [self](const messages::ping& x) {
        self->state.send(self->state.speaker, x);
      },
      [self](const messages::pong& x) {
        self->state.send(self->state.speaker, x);
      },
      [](const messages::stream_id&) {}, // the vehicles' side does so itself
      [self](const messages::peer_hello& x) { self->state.on_hello(x); },
  };
}

/// Tells an endpoint, or who stands for its process, what that has sent.
class delivery_to_provider {
public:
  delivery_to_provider(const process_actor& process,
                       const messages::provider_endpoint_actor& endpoint)
      : process_{process}, endpoint_{endpoint} {}

  void operator()(const messages::peer_hello& x) const {
    caf::anon_send(process_, x);
  }
  void operator()(const wire::goodbye&) const {
    caf::anon_send_exit(process_, caf::exit_reason::remote_link_unreachable);
  }
  void operator()(const wire::broadcast& x) const {
    if (const auto station = x.message.station())
      tell(station->value(), x.message);
  }
  void operator()(const messages::ping& x) const { tell(x); }
  void operator()(const messages::pong& x) const { tell(x); }
  void operator()(const messages::service_request& x) const { tell(x); }
  void operator()(const messages::service_input& x) const { tell(x); }
  void operator()(const messages::service_end& x) const {
    if (x.from == messages::side::requester)
      tell(x);
  }
  template <class T>
  void operator()(const T&) const {} // no process of vehicles says so

private:
  template <class... Ts>
  void tell(const Ts&... xs) const {
    if (endpoint_)
      caf::send_as(process_, endpoint_, xs...);
  }

  const process_actor& process_;
  const messages::provider_endpoint_actor& endpoint_;
};

} // namespace

provider_side::provider_side(caf::actor_system& sys, provider_side_setup setup)
    : shared_{std::make_shared<shared>(sys, std::move(setup))} {}

void provider_side::on_letter(const wire::letter& x) const {
  if (const auto* knock = std::get_if<wire::knock>(&x.what)) {
    if (knock->provider != shared_->setup.name || is_provider_station(x.from))
      return;
    const std::lock_guard lock{shared_->mutex};
    if (shared_->processes.size() >= most_processes
        || shared_->processes.contains(x.link))
      return;
    auto& process = shared_->processes[x.link];
    process.speaker = x.from;
    process.stands_for_it = shared_->sys.spawn(process_of_vehicles, shared_,
                                               x.link, x.from, *knock);
    return;
  }
  const auto* told = std::get_if<wire::broadcast>(&x.what);
  const auto process = told ? shared_->find(x.from) : shared_->find(x.link);
  if (!process) {
    if (told)
      shared_->setup.on_foreign(told->message);
    return;
  }
  if (process->is_of(x.from))
    std::visit(delivery_to_provider{process->stands_for_it, process->endpoint},
               x.what);
}

void provider_side::lose() const {
  const std::lock_guard lock{shared_->mutex};
  for (const auto& [link, process] : shared_->processes)
    caf::anon_send_exit(process.stands_for_it,
                        caf::exit_reason::remote_link_unreachable);
}

} // namespace sofof::actors
