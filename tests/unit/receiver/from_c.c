/* The header as a vehicle's C program sees it. */
#include "tests/unit/receiver/from_c.h"

#include "app/core/protocol/receiver/dottrack_receiver.h"

int frames_a_c_program_finds_foreign(void) {
  dottrack_receiver receiver;
  dottrack_frame frame = {.id = DOTTRACK_DEFAULT_BASE_ID + DOTTRACK_IDENTIFIERS, .length = 8};
  dottrack_pose pose;
  const dottrack_settings settings = dottrack_default_settings();
  dottrack_receiver_init(&receiver, &settings);
  int foreign = 0;
  for (uint64_t i = 0; i < 3; ++i) {
    if (dottrack_receiver_push(&receiver, &frame, i, &pose) == DOTTRACK_FOREIGN) ++foreign;
  }
  return foreign;
}
