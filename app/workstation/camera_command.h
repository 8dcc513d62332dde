#pragma once
// dottrack camera project MODEL, dottrack camera unproject MODEL: a camera model as a filter of CSV
// lines, with its partial derivatives.

#include <CLI/App.hpp>
#include <iosfwd>

#include "app/core/geometry/camera_model.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

// Lines X,Y,Z (metres, world) in; a header and
// X,Y,Z,status,x,y,dx_dX,dx_dY,dx_dZ,dy_dX,dy_dY,dy_dZ out, 17 significant digits. Where the status
// is not ok the fields after it are empty. A first line without any number is a header. A row is
// out before the next line is read. An error names the line; blank lines are passed over.
Result<void> project_lines(const geometry::CameraModel& model, std::istream& in, std::ostream& out);

// The same with lines x,y (pixels) in, rays and their derivatives out.
Result<void> unproject_lines(const geometry::CameraModel& model, std::istream& in,
                             std::ostream& out);

// exit_status: 2 where the model or a line of the input is wrong, 1 where the output is not taken.
void add_camera_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
