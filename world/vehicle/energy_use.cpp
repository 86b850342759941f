// What computing and sending take at both ends.
#include "world/vehicle/energy_use.hpp"

namespace sofof::world {

vehicle_power power_of(const computer_options& computer) {
  cycle_options octet;
  octet.input_octets = 1;
  const auto octet_j = sending_cost(computer, octet).energy_j;
  return {computing_power_w(computer), computer.resting_share, octet_j,
          computer.receiving_share * octet_j};
}

energy_parts& energy_parts::operator+=(const energy_parts& x) {
  computing_j += x.computing_j;
  resting_j += x.resting_j;
  framework_j += x.framework_j;
  sending_j += x.sending_j;
  receiving_j += x.receiving_j;
  server_busy_j += x.server_busy_j;
  server_idle_j += x.server_idle_j;
  return *this;
}

energy_parts energy_of(const energy_use& use, const vehicle_power& vehicle,
                       const server_power& server) {
  return {.computing_j = use.computing_s * vehicle.computing_w,
          .resting_j =
              use.resting_s * vehicle.resting_share * vehicle.computing_w,
          .framework_j = use.framework_j,
          .sending_j = use.octets_up * vehicle.sending_j,
          .receiving_j = use.octets_down * vehicle.receiving_j,
          .server_busy_j = use.served_s * server.busy_w,
          .server_idle_j = use.served_s * server.idle_w};
}

std::optional<double> break_even_w(double home_s, const energy_use& use,
                                   const energy_parts& spent,
                                   double resting_share) {
  const auto less_s = home_s - use.computing_s - resting_share * use.resting_s;
  if (!(less_s > 0))
    return std::nullopt;
  return (spent.framework_j + spent.radio_j() + spent.server_j()) / less_s;
}

} // namespace sofof::world
