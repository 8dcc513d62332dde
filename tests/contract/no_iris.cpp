#include "drivers/recorded/no_iris.h"

#include "tests/contract/iris_contract.h"

namespace dottrack::test {
namespace {

INSTANTIATE_TEST_SUITE_P(Recorded, IrisContract,
                         testing::Values(IrisCase{
                             "no_iris", [] { return std::make_unique<drivers::NoIris>(); }}));

}  // namespace
}  // namespace dottrack::test
