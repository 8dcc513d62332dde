/* dottrack receiver: from CAN frames to poses a vehicle can trust.
 *
 * Two files, C11 (this header C++, too), no heap, no library, no clock: copy dottrack_receiver.h
 * and dottrack_receiver.c into your program. Layout of the messages: dottrack.dbc. What a receiver
 * must do, and why: docs/can.md. One receiver a unit; not for several threads at once.
 *
 * Give every frame of the bus to dottrack_receiver_push(), with the time at which it arrived on a
 * clock of yours that never goes back, in microseconds; call dottrack_receiver_poll() when nothing
 * arrives. Use a pose only while the verdict is DOTTRACK_FRESH and pose.valid is true.
 *
 * A group begins with any of its frames and is complete when all are there that Quality (in FD:
 * FdPose) announces, in any order. A later sequence, or group_timeout_us, gives it up. Sequences
 * 128 to 255 ahead are behind: such frames are late and change nothing. After restart_gap_us
 * without a frame in order any sequence is a beginning; it has to be longer than the time between
 * two groups.
 *
 * The two clocks need not agree: what a group was on its way longer than the quickest counts as its
 * age, and the quickest may become slower by 120 ppm, so much clocks drift apart. A delay that is
 * there from the first group on cannot be known. A unit whose clock began anew is taken up again
 * after restart_gap_us without a fresh group (pose.restarted); a delay that comes after a silence
 * and continues the sequence is none, and its groups stay stale. */
#ifndef DOTTRACK_RECEIVER_H
#define DOTTRACK_RECEIVER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DOTTRACK_PROTOCOL_VERSION 2
#define DOTTRACK_DEFAULT_BASE_ID 0x300
#define DOTTRACK_IDENTIFIERS 64 /* base_id to base_id + 63 */
#define DOTTRACK_MAX_DOTS 16
#define DOTTRACK_MAX_CAMERAS 16

typedef struct dottrack_frame {
  uint32_t id;
  bool extended; /* 29-bit identifier */
  uint8_t length;
  uint8_t data[64];
} dottrack_frame;

typedef enum dottrack_verdict {
  DOTTRACK_FOREIGN = 0, /* not a frame of this unit: nothing changed */
  DOTTRACK_WAITING,     /* a sound frame that completes no group */
  DOTTRACK_FRESH,      /* completes a sound group, young enough, its pose newer than those before */
  DOTTRACK_STALE,      /* completes a group older than the age limit, without an age, or with a pose
                          older than the one before; or a frame of a group given up or overtaken;
                          or, from poll, there is no fresh group within the age limit */
  DOTTRACK_INCOMPLETE, /* the group before was given up: frames of it never came */
  DOTTRACK_CORRUPTED,  /* checksum or length is wrong, or a group says what the layout does not
                          allow; numbers of reasons that a newer unit may have are allowed */
  DOTTRACK_REPEATED,   /* a frame or a group (by its capture time) that has been here before */
  DOTTRACK_OTHER_VERSION /* another layout of the messages than this receiver's */
} dottrack_verdict;

typedef enum dottrack_state { DOTTRACK_ACQUIRING = 0, DOTTRACK_TRACKING = 1 } dottrack_state;

/* What the pose is of a group that has one. */
typedef enum dottrack_kind {
  DOTTRACK_MEASURED = 0,  /* from the pictures of one instant alone */
  DOTTRACK_FILTERED = 1,  /* from the pictures before, too */
  DOTTRACK_PREDICTED = 2, /* carried on to the moment it was sent */
  DOTTRACK_COASTING = 3   /* not seen at that instant: by its motion alone; reason says why */
} dottrack_kind;

typedef enum dottrack_visibility {
  DOTTRACK_NOT_SEEN = 0,
  DOTTRACK_ONE_CAMERA = 1,
  DOTTRACK_LOCATED = 2
} dottrack_visibility;

typedef struct dottrack_dot {
  uint8_t visibility; /* dottrack_visibility */
  uint16_t cameras;   /* one bit a camera */
  bool has_position;
  double position_m[3]; /* world */
  double sigma_m;       /* root of the covariance's trace; negative: not known */
} dottrack_dot;

/* T_world_vehicle: right-handed, world z up; vehicle x forward, y left, z up. What is not available
 * is zero. */
typedef struct dottrack_pose {
  uint8_t sequence;
  uint8_t state;         /* dottrack_state */
  uint8_t reason;        /* why there is no pose: dottrack_reason_text() */
  bool valid;            /* position and orientation are available */
  bool out_of_range;     /* there is a pose, but it does not fit into the messages */
  uint16_t cameras_used; /* one bit a camera */
  uint8_t dots_used;
  uint8_t kind;        /* dottrack_kind */
  uint16_t degraded;   /* one bit a reason: dottrack_degraded_text() */
  uint8_t reset_count; /* a new value: the pose may have jumped */
  bool restarted;      /* the unit's clock began anew since the group before */
  uint64_t capture_us; /* middle of the exposure, the unit's clock */
  uint64_t arrival_us; /* of the frame that completed the group, your clock */
  uint32_t age_us;     /* at arrival: from the middle of the exposure, with the delay on the way
                          beyond the shortest that was seen */
  double position_m[3];
  double orientation_wxyz[4];    /* unit, Hamilton, vehicle to world */
  double residual_m;             /* RMS; negative: not known */
  double false_lock_probability; /* an upper bound; negative: not known */
  bool has_covariance;
  double covariance[36]; /* row-major: x y z roll pitch yaw, metres and radians, world axes */
  bool has_velocity;
  double velocity_m_s[3]; /* world axes */
  bool has_rates;
  double rates_rad_s[3]; /* vehicle axes */
  uint8_t dots;          /* reported in this group: 0 when it has no dot messages */
  dottrack_dot dot[DOTTRACK_MAX_DOTS];
  bool has_cameras;
  uint8_t camera_health[DOTTRACK_MAX_CAMERAS]; /* dottrack_health_text() */
} dottrack_pose;

/* From Version and Configuration. Of a unit with another protocol only its number is read. */
typedef struct dottrack_unit {
  bool has_version;
  uint8_t protocol, major, minor, patch;
  uint32_t group_period_us;
  bool has_configuration;
  uint32_t config_hash;
  uint8_t target, cameras;
} dottrack_unit;

/* How a camera stands with the light, as its last Light message said. What is not available is
 * negative. */
typedef struct dottrack_light {
  bool known;          /* such a message has come */
  uint8_t state;       /* dottrack_light_text() */
  uint8_t iris;        /* dottrack_iris_text() */
  double exposure_s;   /* that the camera was last set to */
  double gain;         /* factor on the signal */
  double opening;      /* of the iris: 0 closed, 1 fully open */
  uint64_t arrival_us; /* your clock */
} dottrack_light;

/* Of frames and groups since dottrack_receiver_init(). The first group of all may have been joined
 * in the middle: it is not counted as incomplete. */
typedef struct dottrack_counts {
  uint64_t frames; /* of this unit's identifiers */
  uint64_t fresh;  /* groups */
  uint64_t stale;  /* groups */
  uint64_t repeated_groups;
  uint64_t incomplete;  /* groups given up with at least one frame */
  uint64_t lost_groups; /* never seen at all, by the sequence; 256 in a row look like none */
  uint64_t corrupted;   /* frames, and groups whose content is impossible */
  uint64_t repeated_frames;
  uint64_t late_frames;   /* of groups given up or overtaken */
  uint64_t other_version; /* frames */
  uint64_t restarts;      /* of the unit's clock */
  uint64_t silences;      /* of restart_gap_us and more: what was lost in them is not counted */
} dottrack_counts;

typedef struct dottrack_settings {
  uint32_t base_id;
  bool extended;
  uint32_t age_limit_us;     /* an older pose is stale */
  uint32_t group_timeout_us; /* from a group's first frame until it is given up */
  uint32_t restart_gap_us;   /* silence after which sequence and clock may begin anew */
} dottrack_settings;

/* Base 0x300, 11 bits, age limit 0.3 s, group timeout 0.1 s, restart gap 1 s. */
dottrack_settings dottrack_default_settings(void);

/* Plain memory of yours. `counts`, `unit` and `light` may be read at any time; the rest is private.
 */
typedef struct dottrack_receiver {
  dottrack_settings settings;
  dottrack_counts counts;
  dottrack_unit unit;
  dottrack_light light[DOTTRACK_MAX_CAMERAS]; /* of units that tell it */
  uint64_t now_us;                            /* the latest time that was told */
  /* the group being collected, or the last one; all times are of your clock */
  bool begun, open, complete, joining, other_version;
  uint8_t sequence;
  uint64_t received, announced; /* one bit an identifier */
  uint64_t opened_at_us, closed_at_us, in_order_at_us;
  uint8_t data[8 * DOTTRACK_IDENTIFIERS + 64 + 8]; /* 8 bytes an identifier, FdPose, 8 spare */
  /* the newest group, the newest fresh one, the clocks' offset */
  bool has_capture, has_pose_capture, has_fresh, has_shortest, clock_in_doubt;
  uint64_t capture_us, pose_capture_us, fresh_at_us;
  uint32_t fresh_age_us;
  uint64_t shortest_us, shortest_at_us;
} dottrack_receiver;

/* `settings` NULL: the default ones. */
void dottrack_receiver_init(dottrack_receiver* receiver, const dottrack_settings* settings);

/* Takes one frame; the work is bounded, whatever came. `pose` is written only with the verdicts
 * FRESH and STALE of a whole group, and then whole: with STALE counts.stale tells that from a late
 * frame. Should a frame end one group as incomplete and complete another, or be itself at fault,
 * the verdict is that of the latter; counts has both. A time that goes back counts as the latest
 * one. */
dottrack_verdict dottrack_receiver_push(dottrack_receiver* receiver, const dottrack_frame* frame,
                                        uint64_t arrival_us, dottrack_pose* pose);

/* Without a frame: INCOMPLETE when an open group has just been given up, STALE while the last fresh
 * group is older than the age limit or there was none, else WAITING. */
dottrack_verdict dottrack_receiver_poll(dottrack_receiver* receiver, uint64_t now_us);

/* Commands, for units that listen. Makes the frame of one; `sequence` differs from the one before.
 */
typedef enum dottrack_command {
  DOTTRACK_COMMAND_ACQUIRE = 1,
  DOTTRACK_COMMAND_SET_TARGET = 2,
  DOTTRACK_COMMAND_REPORT_VERSION = 3
} dottrack_command;

dottrack_frame dottrack_command_frame(const dottrack_settings* settings, dottrack_command command,
                                      uint8_t argument, uint16_t token, uint8_t sequence);

typedef struct dottrack_reply {
  uint8_t command;
  uint8_t result; /* 0: done; dottrack_result_text() */
  uint16_t token;
  uint8_t accepted, rejected; /* commands so far, modulo 256 */
} dottrack_reply;

/* True and written if the frame is a sound reply of the unit. */
bool dottrack_read_reply(const dottrack_settings* settings, const dottrack_frame* frame,
                         dottrack_reply* reply);

/* One word each, never NULL: "too_few_regions"; "unknown" for numbers without a meaning. */
const char* dottrack_verdict_text(dottrack_verdict verdict);
const char* dottrack_state_text(uint8_t state);
const char* dottrack_reason_text(uint8_t reason);
const char* dottrack_degraded_text(unsigned bit);
const char* dottrack_kind_text(uint8_t kind);
const char* dottrack_health_text(uint8_t health);
const char* dottrack_light_text(uint8_t state);
const char* dottrack_iris_text(uint8_t iris);
const char* dottrack_result_text(uint8_t result);

#ifdef __cplusplus
}
#endif

#endif
