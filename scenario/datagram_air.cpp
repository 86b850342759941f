// Octets out, octets in.
#include "scenario/datagram_air.hpp"

#include "messages/v2x/btp_datagram.hpp"

#include <utility>
#include <variant>

namespace sofof::scenario {

namespace {

class sending_sink final : public messages::record_sink {
public:
  sending_sink(std::shared_ptr<network::datagrams> line,
               std::shared_ptr<messages::record_sink> then)
      : line_{std::move(line)}, then_{std::move(then)} {}

  void on_record(const messages::record& x) override {
    if (const auto* sent = std::get_if<messages::air_record>(&x))
      if (const auto octets = messages::btp_datagram(sent->message.view());
          !octets.empty())
        line_->send(octets);
    then_->on_record(x);
  }

private:
  std::shared_ptr<network::datagrams> line_;
  std::shared_ptr<messages::record_sink> then_;
};

} // namespace

std::set<station_id> stations_of(const scenario_definition& s) {
  std::set<station_id> all;
  for (const auto& fleet : s.fleets)
    for (std::int64_t k = 0; k < fleet.count; ++k)
      all.insert(static_cast<station_id>(fleet.first_station + k));
  return all;
}

std::function<messages::broadcast(const messages::its_pdu&, time_point)>
reader_of(const scenario_definition& s, const runtime& time) {
  return [where = messages::georeference{
              messages::geo_frame{s.world->map.origin()},
              time.clock()}](const messages::its_pdu& message, time_point now) {
    return messages::decode(message, where, now);
  };
}

datagram_air::datagram_air(const udp_options& what)
    : line_{std::make_shared<network::datagrams>(
        what.to, what.from, messages::longest_datagram,
        [to = hearing_](std::span<const std::byte> datagram) {
          auto message = messages::message_in(datagram);
          if (!message)
            return;
          const std::lock_guard lock{to->mutex};
          if (to->ear)
            to->ear->on_message({.octets = std::move(*message)});
        })} {}

std::shared_ptr<messages::record_sink>
datagram_air::sending(std::shared_ptr<messages::record_sink> then) const {
  return std::make_shared<sending_sink>(line_, std::move(then));
}

void datagram_air::hear_for(const world_actors& actors,
                            const scenario_definition& s, runtime& time) {
  actors::foreign_air_setup setup;
  setup.providers = actors.providers;
  setup.air = actors.air;
  setup.own = stations_of(s);
  setup.decode = reader_of(s, time);
  const std::lock_guard lock{hearing_->mutex};
  hearing_->ear.emplace(time.system(), std::move(setup));
}

void datagram_air::be_deaf() {
  const std::lock_guard lock{hearing_->mutex};
  hearing_->ear.reset();
}

std::string datagram_air::address() const {
  return network::print_address(line_->address());
}

} // namespace sofof::scenario
