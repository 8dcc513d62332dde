#pragma once
// How many matches as good as this one clutter would offer by chance: what keeps the tracker from
// locking onto the wrong thing (paper section 4: "very occasionally the tracker would lock onto the
// wrong object").

#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/select.h"
#include "app/core/acquisition/target_shape.h"

namespace dottrack::acquisition {

// The expected number of assignments of unrelated finalists that match the target's distances as
// closely as the selection does. Finalists are taken as scattered evenly around the target; only
// those seen by at least as many cameras as the chosen one count as its rivals, since lines of
// sight rarely cross by chance in three views and hardly ever in four. For the dots in the order of
// the target: any rival may be the first, one in a spherical shell the second, in a ring the third,
// in one of two small balls each further one.
double chance_matches(const TargetShape& shape, std::span<const Finalist> finalists,
                      const Selection& selection);

// How closely the selection's distances fit the target's, metres: root mean square over all pairs
// of dots, and with it the finalists' own uncertainty as the least that is believed.
double fit_of(const TargetShape& shape, std::span<const Finalist> finalists,
              const Selection& selection);

}  // namespace dottrack::acquisition
