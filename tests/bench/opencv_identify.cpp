#include "tests/bench/opencv_identify.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/bench/blob_scene.h"

namespace dottrack::bench {

namespace {

// OpenCV has no view of constant pixels; it does not write to these.
cv::Mat wrap(const ImageView& image) {
  return {image.height_px, image.width_px, CV_8UC1,
          const_cast<std::uint8_t*>(image.data),  // NOLINT(cppcoreguidelines-pro-type-const-cast)
          static_cast<std::size_t>(image.stride_bytes)};
}

cv::Mat in_band(const ImageView& image) {
  cv::Mat mask;
  cv::inRange(wrap(image), cv::Scalar(kBandMin), cv::Scalar(255), mask);
  return mask;
}

}  // namespace

std::size_t opencv_contours(const ImageView& image) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(in_band(image), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  double area = 0.0;
  for (const auto& contour : contours) area += cv::moments(contour).m00;
  return area < 0.0 ? 0 : contours.size();
}

std::size_t opencv_connected_components(const ImageView& image) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  return static_cast<std::size_t>(cv::connectedComponentsWithStats(in_band(image), labels, stats,
                                                                   centroids, 4, CV_32S)) -
         1;
}

}  // namespace dottrack::bench
