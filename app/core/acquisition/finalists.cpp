#include "app/core/acquisition/finalists.h"

namespace dottrack::acquisition {

void FinalistSet::clear() {
  finalists_.clear();
  for (auto& heads : heads_) heads.fill(kNone);
}

void FinalistSet::link(std::uint16_t index) {
  const Finalist& finalist = finalists_[index];
  cameras_[index] = finalist.cameras;
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!finalist.cameras.contains(camera)) continue;
    std::uint16_t& head = heads_[camera][finalist.sighting[camera]];
    next_[index][camera] = head;
    head = index;
  }
}

void FinalistSet::unlink(std::uint16_t index) {
  const Finalist& finalist = finalists_[index];
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!finalist.cameras.contains(camera)) continue;
    std::uint16_t* from = &heads_[camera][finalist.sighting[camera]];
    while (*from != index) from = &next_[*from][camera];
    *from = next_[index][camera];
  }
}

bool FinalistSet::add(const Finalist& finalist) {
  if (!try_push_back(finalists_, finalist)) return false;
  link(static_cast<std::uint16_t>(finalists_.size() - 1));
  return true;
}

void FinalistSet::remove(std::uint16_t index) {
  const auto last = static_cast<std::uint16_t>(finalists_.size() - 1);
  unlink(index);
  if (index != last) {
    unlink(last);
    finalists_[index] = finalists_[last];
    link(index);
  }
  finalists_.pop_back();
}

}  // namespace dottrack::acquisition
