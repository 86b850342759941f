// Every field that a schema has is there, as readers expect.
#include "experiments/convert/foxglove.hpp"

#include "base/text/json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace sofof::experiments::convert::foxglove {

namespace {

constexpr std::uint64_t ns_per_s = 1'000'000'000;

std::string time(std::uint64_t unix_ns) {
  return fmt::format(R"({{"sec":{},"nsec":{}}})", unix_ns / ns_per_s,
                     unix_ns % ns_per_s);
}

std::string position(point at) {
  return fmt::format(R"({{"x":{:.3f},"y":{:.3f},"z":0}})", at.x_m, at.y_m);
}

/// Round the axis that points up.
std::string orientation(double heading_rad) {
  return fmt::format(R"({{"x":0,"y":0,"z":{:.6f},"w":{:.6f}}})",
                     std::sin(heading_rad / 2), std::cos(heading_rad / 2));
}

std::string in_json(const colour& c) {
  return fmt::format(R"({{"r":{:g},"g":{:g},"b":{:g},"a":{:g}}})", c[0], c[1],
                     c[2], c[3]);
}

std::string in_json(const box& x) {
  auto middle = position(x.middle.at);
  const auto up = middle.rfind('0');
  middle.replace(up, 1, fmt::format("{:g}", x.height_m / 2));
  return fmt::format(R"({{"pose":{{"position":{},"orientation":{}}},)"
                     R"("size":{{"x":{:g},"y":{:g},"z":{:g}}},"color":{}}})",
                     middle, orientation(x.middle.heading_rad), x.length_m,
                     x.width_m, x.height_m, in_json(x.paint));
}

std::string in_json(const entity::line& x) {
  std::string points;
  for (const auto& p : x.points)
    points += (points.empty() ? "" : ",") + position(p);
  constexpr int strip = 0, loop = 1;
  return fmt::format(
      R"({{"type":{},"pose":{{"position":{},"orientation":{}}},)"
      R"("thickness":{:g},"scale_invariant":false,"points":[{}],)"
      R"("color":{},"colors":[],"indices":[]}})",
      x.is_closed ? loop : strip, position({}), orientation(0), x.width_m,
      points, in_json(x.paint));
}

template <class Part>
std::string list(std::span<const Part> all) {
  std::string text;
  for (const auto& one : all)
    text += (text.empty() ? "" : ",") + in_json(one);
  return text;
}

std::string quoted(std::string_view text) {
  std::string out;
  append_quoted(out, text);
  return out;
}

} // namespace

#define SOFOF_TIME                                                             \
  R"({"type":"object","properties":{"sec":{"type":"integer"},)"                \
  R"("nsec":{"type":"integer"}}})"

const schema frame_transforms{
    "foxglove.FrameTransforms",
    R"({"type":"object","properties":{"transforms":{"type":"array","items":)"
    R"({"type":"object","properties":{"timestamp":)" SOFOF_TIME
    R"(,"parent_frame_id":{"type":"string"},)"
    R"("child_frame_id":{"type":"string"},"translation":{"type":"object"},)"
    R"("rotation":{"type":"object"}}}}},"required":["transforms"]})"};

const schema scene_update{
    "foxglove.SceneUpdate",
    R"({"type":"object","properties":{"deletions":{"type":"array"},)"
    R"("entities":{"type":"array","items":{"type":"object","properties":)"
    R"({"timestamp":)" SOFOF_TIME R"(,"frame_id":{"type":"string"},)"
    R"("id":{"type":"string"},"lifetime":)" SOFOF_TIME
    R"(,"frame_locked":{"type":"boolean"},"metadata":{"type":"array"},)"
    R"("arrows":{"type":"array"},"cubes":{"type":"array"},)"
    R"("spheres":{"type":"array"},"cylinders":{"type":"array"},)"
    R"("lines":{"type":"array"},"triangles":{"type":"array"},)"
    R"("texts":{"type":"array"},"models":{"type":"array"}}}}},)"
    R"("required":["deletions","entities"]})"};

const schema location_fix{
    "foxglove.LocationFix",
    R"({"type":"object","properties":{"timestamp":)" SOFOF_TIME
    R"(,"frame_id":{"type":"string"},"latitude":{"type":"number"},)"
    R"("longitude":{"type":"number"},"altitude":{"type":"number"},)"
    R"("position_covariance":{"type":"array","items":{"type":"number"}},)"
    R"("position_covariance_type":{"type":"integer"}},)"
    R"("required":["latitude","longitude"]})"};

const schema log_message{
    "foxglove.Log",
    R"({"type":"object","properties":{"timestamp":)" SOFOF_TIME
    R"(,"level":{"type":"integer"},"message":{"type":"string"},)"
    R"("name":{"type":"string"},"file":{"type":"string"},)"
    R"("line":{"type":"integer"}},"required":["level","message"]})"};

const schema geo_json{
    "foxglove.GeoJSON",
    R"({"type":"object","properties":{"geojson":{"type":"string"}},)"
    R"("required":["geojson"]})"};

const schema vehicle_state{
    "sofof.VehicleState",
    R"({"type":"object","properties":{"speed_mps":{"type":"number"},)"
    R"("accel_mps2":{"type":"number"},"lateral_m":{"type":"number"},)"
    R"("plan_age_ms":{"type":"number"},"offloaded":{"type":"integer"}},)"
    R"("required":["speed_mps","offloaded"]})"};

const schema offloading_result{
    "sofof.OffloadingResult",
    R"({"type":"object","properties":{"service":{"type":"string"},)"
    R"("provider":{"type":"string"},"latency_ms":{"type":"number"},)"
    R"("used":{"type":"integer"}},"required":["latency_ms","used"]})"};

#undef SOFOF_TIME

std::string transform(std::uint64_t unix_ns, std::string_view frame,
                      const pose& of) {
  return fmt::format(
      R"({{"transforms":[{{"timestamp":{},"parent_frame_id":"map",)"
      R"("child_frame_id":{},"translation":{},"rotation":{}}}]}})",
      time(unix_ns), quoted(frame), position(of.at),
      orientation(of.heading_rad));
}

std::string scene(std::uint64_t unix_ns, std::span<const entity> entities) {
  std::string all;
  for (const auto& x : entities)
    fmt::format_to(
        std::back_inserter(all),
        R"({}{{"timestamp":{},"frame_id":"map","id":{},"lifetime":{},)"
        R"("frame_locked":true,"metadata":[],"arrows":[],"cubes":[{}],)"
        R"("spheres":[],"cylinders":[],"lines":[{}],"triangles":[],)"
        R"("texts":[],"models":[]}})",
        all.empty() ? "" : ",", time(unix_ns), quoted(x.id),
        time(static_cast<std::uint64_t>(
            std::llround(static_cast<double>(ns_per_s) * x.lifetime_s))),
        list(x.boxes), list(x.lines));
  return fmt::format(R"({{"deletions":[],"entities":[{}]}})", all);
}

std::string location(std::uint64_t unix_ns, double latitude_deg,
                     double longitude_deg) {
  return fmt::format(R"({{"timestamp":{},"frame_id":"map","latitude":{:.7f},)"
                     R"("longitude":{:.7f},"altitude":0,)"
                     R"("position_covariance":[0,0,0,0,0,0,0,0,0],)"
                     R"("position_covariance_type":0}})",
                     time(unix_ns), latitude_deg, longitude_deg);
}

std::string log(std::uint64_t unix_ns, level how, std::string_view name,
                std::string_view text) {
  return fmt::format(R"({{"timestamp":{},"level":{},"message":{},"name":{},)"
                     R"("file":"","line":0}})",
                     time(unix_ns), static_cast<int>(how), quoted(text),
                     quoted(name));
}

} // namespace sofof::experiments::convert::foxglove
