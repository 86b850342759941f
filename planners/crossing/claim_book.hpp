// What a vehicle claims of a crossing, what the others claim, and when it may
// rely on its own claim.
#pragma once

#include "planners/scene/told_drive.hpp"

#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// The claim of one vehicle. A drive is claimed, then it binds, and it stays
/// the vehicle's until it is over or given up; nobody else can change it.
///
/// A claim binds once a message of each vehicle that matters is there which
/// was generated after it was made (by more than clocks may differ), and none
/// of them claims what overlaps. All messages of a vehicle tell what it claims.
/// So of two overlapping claims at most one binds, whatever is lost, late or
/// out of order, and whoever proposed them, as long as each vehicle hears each
/// other one that matters once in `memory`: be one made at a, the other at
/// b >= a. For the latter to bind, a message of the first vehicle generated
/// after b is needed, and that one tells of the claim made at a, or it is given
/// up. (Two flags, as Dekker's; in Raynal, Concurrent Programming, 2013,
/// section 2.1.2.)
class claim_book {
public:
  struct rules {
    duration clock_error = std::chrono::milliseconds{5}; ///< Of any clock.
    /// What lies between two vehicles at one place.
    duration apart = std::chrono::milliseconds{500};
    /// Whoever was heard within this time matters.
    duration memory = std::chrono::seconds{2};
    /// What does not bind for so long is given up.
    duration patience = std::chrono::seconds{1};
  };

  enum class state : unsigned char { free, claimed, bound };

  explicit claim_book(station_id me) : claim_book(me, rules{}) {}
  claim_book(station_id me, rules r) : me_{me}, rules_{r} {}

  /// Claims a drive in place of the one before, if any: so the vehicle must be
  /// able to stop. The same again changes nothing.
  /// @param needed  Whose consent is needed, besides that of everybody who is
  ///                heard and matters.
  /// @returns false, and changes nothing, where it overlaps what others claim.
  bool claim(time_point now, const claimed_drive& drive,
             std::span<const station_id> needed);

  /// Takes what another vehicle tells, in any order.
  /// @param matters  It may come to where the own vehicle goes.
  void on_report(time_point now, const crossing_claim& told, bool matters);

  /// Gives up what was claimed in vain or is over, and forgets others.
  void pass_time(time_point now);

  /// Gives up the claim: the vehicle can stop, or will not come there.
  void give_up();

  state is() const {
    return !own_ ? state::free : binds_ ? state::bound : state::claimed;
  }

  /// @returns what is claimed, binding or not; null if nothing is.
  const claimed_drive* own() const { return own_ ? &*own_ : nullptr; }

  /// @returns what to tell now.
  crossing_claim tell(time_point now) const { return {me_, now, own_}; }

  /// Another vehicle as it was heard last.
  struct other {
    crossing_claim told;
    bool matters = false;
  };
  std::span<const other> others() const { return others_; }

  /// @returns whether a drive overlaps what others claim.
  bool is_closed(const claimed_drive& drive) const;

private:
  bool is_apart(const claimed_drive& a, const claimed_drive& b) const;
  bool has_consented(station_id who) const;
  void bind_if_all_consent(time_point now);

  station_id me_;
  rules rules_;
  std::optional<claimed_drive> own_;
  bool binds_ = false;
  time_point claimed_at_;
  std::vector<station_id> needed_;
  std::vector<other> others_;
};

} // namespace sofof::planners
