// Inputs from files, from what the vehicle sees, its way, and other programs.
#include "actors/services/programs/input_source.hpp"

#include "base/files/regular_file.hpp"
#include "base/geometry.hpp"
#include "messages/v2x/cpm_rules.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/perception.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

namespace sofof::actors {

namespace fs = std::filesystem;

namespace {

using input_octets = std::vector<std::byte>;

/// All pictures of a folder are kept.
constexpr std::size_t most_of_a_camera = std::size_t{256} << 20;

input_octets as_octets(std::string_view text) {
  const auto all = std::as_bytes(std::span{text.data(), text.size()});
  return {all.begin(), all.end()};
}

void append_f64(input_octets& to, double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  for (std::size_t k = 0; k < sizeof bits; ++k)
    to.push_back(static_cast<std::byte>(bits >> (8 * k)));
}

/// Pictures of a folder, by name, over and over; each vehicle begins with
/// another one.
class camera_input final : public input_source {
public:
  std::string_view name() const override { return "camera"; }

  void visit_options(option_visitor& s) override { s.field("folder", folder_); }

  void load(const fs::path& beside, std::size_t most) override {
    if (folder_.empty())
      throw std::invalid_argument{"`folder` of its input must name a folder "
                                  "of .jpg files"};
    const auto folder = beside / folder_;
    files_.clear();
    frames_.clear();
    std::error_code failed;
    for (fs::directory_iterator entry{folder, failed}, end;
         !failed && entry != end; entry.increment(failed))
      if (entry->path().extension() == ".jpg")
        files_.push_back(entry->path());
    std::ranges::sort(files_);
    if (failed || files_.empty())
      throw std::invalid_argument{
          fmt::format("there are no .jpg files in {}", folder.string())};
    std::size_t octets = 0;
    for (const auto& file : files_) {
      const auto content = read_regular_file(file, most);
      if (!content.refusal.empty())
        throw std::invalid_argument{fmt::format(
            "the file {} cannot be read: {}", file.string(), content.refusal)};
      octets += content.text.size();
      if (octets > most_of_a_camera)
        throw std::invalid_argument{
            fmt::format("the .jpg files in {} have more than {} octets in all",
                        folder.string(), most_of_a_camera)};
      frames_.push_back(as_octets(content.text));
    }
  }

  std::vector<fs::path> files() const override { return files_; }

  input_octets next(const vehicle_view&, station_id station,
                    std::uint64_t number) const override {
    if (frames_.empty())
      return {};
    return frames_[(number + station.value()) % frames_.size()];
  }

private:
  std::string folder_;
  std::vector<fs::path> files_;
  std::vector<input_octets> frames_;
};

/// @returns what it sees, in that order; of more objects than a CPM takes the
/// nearest ones, these first.
std::vector<world::perceived_object> nearest(const vehicle_look& look) {
  constexpr auto most = messages::cpm_trigger::most_objects;
  auto all = look.seen.objects;
  if (all.size() <= most)
    return all;
  std::ranges::stable_sort(all, {}, [&](const auto& x) {
    return distance_m(x.centre, look.own.position);
  });
  all.resize(most);
  return all;
}

/// A CPM of all that the vehicle sees, as it would send it.
class cpm_input final : public input_source {
public:
  std::string_view name() const override { return "cpm"; }

  input_octets next(const vehicle_view& view, station_id,
                    std::uint64_t) const override {
    const auto look = view.newest();
    if (look.own.station == station_id{0})
      return {};
    std::vector<messages::known_object> objects;
    for (const auto& x : nearest(look))
      objects.push_back({static_cast<std::uint32_t>(objects.size()), x});
    const auto& how = view.how();
    const messages::perceived_scene scene{
        look.own, look.seen.at, objects, look.seen.objects.size(), &how.sensor};
    const auto message =
        how.is_release_2 ? messages::encoded(
            messages::make_cpm_ts103324(scene, how.car, *how.where))
                         : messages::encoded(messages::make_cpm_tr103562(
                             scene, how.car, *how.where));
    return {message.octets.begin(), message.octets.end()};
  }
};

/// The way ahead: pairs of doubles, little endian, m east and north.
class route_input final : public input_source {
public:
  std::string_view name() const override { return "route"; }

  input_octets next(const vehicle_view& view, station_id,
                    std::uint64_t) const override {
    input_octets all;
    for (const auto& p : view.newest().route) {
      append_f64(all, p.x_m);
      append_f64(all, p.y_m);
    }
    return all;
  }
};

/// The newest result of another program of the vehicle.
class program_input final : public input_source {
public:
  std::string_view name() const override { return "program"; }

  void visit_options(option_visitor& s) override {
    s.field("service", service_);
  }

  std::string_view program() const override { return service_; }

  input_octets next(const vehicle_view& view, station_id,
                    std::uint64_t) const override {
    return view.result_of(service_);
  }

private:
  std::string service_;
};

} // namespace

input_source_ptr make_input_source(std::string_view name) {
  if (name == "camera")
    return std::make_shared<camera_input>();
  if (name == "cpm")
    return std::make_shared<cpm_input>();
  if (name == "program")
    return std::make_shared<program_input>();
  if (name == "route")
    return std::make_shared<route_input>();
  return nullptr;
}

std::vector<std::string_view> input_source_names() {
  return {"camera", "cpm", "program", "route"};
}

} // namespace sofof::actors
