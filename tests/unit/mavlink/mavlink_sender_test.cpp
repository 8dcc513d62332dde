// Datagrams through the machine's own network, and addresses that are none.

#include "app/workstation/mavlink/mavlink_sender.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <vector>

#include "app/workstation/mavlink/pose_sequence.h"
#include "tests/unit/mavlink/poses.h"

namespace dottrack::workstation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::plain_pose;

using Datagram = std::vector<std::uint8_t>;

// A socket on 127.0.0.1 or ::1, at a port the system chooses.
class Listener {
 public:
  explicit Listener(int family) : descriptor_(::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_storage address{};
    socklen_t length = 0;
    if (family == AF_INET) {
      auto& to = reinterpret_cast<sockaddr_in&>(address);
      to.sin_family = AF_INET;
      to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      length = sizeof(to);
    } else {
      auto& to = reinterpret_cast<sockaddr_in6&>(address);
      to.sin6_family = AF_INET6;
      to.sin6_addr = in6addr_loopback;
      length = sizeof(to);
    }
    bound_ = descriptor_ >= 0 &&
             ::bind(descriptor_, reinterpret_cast<sockaddr*>(&address), length) == 0 &&
             ::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &length) == 0;
    port_ = ntohs(family == AF_INET ? reinterpret_cast<sockaddr_in&>(address).sin_port
                                    : reinterpret_cast<sockaddr_in6&>(address).sin6_port);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  bool bound() const { return bound_; }
  std::string port() const { return std::to_string(port_); }

  // What has come so far: the loopback delivers before send() returns.
  std::vector<Datagram> received() {
    std::vector<Datagram> all;
    std::array<std::uint8_t, 512> buffer{};
    while (true) {
      const auto size = ::recv(descriptor_, buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (size < 0) return all;
      all.emplace_back(buffer.begin(), buffer.begin() + size);
    }
  }

 private:
  int descriptor_;
  bool bound_ = false;
  std::uint16_t port_ = 0;
};

std::string complaint(const std::string& text) {
  const auto sender = MavlinkSender::open(text);
  return sender ? "none" : sender.error().message;
}

void expect_arrival(Listener& listener, const std::string& address) {
  const auto sender = MavlinkSender::open(address);
  ASSERT_TRUE(sender.has_value()) << sender.error().message;
  PoseSequence same({});
  dottrack_pose pose = plain_pose();
  std::size_t frames = 0;
  for (int i = 0; i < 20; ++i) {
    pose.arrival_us += 100'000;
    pose.position_m[0] += 0.01;
    (*sender)->send(pose);
    const std::vector<Datagram> received = listener.received();
    const auto expected = same.frames_of(pose);
    ASSERT_EQ(received.size(), expected.size()) << i;
    for (std::size_t j = 0; j < received.size(); ++j) {
      const auto view = expected[j].view();
      EXPECT_EQ(received[j], Datagram(view.begin(), view.end())) << i;
    }
    frames += received.size();
  }
  EXPECT_EQ(frames, 42U);
  EXPECT_EQ((*sender)->sent(), 20U);
  EXPECT_EQ((*sender)->failed(), 0U);
}

TEST(MavlinkSender, SendsOverIpv4) {
  Listener listener(AF_INET);
  ASSERT_TRUE(listener.bound());
  expect_arrival(listener, "127.0.0.1:" + listener.port());
}

TEST(MavlinkSender, SendsOverIpv6) {
  Listener listener(AF_INET6);
  if (!listener.bound()) GTEST_SKIP() << "this machine has no IPv6 loopback";
  expect_arrival(listener, "[::1]:" + listener.port());
}

TEST(MavlinkSender, CountsPosesOnly) {
  Listener listener(AF_INET);
  ASSERT_TRUE(listener.bound());
  const auto sender = MavlinkSender::open("127.0.0.1:" + listener.port());
  ASSERT_TRUE(sender.has_value());
  dottrack_pose none = plain_pose();
  none.valid = false;
  (*sender)->send(none);
  EXPECT_EQ(listener.received().size(), 1U);  // the heartbeat
  EXPECT_EQ((*sender)->sent(), 0U);
  EXPECT_EQ((*sender)->failed(), 0U);
}

TEST(MavlinkSender, CountsWhatNobodyTakesAndGoesOn) {
  std::string port;
  {
    Listener gone(AF_INET);
    ASSERT_TRUE(gone.bound());
    port = gone.port();
  }
  const auto sender = MavlinkSender::open("127.0.0.1:" + port);
  ASSERT_TRUE(sender.has_value());
  for (int i = 0; i < 10; ++i) (*sender)->send(plain_pose());
  EXPECT_GT((*sender)->failed(), 0U);
  EXPECT_EQ((*sender)->sent() + (*sender)->failed(), 10U);
}

TEST(MavlinkSender, SaysWhatIsWrongWithAnAddress) {
  const auto names_the_form = HasSubstr("expected HOST:PORT");
  EXPECT_THAT(complaint("localhost"), AllOf(HasSubstr("no port"), names_the_form));
  EXPECT_THAT(complaint(""), AllOf(HasSubstr("no port"), names_the_form));
  EXPECT_THAT(complaint(":14550"), AllOf(HasSubstr("no host"), names_the_form));
  EXPECT_THAT(complaint("[]:14550"), names_the_form);
  EXPECT_THAT(complaint("::1:14550"), AllOf(HasSubstr("brackets"), names_the_form));
  EXPECT_THAT(complaint("[::1]"), HasSubstr("HOST:PORT"));
  for (const char* port : {"", "0", "65536", "99999999999", "x", "80x", "-1", "+5", " 80"}) {
    EXPECT_THAT(complaint(std::string("127.0.0.1:") + port), HasSubstr("from 1 to 65535")) << port;
  }
}

TEST(MavlinkSender, SaysWhenThereIsNoSuchHost) {
  const std::string message = complaint("no-such-host.invalid:14550");
  EXPECT_THAT(message, HasSubstr("no-such-host.invalid"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

}  // namespace
}  // namespace dottrack::workstation
