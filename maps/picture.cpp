// A map as a picture.
#include "maps/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <string_view>

namespace sofof::maps {

namespace {

constexpr auto picture_width = 1200.0, most_height = 1600.0; // pixels
constexpr auto margin = 40.0, legend_height = 56.0;

/// Lanes side by side are told apart by so much between them, m.
constexpr auto gap_m = 0.4;

/// As of the report's page; curves are Okabe and Ito's.
constexpr std::string_view style =
    "svg{background:#fff;font:12px system-ui,sans-serif;fill:#646b73}"
    ".l{fill:none;stroke:#cfd1cd;stroke-linejoin:round}"
    ".d{fill:none;stroke:#8a9199;stroke-width:1.1}"
    ".h{fill:#ddd8cb}.x{fill:#c84d00}.m{fill:#3fa3dc}.v{fill:#009e73}"
    ".b{fill:none;stroke:#b00020;stroke-width:2}.r{fill:#1d2125}"
    ".t{font-weight:600;fill:#1d2125}"
    ".n{font-weight:600;paint-order:stroke;stroke:#fff;stroke-width:3}";

constexpr std::array<std::string_view, 6> series{
    "#0072b2", "#d98e00", "#009e73", "#b85c90", "#3fa3dc", "#7a5c2e"};

/// @returns a text as it may stand in XML.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const auto c : text)
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c >= 0 && c < ' ' ? ' ' : c;
    }
  return safe;
}

class map_drawing {
public:
  map_drawing(const world::streets& world, const picture_additions& more)
      : world_{world}, more_{more} {
    fit();
  }

  std::string paint() {
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\">\n"
        "<style>{2}</style>\n",
        picture_width, height_, style);
    for (std::size_t i = 0; i < more_.providers.size(); ++i)
      put("<path d=\"{0}Z\" fill=\"{1}\" fill-opacity=\"0.09\" stroke=\"{1}\" "
          "stroke-dasharray=\"5 4\"/>\n",
          line(more_.providers[i].area), series[i % series.size()]);
    for (const auto& house : world_.map.buildings())
      put("<path class=\"h\" d=\"{}Z\"/>\n", line(house.corners));
    paint_lanes();
    paint_conflicts();
    for (const auto& route : world_.routes)
      mark("r", 2.5, route->path().at(0).at,
           fmt::format("route {} begins", route->name()));
    for (const auto& bend : more_.bends)
      mark("b", 7, bend.at,
           fmt::format("{}: radius {:.1f} m", bend.lane, bend.radius_m));
    for (std::size_t i = 0; i < more_.providers.size(); ++i)
      paint_provider(more_.providers[i], series[i % series.size()]);
    paint_legend();
    text_ += "</svg>\n";
    return std::move(text_);
  }

private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format,
                   std::forward<Args>(args)...);
  }

  void fit() {
    point low{1e9, 1e9}, high{-1e9, -1e9};
    const auto show = [&](std::span<const point> points) {
      for (const auto p : points) {
        low = {std::min(low.x_m, p.x_m), std::min(low.y_m, p.y_m)};
        high = {std::max(high.x_m, p.x_m), std::max(high.y_m, p.y_m)};
      }
    };
    for (const auto& l : world_.map.lanes())
      show(l.centre);
    for (const auto& p : more_.providers)
      show(p.area);
    const auto wide = std::max(high.x_m - low.x_m, 1.0);
    const auto high_m = std::max(high.y_m - low.y_m, 1.0);
    scale_ = std::min((picture_width - 2 * margin) / wide,
                      (most_height - 2 * margin) / high_m);
    height_ = high_m * scale_ + 2 * margin + legend_height;
    west_m_ = low.x_m - ((picture_width / scale_) - wide) / 2;
    north_m_ = high.y_m;
  }

  double left(point p) const { return (p.x_m - west_m_) * scale_; }
  double top(point p) const { return (north_m_ - p.y_m) * scale_ + margin; }

  std::string line(std::span<const point> points) const {
    std::string path;
    for (const auto p : points)
      fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}",
                     path.empty() ? 'M' : 'L', left(p), top(p));
    return path;
  }

  void paint_lanes() {
    for (const auto& l : world_.map.lanes()) {
      const world::path smooth{l.centre};
      std::vector<point> points;
      const auto count = std::ceil(smooth.length_m() * scale_ / 4) + 1;
      for (auto i = 0.0; i <= count; ++i)
        points.push_back(smooth.at(smooth.length_m() * i / count).at);
      put("<path class=\"l\" stroke-width=\"{:.1f}\" d=\"{}\"><title>{}, "
          "{:.0f} m, {:.1f} m/s</title></path>\n",
          std::max((2 * l.half_width_m - gap_m) * scale_, 1.2), line(points),
          escaped(l.name), smooth.length_m(), l.limits.front().limit_mps);
    }
    for (const auto& l : world_.map.lanes())
      paint_directions(l);
  }

  void paint_directions(const world::lane& l) {
    constexpr auto gap = 90.0, shortest = 24.0; // pixels
    const world::path smooth{l.centre};
    const auto pixels = smooth.length_m() * scale_;
    if (pixels < shortest)
      return;
    const auto half = std::clamp(l.half_width_m * scale_ * 0.55, 2.5, 4.0);
    const auto count = std::max(1.0, std::floor(pixels / gap));
    for (auto i = 0.5; i < count; ++i) {
      const auto at = smooth.at(smooth.length_m() * i / count);
      put("<path class=\"d\" transform=\"translate({:.1f} {:.1f}) "
          "rotate({:.0f})\" d=\"M{:.1f} {:.1f}L{:.1f} 0L{:.1f} {:.1f}\"/>\n",
          left(at.at), top(at.at), -at.heading_rad * 180 / 3.14159265, -half,
          -half, half, -half, half);
    }
  }

  void paint_conflicts() {
    constexpr std::array<std::string_view, 3> classes{"x", "m", "v"};
    constexpr std::array<std::string_view, 3> words{"crosses", "merges with",
                                                    "parts from"};
    for (const auto& c : world_.map.conflicts()) {
      const auto kind = static_cast<std::size_t>(c.how);
      const auto& a = world_.map.lanes()[c.lane_a];
      const auto& b = world_.map.lanes()[c.lane_b];
      const world::path on_a{a.centre};
      mark(classes[kind], 1.8, on_a.at((c.from_a_m + c.to_a_m) / 2).at,
           fmt::format("{} {} {}", a.name, words[kind], b.name));
    }
  }

  void mark(std::string_view kind, double radius, point at,
            const std::string& title) {
    put("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}"
        "</title></circle>\n",
        kind, left(at), top(at), radius, escaped(title));
  }

  void paint_provider(const pictured_provider& p, std::string_view ink) {
    const auto x = left(p.at), y = top(p.at);
    put("<path fill=\"{0}\" d=\"M{1:.1f} {2:.1f}l6 6l-6 6l-6 -6Z\"/><text "
        "class=\"n\" fill=\"{0}\" x=\"{3:.1f}\" y=\"{4:.1f}\">{5}</text>\n",
        ink, x, y - 6, x + 10, y + 4, escaped(p.name));
  }

  void paint_legend() {
    const auto y = height_ - 24;
    constexpr auto longest = 120.0; // pixels
    const auto most_m = longest / scale_;
    auto length_m = std::pow(10.0, std::floor(std::log10(most_m)));
    length_m *= 5 * length_m <= most_m ? 5 : 2 * length_m <= most_m ? 2 : 1;
    put("<rect x=\"20\" y=\"{:.0f}\" width=\"{:.1f}\" height=\"2\"/><text "
        "x=\"20\" y=\"{:.0f}\">{:g} m</text>\n",
        y, length_m * scale_, y - 6, length_m);
    auto x = 200.0;
    const auto entry = [&](std::string_view kind, double radius,
                           const std::string& word) {
      put("<circle class=\"{}\" cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"{}\"/><text "
          "x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
          kind, x, y - 3, radius, x + 10, y + 1, word);
      x += 26 + 6.6 * static_cast<double>(word.size());
    };
    put("<text class=\"t\" x=\"20\" y=\"24\">{}: {} lanes, {} routes</text>\n",
        escaped(world_.map.name()), world_.map.lanes().size(),
        world_.routes.size());
    entry("x", 3, "lanes cross");
    entry("m", 3, "merge");
    entry("v", 3, "part");
    entry("r", 3, "a route begins");
    if (!more_.bends.empty())
      entry("b", 5, fmt::format("too sharp a bend ({})", more_.bends.size()));
  }

  const world::streets& world_;
  const picture_additions& more_;
  std::string text_;
  double scale_ = 1, height_ = 0, west_m_ = 0, north_m_ = 0;
};

} // namespace

std::string draw(const world::streets& world, const picture_additions& more) {
  return map_drawing{world, more}.paint();
}

} // namespace sofof::maps
