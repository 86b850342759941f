// Puts a document into the page.
#include "experiments/report/html.hpp"

#include "base/files/output_file.hpp"
#include "experiments/report/compressed.hpp"
#include "experiments/report/delta_encoding.hpp"
#include "experiments/report/drive_json.hpp"
#include "experiments/report/page.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace sofof::experiments::report {

namespace {

using nlohmann::json;

constexpr std::string_view style_names[]{"line", "points", "steps", "tail"};
constexpr std::string_view meaning_names[]{"any", "measured", "allowed",
                                           "admitted"};
constexpr std::string_view verdict_names[]{"different", "same", "better",
                                           "worse"};

/// A line through a single point would not be seen.
curve::style style_of(const curve& x) {
  const auto points =
      std::ranges::count_if(x.y, [](double y) { return std::isfinite(y); });
  return x.drawn == curve::style::line && points == 1 ? curve::style::points
                                                      : x.drawn;
}

json to_json(const curve& x) {
  json all{{"name", x.name},
           {"x", delta_encoding(x.x)},
           {"style", style_names[static_cast<std::size_t>(style_of(x))]},
           {"dashed", x.dashed}};
  // The page reckons the shares of a tail, of all vehicles or of one.
  if (x.drawn != curve::style::tail)
    all["y"] = delta_encoding(x.y);
  if (x.provider)
    all["provider"] = *x.provider;
  if (!x.stations.empty())
    all["stations"] = delta_encoding(x.stations, 0);
  if (x.means != curve::meaning::any)
    all["means"] = meaning_names[static_cast<std::size_t>(x.means)];
  if (!x.low.empty() && !x.high.empty()) {
    all["low"] = delta_encoding(x.low);
    all["high"] = delta_encoding(x.high);
  }
  return all;
}

json to_json(const paragraph& x) {
  return {{"kind", "paragraph"}, {"text", x.text}};
}

json to_json(const table& x) {
  json all{{"kind", "table"},
           {"title", x.title},
           {"columns", x.columns},
           {"rows", x.rows},
           {"note", x.note}};
  if (!x.column_meanings.empty())
    all["column_meanings"] = x.column_meanings;
  if (!x.row_meanings.empty())
    all["row_meanings"] = x.row_meanings;
  for (const auto one : x.verdicts)
    all["verdicts"].push_back(verdict_names[static_cast<std::size_t>(one)]);
  return all;
}

json to_json(const strip& x) {
  json all{
      {"name", x.name}, {"stays", json::array()}, {"fallbacks", json::array()}};
  for (const auto& [station, from, until, place] : x.stays)
    all["stays"].push_back({station, from, until, place});
  for (const auto& [station, at] : x.fallbacks)
    all["fallbacks"].push_back({station, at});
  return all;
}

void add_strips(json& to, const figure& x) {
  for (const auto& one : x.strips)
    to["strips"].push_back(to_json(one));
  for (const auto& [name, provider] : x.places) {
    to["places"].push_back({{"name", name}});
    if (provider)
      to["places"].back()["provider"] = *provider;
  }
}

json to_json(const figure& x) {
  auto curves = json::array();
  for (const auto& one : x.curves)
    curves.push_back(to_json(one));
  const auto lines = [](const auto& named) {
    auto all = json::array();
    for (const auto& [at, name] : named)
      all.push_back({at, name});
    return all;
  };
  json all{{"kind", "figure"},          {"title", x.title},
           {"x_label", x.x_label},      {"y_label", x.y_label},
           {"curves", curves},          {"marks", lines(x.marks)},
           {"levels", lines(x.levels)}, {"by_clock", x.by_clock},
           {"caption", x.caption}};
  if (x.log_y)
    all["log_y"] = true;
  if (!x.strips.empty())
    add_strips(all, x);
  return all;
}

json to_json(const scatter& x) {
  auto dots = json::array();
  const auto add = [](json& dot, const char* name, const auto& interval) {
    if (interval)
      dot[name] = {interval->first, interval->second};
  };
  for (const auto& one : x.dots) {
    dots.push_back({{"name", one.name},
                    {"x", one.x},
                    {"y", one.y},
                    {"hollow", one.hollow}});
    add(dots.back(), "x_interval", one.x_interval);
    add(dots.back(), "y_interval", one.y_interval);
  }
  return {{"kind", "scatter"},    {"title", x.title}, {"x_label", x.x_label},
          {"y_label", x.y_label}, {"dots", dots},     {"joined", x.joined},
          {"caption", x.caption}};
}

json to_json(const drive& x) {
  auto all = drive_json(x.folder);
  all["kind"] = "drive";
  return all;
}

json to_json(const listing& x) {
  return {{"kind", "listing"}, {"title", x.title}, {"text", x.text}};
}

json to_json(const document& x) {
  auto sections = json::array();
  for (const auto& one : x.sections) {
    auto blocks = json::array();
    for (const auto& b : one.blocks)
      blocks.push_back(std::visit([](const auto& y) { return to_json(y); }, b));
    sections.push_back({{"title", one.title}, {"blocks", std::move(blocks)}});
  }
  return {{"title", x.title},
          {"subtitle", x.subtitle},
          {"sections", std::move(sections)}};
}

std::string html_text(std::string_view text) {
  std::string safe;
  for (const auto c : text)
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      default:
        safe += c;
    }
  return safe;
}

} // namespace

std::string html(const document& what) {
  constexpr std::string_view title = "%title%";
  constexpr std::string_view body = "%document%";
  const auto title_at = page.find(title);
  const auto body_at = page.find(body);
  if (title_at == page.npos || body_at == page.npos || body_at < title_at)
    throw std::logic_error{"apps/report/dist lacks a place for the document"};
  const auto between = title_at + title.size();
  std::string all{page.substr(0, title_at)};
  all += html_text(what.title);
  all += page.substr(between, body_at - between);
  all += compressed(
      to_json(what).dump(-1, ' ', false, json::error_handler_t::replace));
  all += page.substr(body_at + body.size());
  return all;
}

void write_html(const document& what, const std::filesystem::path& file,
                std::string_view choose) {
  output_file::check(file, choose); // before the work
  write_file(file, html(what), choose);
}

} // namespace sofof::experiments::report
