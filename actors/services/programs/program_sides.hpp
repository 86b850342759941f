// A service whose functions are programs, in the vehicle and at a provider.
#pragma once

#include "actors/services/programs/program_options.hpp"
#include "base/options/option_visitor.hpp"
#include "messages/protocol/service_name.hpp"
#include "offloading/service.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace sofof::actors {

/// How large inputs and results are; others are not used.
struct octet_bounds {
  std::int64_t most_input_octets = 100'000;
  std::int64_t least_result_octets = 0;
  std::int64_t most_result_octets = 65'536;

  void visit_options(option_visitor& s);
};

/// What both sides know of it.
struct program_side {
  messages::service_name service;
  program_options program;
  octet_bounds octets;
  /// Computing times of cycles, as they were measured; null: none were.
  std::shared_ptr<const std::vector<duration>> run_times{};
  duration oldest_input = duration::max(); ///< As `program_session` has it.
};

std::shared_ptr<offloading::vehicle_service>
make_program_in_vehicle(program_side what,
                        const offloading::vehicle_context& where);

std::shared_ptr<offloading::provider_service>
make_program_at_provider(program_side what,
                         const offloading::provider_context& where);

} // namespace sofof::actors
