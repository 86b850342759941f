// Which bodies that stations tell of are not there: what those say who look
// at the place.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "planners/plausibility/motion_check.hpp"
#include "planners/plausibility/reputation.hpp"
#include "planners/plausibility/station_doubt.hpp"
#include "planners/plausibility/testimony.hpp"
#include "planners/plausibility/witness.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "planners/scene/track.hpp"
#include "world/roads/road_map.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// Weighs what stations tell of themselves (CAM) and of others (CPM) by who
/// else sees it.
///
/// * A witness is a sensor of the provider or a vehicle that sends CPMs. It
///   confirms a body that it tells of, unless that is known from the same
///   sender only. It denies a body that it does not tell of though it would
///   have seen it (`witness::overlooks`). A vehicle that is planned for denies
///   at once what it would have seen before anybody told of it: bodies do not
///   come from nowhere. Nobody denies what its own sender alone tells of.
/// * A body is doubted for all vehicles, or for the one that denies it itself,
///   as `testimony` says: a vehicle that lies about what it sees harms but
///   itself. A vanished body, which is not told of any more, is not doubted
///   but forgotten.
/// * Who confirms outweighs who denies: what others see is avoided, and so is
///   what no witness can see.
/// * Who has told of a doubted body (`reputation`) is not given time again:
///   what lies open has to be confirmed at once.
/// * A station that jumps is not heard until it is steady (`steady_word`).
/// * A body that reaches half a second long by 1 m into one that is confirmed
///   is doubted, if it is not confirmed itself.
class plausibility {
public:
  /// @param houses  Hide what is behind them.
  explicit plausibility(std::span<const world::building> houses = {});

  /// A station tells where it is.
  /// @returns whether that is to be believed.
  bool on_report(station_id who, sender_id from, const timed_body& self);

  /// A vehicle tells of bodies that it sees: takes out those that jump.
  /// @param ids     Their numbers.
  void sift(station_id who, time_point at, std::vector<std::uint32_t>& ids,
            std::vector<world::perceived_object>& bodies);

  /// Somebody has looked at the road. To be called once the tracks know.
  void judge(const road_observer& who, const road_look& look,
             std::span<const track> tracks);

  /// Copies the tracks that are believed.
  /// @param planned  For whom; what it sees itself counts for it alone.
  void believed(time_point now, std::optional<station_id> planned,
                std::span<const track> tracks, std::vector<track>& out);

  /// @returns whether what a station tells of itself is doubted for all.
  bool doubts(station_id who) const;

  /// @returns what has changed since the last call, the oldest first.
  std::vector<station_doubt> news(time_point now);

private:
  struct witness_record {
    road_observer who{};
    witness is{};
    std::map<std::uint32_t, steady_word> words{}; // of CPMs, by object
    time_point heard{};
    time_point since; // of its first look
  };
  struct station_record {
    sender_id sender = 0;
    steady_word word;
    time_point heard;
    bool jumps = false;
    std::optional<time_point> doubted; // last, if news have told
  };
  struct body_record { // of a track
    std::uint32_t id = 0;
    station_id station = 0; // who tells of it; 0: a sensor of ours
    bool is_named = false;  // it tells of itself
    time_point born{};
    testimony said{};
    std::optional<time_point> overlaps_since{};
    bool overlaps = false;       // for long
    bool is_out_for_all = false; // doubted, as of the last look

    /// @returns whether it may be doubted.
    bool is_suspect() const { return said.is_denied() || overlaps; }
  };

  void follow(const witness_record& w, std::span<const track> tracks);
  void judge(const witness_record& w, const track& x, body_record& r);
  std::optional<time_point> find_birth(std::uint32_t id) const;
  bool comes_from_nowhere(const witness_record& w, const track& x,
                          std::optional<time_point> born) const;
  void check_overlap(const track& x, body_record& r, time_point now,
                     std::span<const track> tracks);
  static bool speaks_for_itself(const witness_record& w, const body_record& r);
  bool is_doubted(const track& x, const body_record& r, time_point now,
                  std::optional<station_id> planned) const;
  bool comes_from_liar(const track& x, const body_record& r, time_point now,
                       std::optional<station_id> planned) const;
  void note(const body_record& r, time_point at, doubt_check check,
            double value, double limit, station_id by);
  void note(station_id who, time_point at, doubt_check check, double value,
            double limit);
  void tidy(time_point now);
  body_record new_record(const track& x) const;
  const witness_record* find_witness(station_id vehicle) const;

  line_of_sight houses_;
  std::map<std::uint64_t, witness_record> witnesses_;
  std::map<station_id, station_record> stations_;
  std::vector<body_record> bodies_, before_; // in order of id
  reputation senders_;
  std::vector<station_doubt> news_;
  time_point tidied_;
  std::vector<std::uint32_t> from_nowhere_; // for who looks just now
  time_point newest_;                       // when the newest body was born
  bool has_suspects_ = false;               // a body that is denied or overlaps
};

} // namespace sofof::planners
