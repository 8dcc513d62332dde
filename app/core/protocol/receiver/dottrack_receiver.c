#include "dottrack_receiver.h"

#include <string.h>

/* Offsets of the identifiers from the base. */
enum {
  STATUS = 0,
  QUALITY = 2,
  VELOCITY = 6,
  RATES = 7,
  SIGMA_POSITION = 8,
  CORRELATION3 = 12,
  CAMERAS = 13,
  VERSION = 14,
  CONFIGURATION = 15,
  FD_POSE = 16,
  REPLY = 17,
  COMMAND = 18,
  LIGHT = 19,
  FIRST_DOT = 32
};

#define BIT(message) ((uint64_t)1 << (message))
#define ALWAYS (BIT(STATUS) | BIT(1) | BIT(QUALITY) | BIT(3) | BIT(4) | BIT(5))
#define MOTION (BIT(VELOCITY) | BIT(RATES))
#define COVARIANCE (BIT(CORRELATION3 + 1) - BIT(SIGMA_POSITION))
#define KNOWN ((BIT(LIGHT + 1) - 1) | ~(BIT(FIRST_DOT) - 1))
#define GROUPED \
  (KNOWN & ~(BIT(VERSION) | BIT(CONFIGURATION) | BIT(REPLY) | BIT(COMMAND) | BIT(LIGHT)))

#define CLASSIC_BYTES 8
#define FD_BYTES 64
#define FD_DATA_ID 0xD07A
#define CAPTURE_MASK (BIT(48) - 1) /* microseconds on the bus are modulo 2^48 */

/* ---- checksums ---- */

/* Of every byte, polynomial 0x2F. */
static const uint8_t crc8_table[256] = {
    0x00, 0x2F, 0x5E, 0x71, 0xBC, 0x93, 0xE2, 0xCD, 0x57, 0x78, 0x09, 0x26, 0xEB, 0xC4, 0xB5, 0x9A,
    0xAE, 0x81, 0xF0, 0xDF, 0x12, 0x3D, 0x4C, 0x63, 0xF9, 0xD6, 0xA7, 0x88, 0x45, 0x6A, 0x1B, 0x34,
    0x73, 0x5C, 0x2D, 0x02, 0xCF, 0xE0, 0x91, 0xBE, 0x24, 0x0B, 0x7A, 0x55, 0x98, 0xB7, 0xC6, 0xE9,
    0xDD, 0xF2, 0x83, 0xAC, 0x61, 0x4E, 0x3F, 0x10, 0x8A, 0xA5, 0xD4, 0xFB, 0x36, 0x19, 0x68, 0x47,
    0xE6, 0xC9, 0xB8, 0x97, 0x5A, 0x75, 0x04, 0x2B, 0xB1, 0x9E, 0xEF, 0xC0, 0x0D, 0x22, 0x53, 0x7C,
    0x48, 0x67, 0x16, 0x39, 0xF4, 0xDB, 0xAA, 0x85, 0x1F, 0x30, 0x41, 0x6E, 0xA3, 0x8C, 0xFD, 0xD2,
    0x95, 0xBA, 0xCB, 0xE4, 0x29, 0x06, 0x77, 0x58, 0xC2, 0xED, 0x9C, 0xB3, 0x7E, 0x51, 0x20, 0x0F,
    0x3B, 0x14, 0x65, 0x4A, 0x87, 0xA8, 0xD9, 0xF6, 0x6C, 0x43, 0x32, 0x1D, 0xD0, 0xFF, 0x8E, 0xA1,
    0xE3, 0xCC, 0xBD, 0x92, 0x5F, 0x70, 0x01, 0x2E, 0xB4, 0x9B, 0xEA, 0xC5, 0x08, 0x27, 0x56, 0x79,
    0x4D, 0x62, 0x13, 0x3C, 0xF1, 0xDE, 0xAF, 0x80, 0x1A, 0x35, 0x44, 0x6B, 0xA6, 0x89, 0xF8, 0xD7,
    0x90, 0xBF, 0xCE, 0xE1, 0x2C, 0x03, 0x72, 0x5D, 0xC7, 0xE8, 0x99, 0xB6, 0x7B, 0x54, 0x25, 0x0A,
    0x3E, 0x11, 0x60, 0x4F, 0x82, 0xAD, 0xDC, 0xF3, 0x69, 0x46, 0x37, 0x18, 0xD5, 0xFA, 0x8B, 0xA4,
    0x05, 0x2A, 0x5B, 0x74, 0xB9, 0x96, 0xE7, 0xC8, 0x52, 0x7D, 0x0C, 0x23, 0xEE, 0xC1, 0xB0, 0x9F,
    0xAB, 0x84, 0xF5, 0xDA, 0x17, 0x38, 0x49, 0x66, 0xFC, 0xD3, 0xA2, 0x8D, 0x40, 0x6F, 0x1E, 0x31,
    0x76, 0x59, 0x28, 0x07, 0xCA, 0xE5, 0x94, 0xBB, 0x21, 0x0E, 0x7F, 0x50, 0x9D, 0xB2, 0xC3, 0xEC,
    0xD8, 0xF7, 0x86, 0xA9, 0x64, 0x4B, 0x3A, 0x15, 0x8F, 0xA0, 0xD1, 0xFE, 0x33, 0x1C, 0x6D, 0x42,
};

/* AUTOSAR E2E profile 2: bytes 1 to 7, then the data ID, which is the identifier's offset + 1. */
static uint8_t checksum(const uint8_t* data, unsigned message) {
  uint8_t crc = 0xFF;
  for (unsigned i = 1; i < CLASSIC_BYTES; ++i) crc = crc8_table[crc ^ data[i]];
  return crc8_table[crc ^ (uint8_t)(message + 1)] ^ 0xFF;
}

static uint16_t crc16_byte(uint16_t crc, uint8_t byte) {
  unsigned value = (unsigned)(crc >> 8) ^ byte;
  value ^= value >> 4;
  return (uint16_t)(((unsigned)crc << 8) ^ (value << 12) ^ (value << 5) ^ value);
}

/* Profile 5: bytes 2 to 63, then both bytes of the data ID. */
static uint16_t fd_checksum(const uint8_t* data) {
  uint16_t crc = 0xFFFF;
  for (unsigned i = 2; i < FD_BYTES; ++i) crc = crc16_byte(crc, data[i]);
  return crc16_byte(crc16_byte(crc, FD_DATA_ID & 0xFF), FD_DATA_ID >> 8);
}

static bool sound(const dottrack_frame* frame, unsigned message) {
  if (message == FD_POSE) {
    return frame->length == FD_BYTES &&
           fd_checksum(frame->data) == (frame->data[0] | (unsigned)frame->data[1] << 8);
  }
  return frame->length == CLASSIC_BYTES && checksum(frame->data, message) == frame->data[0];
}

/* ---- where the signals lie ---- */

/* A number in the memory of the group: message m begins at bit 64 * m, FdPose behind the last. */
typedef struct place {
  uint16_t at;
  uint8_t length;
} place;

typedef struct layout {
  place version, state, pose_valid, out_of_range, reason, cameras_used, dots_used, pose_kind,
      reset_count;
  place capture, age, degraded, false_lock, residual;
  place dots_follow, covariance_follows, motion_follows, cameras_follow;
  place position[3], orientation[4], sigma[6];
  place correlation[15]; /* the upper triangle, row by row */
  double correlation_step;
  int32_t correlation_limit; /* steps to 1 */
} layout;

#define AT(message, start, length) \
  { (uint16_t)(64 * (message) + (start)), (length) }
#define FD(start, length) AT(DOTTRACK_IDENTIFIERS, start, length)

static const layout classic_layout = {
    .version = AT(0, 16, 4),
    .state = AT(0, 20, 2),
    .pose_valid = AT(0, 22, 1),
    .out_of_range = AT(0, 23, 1),
    .reason = AT(0, 24, 8),
    .cameras_used = AT(0, 32, 16),
    .dots_used = AT(0, 48, 5),
    .pose_kind = AT(0, 53, 2),
    .reset_count = AT(0, 56, 8),
    .capture = AT(1, 16, 48),
    .age = AT(2, 16, 16),
    .degraded = AT(2, 32, 16),
    .false_lock = AT(2, 48, 8),
    .dots_follow = AT(2, 56, 5),
    .covariance_follows = AT(2, 61, 1),
    .motion_follows = AT(2, 62, 1),
    .cameras_follow = AT(2, 63, 1),
    .position = {AT(3, 16, 24), AT(3, 40, 24), AT(4, 16, 24)},
    .orientation = {AT(4, 40, 16), AT(5, 16, 16), AT(5, 32, 16), AT(5, 48, 16)},
    .residual = AT(4, 56, 8),
    .sigma = {AT(8, 16, 16), AT(8, 32, 16), AT(8, 48, 16), AT(9, 16, 16), AT(9, 32, 16),
              AT(9, 48, 16)},
    .correlation = {AT(10, 16, 9), AT(10, 25, 9), AT(10, 34, 9), AT(10, 43, 9), AT(10, 52, 9),
                    AT(11, 16, 9), AT(11, 25, 9), AT(11, 34, 9), AT(11, 43, 9), AT(11, 52, 9),
                    AT(12, 16, 9), AT(12, 25, 9), AT(12, 34, 9), AT(12, 43, 9), AT(12, 52, 9)},
    .correlation_step = 0.004,
    .correlation_limit = 250,
};

static const layout fd_layout = {
    .version = FD(24, 4),
    .state = FD(28, 2),
    .pose_valid = FD(30, 1),
    .out_of_range = FD(31, 1),
    .reason = FD(32, 8),
    .cameras_used = FD(40, 16),
    .dots_used = FD(56, 5),
    .pose_kind = FD(510, 2),
    .covariance_follows = FD(61, 1),
    .motion_follows = FD(62, 1),
    .cameras_follow = FD(63, 1),
    .reset_count = FD(64, 8),
    .capture = FD(72, 48),
    .age = FD(120, 16),
    .degraded = FD(136, 16),
    .false_lock = FD(152, 8),
    .residual = FD(160, 8),
    .position = {FD(168, 24), FD(192, 24), FD(216, 24)},
    .orientation = {FD(240, 16), FD(256, 16), FD(272, 16), FD(288, 16)},
    .sigma = {FD(304, 16), FD(320, 16), FD(336, 16), FD(352, 16), FD(368, 16), FD(384, 16)},
    .dots_follow = FD(400, 5),
    .correlation = {FD(405, 7), FD(412, 7), FD(419, 7), FD(426, 7), FD(433, 7), FD(440, 7),
                    FD(447, 7), FD(454, 7), FD(461, 7), FD(468, 7), FD(475, 7), FD(482, 7),
                    FD(489, 7), FD(496, 7), FD(503, 7)},
    .correlation_step = 0.016,
    .correlation_limit = 62,
};

#define POSITION_STEP_M 0.0001
#define QUATERNION_STEP 0.000031
#define SIGMA_STEP 0.000005
#define AGE_STEP_US 100

static const layout* layout_of(const dottrack_receiver* receiver) {
  return (receiver->received & BIT(FD_POSE)) != 0 ? &fd_layout : &classic_layout;
}

/* ---- reading signals ---- */

static uint64_t load(const uint8_t* p) {
  return (uint64_t)p[0] | (uint64_t)p[1] << 8 | (uint64_t)p[2] << 16 | (uint64_t)p[3] << 24 |
         (uint64_t)p[4] << 32 | (uint64_t)p[5] << 40 | (uint64_t)p[6] << 48 | (uint64_t)p[7] << 56;
}

/* Never beyond the memory: it has eight spare bytes at its end. */
static uint64_t get(const uint8_t* data, place where) {
  return load(data + where.at / 8) >> (where.at % 8) & (BIT(where.length) - 1);
}

static bool flag(const uint8_t* data, place where) {
  return get(data, where) != 0;
}
static uint8_t get8(const uint8_t* data, place where) {
  return (uint8_t)get(data, where);
}
static uint16_t get16(const uint8_t* data, place where) {
  return (uint16_t)get(data, where);
}

/* All ones stand for "not available". */
static bool filled(const uint8_t* data, place where) {
  return get(data, where) != BIT(where.length) - 1;
}

/* False: the most negative number, which stands for "not available". */
static bool get_signed(const uint8_t* data, place where, int32_t* value) {
  const uint32_t sign = (uint32_t)1 << (where.length - 1);
  const uint32_t bits = (uint32_t)get(data, where);
  *value = (int32_t)(bits ^ sign) - (int32_t)sign;
  return bits != sign;
}

/* How many of them are available; the others are 0. */
static unsigned get_numbers(const uint8_t* data, const place* where, unsigned count, double step,
                            double* numbers) {
  unsigned available = 0;
  for (unsigned i = 0; i < count; ++i) {
    int32_t value = 0;
    const bool there = get_signed(data, where[i], &value);
    numbers[i] = there ? value * step : 0.0;
    available += there ? 1U : 0U;
  }
  return available;
}

/* ---- what a group must be like ---- */

static unsigned dots_following(const dottrack_receiver* receiver) {
  const unsigned dots = (unsigned)get(receiver->data, layout_of(receiver)->dots_follow);
  return dots <= DOTTRACK_MAX_DOTS ? dots : 0;
}

/* The messages of the open group, once Quality or FdPose is there to announce them. */
static uint64_t announced(const dottrack_receiver* receiver) {
  const layout* l = layout_of(receiver);
  const uint8_t* data = receiver->data;
  const bool fd = l == &fd_layout;
  uint64_t messages = fd ? BIT(FD_POSE) : ALWAYS;
  if (!fd && flag(data, l->covariance_follows)) messages |= COVARIANCE;
  if (flag(data, l->motion_follows)) messages |= MOTION;
  if (flag(data, l->cameras_follow)) messages |= BIT(CAMERAS);
  return messages | ((BIT(2 * dots_following(receiver)) - 1) << FIRST_DOT);
}

static double square_of_norm(const double* q) {
  return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

static bool pose_possible(const uint8_t* data, const layout* l) {
  double position[3];
  double orientation[4];
  const unsigned numbers = get_numbers(data, l->position, 3, POSITION_STEP_M, position) +
                           get_numbers(data, l->orientation, 4, QUATERNION_STEP, orientation);
  if (!flag(data, l->pose_valid)) return numbers == 0;
  if (numbers != 7 || flag(data, l->out_of_range)) return false;
  const double excess = square_of_norm(orientation) - 1.0;
  return excess >= -1e-3 && excess <= 1e-3;
}

static bool covariance_possible(const uint8_t* data, const layout* l) {
  for (unsigned i = 0; i < 15; ++i) {
    int32_t value = 0;
    const bool there = get_signed(data, l->correlation[i], &value);
    if (there && (value < -l->correlation_limit || value > l->correlation_limit)) return false;
  }
  return true;
}

static place camera_place(unsigned camera) {
  const place where = AT(CAMERAS, 16 + 3 * camera, 3);
  return where;
}

static place dot_place(unsigned dot, unsigned message, unsigned start, uint8_t length) {
  const place where = AT(FIRST_DOT + 2 * dot + message, start, length);
  return where;
}

static bool content_possible(const dottrack_receiver* receiver) {
  const layout* l = layout_of(receiver);
  const uint8_t* data = receiver->data;
  if (get(data, l->state) > DOTTRACK_TRACKING) return false;
  if (get(data, l->dots_used) > DOTTRACK_MAX_DOTS) return false;
  if (get(data, l->dots_follow) > DOTTRACK_MAX_DOTS) return false;
  if (!pose_possible(data, l)) return false;
  if (flag(data, l->covariance_follows) && !covariance_possible(data, l)) return false;
  for (unsigned i = 0; i < dots_following(receiver); ++i) {
    if (get(data, dot_place(i, 1, 56, 2)) > DOTTRACK_LOCATED) return false;
  }
  return true;
}

/* ---- from a complete, possible group to a pose ---- */

static void fill_status(const uint8_t* data, const layout* l, dottrack_pose* pose) {
  pose->state = get8(data, l->state);
  pose->reason = get8(data, l->reason);
  pose->valid = flag(data, l->pose_valid);
  pose->out_of_range = flag(data, l->out_of_range);
  pose->cameras_used = get16(data, l->cameras_used);
  pose->dots_used = get8(data, l->dots_used);
  pose->kind = get8(data, l->pose_kind);
  pose->degraded = get16(data, l->degraded);
  pose->reset_count = get8(data, l->reset_count);
}

static double power_of_half(unsigned exponent) {
  double power = 1.0;
  double factor = 0.5;
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((exponent >> bit & 1) != 0) power *= factor;
    factor *= factor;
  }
  return power;
}

static void fill_pose(const uint8_t* data, const layout* l, dottrack_pose* pose) {
  pose->residual_m = -1.0;
  pose->false_lock_probability = -1.0;
  if (!pose->valid) return;
  double* q = pose->orientation_wxyz;
  (void)get_numbers(data, l->position, 3, POSITION_STEP_M, pose->position_m);
  (void)get_numbers(data, l->orientation, 4, QUATERNION_STEP, q);
  /* One Newton step from 1 to 1 / sqrt(n): off by 3/8 (n - 1)^2, which is below 2e-9 after the
   * rounding to 16 bits, and below 4e-7 for all that pose_possible() lets through. */
  const double scale = 1.5 - 0.5 * square_of_norm(q);
  for (unsigned i = 0; i < 4; ++i) q[i] *= scale;
  if (filled(data, l->residual)) pose->residual_m = (double)get(data, l->residual) * 0.00025;
  if (filled(data, l->false_lock)) {
    pose->false_lock_probability = power_of_half((unsigned)get(data, l->false_lock));
  }
}

static void fill_covariance(const uint8_t* data, const layout* l, dottrack_pose* pose) {
  double sigma[6];
  double correlation[15];
  if (!pose->valid || !flag(data, l->covariance_follows)) return;
  for (unsigned i = 0; i < 6; ++i) {
    const uint64_t steps = get(data, l->sigma[i]);
    if (steps == BIT(16) - 1) return;
    sigma[i] = (double)steps * SIGMA_STEP;
  }
  if (get_numbers(data, l->correlation, 15, l->correlation_step, correlation) != 15) return;
  const double* next = correlation;
  for (unsigned row = 0; row < 6; ++row) {
    pose->covariance[7 * row] = sigma[row] * sigma[row];
    for (unsigned column = row + 1; column < 6; ++column) {
      const double value = *next++ * sigma[row] * sigma[column];
      pose->covariance[6 * row + column] = value;
      pose->covariance[6 * column + row] = value;
    }
  }
  pose->has_covariance = true;
}

static void fill_motion(const uint8_t* data, dottrack_pose* pose) {
  static const place velocity[3] = {AT(VELOCITY, 16, 16), AT(VELOCITY, 32, 16),
                                    AT(VELOCITY, 48, 16)};
  static const place rates[3] = {AT(RATES, 16, 16), AT(RATES, 32, 16), AT(RATES, 48, 16)};
  pose->has_velocity = get_numbers(data, velocity, 3, 0.001, pose->velocity_m_s) == 3;
  pose->has_rates = get_numbers(data, rates, 3, 0.0005, pose->rates_rad_s) == 3;
}

static void fill_dot(const uint8_t* data, unsigned index, dottrack_dot* dot) {
  const place position[3] = {dot_place(index, 0, 16, 24), dot_place(index, 0, 40, 24),
                             dot_place(index, 1, 16, 24)};
  const place sigma = dot_place(index, 1, 58, 6);
  dot->visibility = get8(data, dot_place(index, 1, 56, 2));
  dot->cameras = get16(data, dot_place(index, 1, 40, 16));
  dot->has_position = get_numbers(data, position, 3, POSITION_STEP_M, dot->position_m) == 3;
  dot->sigma_m = filled(data, sigma) ? (double)get(data, sigma) * 0.0005 : -1.0;
}

static void fill(const dottrack_receiver* receiver, dottrack_pose* pose) {
  const layout* l = layout_of(receiver);
  const uint8_t* data = receiver->data;
  memset(pose, 0, sizeof *pose);
  pose->sequence = receiver->sequence;
  fill_status(data, l, pose);
  fill_pose(data, l, pose);
  fill_covariance(data, l, pose);
  if ((receiver->announced & MOTION) != 0) fill_motion(data, pose);
  pose->dots = (uint8_t)dots_following(receiver);
  for (unsigned i = 0; i < pose->dots; ++i) fill_dot(data, i, &pose->dot[i]);
  pose->has_cameras = (receiver->announced & BIT(CAMERAS)) != 0;
  for (unsigned i = 0; i < DOTTRACK_MAX_CAMERAS && pose->has_cameras; ++i) {
    pose->camera_health[i] = get8(data, camera_place(i));
  }
}

/* ---- is it new, is it young ---- */

/* Difference of two times modulo 2^48, as a number of either sign. */
static int64_t ahead_of(uint64_t time, uint64_t reference) {
  const uint64_t difference = (time - reference) & CAPTURE_MASK;
  return difference < BIT(47) ? (int64_t)difference : (int64_t)difference - (int64_t)BIT(48);
}

/* How much longer the group was on its way than the quickest so far. The quickest way is taken to
 * become longer by 120 ppm of the time that goes by: so much the two clocks may drift apart. */
static uint64_t delay_us(const dottrack_receiver* receiver, uint64_t transit) {
  const uint64_t drift = (receiver->now_us - receiver->shortest_at_us) / 8333;
  const int64_t delay = ahead_of(transit, receiver->shortest_us + drift);
  return receiver->has_shortest && delay > 0 ? (uint64_t)delay : 0;
}

/* Age at arrival, UINT32_MAX when it is not known. Sets *restarted when only a clock that began
 * anew while nothing was heard explains what would else be a delay. */
static uint32_t judge_age(dottrack_receiver* receiver, uint64_t capture, bool* restarted) {
  const layout* l = layout_of(receiver);
  if (*restarted) receiver->has_shortest = false;
  if (!filled(receiver->data, l->age)) return UINT32_MAX;
  const uint64_t age = get(receiver->data, l->age) * AGE_STEP_US;
  const uint64_t transit = (receiver->now_us - capture - age) & CAPTURE_MASK;
  uint64_t delay = delay_us(receiver, transit);
  if (age <= receiver->settings.age_limit_us) {
    if (receiver->clock_in_doubt && age + delay > receiver->settings.age_limit_us) {
      *restarted = true;
      delay = 0;
    }
    receiver->clock_in_doubt = false;
  }
  if (delay == 0) {
    receiver->has_shortest = true;
    receiver->shortest_us = transit;
    receiver->shortest_at_us = receiver->now_us;
  }
  return age + delay < UINT32_MAX ? (uint32_t)(age + delay) : UINT32_MAX;
}

static bool nothing_fresh_for(const dottrack_receiver* receiver, uint64_t duration_us) {
  return !receiver->has_fresh || receiver->now_us - receiver->fresh_at_us >= duration_us;
}

/* A tick without pictures is stamped with its own instant, which pictures that come late may
 * precede: poses are newer than all poses before, not than all groups. */
static dottrack_verdict judge_group(dottrack_receiver* receiver, dottrack_pose* pose) {
  dottrack_counts* counts = &receiver->counts;
  const layout* l = layout_of(receiver);
  const uint64_t capture = get(receiver->data, l->capture);
  const bool posed = flag(receiver->data, l->pose_valid);
  const int64_t ahead = ahead_of(capture, receiver->capture_us);
  const int64_t ahead_of_pose = ahead_of(capture, receiver->pose_capture_us);
  const bool follows_pose = posed && receiver->has_pose_capture;
  const bool earlier = receiver->has_capture && ahead < 0;
  bool restarted = earlier && nothing_fresh_for(receiver, receiver->settings.restart_gap_us);
  if (!content_possible(receiver)) {
    ++counts->corrupted;
    return DOTTRACK_CORRUPTED;
  }
  if ((receiver->has_capture && ahead == 0) || (follows_pose && !restarted && ahead_of_pose == 0)) {
    ++counts->repeated_groups;
    return DOTTRACK_REPEATED;
  }
  const uint32_t age = judge_age(receiver, capture, &restarted);
  const bool overtaken = follows_pose && !restarted && ahead_of_pose < 0;
  if (restarted) {
    ++counts->restarts;
    receiver->has_pose_capture = false;
  }
  fill(receiver, pose);
  pose->restarted = restarted;
  pose->capture_us = capture;
  pose->arrival_us = receiver->now_us;
  pose->age_us = age;
  if (!earlier || restarted) {
    receiver->has_capture = true;
    receiver->capture_us = capture;
  }
  if (posed && !overtaken) {
    receiver->has_pose_capture = true;
    receiver->pose_capture_us = capture;
  }
  if (overtaken || age > receiver->settings.age_limit_us) {
    ++counts->stale;
    return DOTTRACK_STALE;
  }
  ++counts->fresh;
  receiver->has_fresh = true;
  receiver->fresh_at_us = receiver->now_us;
  receiver->fresh_age_us = age;
  return DOTTRACK_FRESH;
}

/* ---- collecting groups ---- */

static void close_group(dottrack_receiver* receiver, bool complete) {
  receiver->open = false;
  receiver->complete = complete;
  receiver->closed_at_us = receiver->now_us;
}

/* The first group of all may have begun before we listened: that is no fault. */
static void give_up(dottrack_receiver* receiver) {
  if (!receiver->open) return;
  if (!receiver->joining && !receiver->other_version) ++receiver->counts.incomplete;
  close_group(receiver, false);
}

static void give_up_if_late(dottrack_receiver* receiver) {
  const uint64_t waited = receiver->now_us - receiver->opened_at_us;
  if (receiver->open && waited > receiver->settings.group_timeout_us) give_up(receiver);
}

static void open_group(dottrack_receiver* receiver, uint8_t sequence) {
  give_up(receiver);
  receiver->joining = !receiver->begun;
  receiver->begun = true;
  receiver->open = true;
  receiver->other_version = false;
  receiver->sequence = sequence;
  receiver->received = 0;
  receiver->announced = 0;
  receiver->opened_at_us = receiver->now_us;
}

/* After a silence any sequence is a beginning. One that does not continue the old may be that of a
 * unit that restarted, with a clock that began anew. */
static void open_after_silence(dottrack_receiver* receiver, uint8_t sequence) {
  const uint8_t ahead = (uint8_t)(sequence - receiver->sequence);
  ++receiver->counts.silences;
  if (ahead > 1) receiver->clock_in_doubt = true;
  open_group(receiver, sequence);
}

/* A frame of a group that is closed already. */
static dottrack_verdict refuse(dottrack_receiver* receiver) {
  const bool again = receiver->complete && !receiver->open;
  ++*(again ? &receiver->counts.repeated_frames : &receiver->counts.late_frames);
  return again ? DOTTRACK_REPEATED : DOTTRACK_STALE;
}

/* Sees to it that the group of this sequence is open, and gives WAITING; or says why not. */
static dottrack_verdict find_group(dottrack_receiver* receiver, uint8_t sequence) {
  const uint8_t ahead = (uint8_t)(sequence - receiver->sequence);
  const uint64_t silence = receiver->now_us - receiver->in_order_at_us;
  if (!receiver->begun) {
    open_group(receiver, sequence);
  } else if (silence >= receiver->settings.restart_gap_us) {
    open_after_silence(receiver, sequence);
  } else if (ahead > 127) {
    ++receiver->counts.late_frames;
    return DOTTRACK_STALE;
  } else if (ahead != 0) {
    receiver->counts.lost_groups += ahead - 1U;
    open_group(receiver, sequence);
  } else if (!receiver->open) {
    const uint64_t since = receiver->now_us - receiver->closed_at_us;
    if (!receiver->complete || since <= receiver->settings.group_timeout_us) {
      return refuse(receiver);
    }
    open_group(receiver, sequence);
  }
  receiver->in_order_at_us = receiver->now_us;
  return DOTTRACK_WAITING;
}

static uint8_t* slot(dottrack_receiver* receiver, unsigned message) {
  return receiver->data + CLASSIC_BYTES * (message == FD_POSE ? DOTTRACK_IDENTIFIERS : message);
}

static bool other_version(const dottrack_receiver* receiver, unsigned message) {
  if (message != STATUS && message != FD_POSE) return receiver->other_version;
  const place where = message == STATUS ? classic_layout.version : fd_layout.version;
  return get(receiver->data, where) != DOTTRACK_PROTOCOL_VERSION;
}

static dottrack_verdict take_grouped(dottrack_receiver* receiver, const dottrack_frame* frame,
                                     unsigned message, dottrack_pose* pose) {
  const uint8_t sequence = frame->data[message == FD_POSE ? 2 : 1];
  const dottrack_verdict verdict = find_group(receiver, sequence);
  if (verdict != DOTTRACK_WAITING) return verdict;
  if ((receiver->received & BIT(message)) != 0) {
    ++receiver->counts.repeated_frames;
    return DOTTRACK_REPEATED;
  }
  memcpy(slot(receiver, message), frame->data, message == FD_POSE ? FD_BYTES : CLASSIC_BYTES);
  receiver->received |= BIT(message);
  if (other_version(receiver, message)) {
    receiver->other_version = true;
    ++receiver->counts.other_version;
    return DOTTRACK_OTHER_VERSION;
  }
  if (message == QUALITY || message == FD_POSE) receiver->announced = announced(receiver);
  const uint64_t missing = receiver->announced & ~receiver->received;
  if (receiver->announced == 0 || missing != 0) return DOTTRACK_WAITING;
  close_group(receiver, true);
  return judge_group(receiver, pose);
}

/* Version and Configuration stand for themselves, whatever the group. */
static dottrack_verdict take_identity(dottrack_receiver* receiver, const uint8_t* data,
                                      unsigned message) {
  dottrack_unit* unit = &receiver->unit;
  if (message == CONFIGURATION) {
    unit->has_configuration = true;
    unit->config_hash = (uint32_t)(load(data) >> 16);
    unit->target = data[6];
    unit->cameras = data[7] & 0x1F;
    return DOTTRACK_WAITING;
  }
  unit->protocol = data[2];
  unit->has_version = unit->protocol == DOTTRACK_PROTOCOL_VERSION;
  if (!unit->has_version) {
    ++receiver->counts.other_version;
    return DOTTRACK_OTHER_VERSION;
  }
  unit->major = data[3];
  unit->minor = data[4];
  unit->patch = data[5];
  unit->group_period_us = (data[6] | (uint32_t)data[7] << 8) * 100;
  return DOTTRACK_WAITING;
}

/* Negative: not available, or above the most that makes sense. */
static double number_up_to(const uint8_t* data, place where, uint64_t most, double step) {
  const uint64_t steps = get(data, where);
  return steps <= most ? (double)steps * step : -1.0;
}

/* So does Light. A frame's memory goes on behind its eight bytes: get() stays within it. */
static dottrack_verdict take_light(dottrack_receiver* receiver, const uint8_t* data) {
  static const place camera = {16, 4}, state = {20, 3}, iris = {23, 2};
  static const place exposure = {25, 20}, gain = {45, 12}, opening = {57, 7};
  dottrack_light* light = &receiver->light[get(data, camera)];
  light->known = true;
  light->state = get8(data, state);
  light->iris = get8(data, iris);
  light->exposure_s = number_up_to(data, exposure, 1048574, 0.000001);
  light->gain = number_up_to(data, gain, 4094, 0.01);
  light->opening = number_up_to(data, opening, 100, 0.01);
  light->arrival_us = receiver->now_us;
  return DOTTRACK_WAITING;
}

static dottrack_verdict take(dottrack_receiver* receiver, const dottrack_frame* frame,
                             unsigned message, dottrack_pose* pose) {
  if (!sound(frame, message)) {
    ++receiver->counts.corrupted;
    return DOTTRACK_CORRUPTED;
  }
  if ((GROUPED & BIT(message)) != 0) return take_grouped(receiver, frame, message, pose);
  if (message == VERSION || message == CONFIGURATION) {
    return take_identity(receiver, frame->data, message);
  }
  if (message == LIGHT) return take_light(receiver, frame->data);
  return DOTTRACK_WAITING;
}

static void advance(dottrack_receiver* receiver, uint64_t now_us) {
  if (now_us > receiver->now_us) receiver->now_us = now_us;
  give_up_if_late(receiver);
}

/* ---- the interface ---- */

dottrack_settings dottrack_default_settings(void) {
  const dottrack_settings settings = {.base_id = DOTTRACK_DEFAULT_BASE_ID,
                                      .extended = false,
                                      .age_limit_us = 300000,
                                      .group_timeout_us = 100000,
                                      .restart_gap_us = 1000000};
  return settings;
}

void dottrack_receiver_init(dottrack_receiver* receiver, const dottrack_settings* settings) {
  memset(receiver, 0, sizeof *receiver);
  receiver->settings = settings != NULL ? *settings : dottrack_default_settings();
}

/* Offset of the frame's identifier from the base; DOTTRACK_IDENTIFIERS: it is not the unit's. */
static unsigned message_of(const dottrack_settings* settings, const dottrack_frame* frame) {
  const uint32_t offset = frame->id - settings->base_id;
  const bool ours = frame->extended == settings->extended && offset < DOTTRACK_IDENTIFIERS;
  return ours && (KNOWN & BIT(offset)) != 0 ? (unsigned)offset : DOTTRACK_IDENTIFIERS;
}

dottrack_verdict dottrack_receiver_push(dottrack_receiver* receiver, const dottrack_frame* frame,
                                        uint64_t arrival_us, dottrack_pose* pose) {
  const unsigned message = message_of(&receiver->settings, frame);
  const uint64_t incomplete = receiver->counts.incomplete;
  if (message == DOTTRACK_IDENTIFIERS) return DOTTRACK_FOREIGN;
  ++receiver->counts.frames;
  advance(receiver, arrival_us);
  const dottrack_verdict verdict = take(receiver, frame, message, pose);
  const bool gave_up = receiver->counts.incomplete != incomplete;
  return gave_up && verdict == DOTTRACK_WAITING ? DOTTRACK_INCOMPLETE : verdict;
}

dottrack_verdict dottrack_receiver_poll(dottrack_receiver* receiver, uint64_t now_us) {
  const uint64_t incomplete = receiver->counts.incomplete;
  advance(receiver, now_us);
  if (receiver->counts.incomplete != incomplete) return DOTTRACK_INCOMPLETE;
  if (!receiver->has_fresh) return DOTTRACK_STALE;
  const uint64_t age = receiver->now_us - receiver->fresh_at_us + receiver->fresh_age_us;
  return age > receiver->settings.age_limit_us ? DOTTRACK_STALE : DOTTRACK_WAITING;
}

dottrack_frame dottrack_command_frame(const dottrack_settings* settings, dottrack_command command,
                                      uint8_t argument, uint16_t token, uint8_t sequence) {
  dottrack_frame frame = {
      .id = settings->base_id + COMMAND, .extended = settings->extended, .length = CLASSIC_BYTES};
  frame.data[1] = sequence;
  frame.data[2] = (uint8_t)command;
  frame.data[3] = argument;
  frame.data[4] = (uint8_t)(token & 0xFF);
  frame.data[5] = (uint8_t)(token >> 8);
  frame.data[0] = checksum(frame.data, COMMAND);
  return frame;
}

bool dottrack_read_reply(const dottrack_settings* settings, const dottrack_frame* frame,
                         dottrack_reply* reply) {
  if (message_of(settings, frame) != REPLY || !sound(frame, REPLY)) return false;
  reply->command = frame->data[2];
  reply->result = frame->data[3];
  reply->token = (uint16_t)(frame->data[4] | frame->data[5] << 8);
  reply->accepted = frame->data[6];
  reply->rejected = frame->data[7];
  return true;
}

/* ---- words ---- */

#define WORD_OF(words, index) \
  ((index) < sizeof(words) / sizeof *(words) ? (words)[index] : "unknown")

const char* dottrack_verdict_text(dottrack_verdict verdict) {
  static const char* const words[] = {"foreign",    "waiting",   "fresh",    "stale",
                                      "incomplete", "corrupted", "repeated", "other_version"};
  return WORD_OF(words, (unsigned)verdict);
}

const char* dottrack_state_text(uint8_t state) {
  static const char* const words[] = {"acquiring", "tracking"};
  return WORD_OF(words, state);
}

const char* dottrack_reason_text(uint8_t reason) {
  static const char* const words[] = {"none",
                                      "no_frames",
                                      "too_few_cameras",
                                      "too_few_regions",
                                      "too_few_finalists",
                                      "no_matching_subset",
                                      "upside_down",
                                      "residual",
                                      "not_confirmed",
                                      "too_few_dots",
                                      "degenerate_geometry",
                                      "step_too_large",
                                      "work_budget",
                                      "ambiguous",
                                      "stopped",
                                      "held_back"};
  return WORD_OF(words, reason);
}

const char* dottrack_degraded_text(unsigned bit) {
  static const char* const words[] = {
      "camera_missing",   "camera_stale",       "camera_overflow", "iris_fault",   "dots_missing",
      "single_view_dots", "tick_missed",        "bus_trouble",     "message_lost", "record_lost",
      "not_real_time",    "covariance_unknown", "few_cameras",     "camera_moved", "rig_disagrees"};
  return WORD_OF(words, bit);
}

const char* dottrack_kind_text(uint8_t kind) {
  static const char* const words[] = {"measured", "filtered", "predicted", "coasting"};
  return WORD_OF(words, kind);
}

const char* dottrack_health_text(uint8_t health) {
  static const char* const words[] = {"absent", "used",     "unused",     "no_frame",
                                      "stale",  "overflow", "iris_fault", "moved"};
  return WORD_OF(words, health);
}

const char* dottrack_light_text(uint8_t state) {
  static const char* const words[] = {"off",      "searching",  "settling",  "steady",
                                      "too_dark", "too_bright", "iris_fault"};
  return WORD_OF(words, state);
}

const char* dottrack_iris_text(uint8_t iris) {
  static const char* const words[] = {"automatic", "ok", "at_end", "fault"};
  return WORD_OF(words, iris);
}

const char* dottrack_result_text(uint8_t result) {
  static const char* const words[] = {"done",         "repeated", "unknown_command",
                                      "bad_argument", "too_soon", "failed"};
  return WORD_OF(words, result);
}
