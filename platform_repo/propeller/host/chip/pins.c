/* Pins, and the two counters of each cog. A pin is driven where any cog's DIRA says so, high where any such cog's OUTA or counter
 * is high; else the world decides. Counters: NCO, duty and PLL modes make waves, the detectors count. A wave of 20 Hz and more is
 * told as a wave; its single edges are worked out only where a device, a waiting cog or a detector is at that pin. */
#include <math.h>
#include <string.h>
#include "chip.h"

enum { AHEAD = 64, DECAYS = 1024 };
enum { OFF, PLL_INTERNAL, PLL, PLL_BOTH, NCO, NCO_BOTH, DUTY, DUTY_BOTH, HIGH, RISING = 10, LOW = 12, FALLING = 14, DETECTORS_END = 16 };
static const double SLOWEST_WAVE_HZ = 20, FASTEST_EDGES_HZ = 200000;

unsigned watched, asking[3], brief;
static unsigned levels, driven, outside, outside_drives, pulled_up;
static unsigned char shown[PINS];  /* 0, 1, 2 for not driven: as it is */
static unsigned told[3];           /* pins of which each of these levels was told */
static unsigned contacts[PINS];    /* the pins that a contact joins with each */
static unsigned sampled;           /* pins that detectors or waiting cogs look at */
static host_time next_toggle = HOST_NEVER;
static struct { host_time when; int pin, level; } ahead[AHEAD];  /* what the world does at pins later on, in no order */
static int ahead_count;
static host_time next_ahead = HOST_NEVER;
static struct { int pin; double from_us, lasts_us; } decays[DECAYS];  /* how long charges last, by pin and time */
static int decay_count;
static unsigned with_charge, charged;  /* pins at which a charge is kept; those at which there is one, unless it has decayed */
static double falls_us[PINS];

static int mode(const struct counter *counter) { return counter->control >> 26 & 31; }
static unsigned bit(const struct counter *counter) { return 1u << (counter->control & 31); }
static unsigned other_bit(const struct counter *counter) { return 1u << (counter->control >> 9 & 31); }
static int is_nco(const struct counter *counter) { return mode(counter) == NCO || mode(counter) == NCO_BOTH; }
static int is_detector(const struct counter *counter) { return mode(counter) >= HIGH && mode(counter) < DETECTORS_END; }

static double nco_hz(const struct counter *counter) {
  int step = (int)counter->frequency;
  return (step < 0 ? -(double)step : step) * HOST_HZ / 4294967296.0;
}

/* The wave that a counter makes: its frequency, 0 without one, and its duty. */
static double wave_hz(const struct counter *counter, double *duty) {
  double part = counter->frequency / 4294967296.0;
  *duty = 0.5;
  switch (mode(counter)) {
  case NCO: case NCO_BOTH:
    return nco_hz(counter) >= SLOWEST_WAVE_HZ ? nco_hz(counter) : 0;
  case PLL: case PLL_BOTH:
    return nco_hz(counter) * 16 / (1 << (7 - (counter->control >> 23 & 7)));
  case DUTY: case DUTY_BOTH:
    *duty = part;
    return counter->frequency ? HOST_HZ * (part < 0.5 ? part : 1 - part) : 0;
  }
  return 0;
}

static int has_edges(const struct counter *counter) {
  double duty;
  if (!is_nco(counter)) return 0;
  if (wave_hz(counter, &duty) == 0) return 1;
  return ((watched | sampled) & bit(counter)) != 0 && nco_hz(counter) <= FASTEST_EDGES_HZ;
}

static unsigned phase_at(const struct counter *counter, host_time when) {
  unsigned step = 0;
  if (is_nco(counter)) step = counter->frequency;
  else if (mode(counter) == HIGH || mode(counter) == HIGH + 1) step = levels & bit(counter) ? counter->frequency : 0;
  else if (mode(counter) == LOW || mode(counter) == LOW + 1) step = levels & bit(counter) ? 0 : counter->frequency;
  return counter->phase + step * (unsigned)(when - counter->since);
}

static void settle(struct counter *counter, host_time when) {
  counter->phase = phase_at(counter, when);
  counter->since = when;
}

/* When the highest bit of the phase, which is an NCO's output, changes next. */
static host_time toggle_after(const struct counter *counter) {
  int step = (int)counter->frequency;
  unsigned long long phase = counter->phase, half = 1ull << 31, size = step < 0 ? -(long long)step : step, turns;
  if (!step) return HOST_NEVER;
  if (step > 0) turns = ((phase < half ? half : 2 * half) - phase + size - 1) / size;
  else turns = (phase < half ? phase : phase - half) / size + 1;
  return counter->since + turns;
}

static void plan(struct counter *counter) {
  counter->level = is_nco(counter) ? counter->phase >> 31 : 0;
  counter->toggles = has_edges(counter) ? toggle_after(counter) : HOST_NEVER;
}

static void plan_all(void) {
  next_toggle = HOST_NEVER;
  for (int i = 0; i < COGS; i++)
    for (int k = 0; k < 2 && cogs[i].used; k++)
      if (cogs[i].counter[k].toggles < next_toggle && cogs[i].counter[k].control) next_toggle = cogs[i].counter[k].toggles;
}

host_time pins_next(void) { return next_toggle; }

void pins_advance(host_time when) {
  for (int i = 0; i < COGS; i++)
    for (int k = 0; k < 2 && cogs[i].used; k++) {
      struct counter *counter = &cogs[i].counter[k];
      if (!counter->control || counter->toggles > when) continue;
      settle(counter, when);
      plan(counter);
    }
  plan_all();
  pins_update(when);
}

static unsigned counters_out(const struct cog *cog, host_time when, int all) {
  unsigned out = 0;
  for (int k = 0; k < 2; k++) {
    const struct counter *counter = &cog->counter[k];
    if (!is_nco(counter) || !(all || has_edges(counter))) continue;
    int level = all ? (int)(phase_at(counter, when) >> 31) : counter->level;
    if (level) out |= bit(counter);
    else if (mode(counter) == NCO_BOTH) out |= other_bit(counter);
  }
  return out;
}

static void pack(double hz, double duty, unsigned bits[2]) {
  float values[2] = {(float)hz, (float)duty};
  memcpy(bits, values, sizeof values);
}

static void announce(struct cog *cog, struct counter *counter, host_time when) {
  static const unsigned silence[2];
  unsigned bits[2];
  int pin = counter->control & 31;
  double duty, hz = wave_hz(counter, &duty);
  pack(hz, duty, bits);
  int now = hz > 0 && cog->dir & bit(counter) ? (int)(bits[0] ^ bits[1]) | 1 : 0, moved = pin != counter->announced_pin;
  if (now == counter->announced && !(now && moved)) return;
  if (counter->announced && (!now || moved)) link_record(when, RECORD_WAVE, counter->announced_pin, silence[0], silence[1]);
  if (now) link_record(when, RECORD_WAVE, pin, bits[0], bits[1]);
  counter->announced = now;
  counter->announced_pin = pin;
}

static int wakes(const struct cog *cog) { return ((levels & cog->wait_mask) == cog->wait_state) == cog->wait_equal; }

static void set_levels(unsigned now, host_time when) {
  unsigned changed = levels ^ now;
  if (!changed) return;
  for (int i = 0; i < COGS; i++)
    for (int k = 0; k < 2 && cogs[i].used; k++) {
      struct counter *counter = &cogs[i].counter[k];
      if (!is_detector(counter) || !(changed & bit(counter))) continue;
      settle(counter, when);
      int kind = mode(counter) & ~1, rises = (now & bit(counter)) != 0;
      if ((kind == RISING && rises) || (kind == FALLING && !rises)) counter->phase += counter->frequency;
    }
  levels = now;
  for (int i = 0; i < COGS; i++)
    if (cogs[i].used && cogs[i].wait_mask && wakes(&cogs[i])) cogs_wake(&cogs[i], when);
}

/* What is at the pins that the program does not drive: what it drives at the other end of a contact, else what the world drives. */
static unsigned from_outside(unsigned out) {
  unsigned found = (outside & outside_drives) | (pulled_up & ~outside_drives);
  for (int pin = 0; pin < PINS; pin++)
    if (contacts[pin] & driven) found = (found & ~(1u << pin)) | (contacts[pin] & driven & out ? 1u << pin : 0);
  return found;
}

static void charge(int pin, int level, host_time when);

void pins_update(host_time when) {
  unsigned out = 0;
  driven = 0;
  for (int i = 0; i < COGS; i++) {
    if (!cogs[i].used) continue;
    driven |= cogs[i].dir;
    out |= (cogs[i].out | counters_out(&cogs[i], when, 0)) & cogs[i].dir;
  }
  set_levels((driven & out) | (~driven & from_outside(out)), when);
  for (int pin = 0; pin < PINS; pin++) {
    int level = driven >> pin & 1 ? (int)(out >> pin & 1) : 2;
    if (level == shown[pin]) continue;
    shown[pin] = level;
    if (with_charge >> pin & 1) charge(pin, level, when);
    if (brief & told[level] & 1u << pin) continue;
    told[level] |= 1u << pin;
    if (asking[level] >> pin & 1) link_sync(when, RECORD_PIN, pin, level);
    else link_record(when, RECORD_PIN, pin, level, 0);
  }
}

void pins_begin(void) { memset(shown, 2, sizeof shown); }

/* Forgets what is said ahead of a pin, of any if it is negative, that is due by then. */
static void forget_ahead(int pin, host_time until) {
  int kept = 0;
  next_ahead = HOST_NEVER;
  for (int i = 0; i < ahead_count; i++) {
    if ((pin < 0 || ahead[i].pin == pin) && ahead[i].when <= until) continue;
    if (ahead[i].when < next_ahead) next_ahead = ahead[i].when;
    ahead[kept++] = ahead[i];
  }
  ahead_count = kept;
}

static void drive_outside(int pin, int level, host_time when) {
  unsigned mask = 1u << pin;
  outside_drives = level == 2 ? outside_drives & ~mask : outside_drives | mask;
  outside = level == 1 ? outside | mask : outside & ~mask;
  set_levels((levels & driven) | (~driven & from_outside(levels)), when);
}

void pins_pull(int pin, int up, host_time when) {
  pulled_up = up ? pulled_up | 1u << pin : pulled_up & ~(1u << pin);
  set_levels((levels & driven) | (~driven & from_outside(levels)), when);
}

void pins_outside(int pin, int level, host_time when) {
  if (ahead_count) forget_ahead(pin, HOST_NEVER);
  drive_outside(pin, level, when);
}

void pins_outside_ahead(int pin, int level, host_time due) {
  if (ahead_count == AHEAD) host_unmodelled("a device that plans too many levels ahead");
  ahead[ahead_count].when = due;
  ahead[ahead_count].pin = pin;
  ahead[ahead_count++].level = level;
  if (due < next_ahead) next_ahead = due;
}

host_time pins_ahead(void) { return next_ahead; }

void pins_reach(host_time when) {
  for (int i = 0; i < ahead_count; i++)
    if (ahead[i].when <= when) drive_outside(ahead[i].pin, ahead[i].level, when);
  forget_ahead(-1, when);
}

void pins_contact(int pin, int other, int closed, host_time when) {
  unsigned bits[2] = {1u << pin, 1u << other};
  contacts[pin] = closed ? contacts[pin] | bits[1] : contacts[pin] & ~bits[1];
  contacts[other] = closed ? contacts[other] | bits[0] : contacts[other] & ~bits[0];
  set_levels((levels & driven) | (~driven & from_outside(levels)), when);
}

void pins_decay(int pin, double from_us, double lasts_us) {
  if (decay_count == DECAYS) host_unmodelled("a charge that lasts differently so many times");
  with_charge |= 1u << pin;
  decays[decay_count].pin = pin;
  decays[decay_count].from_us = from_us;
  decays[decay_count++].lasts_us = lasts_us;
}

/* How long a charge lasts that begins to decay now. */
static double lasts_us(int pin, double now_us) {
  double found = 0;
  int any = 0;
  for (int i = 0; i < decay_count; i++) {
    if (decays[i].pin != pin) continue;
    if (any && decays[i].from_us > now_us) break;
    found = decays[i].lasts_us;
    any = 1;
  }
  return found;
}

/* A capacitor at a pin: a high output charges it, a low one discharges it, and it decays once the pin is let go. */
static void charge(int pin, int level, host_time when) {
  unsigned mask = 1u << pin;
  double now_us = when * 1e6 / HOST_HZ;
  int full = level == 2 ? charged & mask && now_us < falls_us[pin] : level;
  charged = full ? charged | mask : charged & ~mask;
  falls_us[pin] = HUGE_VAL;
  if (level != 2) pins_outside(pin, level, when);
  else if (full) {
    falls_us[pin] = now_us + lasts_us(pin, now_us);
    host_time due = (host_time)llrint(falls_us[pin] * HOST_HZ / 1e6);
    if (due > when) pins_outside_ahead(pin, 0, due);
    else pins_outside(pin, 0, when);
  }
  cogs_look();
}

int host_outside_level(int pin) { return outside_drives >> pin & 1 ? (int)(outside >> pin & 1) : 2; }

static void sample(unsigned mask) {
  if ((sampled | mask) == sampled) return;
  sampled |= mask;
  for (int i = 0; i < COGS; i++)
    for (int k = 0; k < 2 && cogs[i].used; k++) {
      struct counter *counter = &cogs[i].counter[k];
      if (!is_nco(counter) || counter->toggles != HOST_NEVER) continue;
      settle(counter, cogs[running].now);
      plan(counter);
    }
  plan_all();
}

static int commit_counter(struct cog *cog, int k) {
  struct counter *counter = &cog->counter[k];
  unsigned control = cog->registers[HOST_CTRA + k], frequency = cog->registers[HOST_FRQA + k];
  unsigned phase = cog->registers[HOST_PHSA + k];
  int written = phase != cog->phase_shown[k];
  if (control == counter->control && frequency == counter->frequency && !written) return 0;
  settle(counter, cog->now);
  if (written) counter->phase = cog->phase_shown[k] = phase;
  counter->control = control;
  counter->frequency = frequency;
  if (mode(counter) >= DETECTORS_END) host_unmodelled(k ? "CTRB in a logic mode" : "CTRA in a logic mode");
  if (is_detector(counter)) sample(bit(counter));
  plan(counter);
  return 1;
}

void pins_commit(void) {
  struct cog *cog = &cogs[running];
  unsigned *registers = cog->registers;
  int changed = registers[HOST_OUTA] != cog->out || registers[HOST_DIRA] != cog->dir;
  cog->out = registers[HOST_OUTA];
  cog->dir = registers[HOST_DIRA];
  for (int k = 0; k < 2; k++)
    if (registers[HOST_CTRA + k] || cog->counter[k].control || registers[HOST_FRQA + k] != cog->counter[k].frequency ||
        registers[HOST_PHSA + k] != cog->phase_shown[k])
      changed |= commit_counter(cog, k);
  if (!changed) return;
  for (int k = 0; k < 2; k++)
    if (cog->counter[k].announced || cog->counter[k].control) announce(cog, &cog->counter[k], cog->now);
  plan_all();
  pins_update(cog->now);
  cogs_look();
}

void pins_cog_stopped(struct cog *cog) {
  host_time when = cogs[running].now < cog->now || cog->now == HOST_NEVER ? cogs[running].now : cog->now;
  cog->dir = 0;
  for (int k = 0; k < 2; k++) {
    cog->counter[k].control = 0;
    if (cog->counter[k].announced) announce(cog, &cog->counter[k], when);
  }
  plan_all();
  pins_update(when);
}

volatile unsigned *host_register(int which) {
  struct cog *cog = &cogs[running];
  pins_commit();
  for (int k = 0; k < 2; k++) {
    if (which == HOST_PHSA + k) cog->registers[which] = cog->phase_shown[k] = phase_at(&cog->counter[k], cog->now);
  }
  return &cog->registers[which];
}

unsigned pins_levels(void) {
  unsigned waves = 0;
  for (int i = 0; i < COGS; i++)
    if (cogs[i].used) waves |= counters_out(&cogs[i], cogs[running].now, 1) & cogs[i].dir;
  return levels | waves;
}

unsigned host_pins(void) {
  pins_commit();
  return pins_levels();
}

int host_wait_pins(unsigned mask, unsigned state, int equal, host_time limit) {
  struct cog *cog = &cogs[running];
  pins_commit();
  sample(mask);
  if (((levels & mask) == state) == equal) return 1;
  cog->wait_state = state;
  cog->wait_equal = equal;
  cog->wait_mask = mask;
  if (limit > cog->now) cog->now = limit;
  cogs_reschedule();
  cog->wait_mask = 0;
  return ((levels & mask) == state) == equal;
}
