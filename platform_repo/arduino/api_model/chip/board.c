/* The board of a program that is judged at the Arduino API, on the simulated chip of the Propeller's host model (../../../propeller/host):
 * its first cog is the program, others are what a board has beside: the timer of servos, that of tones, and the interrupts of pins. */
#include <string.h>
#include "chip.h"
#include "board.h"

enum { PROGRAM, SERVO_TIMER, TONE_TIMER, INTERRUPTS, FIRST_TASK };
static const host_time FRAME = 20000ull * HOST_TICKS_PER_US;

extern int main(void);
/* It runs before the constructors of the program, which it runs itself: they may use pins. */
__attribute__((section(".preinit_array"), used)) static int (*const first)(void) = main;

static host_time tick(uint64_t us) { return us * HOST_TICKS_PER_US; }

/* Let a part of the board go on now, whatever it waits for; the first time it begins. */
static void wake(int number, void (*part)(void *)) {
  if (!cogs[number].used) host_start(part, 0, number);
  cogs_wake(&cogs[number], host_now());
}

/* ---- time */

uint64_t board_now(void) {
  host_call();
  return host_now() / HOST_TICKS_PER_US;
}

void board_sleep_until(uint64_t us) { host_sleep_until(tick(us)); }
void board_spend(uint32_t us) { host_spend(tick(us)); }

/* ---- pins */

static void drive(int pin, int level) {
  struct cog *cog = &cogs[PROGRAM];
  unsigned mask = 1u << pin;
  cog->dir = level == BOARD_LET_GO ? cog->dir & ~mask : cog->dir | mask;
  if (level != BOARD_LET_GO) cog->out = level ? cog->out | mask : cog->out & ~mask;
  cog->registers[HOST_OUTA] = cog->out;
  cog->registers[HOST_DIRA] = cog->dir;
  pins_update(host_now());
  cogs_look();
}

void board_drive(int32_t pin, int32_t level) {
  host_call();
  drive(pin, level);
}

void board_pull_up(int32_t pin, int32_t up) { pins_pull(pin, up, host_now()); }

int32_t board_level(int32_t pin) {
  host_call();
  return pins_levels() >> pin & 1;
}

int32_t board_millivolts(int32_t channel) { return host_millivolts(channel); }

void board_wave(int32_t pin, float hz, float duty) {
  unsigned bits[2];
  memcpy(bits, &hz, sizeof hz);
  memcpy(bits + 1, &duty, sizeof duty);
  link_record(host_now(), RECORD_WAVE, pin, bits[0], bits[1]);
}

/* ---- tones, one at a time */

static int tone_pin = -1;
static host_time tone_ends = HOST_NEVER;

static void end_tone(void) {
  if (tone_pin >= 0) board_wave(tone_pin, 0, 0);
  tone_pin = -1;
  tone_ends = HOST_NEVER;
}

static void time_tones(void *unused) {
  (void)unused;
  for (;;) {
    if (host_now() >= tone_ends) end_tone();
    host_sleep_until(tone_ends);
  }
}

void board_tone(int32_t pin, uint32_t hz, uint32_t ms) {
  host_call();
  if (pin != tone_pin && (hz == 0 || tone_pin >= 0)) {
    if (hz == 0) return;
    end_tone();
  }
  if (hz == 0) {
    end_tone();
    return;
  }
  drive(pin, BOARD_LOW);
  board_wave(pin, hz, 0.5f);
  tone_pin = pin;
  tone_ends = ms ? host_now() + tick(1000ull * ms) : HOST_NEVER;
  wake(TONE_TIMER, time_tones);
}

/* ---- servos: their pulses come one after the other, at the beginning of a frame */

static int servo_us[PINS], servos_rest = 1;

static void make_frames(void *unused) {
  (void)unused;
  for (;;) {
    host_time begun = host_now();
    int any = 0;
    for (int pin = 0; pin < PINS; pin++) {
      if (!servo_us[pin]) continue;
      any = 1;
      host_time ends = host_now() + tick(servo_us[pin]);
      drive(pin, BOARD_HIGH);
      host_sleep_until(ends);
      drive(pin, BOARD_LOW);
    }
    servos_rest = !any;
    host_sleep_until(any ? begun + FRAME : HOST_NEVER);
  }
}

void board_servo(int32_t pin, int32_t us) {
  host_call();
  if (us && !servo_us[pin]) drive(pin, BOARD_LOW);
  servo_us[pin] = us;
  if (us && servos_rest) {
    servos_rest = 0;
    wake(SERVO_TIMER, make_frames);
  }
}

/* ---- interrupts of pins: a handler runs beside the program, which goes on meanwhile */

static struct { void (*handler)(void *); void *argument; int falls, rises; } handlers[PINS];
static unsigned watched_for, before;
static int interrupts_off;

static void serve(void *unused) {
  (void)unused;
  for (;;) {
    host_wait_pins(watched_for, before & watched_for, 0, HOST_NEVER);
    while (interrupts_off) host_sleep_until(host_now() + HOST_TICKS_PER_US);
    unsigned now = pins_levels(), changed = (now ^ before) & watched_for;
    before = (before & ~watched_for) | (now & watched_for);
    for (int pin = 0; pin < PINS; pin++)
      if (changed >> pin & 1 && handlers[pin].handler && (now >> pin & 1 ? handlers[pin].rises : handlers[pin].falls))
        handlers[pin].handler(handlers[pin].argument);
  }
}

void board_attach(int32_t pin, void (*handler)(void *), void *argument, int32_t falls, int32_t rises) {
  unsigned mask = 1u << pin;
  host_call();
  handlers[pin].handler = handler;
  handlers[pin].argument = argument;
  handlers[pin].falls = falls;
  handlers[pin].rises = rises;
  watched_for = handler ? watched_for | mask : watched_for & ~mask;
  before = (before & ~mask) | (pins_levels() & mask);
  if (running != INTERRUPTS) wake(INTERRUPTS, serve);
}

void board_interrupts(int32_t on) { interrupts_off = !on; }

/* ---- tasks of the system that some cores have */

void board_task(void (*task)(void *), void *argument) {
  static int next = FIRST_TASK;
  if (next == COGS) board_lacks("so many tasks");
  host_start(task, argument, next++);
}

/* ---- console and two-wire bus */

void board_put(int32_t byte) { host_console_write(byte); }

int32_t board_get(void) {
  host_call();
  return host_console_read(0);
}

int32_t board_bus_start(int32_t scl, int32_t sda, int32_t address, int32_t read) {
  return host_bus_start(host_bus(scl, sda), address, read);
}
int32_t board_bus_write(int32_t scl, int32_t sda, int32_t byte) { return host_bus_write(host_bus(scl, sda), byte); }
int32_t board_bus_read(int32_t scl, int32_t sda) { return host_bus_read(host_bus(scl, sda)); }
void board_bus_stop(int32_t scl, int32_t sda) { host_bus_stop(host_bus(scl, sda)); }

void board_lacks(const char *name) { host_unmodelled(name); }
