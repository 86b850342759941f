// What a log of seeds says, for people.
#include "experiments/torture/seed_table.hpp"

#include <fmt/format.h>

#include <string_view>

namespace sofof::experiments::torture {

namespace {

std::string line(std::string_view name, std::string_view value,
                 std::string_view meaning = {}) {
  return fmt::format("{:<20}{:>12}{}{}\n", name, value,
                     meaning.empty() ? "" : "  ", meaning);
}

std::string share(double part, double all) {
  return all > 0 ? fmt::format("{:.1f} %", 100 * part / all) : "none";
}

} // namespace

std::string table_of(const seed_log& log,
                     const std::filesystem::path& findings) {
  const auto sum = log.sum();
  const auto driven_s = sum[counted::driven_s];
  const auto chain_s = sum[counted::chain_s];
  const auto count = [&](counted what) { return fmt::format("{}", sum[what]); };
  auto text =
      line("seeds", fmt::format("{}", log.seeds().size()))
      + line("vehicle hours", fmt::format("{:.2f}", driven_s / hour_s))
      + line("  by al_ilqr", share(sum[counted::al_ilqr_s], driven_s))
      + line("  offloaded", share(sum[counted::offloaded_s], driven_s))
      + line("  with a chain", share(sum[counted::chain_s], driven_s))
      + line("    tracking", share(sum[counted::tracking_s], chain_s),
             "of these at a provider")
      + line("    environment", share(sum[counted::environment_s], chain_s),
             "likewise")
      + line("episodes", count(counted::episodes))
      + line("sessions", count(counted::sessions), "closed by both sides")
      + line("  late by 2 s", count(counted::late_2_s),
             "or more, of the time in which the link carried")
      + line("disbelieved", count(counted::disbelieved),
             "results, of providers that did not lie")
      + "faults\n";
  for (const auto& [what, meaning] : fault_classes)
    text +=
        line(fmt::format("  {}", counted_names[static_cast<std::size_t>(what)]),
             count(what), meaning);
  std::size_t found = 0;
  std::string list;
  for (const auto& [seed, one] : log.seeds())
    if (!one.broken.empty()) {
      ++found;
      list += fmt::format("  {}: {}\n",
                          (findings / fmt::format("{}", seed)).string(),
                          one.broken);
    }
  return text + line("findings", fmt::format("{}", found)) + list;
}

} // namespace sofof::experiments::torture
