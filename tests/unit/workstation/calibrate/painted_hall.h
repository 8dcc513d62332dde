#pragma once
// Pictures of surveyed dots, painted: flat discs on a floor and on boxes, and some that are no
// dots.

#include <filesystem>
#include <vector>

#include "app/workstation/calibrate/labelling/observe.h"

namespace dottrack::test {

struct PaintedHall {
  std::vector<calibrate::SurveyedDot> dots;
  std::vector<geometry::CameraModel> truths;
  std::vector<geometry::CameraModel> guesses;  // some degrees, decimetres and per cent off
};

inline constexpr int kPaintedColumns = 640;
inline constexpr int kPaintedRows = 480;

// 40 dots of 16 cm all over 8 x 6 m, four cameras above the corners.
PaintedHall painted_hall();

// A plate of two steps, 9 x 8 dots of 1.5 mm every 5 mm, its sides unlike; two cameras in front.
PaintedHall painted_plate();

// <folder>/cam1.pgm, ... with some discs that are no dots.
std::vector<calibrate::CameraInput> paint(const PaintedHall& hall,
                                          const std::filesystem::path& folder);

// Views whose pixel is within the distance of where the truth has the dot, and all of a camera.
struct Right {
  std::size_t right = 0;
  std::size_t all = 0;
};
Right right_ones(const PaintedHall& hall, std::size_t camera, const calibrate::CameraViews& views,
                 double within_px);

}  // namespace dottrack::test
