#pragma once
// From crossings of two lines of sight to finalists: what other cameras see there, where that puts
// the dot, and which finalists are the same.

#include <cstdint>
#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/match.h"
#include "app/core/acquisition/view_finder.h"
#include "app/core/acquisition/work_budget.h"
#include "app/core/tick_result.h"

namespace dottrack::acquisition {

class FinalistBuilder {
 public:
  // Begins anew. The views must stay as they are while pairs are taken.
  void start(std::span<const CameraView> views);

  // What take() is to know of each pair: every camera that has a sighting close to its point, and
  // some others. Of many at once it is found much quicker than one by one.
  void look(std::span<const CandidatePair> pairs, std::span<CameraSet> close) const {
    finder_.look(pairs, close);
  }

  // Finds the finalist of a pair, if at least min_views cameras see it. Answers how many views one
  // of this pair that was passed over now may have at most; 0: there is none but what was found.
  // With min_views 2 no pair is passed over: if it has no finalist whose views agree, it is one.
  int take(const CandidatePair& pair, CameraSet look, int min_views, WorkBudget& budget,
           core::AcquisitionCounts& counts);

  // Drops the finalist when all its sightings belong to others of many more views: its lines of
  // sight are those to other dots. The last finalist takes its place.
  void judge(std::uint16_t index, WorkBudget& budget);

  const Finalists& finalists() const { return set_.finalists(); }

 private:
  bool has_finalist(const CandidatePair& pair, bool count, WorkBudget& budget);
  void place(Finalist finalist, WorkBudget& budget, core::AcquisitionCounts& counts);
  bool merge_with_prior(Finalist& finalist, WorkBudget& budget);
  bool made_of_others(const Finalist& finalist, WorkBudget& budget) const;

  std::span<const CameraView> views_;
  ViewFinder finder_;
  FinalistSet set_;
};

}  // namespace dottrack::acquisition
