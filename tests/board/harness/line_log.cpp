#include "tests/board/harness/line_log.h"

#include <array>
#include <utility>

#include "tests/board/harness/host_clock.h"

namespace dottrack::board {

LineLog::LineLog(UnixSocket socket, const std::filesystem::path& file, Listener listener)
    : socket_(std::move(socket)),
      file_(file),
      listener_(std::move(listener)),
      reader_([this] { read_all(); }) {}

LineLog::~LineLog() {
  stop_ = true;
  reader_.join();
}

bool LineLog::send(std::string_view bytes) {
  return socket_.send(bytes);
}

void LineLog::read_all() {
  std::array<char, 4096> buffer{};
  while (!stop_) {
    std::size_t size = 0;
    const auto read = socket_.receive(buffer, std::chrono::milliseconds(100), size);
    if (read == UnixSocket::Read::closed) break;
    take({buffer.data(), size});
  }
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

void LineLog::take(std::string_view bytes) {
  if (bytes.empty()) return;
  for (const char c : bytes) {
    if (c == '\n') {
      take_line();
    } else if (c != '\r') {
      partial_ += c;
    }
  }
  file_.flush();
  const std::lock_guard lock(mutex_);
  bytes_ += bytes.size();
  changed_.notify_all();
}

void LineLog::take_line() {
  LoggedLine line{host_now(), std::exchange(partial_, {})};
  file_ << line.text << '\n';
  if (listener_) listener_(line);
  const std::lock_guard lock(mutex_);
  lines_.push_back(std::move(line));
}

std::size_t LineLog::size() const {
  const std::lock_guard lock(mutex_);
  return lines_.size();
}

bool LineLog::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

std::size_t LineLog::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::vector<LoggedLine> LineLog::from(std::size_t first) const {
  const std::lock_guard lock(mutex_);
  if (first >= lines_.size()) return {};
  return {lines_.begin() + static_cast<std::ptrdiff_t>(first), lines_.end()};
}

std::string LineLog::text(std::size_t index) const {
  const std::lock_guard lock(mutex_);
  return lines_.at(index).text;
}

std::optional<std::size_t> LineLog::wait_for(const Fits& fits, std::size_t first,
                                             Duration patience) const {
  std::unique_lock lock(mutex_);
  std::optional<std::size_t> found;
  std::size_t next = first;
  changed_.wait_for(lock, patience, [&] {
    for (; next < lines_.size() && !found; ++next) {
      if (fits(lines_[next].text)) found = next;
    }
    return found || closed_;
  });
  return found;
}

}  // namespace dottrack::board
