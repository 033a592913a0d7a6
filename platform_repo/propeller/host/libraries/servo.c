/* servo.h: a cog makes a pulse for each of up to 14 servos every 20 ms, two at a time in windows of 2.5 ms. Source: libservo/servo.c. */
#include "servo.h"

enum { PLACES = 14, WINDOW_TICKS = 2500 * HOST_TICKS_PER_US, NO_RAMP = 2000 };
static volatile struct { int used, pin, asked, sent, step; } servos[PLACES];
static volatile int servo_cog;

static int place_of(int pin) {
  for (int i = 0; i < PLACES; i++)
    if (servos[i].used && servos[i].pin == pin) return i;
  return -1;
}

static void pulse(int counter, int pin, int microseconds) {
  *host_register(HOST_CTRA + counter) = 0;
  *host_register(HOST_FRQA + counter) = 1;
  *host_register(HOST_PHSA + counter) = 0;
  *host_register(HOST_CTRA + counter) = 4u << 26 | (pin & 31);
  DIRA |= 1u << (pin & 31);
  *host_register(HOST_PHSA + counter) = -microseconds * HOST_TICKS_PER_US;
}

static void frames(void *unused) {
  (void)unused;
  host_time window = host_now();
  for (;;) {
    for (int i = 0; i < PLACES; i++) {
      if (servos[i].used && servos[i].asked == 0) {
        DIRA &= ~(1u << (servos[i].pin & 31));
        servos[i].used = 0;
      }
      if (servos[i].used) {
        int missing = servos[i].asked - servos[i].sent, step = servos[i].step;
        if (missing > step) missing = step;
        if (missing < -step) missing = -step;
        servos[i].sent += missing;
        pulse(i % 2, servos[i].pin, servos[i].sent);
      }
      if (i % 2) host_sleep_until(window += WINDOW_TICKS);
    }
    host_sleep_until(window += WINDOW_TICKS);
  }
}

int servo_set(int pin, int time) {
  host_call();
  if (!servo_cog) servo_cog = host_start(frames, 0, -1) + 1;
  if (!servo_cog) return -1;
  int place = place_of(pin);
  if (place >= 0) {
    servos[place].asked = time;
    return 1;
  }
  for (place = 0; place < PLACES && servos[place].used; place++) {}
  if (place == PLACES) return -3;
  servos[place].pin = pin;
  servos[place].asked = servos[place].sent = time;
  servos[place].step = NO_RAMP;
  servos[place].used = 1;
  return pin;
}

int servo_angle(int pin, int degreeTenths) { return servo_set(pin, degreeTenths + 500); }

int servo_speed(int pin, int speed) { return servo_set(pin, speed + 1500); }

int servo_setramp(int pin, int stepSize) {
  host_call();
  int place = place_of(pin);
  if (place < 0) return -4;
  servos[place].step = stepSize;
  return pin;
}

int servo_get(int pin) {
  host_call();
  int place = place_of(pin);
  return place < 0 ? -4 : servos[place].sent;
}

int servo_disable(int pin) { return servo_set(pin, 0); }

void servo_stop(void) {
  host_call();
  if (servo_cog) host_stop(servo_cog - 1);
  servo_cog = 0;
}
