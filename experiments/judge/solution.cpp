// A drive as a solution of CommonRoad.
#include "experiments/judge/solution.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

namespace sofof::experiments::judge {

namespace {

std::string escaped(std::string_view text) {
  std::string made;
  for (const auto c : text)
    switch (c) {
      case '&':
        made += "&amp;";
        break;
      case '<':
        made += "&lt;";
        break;
      case '>':
        made += "&gt;";
        break;
      case '"':
        made += "&quot;";
        break;
      default:
        // Control characters cannot be part of XML.
        made += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  return made;
}

} // namespace

std::string solution_xml(const std::string& benchmark,
                         const std::string& version, const std::string& problem,
                         std::span<const ks_state> states, point middle) {
  auto text =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                  "<CommonRoadSolution benchmark_id=\"KS2:SM1:{}:{}\">"
                  "\n  <ksTrajectory planningProblem=\"{}\">\n",
                  escaped(benchmark), escaped(version), escaped(problem));
  for (const auto& x : states) {
    const auto at = x.at + middle;
    fmt::format_to(std::back_inserter(text),
                   "    <ksState>\n      <x>{:.6f}</x>\n      <y>{:.6f}</y>\n"
                   "      <steeringAngle>{:.8f}</steeringAngle>\n"
                   "      <velocity>{:.6f}</velocity>\n"
                   "      <orientation>{:.8f}</orientation>\n"
                   "      <time>{}</time>\n    </ksState>\n",
                   at.x_m, at.y_m, x.steer_rad, x.speed_mps, x.heading_rad,
                   x.step);
  }
  return text + "  </ksTrajectory>\n</CommonRoadSolution>\n";
}

} // namespace sofof::experiments::judge
