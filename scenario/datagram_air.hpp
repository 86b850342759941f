// ITS messages as datagrams, to and from programs that are none of ours.
#pragma once

#include "actors/simulation/foreign_air.hpp"
#include "network/udp/datagrams.hpp"
#include "scenario/build.hpp"
#include "scenario/run.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

namespace sofof::scenario {

/// @returns how a message of another program is read.
std::function<messages::broadcast(const messages::its_pdu&, time_point)>
reader_of(const scenario_definition& s, const runtime& time);

/// @returns all stations that the scenario's fleets have.
std::set<station_id> stations_of(const scenario_definition& s);

/// Sends what stations of this process send, and lets them hear others.
class datagram_air {
public:
  /// @throws network::network_error when an address cannot be had.
  explicit datagram_air(const udp_options& what);

  /// @returns what sends the ITS messages among records, and hands all on.
  std::shared_ptr<messages::record_sink>
  sending(std::shared_ptr<messages::record_sink> then) const;

  /// The actors live: what comes is told to them from now on.
  void hear_for(const world_actors& actors, const scenario_definition& s,
                runtime& time);
  /// They are about to end.
  void be_deaf();

  /// @returns where it hears, for people.
  std::string address() const;

private:
  /// Who hears, if anybody does; the thread of the datagrams has it, too.
  struct hearing {
    std::mutex mutex;
    std::optional<actors::foreign_air> ear;
  };

  std::shared_ptr<hearing> hearing_ = std::make_shared<hearing>();
  std::shared_ptr<network::datagrams> line_;
};

} // namespace sofof::scenario
