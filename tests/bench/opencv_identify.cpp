#include "tests/bench/opencv_identify.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
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

// The axes of a uniform ellipse, each pixel being a unit square.
void set_axes(const cv::Moments& moments, Blob& blob) {
  const double xx = moments.mu20 / moments.m00;
  const double xy = moments.mu11 / moments.m00;
  const double yy = moments.mu02 / moments.m00;
  const double radius = std::hypot(0.5 * (xx - yy), xy);
  blob.semi_major_px = 2.0 * std::sqrt(0.5 * (xx + yy) + radius + 1.0 / 12.0);
  blob.semi_minor_px = 2.0 * std::sqrt(std::max(0.5 * (xx + yy) - radius, 0.0) + 1.0 / 12.0);
}

}  // namespace

void use_one_opencv_thread() {
  cv::setNumThreads(1);
}

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

std::vector<Blob> opencv_blobs(const ImageView& image) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count =
      cv::connectedComponentsWithStats(in_band(image), labels, stats, centroids, 4, CV_32S);
  std::vector<Blob> blobs;
  for (int i = 1; i < count; ++i) {  // 0 is the ground
    Blob blob{.area_px = stats.at<int>(i, cv::CC_STAT_AREA),
              .x_min = stats.at<int>(i, cv::CC_STAT_LEFT),
              .y_min = stats.at<int>(i, cv::CC_STAT_TOP),
              .width_px = stats.at<int>(i, cv::CC_STAT_WIDTH),
              .height_px = stats.at<int>(i, cv::CC_STAT_HEIGHT),
              .x = centroids.at<double>(i, 0),
              .y = centroids.at<double>(i, 1)};
    if (blob.area_px < 2) continue;
    const cv::Rect box(blob.x_min, blob.y_min, blob.width_px, blob.height_px);
    set_axes(cv::moments(labels(box) == i, true), blob);
    blobs.push_back(blob);
  }
  return blobs;
}

}  // namespace dottrack::bench
