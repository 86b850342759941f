// A service whose function is any program: docs/programs.md. Its name is the
// scenario's.
#include "actors/services/programs/program_client.hpp"
#include "actors/services/programs/program_sides.hpp"
#include "actors/services/programs/run_times.hpp"
#include "actors/services/service_type.hpp"
#include "base/options/option_helpers.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

class program_service final : public service_type {
public:
  program_service() {
    options.limits = {150ms, 300ms, 500ms};
    options.period = 100ms;
    options.input_period = 100ms;
    options.per_input = true;
    options.compute = {.run_time_mean = 8ms,
                       .run_time_sd = 1ms,
                       .run_time_max = 50ms,
                       .demand = {},
                       .input_octets = 30'000};
  }

  std::string_view name() const override { return name_; }

  void be_called(std::string_view name) override { name_ = name; }

  void visit_options(option_visitor& s) override {
    program_.visit_options(s);
    s.table("input", [this](option_visitor& t) {
      visit_choice(t, input_, make_input_source, "input of a program",
                   input_source_names());
    });
    octets_.visit_options(s);
    if (s.has("run_times", !times_file_.empty()))
      s.field("run_times", times_file_);
    service_type::visit_options(s);
  }

  void load(const std::filesystem::path& folder) override {
    program_.locate(folder);
    input_->load(folder, static_cast<std::size_t>(octets_.most_input_octets));
    if (!times_file_.empty())
      times_ = read_run_times(times_at_ = folder / times_file_);
  }

  std::vector<std::filesystem::path> files() const override {
    auto all = program_.files();
    const auto inputs = input_->files();
    all.insert(all.end(), inputs.begin(), inputs.end());
    if (times_)
      all.push_back(times_at_);
    return all;
  }

  std::string_view uses_results_of() const override {
    return input_->program();
  }

  bool is_program() const override { return true; }

  offloading::service in(const service_world& world) const override {
    const program_side own{name(), program_, octets_, times_,
                           options.limits.max_latency};
    auto far = own;
    for (const auto& other : world.programs)
      if (other.service == name_)
        far.program = other.what;
    return {.name = name(),
            .options = options,
            .in_vehicle =
                [own](const auto& where) {
                  return make_program_in_vehicle(own, where);
                },
            .at_provider =
                [far](const auto& where) {
                  return make_program_at_provider(far, where);
                }};
  }

  service_client spawn_client(const client_place& where) const override {
    return {spawn_program_client(where, {name(), input_, options.period})};
  }

private:
  std::string name_ = "program";
  program_options program_;
  octet_bounds octets_;
  std::string times_file_;
  std::filesystem::path times_at_;
  std::shared_ptr<const std::vector<duration>> times_;
  input_source_ptr input_ = make_input_source("camera");
};

} // namespace

service_type_ptr service_program() {
  return std::make_shared<program_service>();
}

} // namespace sofof::actors
