// Which bodies that stations tell of are not there.
#include "planners/plausibility/plausibility.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sofof::planners {

namespace {

using namespace std::chrono_literals;

/// Who has been silent for longer is forgotten, ...
constexpr duration forgotten_after = 10s;
/// ... and a station is believed again, of which nothing was doubted so long.
constexpr duration cleared_after = 10s;
constexpr duration tidy_period = 1s;

/// Nobody has more round him; more are made up.
constexpr std::size_t most_stations = 10'000;
/// Objects of one station; as many as a CPM can number.
constexpr std::size_t most_words = 256;

/// Objects of CPMs are seen with noise: a jump is farther than that.
constexpr auto seen_jump_m = 5.0;

/// A body has to be told of at least so often to be denied.
constexpr duration told_of = 1250ms;
/// It is told of again when its message was made after that of who denies it.
constexpr duration retold_after = 50ms;
/// So long a body must have been told of before it is denied.
constexpr duration open_for = 300ms;
/// Who has looked longer ago does not know where it came from.
constexpr duration known_for = 1250ms;

/// What is so deep in another body, so long, is not beside it.
constexpr auto depth_m = 1.0;
constexpr duration overlaps_for = 500ms;

std::uint64_t key_of(const road_observer& who) {
  return std::uint64_t{who.is_ours} << 32 | who.number;
}

oriented_box shrunk(oriented_box x) {
  x.length_m = std::max(x.length_m - depth_m, 0.1);
  x.width_m = std::max(x.width_m - depth_m, 0.1);
  return x;
}

} // namespace

plausibility::plausibility(std::span<const world::building> houses)
    : houses_{houses} {}

bool plausibility::on_report(station_id who, sender_id from,
                             const timed_body& self) {
  if (stations_.size() >= most_stations && !stations_.contains(who))
    return true;
  auto& x = stations_[who];
  x.sender = from;
  x.heard = self.at;
  assert(stations_.size() <= most_stations);
  const auto off_m = x.word.check(self);
  assert(off_m >= 0);
  x.jumps = off_m > 0;
  if (x.jumps)
    note(who, self.at, doubt_check::jump, off_m, 0);
  return !x.jumps;
}

void plausibility::sift(station_id who, time_point at,
                        std::vector<std::uint32_t>& ids,
                        std::vector<world::perceived_object>& bodies) {
  const auto known = witnesses_.find(key_of({who.value()}));
  if (known == witnesses_.end())
    return; // its first look is about to make it known
  auto& words = known->second.words;
  if (words.size() > most_words)
    words.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto off_m =
        i < ids.size() ? words[ids[i]].check({at, bodies[i]}) : 0;
    if (off_m > seen_jump_m) {
      note(who, at, doubt_check::jump, off_m, seen_jump_m);
      continue;
    }
    assert(kept <= i);
    bodies[kept] = bodies[i];
    if (i < ids.size())
      ids[kept] = ids[i];
    ++kept;
  }
  assert(kept <= bodies.size() && words.size() <= most_words + bodies.size());
  bodies.resize(kept);
  ids.resize(std::min(ids.size(), kept));
}

void plausibility::judge(const road_observer& who, const road_look& look,
                         std::span<const track> tracks) {
  assert(std::ranges::is_sorted(tracks, {}, &track::id));
  if (witnesses_.size() >= most_stations && !witnesses_.contains(key_of(who)))
    return;
  auto& w =
      witnesses_.try_emplace(key_of(who), witness_record{.since = look.at})
          .first->second;
  if (look.at < w.is.at())
    return; // overtaken on its way
  w.who = who;
  w.heard = look.at;
  from_nowhere_.clear();
  for (const auto& x : tracks)
    if (comes_from_nowhere(w, x, find_birth(x.id)))
      from_nowhere_.push_back(x.id);
  w.is.look(look);
  follow(w, tracks);
  assert(bodies_.size() == tracks.size());
  has_suspects_ = false;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    auto& r = bodies_[i];
    judge(w, tracks[i], r);
    if (r.is_named && !r.said.is_confirmed(look.at))
      check_overlap(tracks[i], r, look.at, tracks);
    r.is_out_for_all = is_doubted(tracks[i], r, look.at, std::nullopt);
    has_suspects_ = has_suspects_ || r.is_suspect();
  }
  tidy(look.at);
}

/// @returns when a body was first told of; nullopt for one that has appeared
/// since the last look.
std::optional<time_point> plausibility::find_birth(std::uint32_t id) const {
  const auto r = std::ranges::lower_bound(bodies_, id, {}, &body_record::id);
  return r != bodies_.end() && r->id == id ? std::optional{r->born}
                                           : std::nullopt;
}

/// Whether it was not there when the witness looked last, before anybody told
/// of it.
bool plausibility::comes_from_nowhere(const witness_record& w, const track& x,
                                      std::optional<time_point> born) const {
  const auto looked = w.is.at();
  assert(!born || find_birth(x.id) == born);
  return (!born || *born > looked) && x.seen >= looked
         && looked - w.since >= known_for && x.station != w.who.number
         && w.is.overlooked(x, houses_);
}

/// Keeps a record of each track, and of no other.
void plausibility::follow(const witness_record& w,
                          std::span<const track> tracks) {
  assert(std::ranges::is_sorted(bodies_, {}, &body_record::id));
  std::swap(bodies_, before_);
  bodies_.clear();
  auto old = before_.begin();
  for (const auto& x : tracks) {
    while (old != before_.end() && old->id < x.id)
      ++old;
    if (old != before_.end() && old->id == x.id) {
      bodies_.push_back(std::move(*old++));
    } else {
      bodies_.push_back({.id = x.id, .born = x.seen});
      newest_ = std::max(newest_, x.seen);
      auto& r = bodies_.back();
      if (!w.who.is_ours) {
        r.station = w.who.number;
        r.said.teller(w.who.sender);
      }
    }
    auto& r = bodies_.back();
    assert(r.id == x.id);
    r.is_named = x.station.has_value();
    if (!r.is_named)
      continue;
    r.station = *x.station;
    const auto known = stations_.find(*x.station);
    if (known != stations_.end())
      r.said.teller(known->second.sender);
  }
}

/// Whether a witness would deny what nobody but its own sender tells of: that
/// is no lie about others, but a gap in what it says of itself.
bool plausibility::speaks_for_itself(const witness_record& w,
                                     const body_record& r) {
  return !w.who.is_ours && r.said.teller() == w.who.sender;
}

void plausibility::judge(const witness_record& w, const track& x,
                         body_record& r) {
  const auto at = w.is.at();
  assert(r.id == x.id && r.is_named == x.station.has_value());
  if (!w.who.is_ours
      && (r.is_named ? *x.station == w.who.number : w.is.stands_in(x)))
    return; // itself
  const auto seen = w.is.look_at(x);
  if (seen == witness::sight::same)
    r.said.confirm(w.who, at);
  if (seen != witness::sight::nothing || speaks_for_itself(w, r))
    return;
  const auto is_new =
      at - r.born < open_for
      && std::ranges::find(from_nowhere_, x.id) == from_nowhere_.end();
  if (at - x.seen > told_of || is_new || !w.is.overlooks(x, houses_))
    return;
  r.said.deny(w.who, at, w.is.is_sure(houses_));
  assert(r.said.is_denied());
  const auto by = w.who.is_ours ? reputation::everybody : w.who.number;
  if (is_doubted(x, r, at, by))
    note(r, at, doubt_check::sight, to_seconds(at - r.born),
         to_seconds(open_for),
         r.said.is_denied_for_all() ? reputation::everybody : by);
}

void plausibility::check_overlap(const track& x, body_record& r, time_point now,
                                 std::span<const track> tracks) {
  assert(r.id == x.id && r.is_named);
  assert(bodies_.size() == tracks.size());
  const auto mine = shrunk(predict(x, now).body());
  const auto is_in = [&](std::size_t i) {
    const auto& other = tracks[i];
    return other.id != x.id && distance_m(other.centre(), x.centre()) < 30
           && i < bodies_.size() && bodies_[i].said.is_confirmed(now)
           && overlap(mine, shrunk(predict(other, now).body()));
  };
  auto overlaps = false;
  for (std::size_t i = 0; i < tracks.size() && !overlaps; ++i)
    overlaps = is_in(i);
  if (!overlaps) {
    r.overlaps_since.reset();
    r.overlaps = false;
    return;
  }
  if (!r.overlaps_since)
    r.overlaps_since = now;
  r.overlaps =
      now - *r.overlaps_since >= overlaps_for && x.seen > *r.overlaps_since;
  if (r.overlaps)
    note(r, now, doubt_check::overlap, to_seconds(now - *r.overlaps_since),
         to_seconds(overlaps_for), reputation::everybody);
}

bool plausibility::is_doubted(const track& x, const body_record& r,
                              time_point now,
                              std::optional<station_id> planned) const {
  assert(r.id == x.id);
  assert(!r.overlaps || r.overlaps_since);
  if (r.said.is_confirmed(now))
    return false;
  if (r.overlaps)
    return true;
  if (r.said.was_ever_confirmed()
      && x.seen < r.said.first_denied() + retold_after)
    return false; // it may just have gone
  return r.said.is_denied_for_all()
         || (planned && r.said.is_denied_by(*planned));
}

bool plausibility::comes_from_liar(const track& x, const body_record& r,
                                   time_point now,
                                   std::optional<station_id> planned) const {
  assert(r.id == x.id);
  const auto sender = r.said.teller();
  if (!sender || r.said.is_confirmed(now))
    return false;
  const auto by = planned.value_or(reputation::everybody);
  if (!senders_.is_distrusted(*sender, by, now))
    return false;
  return std::ranges::any_of(witnesses_, [&](const auto& entry) {
    const auto& w = entry.second;
    return (w.who.is_ours || (planned && w.who.number == *planned))
           && !speaks_for_itself(w, r)
           && w.is.look_at(x) == witness::sight::nothing
           && w.is.would_see(x, houses_, now);
  });
}

/// A record for a track that has appeared since the last look: only its sender
/// is known.
plausibility::body_record plausibility::new_record(const track& x) const {
  body_record r{.id = x.id};
  if (!x.station)
    return r;
  if (const auto s = stations_.find(*x.station); s != stations_.end()) {
    r.station = *x.station;
    r.said.teller(s->second.sender);
  }
  return r;
}

void plausibility::believed(time_point now, std::optional<station_id> planned,
                            std::span<const track> tracks,
                            std::vector<track>& out) {
  assert(std::ranges::is_sorted(tracks, {}, &track::id));
  assert(out.empty() || out.data() != tracks.data());
  out.clear();
  const auto* own = planned ? find_witness(*planned) : nullptr;
  const auto has_new = own && !tracks.empty() && now - own->is.at() <= known_for
                       && (bodies_.empty() || newest_ > own->is.at()
                           || tracks.back().id > bodies_.back().id);
  if (!has_suspects_ && !has_new && !senders_.has_liars(now)) {
    out.assign(tracks.begin(), tracks.end());
    return;
  }
  const auto believes = [&](const track& x, const body_record& r,
                            std::optional<time_point> born) {
    assert(r.id == x.id && (!has_new || own));
    if (r.is_suspect() && is_doubted(x, r, now, planned))
      return false;
    // A track before this one may just have made its sender a liar.
    if (senders_.has_liars(now) && comes_from_liar(x, r, now, planned)) {
      note(r.station, now, doubt_check::sender, 0, 0);
      return false;
    }
    if (has_new && !speaks_for_itself(*own, r)
        && comes_from_nowhere(*own, x, born) && !r.said.is_confirmed(now)) {
      note(r, now, doubt_check::sight, to_seconds(now - own->is.at()), 0,
           *planned);
      return false;
    }
    return true;
  };
  auto r = bodies_.begin();
  for (const auto& x : tracks) {
    while (r != bodies_.end() && r->id < x.id)
      ++r;
    const auto is_known = r != bodies_.end() && r->id == x.id;
    const auto is_own = planned && x.station == planned;
    if (is_own
        || (is_known ? believes(x, *r, r->born)
                     : believes(x, new_record(x), std::nullopt)))
      out.push_back(x);
  }
}

const plausibility::witness_record*
plausibility::find_witness(station_id vehicle) const {
  const auto found = witnesses_.find(key_of({vehicle.value()}));
  return found != witnesses_.end() ? &found->second : nullptr;
}

bool plausibility::doubts(station_id who) const {
  const auto x = stations_.find(who);
  if (x != stations_.end() && x->second.jumps)
    return true;
  return std::ranges::any_of(bodies_, [&](const body_record& r) {
    return r.is_named && r.station == who && r.is_out_for_all;
  });
}

void plausibility::note(const body_record& r, time_point at, doubt_check check,
                        double value, double limit, station_id by) {
  if (const auto sender = r.said.teller())
    senders_.blame(*sender, by, at);
  note(r.station, at, check, value, limit);
}

void plausibility::note(station_id who, time_point at, doubt_check check,
                        double value, double limit) {
  if (stations_.size() >= most_stations && !stations_.contains(who))
    return;
  auto& x = stations_[who];
  if (!x.doubted)
    news_.push_back({at, who, true, check, value, limit});
  x.doubted = at;
}

std::vector<station_doubt> plausibility::news(time_point now) {
  tidy(now);
  return std::exchange(news_, {});
}

void plausibility::tidy(time_point now) {
  if (now - tidied_ < tidy_period)
    return;
  tidied_ = now;
  for (auto& [who, x] : stations_)
    if (x.doubted && now - *x.doubted > cleared_after) {
      x.doubted.reset();
      news_.push_back({now, who, false});
    }
  std::erase_if(stations_, [&](const auto& x) {
    return now - x.second.heard > forgotten_after && !x.second.doubted;
  });
  assert(stations_.size() <= most_stations);
  assert(witnesses_.size() <= most_stations);
  std::erase_if(witnesses_, [&](const auto& x) {
    return now - x.second.heard > forgotten_after;
  });
  senders_.tidy(now);
}

} // namespace sofof::planners
