#include "tests/board/harness/line_log.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <thread>

#include "tests/board/harness/guest_shell.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

// The other side of a line: what an emulator offers.
class Offered {
 public:
  Offered() {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = path().string();
    std::copy(name.begin(), name.end(), static_cast<char*>(address.sun_path));
    listener_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    ::listen(listener_, 1);
  }
  Offered(const Offered&) = delete;
  Offered& operator=(const Offered&) = delete;
  ~Offered() {
    hang_up();
    ::close(listener_);
  }

  std::filesystem::path path() const { return folder_.path() / "line"; }
  std::filesystem::path file() const { return folder_.path() / "line.log"; }
  void accept() { accepted_ = ::accept(listener_, nullptr, nullptr); }
  void say(const std::string& text) const { (void)!::write(accepted_, text.data(), text.size()); }
  // Reads until it has heard so many lines.
  std::string hear(int lines) const {
    std::string heard;
    for (char c = 0; lines > 0 && ::read(accepted_, &c, 1) == 1; heard += c) lines -= c == '\n';
    return heard;
  }
  void hang_up() {
    if (accepted_ >= 0) ::close(accepted_);
    accepted_ = -1;
  }

 private:
  test::TemporaryFolder folder_;
  int listener_ = -1;
  int accepted_ = -1;
};

struct Line {
  Line() : log(*UnixSocket::connect(offered.path(), seconds(5)), offered.file()) {
    offered.accept();
  }
  Offered offered;
  LineLog log;
};

TEST(LineLog, CutsWhatComesIntoLines) {
  Line line;
  line.offered.say("first\r\nsec");
  line.offered.say("ond\nrest");
  const auto is_second = [](std::string_view text) { return text == "second"; };
  EXPECT_EQ(line.log.wait_for(is_second, 0, seconds(20)), 1U);
  EXPECT_EQ(line.log.text(0), "first");
}

TEST(LineLog, WaitingEndsWhenTheOtherSideDoes) {
  Line line;
  line.offered.hang_up();
  EXPECT_FALSE(line.log.wait_for([](std::string_view) { return true; }, 0, seconds(60)));
  EXPECT_TRUE(line.log.closed());
}

TEST(GuestShell, GivesStatusAndTextOfACommand) {
  Line line;
  GuestShell shell(line.log);
  std::thread guest([&] {
    EXPECT_NE(line.offered.hear(1).find("{ ls ; }"), std::string::npos);
    line.offered.say("one\ntwo\n\ncommand-1-ended-with 3\n");
  });
  const auto output = shell.run("ls", seconds(20));
  guest.join();
  ASSERT_TRUE(output);
  EXPECT_EQ(output->status, 3);
  EXPECT_EQ(output->text, "one\ntwo");
}

TEST(GuestShell, ASilentGuestIsAnError) {
  Line line;
  GuestShell shell(line.log);
  const auto output = shell.run("ls", std::chrono::milliseconds(50));
  ASSERT_FALSE(output);
  EXPECT_NE(output.error().message.find("ls"), std::string::npos);
}

TEST(GuestShell, AnEmulatorThatHasEndedIsNotWaitedFor) {
  Line line;
  GuestShell shell(line.log);
  line.offered.hang_up();
  EXPECT_FALSE(shell.wait_until_ready(0, seconds(300)));
}

}  // namespace
}  // namespace dottrack::board
