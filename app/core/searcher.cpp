#include "app/core/searcher.h"

#include "app/core/acquisition/sightings.h"
#include "app/core/image/band.h"

namespace dottrack::core {

struct Searcher::Memory {
  Memory(const Rig& rig, std::span<const geometry::Optics> optics) : acquisition(rig, optics) {
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      gates[i] = acquisition::acquisition_gate(rig.cameras[i], optics[i], rig.target);
    }
  }

  acquisition::Acquisition acquisition;
  std::array<image::RegionGate, kMaxCameras> gates{};
  std::array<image::Regions, kMaxCameras> regions;
  std::array<image::IdentifyCounts, kMaxCameras> counts{};
};

Searcher::Searcher(const Rig& rig, std::span<const geometry::Optics> optics,
                   image::Identifier& identifier)
    : rig_(&rig), identifier_(&identifier), memory_(std::make_unique<Memory>(rig, optics)) {}

Searcher::~Searcher() = default;

// 3.1.2
void Searcher::identify(std::span<const CameraFrame> frames) {
  for (std::size_t i = 0; i < rig_->cameras.size(); ++i) {
    memory_->counts[i] = {};
    memory_->regions[i].clear();
    if (!frames[i].delivered) continue;
    memory_->counts[i] = identifier_->identify(frames[i].image, image::band_of(rig_->cameras[i]),
                                               memory_->gates[i], memory_->regions[i]);
  }
}

bool Searcher::look(std::span<const CameraFrame> frames, Time captured) {
  Memory& m = *memory_;
  acquisition::WorkBudget budget(kWorkUnits);
  if (!busy_) {
    captured_ = captured;
    identify(frames);
    std::array<const image::Regions*, kMaxCameras> regions{};
    for (std::size_t i = 0; i < rig_->cameras.size(); ++i) regions[i] = &m.regions[i];
    m.acquisition.start(regions, budget);
  }
  busy_ = !m.acquisition.go_on(budget);
  if (busy_ && m.acquisition.result().counts.ticks >= kMaxTicks) {
    m.acquisition.stop();
    busy_ = false;
  }
  return !busy_;
}

void Searcher::give_up() {
  busy_ = false;
}

const acquisition::Acquisition& Searcher::acquisition() const {
  return memory_->acquisition;
}

void Searcher::report(TickResult& result) const {
  const Memory& m = *memory_;
  for (std::size_t i = 0; i < rig_->cameras.size(); ++i) {
    const image::IdentifyCounts& counts = m.counts[i];
    CameraTick& camera = result.cameras[i];
    camera.components = counts.components;
    camera.rejected_size = counts.rejected_size;
    camera.rejected_shape = counts.rejected_shape;
    camera.regions = counts.accepted;
    camera.sightings = static_cast<std::uint32_t>(m.acquisition.sightings(i));
    camera.rejected_sight = camera.regions - camera.sightings;
    camera.overflow = counts.overflow_runs + counts.overflow_regions > 0;
  }
  result.acquisition = m.acquisition.result().counts;
}

const image::Regions& Searcher::regions(std::size_t camera) const {
  return memory_->regions[camera];
}

std::size_t Searcher::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory) + memory_->acquisition.footprint_bytes();
}

}  // namespace dottrack::core
