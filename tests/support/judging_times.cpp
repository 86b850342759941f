// What judging takes of honest plans in a whole run.
#include "tests/support/judging_times.hpp"

#include "actors/services/planning/plan_request.hpp"
#include "experiments/torture/changed_service.hpp"
#include "messages/etsi/uper.hpp"
#include "planners/judges/plan_judge.hpp"
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test {

using namespace actors;
using namespace experiments::torture;
using namespace messages;
using namespace planners;
using namespace scenario;
using namespace world;

namespace {

/// What judging takes, µs: of each plan, and of each own plan to compare with.
struct judging_times {
  std::vector<double> judge_us, own_us;
};

/// Judges what another judge does, beside it, and takes the time.
class timed_judge final : public offloading::result_judge {
public:
  timed_judge(std::unique_ptr<offloading::result_judge> real,
              std::shared_ptr<offloading::service_function> own,
              service_world world, station_id station, judging_times& figures)
      : real_{std::move(real)}, own_{std::move(own)}, world_{std::move(world)},
        station_{station}, figures_{figures} {}

  offloading::judged_result judge(const payload& result,
                                  const service_input& latest,
                                  time_point now) override {
    const auto request = latest.what.as<plan_request>();
    const auto way = request ? world_.streets->find(request->way) : nullptr;
    const auto message = result.as<its_pdu>();
    const auto before = latest.in_use.as<trajectory>();
    trajectory plan;
    if (way && message && etsi::decode(message->view(), word_)
        && read_suggestion(word_, station_, *way, request->from.s_m,
                           world_.where->ahead_by(message->ahead), now,
                           before.get(), plan)
               == maneuver_fault::none) {
      const auto& own = request->own;
      judged_plan x{*way,
                    plan,
                    before.get(),
                    {own.at, own.position, own.heading_rad, own.speed_mps,
                     own.accel_mps2, own.curvature_1pm},
                    request->from.s_m,
                    request->seen,
                    world_.crossings_granted,
                    now,
                    fingerprint_of_plan(word_)};
      std::shared_ptr<const trajectory> alone;
      if (judge_.wants_own_plan(x)) {
        const auto begin = std::chrono::steady_clock::now();
        alone = own_->run(now, latest).what.as<trajectory>();
        figures_.own_us.push_back(us_since(begin));
        x.own_plan = alone.get();
      }
      const auto begin = std::chrono::steady_clock::now();
      judge_.judge(x);
      figures_.judge_us.push_back(us_since(begin));
    }
    return real_->judge(result, latest, now);
  }

private:
  static double us_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::micro>(
               std::chrono::steady_clock::now() - begin)
        .count();
  }

  std::unique_ptr<offloading::result_judge> real_;
  std::shared_ptr<offloading::service_function> own_;
  service_world world_;
  station_id station_;
  judging_times& figures_;
  plan_judge judge_;
  etsi::mcm word_;
};

/// As the real service in a vehicle, with a judge that is timed.
class timed_in_vehicle final : public offloading::vehicle_service {
public:
  timed_in_vehicle(std::shared_ptr<offloading::vehicle_service> real,
                   service_world world, station_id station,
                   judging_times& figures)
      : real_{std::move(real)}, world_{std::move(world)}, station_{station},
        figures_{figures} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    return real_->make_function();
  }
  service_input encode_input(service_input input,
                             bool takes_over) const override {
    return real_->encode_input(std::move(input), takes_over);
  }
  bool continues(const payload& in_use, const payload& offered,
                 time_point now) const override {
    return real_->continues(in_use, offered, now);
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<timed_judge>(real_->make_judge(),
                                         real_->make_function(), world_,
                                         station_, figures_);
  }
  payload termination_message(const service_end& end, time_point now,
                              const cam& own) const override {
    return real_->termination_message(end, now, own);
  }

private:
  std::shared_ptr<offloading::vehicle_service> real_;
  service_world world_;
  station_id station_;
  judging_times& figures_;
};

} // namespace

int print_judging_times(const char* file, const char* seconds) {
  auto s = load_scenario(
      file, std::vector<std::string>{fmt::format("duration={}s", seconds)});
  judging_times figures;
  for (auto& kind : s.services)
    if (kind->name() == "trajectory_planning")
      kind = std::make_shared<changed_service>(
          kind, [&](offloading::service& service, const service_world& world) {
            service.in_vehicle = [real = service.in_vehicle, world,
                                  &figures](const auto& vehicle) {
              return std::make_shared<timed_in_vehicle>(
                  real(vehicle), world, vehicle.station, figures);
            };
          });
  play(s);
  auto& all = figures.judge_us;
  const auto& own = figures.own_us;
  std::ranges::sort(all);
  const auto at = [&](double share) {
    return all.at(
        static_cast<std::size_t>(share * static_cast<double>(all.size() - 1)));
  };
  const auto sum = std::accumulate(own.begin(), own.end(), 0.0);
  fmt::print(
      "plans={} p50_us={:.2f} p99_us={:.2f} own_plans={} own_ms={:.2f}\n",
      all.size(), at(0.5), at(0.99), own.size(), sum / 1e3);
  return 0;
}

} // namespace sofof::test
