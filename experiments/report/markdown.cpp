// Sections, tables, and the points of figures.
#include "experiments/report/markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace sofof::experiments::report {

namespace {

/// Figures with more points than this are for eyes, not for tables.
constexpr std::size_t most_points = 20;

std::string cell(std::string_view text) {
  std::string safe;
  for (const auto c : text)
    (c == '|' ? safe += "\\|" : safe += c);
  return safe;
}

void row(std::string& out, const std::vector<std::string>& cells) {
  out += '|';
  for (const auto& text : cells)
    out += fmt::format(" {} |", cell(text));
  out += '\n';
}

void write(std::string& out, const table& t) {
  out += fmt::format("**{}**\n\n", t.title);
  row(out, t.columns);
  row(out, std::vector<std::string>(t.columns.size(), "---"));
  for (const auto& cells : t.rows)
    row(out, cells);
  out += '\n';
  if (!t.note.empty())
    out += t.note + "\n\n";
}

/// A number with three places at most, without zeros at its end.
std::string number(double x) {
  auto text = fmt::format("{:.3f}", x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.'))
    text.pop_back();
  return text;
}

std::string value_at(const curve& c, double x) {
  const auto found = std::ranges::lower_bound(c.x, x);
  if (found == c.x.end() || *found != x)
    return "";
  const auto i = static_cast<std::size_t>(found - c.x.begin());
  return std::isfinite(c.y[i]) ? number(c.y[i]) : "";
}

void write(std::string& out, const figure& f) {
  std::set<double> places;
  for (const auto& c : f.curves)
    places.insert(c.x.begin(), c.x.end());
  if (places.size() > most_points) {
    out += fmt::format("*{}: see the figure in the report.*\n\n", f.title);
    return;
  }
  auto note = f.caption;
  const auto add = [&note](const std::string& sentence) {
    note += (note.empty() ? "" : " ") + sentence;
  };
  for (const auto& [at, name] : f.marks)
    add(fmt::format("Upright line at {}: {}.", number(at), name));
  for (const auto& [at, name] : f.levels)
    add(fmt::format("Level line at {}: {}.", number(at), name));
  table points{f.title + " (" + f.y_label + ")", {f.x_label}, {}, note};
  for (const auto& c : f.curves)
    points.columns.push_back(c.name);
  for (const auto x : places) {
    auto& cells = points.rows.emplace_back();
    cells.push_back(number(x));
    for (const auto& c : f.curves)
      cells.push_back(value_at(c, x));
  }
  write(out, points);
}

void write(std::string& out, const scatter& s) {
  table points{s.title, {"", s.x_label, s.y_label}, {}, s.caption};
  for (const auto& one : s.dots)
    points.rows.push_back({one.name, number(one.x), number(one.y)});
  write(out, points);
}

void write(std::string& out, const paragraph& p) {
  out += p.text + "\n\n";
}

void write(std::string&, const drive&) {}
void write(std::string&, const listing&) {}

} // namespace

std::string markdown(const document& what) {
  auto out = fmt::format("# {}\n{}\n\n", what.title, what.subtitle);
  for (const auto& section : what.sections) {
    out += fmt::format("## {}\n\n", section.title);
    for (const auto& block : section.blocks)
      std::visit([&out](const auto& x) { write(out, x); }, block);
  }
  out.pop_back(); // one line end is enough
  return out;
}

} // namespace sofof::experiments::report
