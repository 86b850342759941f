// Properties by which C-ROADS tells messages apart.
#include "actors/broker/c_roads.hpp"

#include "actors/broker/its_kind.hpp"
#include "messages/etsi/message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <numbers>
#include <variant>

namespace sofof::actors::wire {

namespace {

constexpr std::string_view type_property = "messageType";

/// What a message says of itself.
struct its_summary {
  std::string_view type;    ///< As C-ROADS calls it.
  std::string_view version; ///< Of the standard that describes it.
  std::int32_t latitude = 0, longitude = 0;   ///< 1e-7 degrees, WGS84.
  std::optional<std::int64_t> station_type{}; ///< ETSI TS 102 894-2.
};

template <class T>
its_summary summary_at(std::string_view type, std::string_view version,
                       const T& position) {
  return {type, version, position.latitude.value, position.longitude.value};
}

its_summary summary_of(const messages::etsi::cam& x) {
  const auto& basic = x.body.parameters.basic;
  auto all = summary_at("CAM", "1.4.1", basic.position);
  all.station_type = static_cast<std::int64_t>(basic.station_type);
  return all;
}

its_summary summary_of(const messages::etsi::tr103562::cpm& x) {
  return summary_at("CPM", "TR103562:2.1.1",
                    x.body.parameters.management.position);
}

its_summary summary_of(const messages::etsi::ts103324::cpm& x) {
  return summary_at("CPM", "2.1.1", x.body.management.position);
}

its_summary summary_of(const messages::etsi::mcm& x) {
  return summary_at("MCM", "1", x.body.parameters.basic.position);
}

bool is_place(const its_summary& x) {
  return std::abs(x.latitude) <= 900'000'000
         && std::abs(x.longitude) <= 1'800'000'000;
}

} // namespace

bool is_publisher(std::string_view text) {
  constexpr std::size_t country = 2, most_digits = 10;
  const auto is_in = [](char low, char high) {
    return [=](char c) { return low <= c && c <= high; };
  };
  return text.size() > country && text.size() <= country + most_digits
         && std::ranges::all_of(text.substr(0, country), is_in('A', 'Z'))
         && std::ranges::all_of(text.substr(country), is_in('0', '9'));
}

std::string quadtree_key(double latitude_deg, double longitude_deg) {
  using std::numbers::pi;
  constexpr double northern_end_deg = 85.05112878;
  constexpr auto tiles = std::uint32_t{1} << quadtree_levels;
  const auto sine = std::sin(
      std::clamp(latitude_deg, -northern_end_deg, northern_end_deg) * pi / 180);
  const auto tile = [](double share) {
    return static_cast<std::uint32_t>(
        std::clamp(std::floor(share * tiles), 0.0, tiles - 1.0));
  };
  const auto x = tile((longitude_deg + 180) / 360);
  const auto y = tile(0.5 - std::log((1 + sine) / (1 - sine)) / (4 * pi));
  std::string key;
  for (int level = quadtree_levels; level-- > 0;)
    key += static_cast<char>('0' + (x >> level & 1) + 2 * (y >> level & 1));
  return key;
}

void add_c_roads_properties(network::amqp::message& m,
                            std::string_view publisher) {
  assert(is_publisher(publisher));
  const auto decoded = messages::etsi::decode_message(m.body);
  if (!decoded.value)
    return;
  const auto what =
      std::visit([](const auto& x) { return summary_of(x); }, *decoded.value);
  if (!is_place(what))
    return;
  const auto latitude = what.latitude * 1e-7;
  const auto longitude = what.longitude * 1e-7;
  const auto text = [&m](std::string_view name, std::string value) {
    m.all.emplace(name, std::move(value));
  };
  text(type_property, std::string{what.type});
  text("protocolVersion", fmt::format("{}:{}", what.type, what.version));
  text("publisherId", std::string{publisher});
  text("publicationId", fmt::format("{}:sofof-{}", publisher, what.type));
  text("originatingCountry", std::string{publisher.substr(0, 2)});
  text("quadTree", fmt::format(",{},", quadtree_key(latitude, longitude)));
  m.all.emplace("latitude", latitude);
  m.all.emplace("longitude", longitude);
  m.all.emplace("timestamp", std::int64_t{m.created.count()});
  if (what.station_type)
    m.all.emplace("stationType", *what.station_type);
}

std::optional<messages::its_pdu>
c_roads_message(const network::amqp::message& m) {
  using network::amqp::find;
  const auto* type = find<std::string>(m.all, type_property);
  if (!type || m.all.contains("mid"))
    return std::nullopt;
  messages::its_pdu its{.octets = m.body};
  const auto* kind = kind_of(its);
  const auto is_same = [](char a, char b) {
    return std::toupper(static_cast<unsigned char>(a)) == b;
  };
  if (!kind || !its.station()
      || !std::ranges::equal(kind->subject, *type, is_same))
    return std::nullopt;
  return its;
}

} // namespace sofof::actors::wire
