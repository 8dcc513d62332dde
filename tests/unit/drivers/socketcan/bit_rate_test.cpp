#include "drivers/socketcan/bit_rate.h"

#include <gtest/gtest.h>
#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>

#include <cstring>
#include <string_view>
#include <vector>

namespace dottrack::drivers {
namespace {

using Bytes = std::vector<std::byte>;

template <class T>
Bytes bytes_of(const T& value) {
  Bytes bytes(sizeof(T));
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

Bytes text(std::string_view word) {
  Bytes bytes(word.size() + 1);
  std::memcpy(bytes.data(), word.data(), word.size());
  return bytes;
}

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Bytes attribute(unsigned short type, const Bytes& content) {
  const rtattr head{.rta_len = static_cast<unsigned short>(RTA_LENGTH(content.size())),
                    .rta_type = type};
  Bytes bytes = joined({bytes_of(head), content});
  bytes.resize(RTA_ALIGN(bytes.size()));
  return bytes;
}

Bytes message(unsigned short type, const Bytes& attributes) {
  nlmsghdr head{};
  head.nlmsg_type = type;
  head.nlmsg_len = static_cast<std::uint32_t>(NLMSG_LENGTH(sizeof(ifinfomsg)) + attributes.size());
  return joined({bytes_of(head), bytes_of(ifinfomsg{}), attributes});
}

Bytes link_of_kind(std::string_view kind) {
  can_bittiming timing{};
  timing.bitrate = 250000;
  const Bytes data = joined({attribute(IFLA_CAN_STATE, bytes_of(std::uint32_t{1})),
                             attribute(IFLA_CAN_BITTIMING, bytes_of(timing))});
  const Bytes info = joined(
      {attribute(IFLA_INFO_KIND, text(kind)), attribute(IFLA_INFO_DATA | NLA_F_NESTED, data)});
  return joined({attribute(IFLA_IFNAME, text("can0")), attribute(IFLA_LINKINFO, info)});
}

TEST(BitRate, IsFoundInTheAnswerAboutACanLink) {
  EXPECT_EQ(bit_rate_in(message(RTM_NEWLINK, link_of_kind("can"))), 250000U);
}

TEST(BitRate, IsZeroWhereThereIsNone) {
  EXPECT_EQ(bit_rate_in({}), 0U);
  EXPECT_EQ(bit_rate_in(message(RTM_NEWLINK, {})), 0U);
  EXPECT_EQ(bit_rate_in(message(RTM_NEWLINK, link_of_kind("vcan"))), 0U);
  EXPECT_EQ(bit_rate_in(message(NLMSG_ERROR, link_of_kind("can"))), 0U);
}

TEST(BitRate, AnAnswerCutShortAnywhereIsRead) {
  const Bytes whole = message(RTM_NEWLINK, link_of_kind("can"));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    if (size >= sizeof(nlmsghdr)) {
      const auto told = static_cast<std::uint32_t>(size);
      std::memcpy(cut.data(), &told, sizeof(told));
    }
    EXPECT_EQ(bit_rate_in(cut), 0U) << size;
  }
}

}  // namespace
}  // namespace dottrack::drivers
