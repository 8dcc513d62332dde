#pragma once
// What is wrong where pictures, survey and guesses do not fit: one line that says what to do.

#include <optional>
#include <string>

#include "app/workstation/calibrate/labelling/agreement.h"
#include "app/workstation/calibrate/labelling/observe.h"

namespace dottrack::calibrate {

// Of a camera without labels. `scenes`: of all cameras, in the order of the inputs.
std::string why_unlabelled(std::span<const SurveyedDot> dots,
                           const std::vector<CameraInput>& inputs,
                           const std::vector<LabelledCamera>& cameras, std::size_t camera);

// Of cameras that are labelled, each with one labelling: whether their places are as was believed,
// or believable at all. Nothing: they are.
std::optional<std::string> why_unbelievable(std::span<const SurveyedDot> dots,
                                            const std::vector<CameraInput>& inputs,
                                            const std::vector<LabelledCamera>& cameras);

// Where nothing but the dots says which is which: how they fit in a mirror. An error where they fit
// better there; a remark where they fit as well, so that left-handed coordinates cannot be told.
Result<std::optional<std::string>> try_mirror(std::span<const SurveyedDot> dots,
                                              const std::vector<CameraInput>& inputs,
                                              const std::vector<LabelledCamera>& cameras);

}  // namespace dottrack::calibrate
