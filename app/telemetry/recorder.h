#pragma once
// From the loop's ring to whoever keeps the records: files, mostly, so never in the loop's thread
// on the board.

#include <cstddef>
#include <vector>

#include "app/telemetry/cycle_record.h"
#include "rtos_shim/spsc_ring.h"

namespace dottrack::telemetry {

// Two seconds of records at 30 Hz.
using RecordRing = rtos::SpscRing<CycleRecord, 64>;

// Keeps records. Outside the loop: may allocate and may be slow.
class RecordWriter {
 public:
  RecordWriter() = default;
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;
  virtual ~RecordWriter() = default;

  void write(const CycleRecord& record) { do_write(record); }

 private:
  virtual void do_write(const CycleRecord& record) = 0;
};

// The ring's one consumer.
class Recorder {
 public:
  explicit Recorder(RecordRing& ring) : ring_(ring) {}

  // Every record from now on also goes to this writer, which must outlive the recorder.
  void add(RecordWriter& writer) { writers_.push_back(&writer); }

  // Hands every waiting record to every writer, oldest first; returns how many there were.
  std::size_t drain();

 private:
  RecordRing& ring_;
  std::vector<RecordWriter*> writers_;
  CycleRecord record_;
};

}  // namespace dottrack::telemetry
