#pragma once
// Looks through whole images for the target, over as many ticks as it takes: identify, then
// acquisition within a bound of work a tick.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "app/core/acquisition/acquisition.h"
#include "app/core/camera_frame.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::core {

class Searcher {
 public:
  // Work of acquisition in one tick, in units of about 10 ns on a desktop core; see WorkBudget.
  static constexpr std::uint64_t kWorkUnits = 200'000;
  // A search that takes longer is given up: the vehicle is elsewhere by now.
  static constexpr std::uint32_t kMaxTicks = 20;

  // The rig, the optics and the identifier must outlive the object.
  Searcher(const Rig& rig, std::span<const geometry::Optics> optics, image::Identifier& identifier);
  ~Searcher();
  Searcher(const Searcher&) = delete;
  Searcher& operator=(const Searcher&) = delete;

  // One tick's part: goes on with the search that is under way, else begins one on these frames.
  // True when a search has ended with it, or has been given up: its result says which.
  bool look(std::span<const CameraFrame> frames, Time captured);
  // Drops the search that is under way.
  void give_up();

  bool busy() const { return busy_; }
  // When the frames were taken that the last search looks through.
  Time captured() const { return captured_; }
  const acquisition::Acquisition& acquisition() const;

  // What became of the images of the last search, gate by gate.
  void report(TickResult& result) const;
  const image::Regions& regions(std::size_t camera) const;

  std::size_t footprint_bytes() const;

 private:
  struct Memory;

  void identify(std::span<const CameraFrame> frames);

  const Rig* rig_;
  image::Identifier* identifier_;
  std::unique_ptr<Memory> memory_;
  Time captured_{};
  bool busy_ = false;
};

}  // namespace dottrack::core
