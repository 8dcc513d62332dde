#include "app/core/image/components.h"

#include <algorithm>
#include <utility>

namespace dottrack::image {

std::uint32_t Components::find(std::uint32_t label) {
  while (components_[label].parent != label) {
    const std::uint32_t grandparent = components_[components_[label].parent].parent;
    components_[label].parent = grandparent;
    label = grandparent;
  }
  return label;
}

// The older of the two stays, so a component's place is that of its first pixel.
std::uint32_t Components::unite(std::uint32_t a, std::uint32_t b) {
  if (a == b) return a;
  if (b < a) std::swap(a, b);
  Component& into = components_[a];
  Component& from = components_[b];
  from.parent = a;
  next_run_[into.tail] = from.head;
  into.tail = from.tail;
  into.area_px += from.area_px;
  into.x_min = std::min(into.x_min, from.x_min);
  into.x_max = std::max(into.x_max, from.x_max);
  into.y_min = std::min(into.y_min, from.y_min);
  into.y_max = std::max(into.y_max, from.y_max);
  return a;
}

std::uint32_t Components::start(std::uint32_t run, const Run& ends) {
  const auto label = static_cast<std::uint32_t>(size_++);
  const auto y = static_cast<std::int16_t>(row(ends.first));
  components_[label] = {label,
                        run,
                        run,
                        ends.last - ends.first + 1,
                        static_cast<std::int16_t>(column(ends.first)),
                        static_cast<std::int16_t>(column(ends.last)),
                        y,
                        y};
  return label;
}

void Components::append(std::uint32_t label, std::uint32_t run, const Run& ends) {
  Component& component = components_[label];
  next_run_[component.tail] = run;
  component.tail = run;
  component.area_px += ends.last - ends.first + 1;
  component.x_min = std::min(component.x_min, static_cast<std::int16_t>(column(ends.first)));
  component.x_max = std::max(component.x_max, static_cast<std::int16_t>(column(ends.last)));
  component.y_max = static_cast<std::int16_t>(row(ends.first));
}

void Components::connect(const RunList& runs) {
  size_ = 0;
  std::uint32_t above = 0;  // no run before it touches the next run from above
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    const Run run = runs[i];
    next_run_[i] = kEnd;
    while (runs[above].last < run.first - kRowStep) ++above;
    if (runs[above].first > run.last - kRowStep) {
      label_[i] = start(i, run);
      continue;
    }
    std::uint32_t label = find(label_[above]);
    while (runs[above + 1].first <= run.last - kRowStep)
      label = unite(label, find(label_[++above]));
    append(label, i, run);
    label_[i] = label;
  }
}

}  // namespace dottrack::image
