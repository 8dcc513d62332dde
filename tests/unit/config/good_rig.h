#pragma once
// A rig that loads, line by line, for tests that break one thing in it.

#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.h"

namespace dottrack::test {

inline constexpr std::string_view kGoodRig =
    "[rig]\n"                            // 1
    "name = \"sandbox\"\n"               // 2
    "frame_rate_hz = 25.0\n"             // 3
    "\n"                                 // 4
    "[[camera]]\n"                       // 5
    "name = \"cam1\"\n"                  // 6
    "model = \"cam1.cahv\"\n"            // 7
    "distance_m = [2.0, 14.0]\n"         // 8
    "intensity_dn = [128, 250]\n"        // 9
    "min_contrast_dn = 9\n"              // 10
    "background_px = 31\n"               // 11
    "polarity = \"dark\"\n"              // 12
    "\n"                                 // 13
    "[[camera]]\n"                       // 14
    "name = \"cam-2_b\"\n"               // 15
    "model = \"models/cam2.cahv\"\n"     // 16
    "device = \"/base/i2c/imx296@1\"\n"  // 17
    "distance_m = [1, 9]\n"              // 18
    "min_contrast_dn = 8\n"              // 19
    "\n"                                 // 20
    "[target]\n"                         // 21
    "name = \"rover\"\n"                 // 22
    "dots = \"target.csv\"\n"            // 23
    "upright = false\n"                  // 24
    "max_step_m = 0.3\n"                 // 25
    "\n"                                 // 26
    "[tracking]\n"                       // 27
    "max_rms_residual_m = 0.01\n"        // 28
    "lost_after_ticks = 7\n";            // 29

inline constexpr std::string_view kGoodTarget =
    "dot,x_m,y_m,z_m,diameter_m\n"
    "0,0.0,0.0,0.5,0.1\n"
    "1,1.0,0.0,0.5,0.1\n"
    "2,0.0,0.7,0.6,0.1\n";

inline std::string model_text(std::string_view dimensions_line) {
  return "# a camera on the ceiling, looking down\n\nModel = CAHV = perspective, linear\n\n" +
         std::string(dimensions_line) +
         "\nC = 2.0 1.5 5.0\nA = 0.0 0.0 -1.0\nH = 457.0 0.0 -319.5\nV = 0.0 -457.0 -239.5\n";
}

// The text with its first `from` replaced; a test whose `from` is not there would test nothing.
inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const auto at = result.find(from);
  if (at == std::string::npos) throw std::invalid_argument("not in the text: " + std::string(from));
  return result.replace(at, from.size(), to);
}

class RigFolder : public TemporaryFolder {
 public:
  RigFolder() {
    write("cam1.cahv", model_text("Dimensions = 640 480\n"));
    write("models/cam2.cahv", model_text("Dimensions = 2048 2048\n"));
    write("target.csv", kGoodTarget);
    write("rig.toml", kGoodRig);
  }
  std::filesystem::path rig() const { return path() / "rig.toml"; }
};

}  // namespace dottrack::test
