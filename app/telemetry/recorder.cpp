#include "app/telemetry/recorder.h"

namespace dottrack::telemetry {

std::size_t Recorder::drain() {
  std::size_t count = 0;
  for (; ring_.try_pop(record_); ++count) {
    for (RecordWriter* writer : writers_) writer->write(record_);
  }
  return count;
}

}  // namespace dottrack::telemetry
