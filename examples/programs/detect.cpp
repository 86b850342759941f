// Object detection as a program, by OpenCV: a grey JPEG in, boxes of bright
// cars out, as detect.py says them.
#include "examples/programs/service_program.hpp"
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace {

constexpr int scale = 2; // it looks at a picture half as wide and high
constexpr double bright = 180;
constexpr int least_area = 100; // of a car there

std::optional<service_program::octets>
detect(const service_program::input& frame) {
  const auto picture = cv::imdecode(frame.what, cv::IMREAD_REDUCED_GRAYSCALE_2);
  if (picture.empty())
    return std::nullopt; // it is no JPEG
  cv::Mat is_bright, labels, found, centres;
  cv::threshold(picture, is_bright, bright, 255, cv::THRESH_BINARY);
  const auto count =
      cv::connectedComponentsWithStats(is_bright, labels, found, centres, 4);
  service_program::octets boxes(4);
  for (int k = 1; k < count; ++k) { // the first is all that is dark
    if (found.at<int>(k, cv::CC_STAT_AREA) < least_area)
      continue;
    ++boxes[0];
    for (const auto side : {cv::CC_STAT_LEFT, cv::CC_STAT_TOP,
                            cv::CC_STAT_WIDTH, cv::CC_STAT_HEIGHT})
      service_program::detail::append_number(
          boxes, static_cast<std::uint64_t>(scale * found.at<int>(k, side)), 2);
  }
  return boxes;
}

} // namespace

int main() {
  cv::setNumThreads(1); // each vehicle has a process of its own
  return service_program::serve({detect, {}, {}});
}
