// What a vehicle asks of the planner in it, and how it reads results.
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/planning_sides.hpp"

#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

class planning_requests final : public plan_client {
public:
  messages::payload ask(const world::route& way,
                        const planners::planning_input& from,
                        const world::perception& seen, const messages::cam& own,
                        const messages::payload& crossing) const override {
    return messages::payload::of(
        plan_request{way.name(),
                     from,
                     seen,
                     own,
                     crossing.as<planners::crossing_view>(),
                     {}});
  }

  std::optional<received_plan>
  read(const messages::service_result& result) const override {
    auto plan = result.what.as<world::trajectory>();
    if (!plan)
      return std::nullopt;
    const auto about = result.about.as<planners::plan_report>();
    return received_plan{std::move(plan),
                         about ? *about : planners::plan_report{}};
  }
};

} // namespace

std::shared_ptr<const plan_client> make_plan_client() {
  return std::make_shared<planning_requests>();
}

} // namespace sofof::actors
