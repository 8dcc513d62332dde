#pragma once
// Which line of which bank is what of which iris. Start-up only.

#include <memory>
#include <optional>
#include <vector>

#include "drivers/libgpiod/gpio_iris.h"
#include "drivers/libgpiod/line_bank.h"

namespace dottrack::drivers {

// An iris's lines in its bank, one bit each; 0 where it has none.
struct IrisLines {
  std::size_t bank = 0;
  std::uint64_t step = 0;
  std::uint64_t direction = 0;
  std::uint64_t enable = 0;
  std::uint64_t override_auto = 0;
  std::uint64_t end_stop = 0;  // of the inputs
};

struct IrisBanks {
  std::vector<std::unique_ptr<LineBank>> banks;  // one a chip
  std::vector<std::optional<IrisLines>> irises;  // one a camera
};

// Takes all lines, inactive. An error names camera, chip and line.
Result<IrisBanks> request_iris_lines(const std::vector<std::optional<IrisWiring>>& irises,
                                     LineBanks& banks);

}  // namespace dottrack::drivers
