// What a learner has learned, as text that gives back the same bits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::policies {

/// Writes words, one space or one line end apart, and "end" as the last: a
/// text that is cut off is none. Numbers are the shortest that read back as the
/// same double.
class state_writer {
public:
  /// Starts with a line "sofof KIND VERSION".
  state_writer(std::string_view kind, std::uint64_t version);

  state_writer& line(); ///< Starts a new one.
  state_writer& word(std::string_view word);
  state_writer& count(std::uint64_t number);
  state_writer& number(double number);

  std::string text() const { return text_ + "\nend\n"; }

private:
  std::string text_;
};

/// Reads what a state_writer has written; spaces and line ends are alike.
/// After the first fault every read gives 0 and tells nothing more.
class state_reader {
public:
  /// Expects the line "sofof KIND VERSION".
  state_reader(std::string_view text, std::string_view kind,
               std::uint64_t version);

  /// @returns any word; an empty one is refused.
  std::string_view word();
  void expect(std::string_view word);
  /// Expects a whole number that is known already, e.g. a size.
  void expect(std::string_view word, std::uint64_t number);
  /// @returns a whole number from 0 to `most`; by default all that a double
  /// can count.
  std::uint64_t count(std::uint64_t most = 1ULL << 53);
  /// @returns a finite number.
  double number();
  void expect_end();

  /// Ends reading, unless it has ended already.
  /// @param reason  Goes after "line 3, word 12: ".
  void refuse(std::string_view reason);

  bool failed() const { return fault_.has_value(); }
  /// @returns a sentence that says what is wrong and where, if anything is.
  const std::optional<std::string>& fault() const { return fault_; }

  /// @returns what follows the "end" of this text; to be asked instead of
  /// `expect_end` where texts follow each other.
  std::string_view after_end();

private:
  std::string_view next();
  template <class Number>
  Number read(std::string_view wanted);

  std::string_view rest_;
  std::uint64_t words_read_ = 0;
  std::size_t line_ = 1; // of the last one
  std::optional<std::string> fault_;
};

/// @param part  Of `whole`.
/// @returns it with as many line ends before it as there, so that complaints
/// have the lines of the whole.
std::string placed_in(std::string_view whole, std::string_view part);

} // namespace sofof::policies
