/* Prints the poses of a dottrack unit from a SocketCAN interface, one line a group.
 *
 *   cc -std=c11 print_poses.c ../dottrack_receiver.c -o print_poses
 *   ./print_poses can0
 *
 * Exit status: 0 ended by a signal or after the groups asked for; 1 the interface failed while
 * reading; 2 wrong use, or the interface cannot be opened. */
#define _GNU_SOURCE /* of the system's headers: struct ifreq, SO_TIMESTAMPNS */

#include <errno.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "../dottrack_receiver.h"

#define POLL_MS 100

typedef struct options {
  const char* interface;
  dottrack_settings settings;
  unsigned long groups; /* to print; 0: without end */
} options;

static volatile sig_atomic_t stopped = 0;

static void stop(int signal_number) {
  (void)signal_number;
  stopped = 1;
}

static int usage(void) {
  fprintf(stderr,
          "usage: print_poses [-b BASE] [-x] [-n GROUPS] INTERFACE   (BASE: first identifier, "
          "default 0x300; -x: 29-bit identifiers)\n");
  return 2;
}

static bool read_number(const char* text, unsigned long most, unsigned long* number) {
  char* end = NULL;
  errno = 0;
  *number = strtoul(text, &end, 0);
  return errno == 0 && end != text && *end == '\0' && text[0] != '-' && *number <= most;
}

static bool read_options(int count, char** words, options* chosen) {
  unsigned long number = 0;
  int option = 0;
  chosen->settings = dottrack_default_settings();
  chosen->groups = 0;
  opterr = 0;
  while ((option = getopt(count, words, "b:xn:")) != -1) {
    if (option == 'b' && read_number(optarg, CAN_EFF_MASK, &number)) {
      chosen->settings.base_id = (uint32_t)number;
    } else if (option == 'n' && read_number(optarg, 1000000000UL, &number)) {
      chosen->groups = number;
    } else if (option == 'x') {
      chosen->settings.extended = true;
    } else {
      return false;
    }
  }
  const uint32_t last = chosen->settings.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
  if (chosen->settings.base_id > last - DOTTRACK_IDENTIFIERS + 1) return false;
  chosen->interface = optind + 1 == count ? words[optind] : NULL;
  return chosen->interface != NULL;
}

/* Only the unit's identifiers, one filter each: a base need not be a multiple of 64. */
static bool filter(int can, const dottrack_settings* settings) {
  struct can_filter filters[DOTTRACK_IDENTIFIERS];
  for (uint32_t i = 0; i < DOTTRACK_IDENTIFIERS; ++i) {
    const uint32_t id = settings->base_id + i;
    filters[i].can_id = settings->extended ? id | CAN_EFF_FLAG : id;
    filters[i].can_mask =
        CAN_EFF_FLAG | CAN_RTR_FLAG | (settings->extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  }
  return setsockopt(can, SOL_CAN_RAW, CAN_RAW_FILTER, filters, sizeof filters) == 0;
}

static int failed(int can, const char* interface, const char* what) {
  fprintf(stderr, "print_poses: %s: %s: %s\n", interface, what, strerror(errno));
  if (can >= 0) (void)close(can);
  return -1;
}

/* The socket, or -1 after a line that says why. */
static int open_bus(const options* chosen) {
  const char* interface = chosen->interface;
  const int on = 1;
  struct sockaddr_can address;
  memset(&address, 0, sizeof address);
  const int can = socket(AF_CAN, SOCK_RAW, CAN_RAW);
  if (can < 0) return failed(can, interface, "no SocketCAN in this kernel");
  address.can_family = AF_CAN;
  address.can_ifindex = (int)if_nametoindex(interface);
  if (address.can_ifindex == 0) return failed(can, interface, "no such interface");
  if (!filter(can, &chosen->settings)) return failed(can, interface, "cannot filter");
  /* A classic bus, or an old kernel, has neither: then frames are classic, and the time is ours. */
  (void)setsockopt(can, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on);
  (void)setsockopt(can, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  if (bind(can, (const struct sockaddr*)&address, sizeof address) != 0) {
    return failed(can, interface, "cannot listen");
  }
  return can;
}

static int64_t nanoseconds(struct timespec time) {
  return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

static int64_t clock_ns(clockid_t clock) {
  struct timespec now;
  (void)clock_gettime(clock, &now);
  return nanoseconds(now);
}

static uint64_t now_us(void) {
  return (uint64_t)clock_ns(CLOCK_MONOTONIC) / 1000;
}

/* How long ago the kernel had the frame. Its stamp is wall time, which may jump: only a plausible
 * difference counts, and the receiver is given the monotonic time less that. */
static uint64_t waited_us(struct msghdr* message) {
  for (struct cmsghdr* c = CMSG_FIRSTHDR(message); c != NULL; c = CMSG_NXTHDR(message, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_TIMESTAMPNS) continue;
    struct timespec stamp;
    memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
    const int64_t waited = (clock_ns(CLOCK_REALTIME) - nanoseconds(stamp)) / 1000;
    return waited > 0 && waited < 10000000 ? (uint64_t)waited : 0;
  }
  return 0;
}

/* True with a data frame; false with nothing or something else, `errno` then says what. */
static bool read_frame(int can, dottrack_frame* frame, uint64_t* arrival_us) {
  struct canfd_frame raw;
  union {
    struct cmsghdr head;
    char bytes[CMSG_SPACE(sizeof(struct timespec))];
  } control;
  struct iovec part = {.iov_base = &raw, .iov_len = sizeof raw};
  struct msghdr message = {
      .msg_iov = &part, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof control};
  errno = 0;
  const ssize_t size = recvmsg(can, &message, 0);
  const bool whole = size == (ssize_t)CAN_MTU || size == (ssize_t)CANFD_MTU;
  if (!whole || raw.len > sizeof frame->data || (raw.can_id & (CAN_RTR_FLAG | CAN_ERR_FLAG)) != 0) {
    return false;
  }
  const uint64_t now = now_us();
  const uint64_t waited = waited_us(&message);
  *arrival_us = waited < now ? now - waited : now;
  memset(frame, 0, sizeof *frame);
  frame->extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame->id = raw.can_id & (frame->extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame->length = raw.len;
  memcpy(frame->data, raw.data, raw.len);
  return true;
}

/* Square root of a variance in mm or mrad, without the mathematics library. */
static double thousandth_root(double variance) {
  double root = variance > 1.0 ? variance : 1.0;
  for (int i = 0; i < 60; ++i) root = 0.5 * (root + variance / root);
  return root * 1000.0;
}

static void print_pose(dottrack_verdict verdict, const dottrack_pose* pose) {
  const double* p = pose->position_m;
  const double* q = pose->orientation_wxyz;
  printf("%-10s %3u %-9s age %6.1f ms", dottrack_verdict_text(verdict), pose->sequence,
         dottrack_state_text(pose->state), pose->age_us / 1000.0);
  if (pose->valid) {
    printf("  x %9.4f y %9.4f z %9.4f m  q %8.5f %8.5f %8.5f %8.5f", p[0], p[1], p[2], q[0], q[1],
           q[2], q[3]);
  } else {
    printf("  no pose: %s",
           pose->out_of_range ? "out_of_range" : dottrack_reason_text(pose->reason));
  }
  if (pose->has_covariance) {
    printf("  sigma");
    for (int i = 0; i < 6; ++i) printf(" %.2f", thousandth_root(pose->covariance[7 * i]));
    printf(" mm mrad");
  }
  for (unsigned bit = 0; bit < 16; ++bit) {
    if ((pose->degraded >> bit & 1) != 0) printf(" %s", dottrack_degraded_text(bit));
  }
  printf("%s\n", pose->restarted ? " restarted" : "");
}

/* A line for each group and each fault; gives the number of groups. */
static unsigned long report(dottrack_verdict verdict, bool whole_group, const dottrack_pose* pose) {
  if (verdict == DOTTRACK_FOREIGN || verdict == DOTTRACK_WAITING) return 0;
  if (whole_group) {
    print_pose(verdict, pose);
  } else {
    printf("%s\n", dottrack_verdict_text(verdict));
  }
  (void)fflush(stdout);
  return whole_group ? 1 : 0;
}

static int listen_to(int can, const options* chosen) {
  dottrack_receiver receiver;
  dottrack_pose pose;
  dottrack_frame frame;
  uint64_t arrival_us = 0;
  unsigned long groups = 0;
  bool was_stale = false;
  dottrack_receiver_init(&receiver, &chosen->settings);
  while (stopped == 0 && (chosen->groups == 0 || groups < chosen->groups)) {
    struct pollfd waiting = {.fd = can, .events = POLLIN};
    const int ready = poll(&waiting, 1, POLL_MS);
    if (ready > 0 && read_frame(can, &frame, &arrival_us)) {
      const uint64_t before = receiver.counts.fresh + receiver.counts.stale;
      const dottrack_verdict verdict = dottrack_receiver_push(&receiver, &frame, arrival_us, &pose);
      const bool whole_group = receiver.counts.fresh + receiver.counts.stale != before;
      groups += report(verdict, whole_group, &pose);
      if (verdict == DOTTRACK_FRESH) was_stale = false;
    } else if (ready != 0 && errno != 0 && errno != EINTR) {
      (void)failed(-1, chosen->interface, "cannot read");
      return 1;
    } else {
      const dottrack_verdict verdict = dottrack_receiver_poll(&receiver, now_us());
      /* Nothing fresh: said once, not with every look. */
      if (verdict == DOTTRACK_INCOMPLETE || (verdict == DOTTRACK_STALE && !was_stale)) {
        (void)report(verdict, false, &pose);
      }
      was_stale = was_stale || verdict == DOTTRACK_STALE;
    }
  }
  return 0;
}

int main(int count, char** words) {
  options chosen;
  if (!read_options(count, words, &chosen)) return usage();
  const int can = open_bus(&chosen);
  if (can < 0) return 2;
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = stop;
  (void)sigaction(SIGINT, &action, NULL);
  (void)sigaction(SIGTERM, &action, NULL);
  const int status = listen_to(can, &chosen);
  (void)close(can);
  return status;
}
