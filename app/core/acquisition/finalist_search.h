#pragma once
// Match, both steps, as a search that can be interrupted: from all cameras' sightings to finalists
// (paper sections 3.1.3, 3.1.4), those of many views first.

#include <memory>
#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/match.h"
#include "app/core/acquisition/work_budget.h"
#include "app/core/tick_result.h"

namespace dottrack::acquisition {

// Lazy: a finalist seen by k cameras shows in any two of them, so finalists of many views are found
// from few of the pairs of cameras, and most of the pairs are never looked at. While more than two
// views are asked for, lines of sight that pass each other by more than kSureResidual_px in either
// image are left aside, too: a dot whose views disagree that much may have to wait for the search
// for two. Memory is taken at construction.
class FinalistSearch {
 public:
  FinalistSearch();
  ~FinalistSearch();
  FinalistSearch(const FinalistSearch&) = delete;
  FinalistSearch& operator=(const FinalistSearch&) = delete;

  // Begins anew. The views must stay as they are until the search is given up.
  void start(std::span<const CameraView> views, double largest_diameter_m);

  // Searches on for every finalist that at least min_views cameras (2 or more) see. True when the
  // search is complete; false when the budget ran out: call again with another one. Within one
  // search min_views may only become smaller; what was found before is kept.
  bool advance(int min_views, WorkBudget& budget, core::AcquisitionCounts& counts);

  // Refined by weighted least squares over all their lines of sight. Complete for as few views as
  // was last asked for; some of fewer may be among them.
  const Finalists& finalists() const;

  std::size_t footprint_bytes() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace dottrack::acquisition
