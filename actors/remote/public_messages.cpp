// The messages that processes may send each other, read from the interfaces of
// the actors that they reach.
#include "actors/remote/public_messages.hpp"

#include "messages/type_ids.hpp"

#include <caf/error.hpp>
#include <caf/exit_reason.hpp>
#include <caf/sec.hpp>
#include <caf/type_id.hpp>

#include <algorithm>
#include <type_traits>

namespace sofof::actors {

namespace {

/// Octets of a payload; several times the largest CPM, input or result.
constexpr std::size_t longest_plain_message = 64 * 1024;
/// A certificate, most_claims stations, and a proof.
constexpr std::size_t longest_hello = 128 * 1024;
/// 1000 waypoints, 64 kinds of service and 64 candidates.
constexpr std::size_t longest_request = 24 * 1024;
constexpr std::size_t longest_ping = 64;

template <class... Ts>
message_form form_of() {
  constexpr auto has = []<class T>(std::type_identity<T>) {
    return (std::is_same_v<T, Ts> || ...);
  };
  auto longest = longest_plain_message;
  if (has(std::type_identity<messages::peer_hello>{}))
    longest = longest_hello;
  if (has(std::type_identity<messages::service_request>{}))
    longest = longest_request;
  if (has(std::type_identity<messages::ping>{})
      || has(std::type_identity<messages::pong>{})
      || has(std::type_identity<messages::stream_id>{}))
    longest = longest_ping;
  return {{caf::type_id_v<Ts>...}, longest};
}

/// Adds what one message of an interface is, and what answers it.
template <class Signature>
struct signature;

template <class... Answers, class... Ts>
struct signature<caf::result<Answers...>(Ts...)> {
  static constexpr bool is_request =
      !std::is_same_v<caf::result<Answers...>, caf::result<void>>;

  static void add_message(message_forms& to) {
    (is_request ? to.asked : to.told).push_back(form_of<Ts...>());
  }
  static void add_answer(message_forms& to) {
    if constexpr (is_request)
      to.answered.push_back(form_of<Answers...>());
  }
};

template <class... Signatures>
void add_messages(message_forms& to, caf::detail::type_list<Signatures...>) {
  (signature<Signatures>::add_message(to), ...);
}

template <class... Signatures>
void add_answers(message_forms& to, caf::detail::type_list<Signatures...>) {
  (signature<Signatures>::add_answer(to), ...);
}

} // namespace

const message_forms& messages_to_provider() {
  static const auto forms = [] {
    message_forms all;
    add_messages(all, messages::acceptor_actor::signatures{});
    add_messages(all, messages::handshake_actor::signatures{});
    add_messages(all, messages::provider_endpoint_actor::signatures{});
    return all;
  }();
  return forms;
}

const message_forms& messages_to_vehicles() {
  static const auto forms = [] {
    message_forms all;
    add_answers(all, messages::acceptor_actor::signatures{});
    add_answers(all, messages::handshake_actor::signatures{});
    add_messages(all, messages::vehicle_endpoint_actor::signatures{});
    all.error_type = caf::type_id_v<caf::error>;
    all.string_type = caf::type_id_v<std::string>;
    all.error_categories = {caf::type_id_v<caf::sec>,
                            caf::type_id_v<caf::exit_reason>};
    return all;
  }();
  return forms;
}

} // namespace sofof::actors
