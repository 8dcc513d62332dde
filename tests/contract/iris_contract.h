#pragma once
// What every Iris promises.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "hal/iris.h"

namespace dottrack::test {

struct IrisCase {
  std::string name;
  std::function<std::unique_ptr<hal::Iris>()> make;
};
inline void PrintTo(const IrisCase& made, std::ostream* out) {
  *out << made.name;
}

class IrisContract : public testing::TestWithParam<IrisCase> {
 protected:
  std::unique_ptr<hal::Iris> iris_ = GetParam().make();
};

}  // namespace dottrack::test
