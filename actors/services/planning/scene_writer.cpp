// Scenes as scene messages, rounded to the cautious side: written.
#include "actors/services/planning/scene_units.hpp"
#include "actors/services/planning/scene_words.hpp"
#include "messages/v2x/encoded.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace sofof::actors {
namespace {

using messages::scene_message;
namespace told = messages::scene;
using namespace scene_units;

/// Writes a scene down as long as everything fits.
class scene_writer {
public:
  /// @param late_s  So long before the scene is the message's reference time.
  scene_writer(double own_s_m, double late_s)
      : own_s_m_{own_s_m}, late_s_{late_s} {
    assert(late_s_ >= 0);
  }

  bool fits() const { return fits_; }

  void write(const planners::driving_scene& scene, told::content& out) {
    out.is_impatient = scene.is_impatient;
    if (scene.lead)
      out.lead = lead(*scene.lead, scene.lead_told);
    else
      fits_ = fits_ && scene.lead_told.empty();
    list(scene.crossings, out.crossings,
         [this](const auto& x) { return crossing(x); });
    list(scene.beside, out.beside, [this](const auto& x) { return body(x); });
    std::sort(out.beside.begin(), out.beside.end(), // rounding may swap them
              [](const auto& a, const auto& b) {
                return std::pair{a.along.from.value, a.low.value}
                       < std::pair{b.along.from.value, b.low.value};
              });
    list(scene.yields_m, out.yields, [this](double s_m) {
      return number<told::arc_length>(length.below(s_m - own_s_m_));
    });
    list(scene.keep_free, out.keep_free,
         [this](const auto& x) { return stretch(x.from_m, x.to_m); });
  }

private:
  template <class Number>
  Number number(double units) {
    if (units >= static_cast<double>(Number::low)
        && units <= static_cast<double>(Number::high)) // NaN is not
      return {static_cast<typename Number::number>(units)};
    fits_ = false;
    return {};
  }

  void list(const auto& from, auto& to, const auto& written) {
    if (from.size() > std::remove_reference_t<decltype(to)>::high) {
      fits_ = false;
      return;
    }
    for (const auto& x : from)
      to.push_back(written(x));
  }

  told::stretch stretch(double from_m, double to_m) {
    const auto from = length.below(from_m - own_s_m_);
    const auto to = length.above(to_m - own_s_m_);
    return {number<told::arc_length>(from),
            number<decltype(told::stretch::length)>(to - from)};
  }

  told::lead lead(const planners::lead_vehicle& x,
                  const std::vector<planners::way_moment>& moments) {
    told::lead out;
    if (x.station)
      out.station = x.station->value();
    const auto rear =
        length.below(x.rear_s_m - own_s_m_ - late_s_ * x.speed_mps);
    out.rear = number<told::arc_length>(rear);
    out.speed = number<decltype(out.speed)>(lead_speed.below(x.speed_mps));
    out.accel = number<decltype(out.accel)>(lead_accel.below(x.accel_mps2));
    if (moments.empty())
      return out;
    auto at = rear, time = 0.0;
    list(moments, out.told.emplace(), [&](const planners::way_moment& m) {
      const auto next = length.below(m.s_m - own_s_m_);
      const auto then = instant.above(m.t_s + late_s_);
      told::lead_moment moment;
      moment.way = number<decltype(moment.way)>(next - std::exchange(at, next));
      moment.time.value =
          number<decltype(moment.time.value)>(then - std::exchange(time, then));
      return moment;
    });
    return out;
  }

  told::crossing crossing(const planners::crossing_user& x) {
    told::crossing out;
    out.on = stretch(x.from_m, x.to_m);
    const auto latest = static_cast<double>(decltype(out.enter)::high);
    const auto enter = std::min(instant.below(x.enter_s + late_s_), latest);
    const auto stay = instant.above(x.leave_s + late_s_) - enter;
    out.enter = number<decltype(out.enter)>(enter);
    out.stay = number<decltype(out.stay)>(
        stay > told::stays_for_ever ? told::stays_for_ever : stay);
    out.goes_first = x.goes_first;
    const auto brakes = braking.above(x.brakes_mps2);
    out.brakes = number<decltype(out.brakes)>(
        brakes > told::brakes_beyond ? told::brakes_beyond : brakes);
    out.body = number<decltype(out.body)>(x.body);
    return out;
  }

  told::body_beside body(const planners::lane_obstacle& x) {
    told::body_beside out;
    const auto speed = beside_speed.near(x.speed_mps);
    const auto drift_m =
        covered_s * std::abs(x.speed_mps - beside_speed.si(speed));
    const auto moved_m = -late_s_ * x.speed_mps;
    out.along =
        stretch(x.from_m + moved_m - drift_m, x.to_m + moved_m + drift_m);
    const auto low = lateral.below(x.low_m), high = lateral.above(x.high_m);
    const auto grown_m =
        std::max(x.low_m - lateral.si(low), lateral.si(high) - x.high_m);
    out.low = number<told::lateral_offset>(low);
    out.high = number<told::lateral_offset>(high);
    out.speed.value = number<decltype(out.speed.value)>(speed);
    const auto lacks_m = x.lacks_m > 0 ? x.lacks_m + grown_m : x.lacks_m;
    out.lacks.value = number<decltype(out.lacks.value)>(lateral.above(lacks_m));
    const auto most = static_cast<double>(decltype(out.left.value)::high);
    out.left.value = number<decltype(out.left.value)>(
        std::min(lateral.below(x.left_m), most));
    return out;
  }

  double own_s_m_, late_s_;
  bool fits_ = true;
};

} // namespace

messages::its_pdu make_scene_words(const planners::driving_scene& scene,
                                   const scene_place& own,
                                   const messages::georeference& where) {
  using std::chrono::milliseconds;
  const auto its = where.clock.timestamp(own.at);
  const auto reference = where.clock.time(its);
  const auto late = own.at - reference;
  if (own.at != scene.at || own.seen > own.at || late < duration::zero()
      || late >= milliseconds{1} || !std::isfinite(own.s_m)
      || !(std::hypot(own.position.x_m, own.position.y_m) < farthest_m))
    return {};
  scene_message message;
  auto& body = message.body;
  const auto age = std::chrono::ceil<milliseconds>(
      std::max(reference - own.seen, duration::zero()));
  if (age > milliseconds{decltype(body.age)::high})
    return {};
  message.header.station = own.station.value();
  body.generation = messages::etsi::to_delta_time(its);
  body.age = static_cast<decltype(body.age)::number>(age.count());
  const auto at = where.frame.to_wgs84(own.position);
  body.reference = {at.latitude, at.longitude};
  scene_writer writer{own.s_m, to_seconds(late)};
  writer.write(scene, body);
  if (!writer.fits() || !is_in_order(body))
    return {};
  return messages::encoded(message);
}

} // namespace sofof::actors
