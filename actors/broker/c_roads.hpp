// ITS messages on a broker as C-ROADS describes them.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "network/amqp/message.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::actors::wire {

/// @returns whether this is the identity of a publisher: the two letters of its
/// country and 1 to 10 digits, "DE12345".
bool is_publisher(std::string_view text);

/// The levels of a quadtree key: a tile is 150 m wide at the equator and 100 m
/// in Germany.
inline constexpr int quadtree_levels = 18;

/// @param latitude_deg, longitude_deg  WGS84; latitudes beyond ±85.05° count as
///                                     that, where the square map ends.
/// @returns the tile that holds a place: a digit of 0 to 3 a level, from the
/// whole Earth on; one tile lies in another if it begins with its digits.
/// Source: Microsoft, Bing Maps Tile System.
std::string quadtree_key(double latitude_deg, double longitude_deg);

/// Adds what subscribers of a C-ROADS Basic Interface select by: messageType,
/// protocolVersion, quadTree, latitude, longitude, timestamp, publisherId,
/// publicationId, originatingCountry and stationType. A message whose body is
/// no CAM, CPM or MCM, or says no place, is left as it is.
/// Source: C-ROADS, IP Based Interface Profile 2.1.0, as
/// NordicWayInterchange/interchange names its properties.
/// @param publisher  Whose message it is, see `is_publisher`.
void add_c_roads_properties(network::amqp::message& m,
                            std::string_view publisher);

/// @returns the CAM, CPM or MCM of a message that has these properties and none
/// of uulm-mrm/v2x_etsi_asn1; nothing for any other message.
std::optional<messages::its_pdu> c_roads_message(const network::amqp::message&);

} // namespace sofof::actors::wire
