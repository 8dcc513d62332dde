#include "app/core/acquisition/finalist_search.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <memory>
#include <set>

#include "tests/unit/acquisition/reference_merger.h"
#include "tests/unit/acquisition/room_views.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr double kDiameter_m = 0.1;
constexpr double kNoise_px = 0.1;
constexpr std::uint64_t kUnlimited = 1ULL << 60U;

using Key = std::vector<int>;  // a finalist's sighting in every camera, or -1

template <class AnyFinalist>
Key key_of(const AnyFinalist& finalist) {
  Key key;
  for (std::size_t c = 0; c < kMaxCameras; ++c) {
    key.push_back(finalist.cameras.contains(c) ? finalist.sighting[c] : -1);
  }
  return key;
}

std::set<Key> keys_of(std::span<const Finalist> finalists) {
  std::set<Key> keys;
  for (const Finalist& f : finalists) {
    EXPECT_TRUE(keys.insert(key_of(f)).second) << "two finalists with the same views";
  }
  return keys;
}

class FinalistSearchTest : public testing::Test {
 protected:
  void use(const std::vector<core::Camera>& cameras) {
    cameras_ = cameras;
    views_ = std::vector<CameraView>(cameras.size());
  }

  void see(const std::vector<Vector3d>& points, double noise_px) {
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      test::see(cameras_[i], points, kDiameter_m, noise_px, random_, views_[i]);
    }
  }

  // Searches in slices of that many units; how many it took.
  int search(int min_views, std::uint64_t units = kUnlimited) {
    int slices = 0;
    for (bool complete = false; !complete; ++slices) {
      WorkBudget budget(units);
      complete = search_.advance(min_views, budget, counts_);
    }
    return slices;
  }

  std::span<const Finalist> finalists() const { return as_span(search_.finalists()); }

  const Finalist* find(const test::SeenDot& dot) const {
    const Finalist* best = nullptr;
    for (const Finalist& f : finalists()) {
      int common = 0;
      for (std::size_t c = 0; c < cameras_.size(); ++c) {
        common += dot.cameras.contains(c) && f.sees(c, dot.sighting[c]) ? 1 : 0;
      }
      if (common * 2 <= f.cameras.size()) continue;
      if (best == nullptr || f.cameras.size() > best->cameras.size()) best = &f;
    }
    return best;
  }

  std::mt19937 random_{6};
  std::vector<core::Camera> cameras_ = test::ceiling_cameras();
  std::vector<CameraView> views_ = std::vector<CameraView>(cameras_.size());
  FinalistSearch search_;
  core::AcquisitionCounts counts_;
};

TEST_F(FinalistSearchTest, ADotSeenByAllCamerasIsOneFinalist) {
  see({{4.0, 3.0, 0.3}}, kNoise_px);
  for (const int min_views : {4, 3, 2}) {
    search_.start(views_, kDiameter_m);
    search(min_views);
    ASSERT_EQ(finalists().size(), 1U);
    const Finalist& finalist = finalists()[0];
    EXPECT_EQ(finalist.cameras.size(), 5);
    EXPECT_LT((finalist.position_m - Vector3d(4.0, 3.0, 0.3)).norm(), 0.005);
    EXPECT_NEAR(finalist.diameter_m, kDiameter_m, 0.01);
    EXPECT_GT(finalist.covariance_m2.trace(), 0.0);
    EXPECT_EQ(finalist.pairs == 10U, min_views == 2);
  }
}

TEST_F(FinalistSearchTest, EveryDotOfManyIsFoundWithAllItsViews) {
  int dots = 0;
  int whole = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const auto points = test::points_in_room(30, random_);
    const auto seen = test::see_room(cameras_, points, 0, kDiameter_m, 0.15, random_, views_);
    search_.start(views_, kDiameter_m);
    search(2);
    for (const test::SeenDot& dot : seen) {
      if (dot.cameras.size() < 2) continue;
      ++dots;
      const Finalist* f = find(dot);
      whole += f != nullptr && key_of(*f) == key_of(dot) ? 1 : 0;
    }
  }
  EXPECT_GT(dots, 400);
  EXPECT_GE(whole, dots * 98 / 100);
}

TEST_F(FinalistSearchTest, NoViewIsListedTwiceAndNoneIsLeftAlone) {
  see(test::points_in_room(60, random_), 0.2);
  search_.start(views_, kDiameter_m);
  for (const int min_views : {4, 3, 2}) {
    search(min_views);
    for (const Finalist& f : finalists()) EXPECT_GE(f.cameras.size(), 2);
    keys_of(finalists());
  }
  EXPECT_GT(finalists().size(), 50U);
  EXPECT_EQ(counts_.finalists, finalists().size());
}

TEST_F(FinalistSearchTest, TwoRegionsOfOneCameraNeverJoinOneFinalist) {
  see({{4.0, 3.0, 0.3}, {4.02, 3.01, 0.3}}, 0.0);
  search_.start(views_, kDiameter_m);
  search(2);
  EXPECT_GE(finalists().size(), 2U);
}

// Dots among clutter: found in the first search that asks for no more views than they have, with
// the position that their views give and with the views that are theirs.
struct Tally {
  int dots = 0;
  int found = 0;
  int views = 0;
  int views_found = 0;
  double squared = 0.0;  // Mahalanobis distances
};

class DotsInClutterTest : public FinalistSearchTest {
 protected:
  void count(const test::SeenDot& dot, Tally& tally) const {
    ++tally.dots;
    tally.views += dot.cameras.size();
    const Finalist* f = find(dot);
    if (f == nullptr) return;
    const Vector3d error = f->position_m - dot.position_m;
    const double distance2 = error.dot(f->covariance_m2.inverse() * error);
    if (distance2 > 25.0) return;
    ++tally.found;
    tally.squared += distance2;
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      if (dot.cameras.contains(c) && f->sees(c, dot.sighting[c])) ++tally.views_found;
    }
  }

  void search_rooms(int rooms, std::size_t points, std::size_t clutter, int min_views,
                    Tally& tally) {
    use(test::room_cameras());
    for (int room = 0; room < rooms; ++room) {
      const auto seen = test::see_room(cameras_, test::points_in_hall(points, random_), clutter,
                                       kDiameter_m, kNoise_px, random_, views_);
      search_.start(views_, kDiameter_m);
      for (int k = 4; k >= min_views; --k) search(k);
      for (const test::SeenDot& dot : seen) {
        if (dot.cameras.size() >= min_views) count(dot, tally);
      }
    }
    EXPECT_LT(tally.squared / tally.found, 4.0);  // 3 where the noise is what it is taken for
    EXPECT_EQ(counts_.overflow, 0U);
  }
};

TEST_F(DotsInClutterTest, OfFourViewsOrMoreAreAllFound) {
  Tally tally;
  search_rooms(8, 48, 280, 4, tally);
  EXPECT_GT(tally.dots, 200);
  EXPECT_EQ(tally.found, tally.dots);
  EXPECT_GE(tally.views_found, tally.views * 999 / 1000);
}

TEST_F(DotsInClutterTest, OfThreeViewsOrMoreAreAllFound) {
  Tally tally;
  search_rooms(8, 48, 150, 3, tally);
  EXPECT_GT(tally.dots, 200);
  EXPECT_EQ(tally.found, tally.dots);
  EXPECT_GE(tally.views_found, tally.views * 998 / 1000);
}

TEST_F(DotsInClutterTest, OfTwoViewsOrMoreAreAllFound) {
  Tally tally;
  search_rooms(8, 48, 50, 2, tally);
  EXPECT_GT(tally.dots, 200);
  EXPECT_GE(tally.found, tally.dots * 99 / 100);
  EXPECT_GE(tally.views_found, tally.views * 997 / 1000);
}

TEST_F(FinalistSearchTest, IsTheSameHoweverItIsInterrupted) {
  use(test::room_cameras());
  test::see_room(cameras_, test::points_in_hall(40, random_), 150, kDiameter_m, kNoise_px, random_,
                 views_);
  struct Outcome {
    std::vector<Finalist> finalists;
    int slices = 0;
  };
  const auto outcome = [&](std::uint64_t units) {
    Outcome result;
    search_.start(views_, kDiameter_m);
    for (const int min_views : {4, 3, 2}) {
      result.slices += search(min_views, units);
      result.finalists.insert(result.finalists.end(), finalists().begin(), finalists().end());
    }
    return result;
  };
  const Outcome whole = outcome(kUnlimited);
  EXPECT_EQ(whole.slices, 3);
  ASSERT_GT(whole.finalists.size(), 500U);
  for (const std::uint64_t units : {1U, 7U, 100U, 10000U}) {
    const Outcome sliced = outcome(units);
    EXPECT_GT(sliced.slices, 10);
    ASSERT_EQ(sliced.finalists.size(), whole.finalists.size());
    for (std::size_t i = 0; i < whole.finalists.size(); ++i) {
      const Finalist& a = whole.finalists[i];
      const Finalist& b = sliced.finalists[i];
      EXPECT_EQ(key_of(a), key_of(b));
      EXPECT_EQ(a.position_m, b.position_m);
      EXPECT_EQ(a.covariance_m2, b.covariance_m2);
      EXPECT_EQ(a.diameter_m, b.diameter_m);
      EXPECT_EQ(a.pairs, b.pairs);
    }
  }
}

TEST_F(FinalistSearchTest, ASliceIsAboutAsLongAsItsBudget) {
  use(test::room_cameras());
  test::see_room(cameras_, test::points_in_hall(40, random_), 200, kDiameter_m, kNoise_px, random_,
                 views_);
  search_.start(views_, kDiameter_m);
  constexpr std::uint64_t kUnits = 3000;
  std::uint64_t longest = 0;
  for (bool complete = false; !complete;) {
    WorkBudget budget(kUnits);
    complete = search_.advance(2, budget, counts_);
    longest = std::max(longest, budget.spent());
  }
  EXPECT_GT(longest, kUnits);
  EXPECT_LT(longest, 3 * kUnits);
}

// Without ambiguity there is one answer, and the paper's procedure finds it too.
TEST_F(FinalistSearchTest, FindsWhatThePapersProcedureFinds) {
  use(test::room_cameras());
  std::size_t total = 0;
  for (int trial = 0; trial < 10; ++trial) {
    test::see_room(cameras_, test::points_in_hall(12, random_), 0, kDiameter_m, 0.05, random_,
                   views_);
    search_.start(views_, kDiameter_m);
    search(2);
    const std::vector<Finalist> expected = test::ReferenceMerger().finalists(views_, kDiameter_m);
    const std::set<Key> ours = keys_of(finalists());
    for (const Finalist& f : expected) {
      if (f.cameras.size() < 4) continue;  // lines of sight to several dots may cross
      ++total;
      EXPECT_EQ(ours.count(key_of(f)), 1U);
    }
  }
  EXPECT_GT(total, 80U);
}

// Two views are enough for the paper's procedure: whatever two lines cross at is among the
// finalists, be it with more views, unless both lines are those of dots that many cameras see.
TEST_F(FinalistSearchTest, ContainsEveryCrossingOfTwoLines) {
  std::size_t total = 0;
  std::size_t contained = 0;
  std::size_t alone_too = 0;
  for (int trial = 0; trial < 5; ++trial) {
    test::see_room(cameras_, test::points_in_room(20, random_), 60, kDiameter_m, kNoise_px, random_,
                   views_);
    search_.start(views_, kDiameter_m);
    search(2);
    const auto matcher = std::make_unique<Matcher>();
    const auto pairs = std::make_unique<CandidatePairs>();
    for (std::size_t a = 0; a < cameras_.size(); ++a) {
      for (std::size_t b = a + 1; b < cameras_.size(); ++b) {
        pairs->clear();
        core::AcquisitionCounts counts;
        WorkBudget budget(kUnlimited);
        matcher->match(views_, a, b, kDiameter_m, *pairs, counts, budget);
        for (const CandidatePair& pair : *pairs) {
          Finalist alone;
          PointViews views;
          views.set(a, pair.sighting[0]);
          views.set(b, pair.sighting[1]);
          if (!refine_finalist(views_, views, alone)) continue;
          ++total;
          bool found = false;
          CameraSet of_others;  // where the sighting is one of a finalist of many views
          for (const Finalist& f : finalists()) {
            const bool in_a = f.sees(a, pair.sighting[0]);
            const bool in_b = f.sees(b, pair.sighting[1]);
            found = found || (in_a && in_b);
            if (f.cameras.size() < 5) continue;
            if (in_a) of_others.insert(a);
            if (in_b) of_others.insert(b);
          }
          contained += found || of_others.size() == 2 ? 1U : 0U;
          alone_too += found ? 1U : 0U;
        }
      }
    }
  }
  EXPECT_GT(total, 1000U);
  EXPECT_EQ(contained, total);
  EXPECT_GT(alone_too, total * 3 / 4);
}

TEST_F(FinalistSearchTest, CamerasAtOnePlaceDoNotHideADot) {
  // Three places, two cameras at each: every dot that four cameras see is seen from two places.
  auto cameras = test::ceiling_cameras();
  cameras.resize(3);
  for (std::size_t i = 0; i < 3; ++i) cameras.push_back(cameras[i]);
  use(cameras);
  int dots = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const auto seen = test::see_room(cameras_, test::points_in_room(10, random_), 30, kDiameter_m,
                                     kNoise_px, random_, views_);
    for (const int min_views : {4, 3, 2}) {
      search_.start(views_, kDiameter_m);
      search(min_views);
      for (const test::SeenDot& dot : seen) {
        std::set<std::size_t> places;
        for (std::size_t c = 0; c < 6; ++c) {
          if (dot.cameras.contains(c)) places.insert(c % 3);
        }
        if (places.size() < 2 || dot.cameras.size() < min_views) continue;
        ++dots;
        EXPECT_NE(find(dot), nullptr);
      }
    }
  }
  EXPECT_GT(dots, 200);
}

TEST_F(FinalistSearchTest, CamerasWithoutSightingsTakeNoPart) {
  use(test::room_cameras());
  auto seen = test::see_room(cameras_, test::points_in_hall(30, random_), 50, kDiameter_m,
                             kNoise_px, random_, views_);
  for (const std::size_t c : {0U, 3U, 7U, 8U}) {
    views_[c].sightings.clear();
    for (test::SeenDot& dot : seen) dot.cameras.erase(c);
  }
  search_.start(views_, kDiameter_m);
  search(4);
  int dots = 0;
  for (const test::SeenDot& dot : seen) {
    if (dot.cameras.size() < 4) continue;
    ++dots;
    EXPECT_NE(find(dot), nullptr);
  }
  EXPECT_GT(dots, 10);
  for (CameraView& view : views_) view.sightings.clear();
  search_.start(views_, kDiameter_m);
  EXPECT_EQ(search(2), 1);
  EXPECT_TRUE(finalists().empty());
}

TEST_F(FinalistSearchTest, FewViewsAreNotLookedForBeforeTheyAreAskedFor) {
  use(test::room_cameras());
  test::see_room(cameras_, test::points_in_hall(40, random_), 200, kDiameter_m, kNoise_px, random_,
                 views_);
  search_.start(views_, kDiameter_m);
  search(4);
  const std::uint32_t pairs_of_four = counts_.pairs_tested;
  search(2);
  EXPECT_LT(2 * pairs_of_four, counts_.pairs_tested);
}

}  // namespace
}  // namespace dottrack::acquisition
