// What is seen is copied: programs take it when they need it.
#include "actors/services/programs/vehicle_view.hpp"

#include "base/protocol.hpp"

namespace sofof::actors {

namespace {

class onlooking_client final : public plan_client {
public:
  onlooking_client(std::shared_ptr<const plan_client> asks,
                   std::shared_ptr<vehicle_view> view)
      : asks_{std::move(asks)}, view_{std::move(view)} {}

  messages::payload ask(const world::route& way,
                        const planners::planning_input& from,
                        const world::perception& seen, const messages::cam& own,
                        const messages::payload& crossing) const override {
    view_->see({own, seen,
                way.waypoints(from.s_m, protocol::route_ahead_m,
                              protocol::route_spacing_m)});
    return asks_->ask(way, from, seen, own, crossing);
  }

  std::optional<received_plan>
  read(const messages::service_result& result) const override {
    return asks_->read(result);
  }

private:
  std::shared_ptr<const plan_client> asks_;
  std::shared_ptr<vehicle_view> view_;
};

} // namespace

void vehicle_view::see(vehicle_look look) {
  const std::lock_guard locked{lock_};
  newest_ = std::move(look);
}

vehicle_look vehicle_view::newest() const {
  const std::lock_guard locked{lock_};
  return newest_;
}

void vehicle_view::keep_result(std::string_view service,
                               std::vector<std::byte> octets) {
  const std::lock_guard locked{lock_};
  results_[std::string{service}] = std::move(octets);
}

std::vector<std::byte> vehicle_view::result_of(std::string_view service) const {
  const std::lock_guard locked{lock_};
  const auto i = results_.find(service);
  return i == results_.end() ? std::vector<std::byte>{} : i->second;
}

std::shared_ptr<const plan_client>
onlooking(std::shared_ptr<const plan_client> asks,
          std::shared_ptr<vehicle_view> view) {
  return std::make_shared<onlooking_client>(std::move(asks), std::move(view));
}

} // namespace sofof::actors
