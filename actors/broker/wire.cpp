// ITS messages as they are; all else by CAF's binary serializer.
#include "actors/broker/wire.hpp"

#include "actors/broker/c_roads.hpp"
#include "actors/broker/its_kind.hpp"
#include "messages/type_ids.hpp"

#include <caf/binary_deserializer.hpp>
#include <caf/binary_serializer.hpp>
#include <caf/byte_buffer.hpp>

#include <algorithm>
#include <cassert>
#include <memory>
#include <string_view>
#include <utility>

namespace sofof::actors::wire {

namespace {

using network::amqp::find;

constexpr std::string_view own_subject = "sofof";

constexpr std::chrono::milliseconds own_ttl{1000};

/// How each content is called, in the order of the variant.
constexpr std::string_view names[] = {
    "broadcast", "connect_request", "challenge", "hello",
    "welcome",   "refusal",         "closing",   "ping",
    "pong",      "request",         "input",     "end",
    "offer",     "response",        "digest",    "result"};
static_assert(std::size(names) == std::variant_size_v<content>);

template <class T>
std::vector<std::byte> written(const T& x) {
  caf::byte_buffer to;
  caf::binary_serializer out{nullptr, to};
  const auto good = out.apply(x);
  assert(good); // a buffer takes everything
  static_cast<void>(good);
  std::vector<std::byte> all(to.size());
  std::ranges::transform(to, all.begin(),
                         [](auto b) { return static_cast<std::byte>(b); });
  return all;
}

template <class T>
bool read(const std::vector<std::byte>& from, T& x) {
  const auto* first = reinterpret_cast<const caf::byte*>(from.data());
  caf::binary_deserializer in{nullptr, caf::make_span(first, from.size())};
  return in.apply(x) && in.remaining() == 0;
}

/// The ITS message that a content holds, and the content without it.
struct parts {
  std::shared_ptr<const messages::its_pdu> its;
  std::vector<std::byte> rest;
};

template <class T>
parts taken_apart(const T& x) {
  if constexpr (std::is_same_v<T, broadcast>) {
    return {std::make_shared<const messages::its_pdu>(x.message), {}};
  } else if constexpr (requires { x.what.template as<messages::its_pdu>(); }) {
    if (auto its = x.what.template as<messages::its_pdu>();
        its && kind_of(*its)) {
      auto rest = x;
      rest.what = {};
      return {std::move(its), written(rest)};
    }
  }
  if constexpr (std::is_same_v<T, broadcast>)
    return {};
  else
    return {nullptr, written(x)};
}

/// Reads the content of this number.
template <std::size_t I = 0>
bool read_content(std::size_t number, const std::vector<std::byte>& from,
                  content& to) {
  if constexpr (I < std::variant_size_v<content>) {
    if (number != I)
      return read_content<I + 1>(number, from, to);
    auto& x = to.emplace<I>();
    if constexpr (I == 0)
      return false; // broadcasts are ITS messages
    else
      return read(from, x);
  } else {
    return false;
  }
}

bool put_in(content& to, messages::its_pdu its) {
  if (auto* input = std::get_if<messages::service_input>(&to))
    input->what = messages::payload::of(std::move(its));
  else if (auto* result = std::get_if<messages::service_result>(&to))
    result->what = messages::payload::of(std::move(its));
  else if (auto* end = std::get_if<messages::service_end>(&to))
    end->what = messages::payload::of(std::move(its));
  else
    return false;
  return true;
}

std::optional<std::size_t> number_of(const network::amqp::message& m) {
  const auto* kind = find<std::string>(m.all, "sofof");
  if (!kind)
    return std::nullopt;
  const auto* at = std::ranges::find(names, *kind);
  if (at == std::end(names))
    return std::nullopt;
  return static_cast<std::size_t>(at - std::begin(names));
}

/// @returns the ITS message in a body, if it is what the properties say.
std::optional<messages::its_pdu> its_in(const network::amqp::message& m,
                                        station_id from) {
  const auto* mid = find<std::uint16_t>(m.all, "mid");
  messages::its_pdu its{.octets = m.body};
  const auto* kind = kind_of(its);
  if (!mid || !kind || kind->mid != *mid || kind->subject != m.subject
      || its.station() != from)
    return std::nullopt;
  return its;
}

} // namespace

network::amqp::message to_amqp(const envelope& x,
                               std::chrono::milliseconds now) {
  network::amqp::message m;
  m.user = x.user;
  m.created = now;
  auto [its, rest] =
      std::visit([](const auto& one) { return taken_apart(one); }, x.what);
  const auto from = its ? its->station().value_or(x.from) : x.from;
  m.all.emplace("station_id", from.value());
  if (x.to)
    m.all.emplace("destination_station_id", x.to->value());
  if (x.what.index() != 0)
    m.all.emplace("sofof", std::string{names[x.what.index()]});
  if (x.link != 0)
    m.all.emplace("sofof_link", x.link);
  const auto* kind = its ? kind_of(*its) : nullptr;
  m.subject = kind ? kind->subject : own_subject;
  m.ttl = kind ? kind->ttl : own_ttl;
  if (!kind) {
    m.body = std::move(rest);
    return m;
  }
  m.all.emplace("mid", kind->mid);
  m.body = its->octets;
  if (!rest.empty())
    m.all.emplace("sofof_rest", std::move(rest));
  return m;
}

std::optional<envelope> from_amqp(const network::amqp::message& m) {
  const auto* from = find<std::uint32_t>(m.all, "station_id");
  if (!from) {
    auto its = c_roads_message(m);
    if (!its)
      return std::nullopt;
    const auto station = its->station().value_or(0);
    return envelope{
        .user = m.user, .from = station, .what = broadcast{std::move(*its)}};
  }
  envelope x{.user = m.user, .from = *from};
  if (const auto* to = find<std::uint32_t>(m.all, "destination_station_id"))
    x.to = *to;
  if (const auto* link = find<std::int64_t>(m.all, "sofof_link"))
    x.link = *link;
  const auto number = number_of(m);
  if (m.subject == own_subject)
    return number && read_content(*number, m.body, x.what) ? std::optional{x}
                                                           : std::nullopt;
  auto its = its_in(m, x.from);
  if (!its)
    return std::nullopt;
  if (!number) {
    x.what = broadcast{std::move(*its)};
    return x;
  }
  const auto* rest = find<std::vector<std::byte>>(m.all, "sofof_rest");
  if (!rest || !read_content(*number, *rest, x.what)
      || !put_in(x.what, std::move(*its)))
    return std::nullopt;
  return x;
}

} // namespace sofof::actors::wire
