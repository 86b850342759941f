// Crossing management in a vehicle and at a provider.
#include "actors/services/crossing/crossing_sides.hpp"

#include "actors/services/crossing/crossing_office.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "base/protocol.hpp"
#include "messages/v2x/encoded.hpp"

#include <cmath>
#include <utility>

namespace sofof::actors {

namespace {

class own_rules final : public offloading::service_function {
public:
  offloading::service_output run(time_point,
                                 const messages::service_input&) override {
    return {};
  }
};

/// Reads advice; what it is worth the claims show.
class advice_reader final : public offloading::result_judge {
public:
  advice_reader(crossing_world_ptr world, station_id me)
      : world_{std::move(world)}, me_{me} {}

  offloading::judged_result judge(const messages::payload& result,
                                  const messages::service_input& latest,
                                  time_point now) override {
    const auto request = latest.what.as<crossing_request>();
    const auto way = request ? world_->streets->find(request->way) : nullptr;
    if (!way)
      return {};
    world::trajectory drive;
    const auto message = result.as<messages::its_pdu>();
    if (!message || !messages::etsi::decode(message->view(), word_))
      return {{}, {}, objection{"readable", 0, 1}};
    const auto fault = messages::read_suggestion(
        word_, me_, *way, request->s_m, world_->where->ahead_by(message->ahead),
        now, nullptr, drive);
    if (!fault) // nothing is suggested now
      return {messages::payload::of(world::trajectory{})};
    if (*fault != messages::maneuver_fault::none)
      return {{}, {}, objection{to_string(*fault), 0, 1}};
    return {messages::payload::of(std::move(drive))};
  }

private:
  crossing_world_ptr world_;
  station_id me_;
  messages::etsi::mcm word_;
};

class crossing_in_vehicle final : public offloading::vehicle_service {
public:
  crossing_in_vehicle(crossing_world_ptr world,
                      offloading::vehicle_context vehicle)
      : world_{std::move(world)}, vehicle_{std::move(vehicle)} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<own_rules>();
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<advice_reader>(world_, vehicle_.station);
  }

  /// That it asks; what it does it tells everybody.
  messages::service_input encode_input(messages::service_input input,
                                       bool) const override {
    const auto request = input.what.as<crossing_request>();
    const auto way = request ? world_->streets->find(request->way) : nullptr;
    if (!way)
      return {};
    const auto ahead = way->waypoints(request->s_m, protocol::authority_m,
                                      protocol::authority_spacing_m);
    auto message = messages::encoded(messages::make_word(
        {request->own, ahead, nullptr, {}}, world_->car, *world_->where));
    if (message.octets.empty())
      return {};
    input.what = messages::payload::of(std::move(message));
    input.in_use = {};
    return input;
  }

private:
  crossing_world_ptr world_;
  offloading::vehicle_context vehicle_;
};

class advising final : public offloading::service_function {
public:
  advising(crossing_world_ptr world, offloading::provider_context provider,
           station_id vehicle, std::shared_ptr<crossing_office> office)
      : world_{std::move(world)}, provider_{std::move(provider)},
        station_{vehicle}, office_{std::move(office)} {}
  ~advising() override { office_->leave(station_); }
  advising(const advising&) = delete;
  advising& operator=(const advising&) = delete;

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto drive = office_->advise(now, station_);
    const messages::suggestion what{
        provider_.station,
        provider_.place(),
        station_,
        {static_cast<std::uint16_t>(input.session.counter), ++update_}};
    const auto rest = told_rest(drive, now);
    if (rest.points.size() < fewest_points
        || !messages::make_suggestion(what, rest, *world_->where, waypoints_,
                                      said_))
      said_ = messages::make_silence(what, now, *world_->where);
    auto message = messages::encoded(said_);
    if (message.octets.empty())
      return {};
    return {messages::payload::of(std::move(message))};
  }

private:
  /// What is left of a drive is not worth saying: it has left the crossing.
  static constexpr std::size_t fewest_points = 6;

  crossing_world_ptr world_;
  offloading::provider_context provider_;
  station_id station_;
  std::shared_ptr<crossing_office> office_;
  std::uint16_t update_ = 0;
  messages::etsi::mcm said_;
  std::vector<messages::maneuver_waypoint> waypoints_;
};

class crossing_at_provider final : public listening_service {
public:
  crossing_at_provider(crossing_world_ptr world,
                       offloading::provider_context provider)
      : world_{std::move(world)}, provider_{std::move(provider)},
        office_{std::make_shared<crossing_office>(world_, provider_.clock)} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    return std::make_shared<advising>(world_, provider_, vehicle, office_);
  }
  broadcast_listener* listener() override { return office_.get(); }

private:
  crossing_world_ptr world_;
  offloading::provider_context provider_;
  std::shared_ptr<crossing_office> office_;
};

} // namespace

std::shared_ptr<offloading::vehicle_service>
make_crossing_in_vehicle(crossing_world_ptr world,
                         offloading::vehicle_context vehicle) {
  return std::make_shared<crossing_in_vehicle>(std::move(world),
                                               std::move(vehicle));
}

std::shared_ptr<offloading::provider_service>
make_crossing_at_provider(crossing_world_ptr world,
                          offloading::provider_context provider) {
  return std::make_shared<crossing_at_provider>(std::move(world),
                                                std::move(provider));
}

} // namespace sofof::actors
