/* The pipe to the world: records of what happens go out, what the world does comes in. The world (devices at the pins, typed text)
 * is played at the other end; the run goes on to the next time at which the world acts, or to a change at a watched pin.
 * Out: records of 24 bytes {time, kind, three values}, and at the end a text and the coverage counters.
 * In: settings; then, after each record that asks, commands of 16 bytes {kind, two values} up to GO. A DECAY has 16 bytes more. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>
#include "chip.h"

struct settings settings;

struct record_out { unsigned long long when; unsigned kind, a, b, c; };
struct command_in { int kind, a; long long b; };
struct settings_in {
  unsigned long long horizon, next_wake, most_records, calls_from;
  double block_factor, call_factor, noise, late_us, early_part, line_part, clock_us;
  unsigned block_ticks, call_ticks, watched, asking[3], brief, seed;
};
enum { GO, LEVEL, VOLTAGE, TYPED, JOIN, PART, LEVEL_AHEAD, DECAY };

static struct record_out buffer[1024];
static int filled;
static unsigned long long written, most_records;
static int millivolts[CHANNELS];
static unsigned char typed[65536];
static unsigned typed_first, typed_last;
static unsigned long long noise_state, random_state;

static void put(const void *data, unsigned size) {
  for (const char *at = data; size;) {
    long done = write(1, at, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) syscall(SYS_exit, 1);
    at += done;
    size -= done;
  }
}

static void get(void *data, unsigned size) {
  for (char *at = data; size;) {
    long done = read(0, at, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) syscall(SYS_exit, 1);
    at += done;
    size -= done;
  }
}

static void flush(void) {
  put(buffer, filled * sizeof *buffer);
  filled = 0;
}

void link_open(void) {
  struct settings_in in;
  get(&in, sizeof in);
  horizon = in.horizon;
  next_wake = in.next_wake;
  most_records = in.most_records;
  watched = in.watched;
  memcpy(asking, in.asking, sizeof asking);
  brief = in.brief;
  settings.block_ticks = in.block_ticks * in.block_factor;
  settings.call_ticks = in.call_ticks * in.call_factor;
  settings.noise = in.noise;
  settings.late_us = in.late_us;
  settings.calls_from = in.calls_from;
  settings.early_part = in.early_part;
  settings.line_part = in.line_part;
  settings.clock_us = in.clock_us;
  noise_state = in.seed * 2654435761ull + 88172645463325252ull;
  random_state = in.seed + 1;
}

static void end(const char *status, const char *cause, int with_counters);

void link_record(host_time when, enum record kind, unsigned a, unsigned b, unsigned c) {
  if (++written > most_records) end("output limit", "", 1);
  buffer[filled++] = (struct record_out){when, kind, a, b, c};
  if (filled == sizeof buffer / sizeof *buffer) flush();
}

static int obey(host_time when) {
  struct command_in command;
  double decay[2];
  for (;;) {
    get(&command, sizeof command);
    switch (command.kind) {
    case LEVEL: pins_outside(command.a, (int)command.b, when); break;
    case LEVEL_AHEAD: pins_outside_ahead(command.a & 31, command.a >> 5, command.b); break;
    case DECAY:
      get(decay, sizeof decay);
      pins_decay(command.a, decay[0], decay[1]);
      break;
    case JOIN: case PART: pins_contact(command.a, (int)command.b, command.kind == JOIN, when); break;
    case VOLTAGE: millivolts[command.a] = (int)command.b; break;
    case TYPED:
      typed[typed_last++ % sizeof typed] = command.a;
      for (int i = 0; i < COGS; i++)
        if (cogs[i].used && cogs[i].wait_console) cogs_wake(&cogs[i], when);
      break;
    default:
      next_wake = command.b;
      return command.a;
    }
  }
}

int link_sync(host_time when, enum record kind, unsigned a, unsigned b) {
  link_record(when, kind, a, b, 0);
  flush();
  int value = obey(when);
  cogs_look();
  return value;
}

/* ---- noise: xorshift, repeatable from the seed */

double link_noise(void) {
  noise_state ^= noise_state << 13;
  noise_state ^= noise_state >> 7;
  noise_state ^= noise_state << 17;
  return (double)(noise_state >> 11) / (1ull << 52) - 1;
}

unsigned host_random(void) {
  random_state = random_state * 6364136223846793005ull + 1442695040888963407ull;
  return random_state >> 49;
}

/* ---- what the chip's parts ask */

void host_console_write(int byte) {
  tell_call(__builtin_frame_address(0), 1);
  link_record(host_now(), RECORD_CONSOLE, byte & 0xFF, running, 0);
}

int host_console_read(host_time limit) {
  struct cog *cog = &cogs[running];
  pins_commit();
  if (typed_first == typed_last) {
    cog->wait_console = 1;
    if (limit > cog->now) cog->now = limit;
    cogs_reschedule();
    cog->wait_console = 0;
  }
  return typed_first == typed_last ? -1 : typed[typed_first++ % sizeof typed];
}

int host_millivolts(int channel) { return channel >= 0 && channel < CHANNELS ? millivolts[channel] : 0; }

void host_aims(int pin, int aim) { link_record(host_now(), RECORD_AIM, pin & 31, aim, 0); }

int host_bus(int scl, int sda) { return (scl & 31) << 5 | (sda & 31); }
int host_bus_start(int bus, int address, int read) { return link_sync(host_now(), RECORD_BUS_START, bus, (address & 0x7F) << 1 | !!read); }
int host_bus_write(int bus, int byte) { return link_sync(host_now(), RECORD_BUS_WRITE, bus, byte & 0xFF); }
int host_bus_read(int bus) { return link_sync(host_now(), RECORD_BUS_READ, bus, 0); }
void host_bus_stop(int bus) { link_sync(host_now(), RECORD_BUS_STOP, bus, 0); }

/* ---- the end */

/* The static data of the user's program, coverage counters among them: its section is named so when it is linked. */
extern char __start_program_data[] __attribute__((weak)), __stop_program_data[] __attribute__((weak));

static void end(const char *status, const char *cause, int with_counters) {
  static int ending;
  if (!ending++) pins_commit();  /* what was written last is seen, too */
  host_time when = cogs[running].now < horizon ? cogs[running].now : horizon;
  unsigned size = with_counters ? __stop_program_data - __start_program_data : 0;
  if (ending == 1) compared_tell(when);
  if (filled == sizeof buffer / sizeof *buffer) flush();
  buffer[filled++] = (struct record_out){when, RECORD_END, strlen(status), strlen(cause), size};
  flush();
  put(status, strlen(status));
  put(cause, strlen(cause));
  put(__start_program_data, size);
  syscall(SYS_exit, 0);
  for (;;) {}
}

void host_end(const char *status, const char *cause) {
  end(status, cause, 1);
  for (;;) {}
}

void host_unmodelled(const char *name) { host_end("unmodelled", name); }
