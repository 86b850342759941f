// A provider's acceptor, handshake and endpoint in one actor, which sends
// letters.
#include "actors/broker/vehicle_side.hpp"

#include <caf/exit_reason.hpp>
#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <caf/typed_response_promise.hpp>

#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

using way_actor =
    messages::acceptor_actor::extend_with<messages::handshake_actor>::
        extend_with<messages::provider_endpoint_actor>::extend<
            // The provider's answers: an invitation, a welcome and its station,
            // or a refusal.
            messages::reacts_to<std::uint32_t, std::uint64_t, std::string>,
            messages::reacts_to<messages::peer_welcome, station_id::rep>,
            messages::reacts_to<std::string, bool>>;

/// A way that is open.
struct open_way {
  std::string provider;
  caf::weak_actor_ptr way;
  messages::vehicle_endpoint_actor endpoint; ///< Null before the hello.
};

} // namespace

struct vehicle_side::shared {
  shared(caf::actor_system& s, vehicle_side_setup with)
      : sys{s}, setup{std::move(with)} {}

  caf::actor_system& sys;
  const vehicle_side_setup setup;
  std::mutex mutex; // of the following
  std::map<std::int64_t, open_way> ways;
  std::map<std::pair<station_id, std::byte>, std::vector<std::byte>> latest;

  /// Sends a CAM, CPM or MCM that is for everybody, if it is not the one of
  /// this kind that was sent last.
  void tell(station_id from, const messages::its_pdu& message) {
    if (message.octets.size() < 2)
      return;
    {
      const std::lock_guard lock{mutex};
      auto& last = latest[{from, message.octets[1]}];
      if (last == message.octets)
        return;
      last = message.octets;
    }
    setup.send(
        {.user = setup.user, .from = from, .what = wire::broadcast{message}});
  }

  std::optional<open_way> find(std::int64_t link) {
    const std::lock_guard lock{mutex};
    const auto at = ways.find(link);
    return at == ways.end() ? std::nullopt : std::optional{at->second};
  }
};

namespace {

struct way_state {
  static inline const char* name = "way_to_provider";
  using shared_ptr = std::shared_ptr<vehicle_side::shared>;

  way_actor::stateful_pointer<way_state> self = nullptr;
  shared_ptr shared;
  std::int64_t link = 0;
  std::string provider;
  std::optional<station_id> station; // the provider's, once it has answered
  messages::vehicle_endpoint_actor endpoint;
  caf::typed_response_promise<std::uint32_t, std::uint64_t, std::string,
                              caf::strong_actor_ptr>
      invited;
  caf::typed_response_promise<messages::peer_welcome,
                              messages::provider_endpoint_actor>
      welcomed;

  ~way_state() {
    if (!shared)
      return;
    if (endpoint)
      send(wire::goodbye{});
    const std::lock_guard lock{shared->mutex};
    shared->ways.erase(link);
  }

  void send(wire::content what) const {
    shared->setup.send({.user = shared->setup.user,
                        .from = shared->setup.station,
                        .to = station,
                        .link = link,
                        .what = std::move(what)});
  }

  auto on_knock(std::uint32_t protocol, std::uint64_t types) {
    if (const auto& who = self->current_sender())
      self->monitor(who);
    invited = self->make_response_promise<std::uint32_t, std::uint64_t,
                                          std::string, caf::strong_actor_ptr>();
    send(wire::knock{provider, protocol, types});
    return invited;
  }

  void on_invitation(std::uint32_t protocol, std::uint64_t types,
                     const std::string& nonce) {
    if (invited.pending())
      invited.deliver(protocol, types, nonce,
                      nonce.empty()
                          ? caf::strong_actor_ptr{}
                          : caf::actor_cast<caf::strong_actor_ptr>(self));
  }

  auto on_hello(const messages::peer_hello& hello,
                const messages::vehicle_endpoint_actor& from) {
    endpoint = from;
    {
      const std::lock_guard lock{shared->mutex};
      shared->ways[link].endpoint = from;
    }
    welcomed = self->make_response_promise<messages::peer_welcome,
                                           messages::provider_endpoint_actor>();
    send(hello);
    return welcomed;
  }

  void on_welcome(const messages::peer_welcome& welcome, station_id from) {
    station = from;
    if (welcomed.pending())
      welcomed.deliver(welcome, messages::provider_endpoint_actor{self});
  }

  void on_refusal(const std::string& why, bool for_ever) {
    const auto error = caf::make_error(
        for_ever ? caf::sec::invalid_argument : caf::sec::runtime_error, why);
    if (welcomed.pending())
      welcomed.deliver(error);
    else if (invited.pending())
      invited.deliver(error);
  }

  void acknowledge(const messages::stream_id& stream) {
    self->send(endpoint, stream);
  }

  void on_its_message(station_id from, const messages::its_pdu& message) {
    shared->tell(from, message);
    acknowledge(messages::stream_of(from, message));
  }

  void on_input(const messages::service_input& input) {
    send(input);
    acknowledge(
        messages::stream_of(input.session, messages::stream_id::what::input));
  }
};

way_actor::behavior_type way(way_actor::stateful_pointer<way_state> self,
                             std::shared_ptr<vehicle_side::shared> shared,
                             std::int64_t link, std::string provider) {
  auto& s = self->state;
  s.self = self;
  s.shared = std::move(shared);
  s.link = link;
  s.provider = std::move(provider);
  {
    const std::lock_guard lock{s.shared->mutex};
    s.shared->ways.emplace(
        link, open_way{s.provider, caf::weak_actor_ptr{self->ctrl()}, {}});
  }
  self->set_down_handler([self](const caf::down_msg&) { self->quit(); });
  return {
      // Of the vehicles:
      [self](std::uint32_t protocol, std::uint64_t types) {
        return self->state.on_knock(protocol, types);
      },
      [self](const messages::peer_hello& hello,
             const messages::vehicle_endpoint_actor& from) {
        return self->state.on_hello(hello, from);
      },
      [self](station_id::rep from, const messages::its_pdu& message) {
        self->state.on_its_message(from, message);
      },
      [self](const messages::service_request& x) { self->state.send(x); },
      [self](const messages::service_input& x) { self->state.on_input(x); },
      [self](const messages::service_end& x) { self->state.send(x); },
      [self](const messages::ping& x) { self->state.send(x); },
      [self](const messages::pong& x) { self->state.send(x); },
      [](const messages::stream_id&) {}, // the provider's side does so itself
      // Of the provider:
      [self](std::uint32_t protocol, std::uint64_t types,
             const std::string& nonce) {
        self->state.on_invitation(protocol, types, nonce);
      },
      [self](const messages::peer_welcome& welcome, station_id::rep from) {
        self->state.on_welcome(welcome, from);
      },
      [self](const std::string& why, bool for_ever) {
        self->state.on_refusal(why, for_ever);
      },
  };
}

/// Tells an open way or its endpoint what a provider has sent.
class delivery_to_vehicles {
public:
  /// @param way  Lives.
  delivery_to_vehicles(const wire::letter& from, way_actor way,
                       const messages::vehicle_endpoint_actor& endpoint)
      : from_{from}, way_{std::move(way)}, endpoint_{endpoint} {}

  void operator()(const wire::invitation& x) const {
    caf::anon_send(way_, x.protocol, x.types, x.nonce);
  }
  void operator()(const messages::peer_welcome& x) const {
    caf::anon_send(way_, x, from_.from.value());
  }
  void operator()(const wire::refusal& x) const {
    caf::anon_send(way_, x.why, x.for_ever);
  }
  void operator()(const wire::goodbye&) const {
    caf::anon_send_exit(way_, caf::exit_reason::remote_link_unreachable);
  }
  void operator()(const wire::offer& x) const {
    if (from_.to)
      tell(from_.to->value(), x.what);
  }
  void operator()(const messages::ping& x) const { tell(x); }
  void operator()(const messages::pong& x) const { tell(x); }
  void operator()(const messages::service_response& x) const { tell(x); }
  void operator()(const messages::session_digest& x) const { tell(x); }
  void operator()(const messages::service_result& x) const { tell(x); }
  void operator()(const messages::service_end& x) const {
    if (x.from == messages::side::provider)
      tell(x);
  }
  template <class T>
  void operator()(const T&) const {} // no provider says so

private:
  template <class... Ts>
  void tell(const Ts&... xs) const {
    if (endpoint_)
      caf::send_as(way_, endpoint_, xs...);
  }

  const wire::letter& from_;
  way_actor way_;
  const messages::vehicle_endpoint_actor& endpoint_;
};

} // namespace

vehicle_side::vehicle_side(caf::actor_system& sys, vehicle_side_setup setup)
    : shared_{std::make_shared<shared>(sys, std::move(setup))} {}

messages::acceptor_actor
vehicle_side::way_to(const std::string& provider) const {
  return shared_->sys.spawn(way, shared_, shared_->setup.draw_link(), provider);
}

void vehicle_side::tell(station_id from,
                        const messages::its_pdu& message) const {
  shared_->tell(from, message);
}

void vehicle_side::on_letter(const wire::letter& x) const {
  const auto to = shared_->find(x.link);
  const auto& is_sent_by = shared_->setup.is_sent_by;
  if (!to || (is_sent_by && !is_sent_by(x.user, to->provider)))
    return;
  if (const auto way = caf::actor_cast<way_actor>(to->way))
    std::visit(delivery_to_vehicles{x, way, to->endpoint}, x.what);
}

void vehicle_side::lose() const {
  const std::lock_guard lock{shared_->mutex};
  for (const auto& [link, to] : shared_->ways)
    if (const auto way = caf::actor_cast<way_actor>(to.way))
      caf::anon_send_exit(way, caf::exit_reason::remote_link_unreachable);
}

} // namespace sofof::actors
