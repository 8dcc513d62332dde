#pragma once
// Where to begin when nothing is known: a few dots of one plane that lie beside each other, and
// blobs that lie beside each other in the same pattern.

#include <vector>

#include "app/workstation/calibrate/labelling/scene.h"
#include "app/workstation/calibrate/labelling/survey_index.h"

namespace dottrack::calibrate {

// A dot, two neighbours, and those others around it that lie in the plane of the three.
struct Patch {
  int dot = 0;
  int first = 0;
  int second = 0;
  struct Other {
    int dot;
    double along_first;  // place = dot + along_first (first - dot) + along_second (second - dot)
    double along_second;
  };
  std::vector<Other> others;
};

// Patches alike but for their place: on a grid, nearly all of them.
struct PatchKind {
  Patch example;  // the one with the most others
  // Of all of them, (dot, first, second).
  struct Place {
    int dot, first, second;
  };
  std::vector<Place> places;
};

// Kinds of patches in the survey, those with the most places first.
std::vector<PatchKind> patch_kinds(const Scene& scene, const SurveyIndex& survey);

// A patch seen at three blobs, with the others that were found.
struct Sighting {
  Labels labels;
  double log_odds = 0.0;
  int size = 0;  // of the patch in the image, in steps of an eighth
};

// The best sightings of a kind of patches, best first; some of each size, since a grid may look
// like a part of itself in another size.
std::vector<Sighting> sightings(const Scene& scene, const PatchKind& kind, std::size_t most);

}  // namespace dottrack::calibrate
