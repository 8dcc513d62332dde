#pragma once
// The lines that come out of a socket, kept with the time of their arrival.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/board/harness/unix_socket.h"

namespace dottrack::board {

struct LoggedLine {
  Time received{};  // on this machine's clock
  std::string text;
};

// A thread of its own reads; everyone else asks. The lines also go to a file.
class LineLog {
 public:
  using Listener = std::function<void(const LoggedLine&)>;

  // `listener` is called for every line, on the reading thread.
  LineLog(UnixSocket socket, const std::filesystem::path& file, Listener listener = {});
  ~LineLog();
  LineLog(const LineLog&) = delete;
  LineLog& operator=(const LineLog&) = delete;

  bool send(std::string_view bytes);

  std::size_t size() const;   // lines so far
  bool closed() const;        // nothing more will come
  std::size_t bytes() const;  // also those of a line that is not complete
  std::vector<LoggedLine> from(std::size_t first) const;

  // The index of the first line from `first` on that fits; waits for it up to `patience`, or until
  // the other side closes.
  using Fits = std::function<bool(std::string_view)>;
  std::optional<std::size_t> wait_for(const Fits& fits, std::size_t first, Duration patience) const;
  std::string text(std::size_t index) const;

 private:
  void read_all();
  void take(std::string_view bytes);
  void take_line();

  UnixSocket socket_;
  std::ofstream file_;
  Listener listener_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<LoggedLine> lines_;
  std::string partial_;  // of the reading thread alone
  std::size_t bytes_ = 0;
  bool closed_ = false;
  std::atomic<bool> stop_{false};
  std::thread reader_;
};

}  // namespace dottrack::board
