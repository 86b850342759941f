// Every type of Proton has one of ours, or none.
#include "network/amqp/proton_message.hpp"

#include <cstring>
#include <proton/binary.hpp>
#include <proton/codec/map.hpp>
#include <proton/duration.hpp>
#include <proton/error.hpp>
#include <proton/map.hpp>
#include <proton/scalar.hpp>
#include <proton/timestamp.hpp>
#include <proton/value.hpp>

namespace sofof::network::amqp {

namespace {

std::vector<std::byte> bytes_of(const proton::binary& x) {
  std::vector<std::byte> all(x.size());
  if (!all.empty())
    std::memcpy(all.data(), x.data(), x.size());
  return all;
}

proton::binary binary_of(const std::vector<std::byte>& x) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(x.data());
  return proton::binary(first, first + x.size());
}

proton::scalar scalar_of(const property& x) {
  return std::visit(
      []<class T>(const T& value) -> proton::scalar {
        if constexpr (std::is_same_v<T, std::vector<std::byte>>)
          return binary_of(value);
        else
          return value;
      },
      x);
}

std::optional<property> property_of(const proton::scalar& x) {
  switch (x.type()) {
    case proton::BOOLEAN:
      return proton::get<bool>(x);
    case proton::USHORT:
      return proton::get<std::uint16_t>(x);
    case proton::UINT:
      return proton::get<std::uint32_t>(x);
    case proton::UBYTE:
    case proton::BYTE:
    case proton::SHORT:
    case proton::INT:
    case proton::LONG:
      return proton::coerce<std::int64_t>(x);
    case proton::FLOAT:
    case proton::DOUBLE:
      return proton::coerce<double>(x);
    case proton::STRING:
      return proton::get<std::string>(x);
    case proton::BINARY:
      return bytes_of(proton::get<proton::binary>(x));
    default:
      return std::nullopt;
  }
}

} // namespace

proton::message to_proton(const message& m) {
  proton::message to;
  if (!m.user.empty())
    to.user(m.user);
  if (!m.subject.empty())
    to.subject(m.subject);
  to.creation_time(proton::timestamp{m.created.count()});
  if (m.ttl.count() > 0)
    to.ttl(proton::duration{m.ttl.count()});
  for (const auto& [name, value] : m.all)
    to.properties().put(name, scalar_of(value));
  to.inferred(true); // a data section, and no AMQP value
  to.body(binary_of(m.body));
  return to;
}

properties properties_of(const proton::message& m) {
  std::map<std::string, proton::scalar> given;
  if (const auto& found = m.properties(); !found.empty())
    proton::get(found.value(), given);
  properties all;
  for (const auto& [name, value] : given)
    if (auto ours = property_of(value))
      all.emplace(name, std::move(*ours));
  return all;
}

std::optional<message> from_proton(const proton::message& m) {
  try {
    if (m.body().type() != proton::BINARY)
      return std::nullopt;
    message all;
    all.user = m.user();
    all.subject = m.subject();
    all.created = std::chrono::milliseconds{m.creation_time().milliseconds()};
    all.ttl = std::chrono::milliseconds{m.ttl().milliseconds()};
    all.all = properties_of(m);
    all.body = bytes_of(proton::get<proton::binary>(m.body()));
    return all;
  } catch (const proton::error&) {
    return std::nullopt;
  }
}

} // namespace sofof::network::amqp
