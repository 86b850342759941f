// The options of driving, as a scenario file lists them.
#include "planners/trajectory/lane_follow.hpp"
#include "planners/trajectory/spatial_planner.hpp"
#include "world/vehicle/cabin.hpp"

#include <doctest/doctest.h>

#include <set>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

/// Collects names; checks that defaults keep their ranges.
class listing : public option_visitor {
public:
  std::set<std::string, std::less<>> names;

  void field(std::string_view key, double& value, range r) override {
    CAPTURE(key);
    CHECK(names.emplace(key).second);
    CHECK(value >= r.min);
    CHECK(value <= r.max);
    CHECK(r.max < 1e300);
  }
  void field(std::string_view, bool&) override {}
  void field(std::string_view key, std::int64_t& value, range r) override {
    auto number = static_cast<double>(value);
    field(key, number, r);
  }
  void field(std::string_view, std::string&) override {}
  void field(std::string_view, duration&, duration) override {}
  void field(std::string_view, std::vector<std::string>&) override {}
  void field(std::string_view, point&) override {}
  void field(std::string_view, std::vector<point>&) override {}
  void table(std::string_view,
             const std::function<void(option_visitor&)>&) override {}
  void
  tables(std::string_view, std::size_t,
         const std::function<void(std::size_t, option_visitor&)>&) override {}
  void refuse(std::string_view, const std::string&) override {}
};

/// Every member is as large as a double, so their number is the struct's size.
/// @param hidden  Members that are no options.
template <class Params>
void check_all_listed(std::size_t hidden = 0) {
  Params params;
  listing list;
  params.visit_options(list);
  CHECK(list.names.size() == sizeof(Params) / sizeof(double) - hidden);
}

} // namespace

TEST_CASE("every option is listed once, its default within its range") {
  check_all_listed<comfort_limits>(1); // the car's front
  check_all_listed<cabin_params>();
  check_all_listed<spatial_params>();
}
