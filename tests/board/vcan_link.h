#pragma once
// A virtual CAN interface of this test's own, made and taken away over rtnetlink; needs the right
// to administer the network.

#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace dottrack::test {

// A request about one link, put together attribute by attribute.
class LinkRequest {
 public:
  LinkRequest(unsigned short type, unsigned flags, bool up) {
    head_.nlmsg_type = type;
    head_.nlmsg_flags = static_cast<unsigned short>(NLM_F_REQUEST | NLM_F_ACK | flags);
    link_.ifi_flags = up ? IFF_UP : 0;
    link_.ifi_change = IFF_UP;
  }

  LinkRequest& add(unsigned short type, std::span<const std::byte> content) {
    const rtattr head{.rta_len = static_cast<unsigned short>(RTA_LENGTH(content.size())),
                      .rta_type = type};
    const auto room = std::span(bytes_).subspan(size_, RTA_SPACE(content.size()));
    std::ranges::copy(std::as_bytes(std::span(&head, 1)), room.begin());
    std::ranges::copy(content, room.subspan(RTA_LENGTH(0)).begin());
    size_ += room.size();
    return *this;
  }

  // 0 or an errno.
  int ask() {
    const int descriptor = ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
    if (descriptor < 0) return errno;
    head_.nlmsg_len = static_cast<unsigned>(size_);
    std::memcpy(bytes_.data(), &head_, sizeof(head_));
    std::memcpy(bytes_.data() + NLMSG_HDRLEN, &link_, sizeof(link_));
    struct {
      nlmsghdr head;
      nlmsgerr error;
      std::byte echoed[1024];
    } answer{};
    const bool answered = ::send(descriptor, bytes_.data(), size_, 0) > 0 &&
                          ::recv(descriptor, &answer, sizeof(answer), 0) > 0;
    const int error = answered ? -answer.error.error : errno;
    ::close(descriptor);
    return error;
  }

 private:
  nlmsghdr head_{};
  ifinfomsg link_{};
  alignas(4) std::array<std::byte, 512> bytes_{};
  std::size_t size_ = NLMSG_SPACE(sizeof(ifinfomsg));
};

class VcanLink {
 public:
  explicit VcanLink(std::string name, unsigned mtu_bytes = 72)
      : name_(std::move(name)), mtu_bytes_(mtu_bytes) {
    remove();  // left over by a run that was cut off
    error_ = make();
  }
  VcanLink(const VcanLink&) = delete;
  VcanLink& operator=(const VcanLink&) = delete;
  ~VcanLink() { remove(); }

  const std::string& name() const { return name_; }
  int error() const { return error_; }  // why it could not be made; 0 if it could

  // Up, at once. 0 or an errno.
  int make() const {
    struct {
      rtattr head{.rta_len = RTA_LENGTH(sizeof(kind)), .rta_type = IFLA_INFO_KIND};
      char kind[5] = "vcan";
    } const info;
    return about(RTM_NEWLINK, NLM_F_CREATE | NLM_F_EXCL, true)
        .add(IFLA_MTU, std::as_bytes(std::span(&mtu_bytes_, 1)))
        .add(IFLA_LINKINFO, std::as_bytes(std::span(&info, 1)))
        .ask();
  }
  int remove() const { return about(RTM_DELLINK, 0, false).ask(); }
  int set_up(bool up) const { return about(RTM_NEWLINK, 0, up).ask(); }

 private:
  LinkRequest about(unsigned short type, unsigned flags, bool up) const {
    LinkRequest request(type, flags, up);
    request.add(IFLA_IFNAME, std::as_bytes(std::span(name_.c_str(), name_.size() + 1)));
    return request;
  }

  std::string name_;
  unsigned mtu_bytes_;
  int error_ = 0;
};

// Why no virtual interface of that name can be had here; empty if one can.
inline std::string why_no_vcan(const std::string& name) {
  const int descriptor = ::socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, 1 /* CAN_RAW */);
  if (descriptor < 0) return "no CAN in this kernel";
  ::close(descriptor);
  const VcanLink trial(name);
  if (trial.error() == 0) return {};
  return std::string("cannot make a virtual CAN interface: ") + std::strerror(trial.error());
}

}  // namespace dottrack::test
