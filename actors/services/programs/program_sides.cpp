// Both sides run a process for each function; results of others are judged by
// their size.
#include "actors/services/programs/program_sides.hpp"

#include "actors/services/programs/program_function.hpp"
#include "base/process/spare_programs.hpp"

#include <fmt/format.h>

#include <utility>

namespace sofof::actors {

namespace {

/// What programs are told first.
kept_setup setup_of(const program_side& what, std::string_view side,
                    bool is_virtual) {
  const auto most = what.octets.most_result_octets;
  auto setup = what.program.setup(
      fmt::format("protocol=1\nservice={}\nside={}\ntime={}\n"
                  "most_result_octets={}\n",
                  what.service.view(), side, is_virtual ? "virtual" : "real",
                  most),
      static_cast<std::size_t>(most), is_virtual);
  // For people who look at processes.
  setup.how.environment = {fmt::format("SOFOF_SERVICE={}", what.service.view()),
                           fmt::format("SOFOF_SIDE={}", side)};
  return setup;
}

std::shared_ptr<offloading::service_function>
make_program_function(const program_side& what, kept_setup setup,
                      station_id station, program_session whose) {
  setup.activation = fmt::format("station={}\n", station);
  whose.most_input_octets =
      static_cast<std::size_t>(what.octets.most_input_octets);
  whose.run_times = what.run_times;
  whose.oldest_input = what.oldest_input;
  whose.about.station = station;
  whose.about.service = what.service;
  return std::make_shared<program_function>(std::move(setup), std::move(whose));
}

/// By the bounds that the scenario sets.
class octets_judge final : public offloading::result_judge {
public:
  explicit octets_judge(const octet_bounds& bounds) : bounds_{bounds} {}

  offloading::judged_result judge(const messages::payload& result,
                                  const messages::service_input&,
                                  time_point) override {
    const auto octets = result.as<program_octets>();
    if (!octets)
      return {{}, objection{"readable", 0, 1}};
    const auto count = static_cast<std::int64_t>(octets->octets.size());
    if (count < bounds_.least_result_octets)
      return {{},
              objection{"least_octets", static_cast<double>(count),
                        static_cast<double>(bounds_.least_result_octets)}};
    if (count > bounds_.most_result_octets)
      return {{},
              objection{"most_octets", static_cast<double>(count),
                        static_cast<double>(bounds_.most_result_octets)}};
    return {result};
  }

private:
  octet_bounds bounds_;
};

class program_in_vehicle final : public offloading::vehicle_service {
public:
  program_in_vehicle(program_side what,
                     const offloading::vehicle_context& where)
      : what_{std::move(what)}, where_{where} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    auto setup = setup_of(what_, "vehicle", where_.virtual_time);
    setup.how.environment.push_back(
        fmt::format("SOFOF_STATION={}", where_.station));
    return make_program_function(what_, std::move(setup), where_.station,
                                 {.about = {},
                                  .report = where_.report,
                                  .is_virtual = where_.virtual_time});
  }

  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<octets_judge>(what_.octets);
  }

private:
  program_side what_;
  offloading::vehicle_context where_;
};

class programs_at_provider final : public offloading::provider_service {
public:
  programs_at_provider(program_side what,
                       const offloading::provider_context& where)
      : what_{std::move(what)}, where_{where}, setup_{setup_of(
                                                   what_, "provider",
                                                   where_.virtual_time)},
        spares_{std::make_shared<spare_programs>(
            setup_, static_cast<std::size_t>(what_.program.spares))} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    auto setup = setup_;
    setup.take_started =
        [spare = std::make_shared<std::unique_ptr<framed_program>>(
             spares_->take())] { return std::move(*spare); };
    return make_program_function(what_, std::move(setup), vehicle,
                                 {.about = {.provider = where_.id},
                                  .report = where_.report,
                                  .besides = [all = spares_] { all->look(); },
                                  .is_virtual = where_.virtual_time});
  }

private:
  program_side what_;
  offloading::provider_context where_;
  kept_setup setup_;
  std::shared_ptr<spare_programs> spares_; // for sessions to come
};

} // namespace

void octet_bounds::visit_options(option_visitor& s) {
  constexpr double most = 1 << 24;
  s.field("most_input_octets", most_input_octets, {1, most});
  s.field("least_result_octets", least_result_octets, {0, most});
  s.field("most_result_octets", most_result_octets, {0, most});
  if (least_result_octets > most_result_octets)
    s.refuse("least_result_octets",
             "must not be more than `most_result_octets`.");
}

std::shared_ptr<offloading::vehicle_service>
make_program_in_vehicle(program_side what,
                        const offloading::vehicle_context& where) {
  return std::make_shared<program_in_vehicle>(std::move(what), where);
}

std::shared_ptr<offloading::provider_service>
make_program_at_provider(program_side what,
                         const offloading::provider_context& where) {
  return std::make_shared<programs_at_provider>(std::move(what), where);
}

} // namespace sofof::actors
