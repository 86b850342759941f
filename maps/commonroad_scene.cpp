// What a CommonRoad scenario says beside its lanes.
#include "maps/commonroad_scene.hpp"

#include <fmt/format.h>

#include "maps/commonroad_values.hpp"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace sofof::maps {

namespace {

constexpr std::size_t most_bodies = 2000, most_problems = 100;

/// What a body may be at most, m; a larger one is refused by scenarios, too.
constexpr auto largest_body_m = 50.0, smallest_body_m = 0.1;

constexpr auto widest_interval_rad = 100.0, widest_interval_mps = 1000.0;

class scene_reader {
public:
  explicit scene_reader(const xml_file& file) : file_{file}, values_{file} {}

  commonroad_scene read() {
    read_head();
    const auto root = file_.root();
    for (const auto lanelet : root.children("lanelet"))
      read_lanelet(lanelet);
    for (const auto child : root.children())
      read_child(child);
    return std::move(scene_);
  }

private:
  void read_head() {
    const auto root = file_.root();
    scene_.benchmark = file_.text(root, "benchmarkID");
    scene_.version = file_.text(root, "commonRoadVersion");
    if (scene_.version != "2018b" && scene_.version != "2020a")
      file_.refuse(root, fmt::format("commonRoadVersion \"{}\" is not known; "
                                     "known are 2018b and 2020a.",
                                     scene_.version));
    scene_.step_s = file_.number(root, "timeStepSize", 0.01, 10);
  }

  void read_lanelet(pugi::xml_node lanelet) {
    auto rim = values_.points(values_.need(lanelet, "leftBound"), 2);
    const auto right = values_.points(values_.need(lanelet, "rightBound"), 2);
    rim.insert(rim.end(), right.rbegin(), right.rend());
    lanelets_.emplace(file_.text(lanelet, "id"), scene_.lanelets.size());
    scene_.lanelets.push_back(std::move(rim));
  }

  void read_child(pugi::xml_node child) {
    const std::string_view name = child.name();
    if (name == "obstacle" || name == "staticObstacle"
        || name == "dynamicObstacle") {
      const std::string_view role =
          name == "obstacle" ? child.child_value("role") : name;
      if (scene_.bodies.size() == most_bodies)
        file_.refuse(child, fmt::format("there are more than {} obstacles.",
                                        most_bodies));
      read_body(child, role.starts_with("dynamic"));
    } else if (name == "environmentObstacle") {
      read_house(child);
    } else if (name == "phantomObstacle") {
      scene_.left_out.push_back(fmt::format(
          "obstacle {} is a phantom, which nobody can see, and is left out.",
          file_.text(child, "id")));
    } else if (name == "planningProblem") {
      if (scene_.problems.size() == most_problems)
        file_.refuse(child, fmt::format("there are more than {} planning "
                                        "problems.",
                                        most_problems));
      read_problem(child);
    }
  }

  // -- bodies ---------------------------------------------------------------

  void read_body(pugi::xml_node obstacle, bool moves) {
    scene_body made;
    made.id = file_.text(obstacle, "id");
    const auto begin = values_.need(obstacle, "initialState");
    const auto shape = obstacle.child("shape");
    const auto occupied = obstacle.child("occupancySet");
    made.moves = moves;
    if (moves && occupied)
      read_occupancies(occupied, made);
    else
      read_states(obstacle, begin, values_.need(obstacle, "shape"), made);
    if (made.length_m > largest_body_m || made.width_m > largest_body_m)
      file_.refuse(shape ? shape : obstacle,
                   fmt::format("obstacle {} is {:.0f} m × {:.0f} m; {:.0f} m "
                               "are the most.",
                               made.id, made.length_m, made.width_m,
                               largest_body_m));
    made.length_m = std::max(made.length_m, smallest_body_m);
    made.width_m = std::max(made.width_m, smallest_body_m);
    scene_.bodies.push_back(std::move(made));
  }

  void read_states(pugi::xml_node obstacle, pugi::xml_node begin,
                   pugi::xml_node shape, scene_body& to) {
    const auto box = values_.box(shape);
    to.length_m = box.length_m;
    to.width_m = box.width_m;
    const auto add = [&](pugi::xml_node node) {
      auto x = values_.state(node);
      const point along{std::cos(x.heading_rad), std::sin(x.heading_rad)};
      const point left{-along.y_m, along.x_m};
      x.at = x.at + box.middle.x_m * along + box.middle.y_m * left;
      x.heading_rad = wrap_angle(x.heading_rad + box.heading_rad);
      x.speed_mps *= std::cos(box.heading_rad);
      add_state(x, node, to);
    };
    add(begin);
    if (to.moves)
      for (const auto node : values_.need(obstacle, "trajectory").children())
        if (std::string_view{node.name()} == "state")
          add(node);
  }

  /// Some files repeat the initial state in the trajectory.
  void add_state(const scene_body::state& x, pugi::xml_node at,
                 scene_body& to) const {
    if (to.states.empty() || x.step > to.states.back().step)
      to.states.push_back(x);
    else if (to.states.size() == 1 && x.step == to.states.back().step)
      to.states.back() = x;
    else
      file_.refuse(at, fmt::format("obstacle {}: time {} does not come after "
                                   "{}.",
                                   to.id, x.step, to.states.back().step));
  }

  void read_occupancies(pugi::xml_node all, scene_body& to) {
    for (const auto one : all.children("occupancy")) {
      const auto box = values_.box(values_.need(one, "shape"));
      to.length_m = std::max(to.length_m, box.length_m);
      to.width_m = std::max(to.width_m, box.width_m);
      add_state({values_.steps(one).first, box.middle,
                 wrap_angle(box.heading_rad), 0},
                one, to);
    }
    if (to.states.empty())
      file_.refuse(all, "<occupancySet> needs an <occupancy>.");
    auto& states = to.states;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
      const point along{std::cos(states[i].heading_rad),
                        std::sin(states[i].heading_rad)};
      states[i].speed_mps =
          dot(along, states[i + 1].at - states[i].at)
          / (scene_.step_s * (states[i + 1].step - states[i].step));
    }
    if (states.size() > 1)
      states.back().speed_mps = states[states.size() - 2].speed_mps;
  }

  void read_house(pugi::xml_node obstacle) {
    for (auto& one : values_.regions(values_.need(obstacle, "shape"))) {
      if (one.corners.empty())
        one.corners = rim_of_disc(one);
      try {
        polygon{one.corners};
      } catch (const std::invalid_argument& problem) {
        file_.refuse(obstacle, problem.what());
      }
      scene_.houses.push_back(std::move(one.corners));
    }
  }

  static std::vector<point> rim_of_disc(const scene_region& disc) {
    const auto regular = polygon::regular(disc.centre, disc.radius_m, 16);
    return {regular.corners().begin(), regular.corners().end()};
  }

  // -- what is to be driven -------------------------------------------------

  void read_problem(pugi::xml_node problem) {
    planning_problem made;
    made.id = file_.text(problem, "id");
    const auto begin = values_.need(problem, "initialState");
    values_.need(begin, "orientation");
    values_.need(begin, "velocity");
    const auto x = values_.state(begin);
    if (x.speed_mps < 0)
      file_.refuse(begin, "the drive begins backwards; cars of ours cannot.");
    made.begin = x.step;
    made.at = x.at;
    made.heading_rad = x.heading_rad;
    made.speed_mps = x.speed_mps;
    for (const auto goal : problem.children("goalState"))
      made.goals.push_back(read_goal(goal));
    if (made.goals.empty())
      file_.refuse(problem, "<planningProblem> needs a <goalState>.");
    if (made.end() < made.begin)
      file_.refuse(problem, "all goals are over before the drive begins.");
    scene_.problems.push_back(std::move(made));
  }

  goal_state read_goal(pugi::xml_node goal) const {
    goal_state made;
    std::tie(made.first, made.last) = values_.steps(goal);
    if (const auto position = goal.child("position")) {
      made.places = values_.regions(position);
      for (const auto lanelet : position.children("lanelet"))
        made.places.push_back({outline_of(lanelet), {}});
      if (made.places.empty())
        file_.refuse(position, "<position> of a goal needs a <rectangle>, "
                               "<circle>, <polygon> or <lanelet>.");
    }
    if (const auto speed = goal.child("velocity"))
      made.speed_mps =
          values_.interval(speed, -widest_interval_mps, widest_interval_mps);
    if (const auto heading = goal.child("orientation"))
      made.heading_rad =
          values_.interval(heading, -widest_interval_rad, widest_interval_rad);
    return made;
  }

  std::vector<point> outline_of(pugi::xml_node lanelet) const {
    const auto name = file_.text(lanelet, "ref");
    const auto found = lanelets_.find(name);
    if (found == lanelets_.end())
      file_.refuse(lanelet, fmt::format("there is no lanelet \"{}\".", name));
    return scene_.lanelets[found->second];
  }

  const xml_file& file_;
  commonroad_values values_;
  commonroad_scene scene_;
  std::unordered_map<std::string_view, std::size_t> lanelets_;
};

} // namespace

time_step planning_problem::end() const {
  return std::ranges::max_element(goals, {}, &goal_state::last)->last;
}

commonroad_scene read_commonroad_scene(const xml_file& file) {
  return scene_reader{file}.read();
}

} // namespace sofof::maps
