// A driver joins the contract of its interface only where its device or its library is there.

#include <gtest/gtest.h>

namespace dottrack::test {

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(FrameGrabberContract);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CanBusContract);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(IrisContract);

}  // namespace dottrack::test
