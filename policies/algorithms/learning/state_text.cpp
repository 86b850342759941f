// What a learner has learned, as text that gives back the same bits.
#include "policies/algorithms/learning/state_text.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace sofof::policies {

namespace {

constexpr std::string_view between_words = " \n";
constexpr std::size_t longest_quote = 24;

template <class Number>
std::string digits(Number number) {
  std::array<char, 32> buffer; // the longest double has 24
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return {buffer.data(), end};
}

std::string quoted(std::string_view word) {
  return "\"" + std::string{word.substr(0, longest_quote)} + "\"";
}

} // namespace

state_writer::state_writer(std::string_view kind, std::uint64_t version) {
  text_ = "sofof";
  word(kind).count(version);
}

state_writer& state_writer::line() {
  text_ += '\n';
  return *this;
}

state_writer& state_writer::word(std::string_view word) {
  if (!text_.ends_with('\n'))
    text_ += ' ';
  text_ += word;
  return *this;
}

state_writer& state_writer::count(std::uint64_t number) {
  return word(digits(number));
}

state_writer& state_writer::number(double number) {
  return word(digits(number));
}

state_reader::state_reader(std::string_view text, std::string_view kind,
                           std::uint64_t version)
    : rest_{text} {
  expect("sofof");
  expect(kind, version);
}

std::string_view state_reader::word() {
  const auto found = next();
  if (found.empty())
    refuse("expected a word.");
  return found;
}

std::string_view state_reader::after_end() {
  expect("end");
  return failed() ? std::string_view{} : rest_;
}

void state_reader::expect(std::string_view word) {
  const auto found = next();
  if (found != word)
    refuse("expected " + quoted(word) + ", found " + quoted(found) + ".");
}

void state_reader::expect(std::string_view word, std::uint64_t number) {
  expect(word);
  const auto found = count();
  if (found != number)
    refuse("expected " + std::string{word} + ' ' + digits(number) + ", found "
           + digits(found) + ".");
}

std::uint64_t state_reader::count(std::uint64_t most) {
  const auto number = read<std::uint64_t>("a whole number");
  if (number <= most)
    return number;
  refuse("expected at most " + digits(most) + '.');
  return 0;
}

double state_reader::number() {
  const auto number = read<double>("a number");
  if (std::isfinite(number))
    return number;
  refuse("expected a finite number.");
  return 0;
}

void state_reader::expect_end() {
  expect("end");
  expect("");
}

void state_reader::refuse(std::string_view reason) {
  if (!failed())
    fault_ = "line " + digits(line_) + ", word " + digits(words_read_) + ": "
             + std::string{reason};
}

std::string_view state_reader::next() {
  if (failed())
    return {};
  const auto blanks = rest_.substr(
      0, std::min(rest_.find_first_not_of(between_words), rest_.size()));
  line_ += static_cast<std::size_t>(std::ranges::count(blanks, '\n'));
  rest_.remove_prefix(blanks.size());
  const auto word = rest_.substr(
      0, std::min(rest_.find_first_of(between_words), rest_.size()));
  rest_.remove_prefix(word.size());
  ++words_read_;
  return word;
}

template <class Number>
Number state_reader::read(std::string_view wanted) {
  const auto word = next();
  Number number{};
  const auto end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  if (error == std::errc{} && rest == end)
    return number;
  refuse("expected " + std::string{wanted} + ", found " + quoted(word) + ".");
  return 0;
}

std::string placed_in(std::string_view whole, std::string_view part) {
  assert(whole.data() <= part.data());
  assert(part.data() + part.size() <= whole.data() + whole.size());
  const auto before =
      whole.substr(0, static_cast<std::size_t>(part.data() - whole.data()));
  const auto lines = std::ranges::count(before, '\n');
  return std::string(static_cast<std::size_t>(lines), '\n').append(part);
}

} // namespace sofof::policies
